rule curves:
    """Solve every curve of one figure."""
    input:
        plan=planned("curves_{figure}", "solve", "figures/shared/curves", "figures/{figure}/curves.py",
            "printed",
            settings=lambda figure: {key: FIGURES[figure][key] for key in ("settings", "nodes")},
            reads=lambda figure: FIGURES[figure]["tables"]),
        tables=of_figure("tables"),
    output:
        table="results/curves/{figure}.csv",
        record="results/records/curves_{figure}.json",
    log:
        "results/logs/curves_{figure}.log",
    priority: priority
    resources:
        timed=lambda wildcards: int(wildcards.figure in TIMED),
    message:
        "Solving {wildcards.figure}"
    conda:
        "../envs/planarimpact.yaml"
    script:
        "../scripts/solve.py"
