rule curves:
    """Solve every curve of one figure."""
    input:
        modules=of_figure("solver"),
        tables=of_figure("tables"),
    output:
        "results/curves/{figure}.csv",
    params:
        settings=of_figure("settings"),
        nodes=of_figure("nodes"),
    log:
        "results/logs/curves_{figure}.log",
    benchmark:
        "results/benchmarks/curves_{figure}.tsv"
    threads: cores_reserved
    message:
        "Solving {wildcards.figure}"
    conda:
        "../envs/planarimpact.yaml"
    script:
        "../scripts/solve.py"
