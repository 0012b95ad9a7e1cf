rule compare:
    """Compare a figure's curves, a scene or the study with reference data; always succeeds."""
    input:
        modules=modules("compare"),
        table=of_judged("table"),
        series=of_judged("series"),
    output:
        verdicts="results/verdicts/{judged}.csv",
        residuals="results/residuals/{judged}.csv",
    params:
        comparisons=of_judged("comparisons"),
        references=of_judged("references"),
        sources=of_judged("sources"),
        significance=config["significance"],
    log:
        "results/logs/compare_{judged}.log",
    benchmark:
        "results/benchmarks/compare_{judged}.tsv"
    message:
        "Comparing {wildcards.judged} with references"
    conda:
        "../envs/planarimpact.yaml"
    script:
        "../scripts/compare.py"


rule verdicts:
    """One table of all verdicts, worst first."""
    input:
        modules=modules("gather_verdicts"),
        verdicts=expand("results/verdicts/{judged}.csv", judged=JUDGED),
    output:
        "results/verdicts.csv",
    log:
        "results/logs/verdicts.log",
    benchmark:
        "results/benchmarks/verdicts.tsv"
    message:
        "Gathering the verdicts"
    conda:
        "../envs/planarimpact.yaml"
    script:
        "../scripts/gather_verdicts.py"


rule sensitivity:
    """Find the smallest change of each group that the comparisons of one figure catch."""
    input:
        modules=of_figure("sensitivity"),
        tables=of_figure("tables"),
        curves="results/curves/{figure}.csv",
        series=of_judged("series", "figure"),
    output:
        "results/sensitivity/{figure}.csv",
    params:
        settings=of_figure("settings"),
        nodes=of_figure("nodes"),
        judged=lambda wildcards: JUDGED[wildcards.figure],
        significance=config["significance"],
    log:
        "results/logs/sensitivity_{figure}.log",
    benchmark:
        "results/benchmarks/sensitivity_{figure}.tsv"
    message:
        "Finding what the comparisons of {wildcards.figure} catch"
    conda:
        "../envs/planarimpact.yaml"
    script:
        "../scripts/sensitivity.py"


rule gather_sensitivity:
    """One table of the smallest change that each comparison catches."""
    input:
        modules=modules("gather_sensitivity"),
        parts=expand("results/sensitivity/{figure}.csv", figure=FIGURES),
    output:
        "results/sensitivity.csv",
    log:
        "results/logs/gather_sensitivity.log",
    benchmark:
        "results/benchmarks/gather_sensitivity.tsv"
    message:
        "Gathering what the comparisons catch"
    conda:
        "../envs/planarimpact.yaml"
    script:
        "../scripts/gather_sensitivity.py"


# Every rule whose files a run makes: the gate asks for all of them, wanted by others or not.
MAKERS = [
    rules.curves,
    rules.series,
    rules.draw,
    rules.compare,
    rules.verdicts,
    rules.sensitivity,
    rules.gather_sensitivity,
    rules.ledger,
    rules.ledger_page,
    rules.letter,
    rules.trade,
    rules.stability,
    rules.scene,
    rules.solve_chunk,
    rules.gather_chunks,
    rules.draw_study,
    rules.notebook,
    rules.explorer,
    rules.interface,
    rules.report,
]


MADE = expand([f"{path}" for maker in MAKERS for path in maker.output], **VALUES)


rule gate:
    """Fail the run if a row diverges, no longer holds or is missing, or if a file is not whole.

    Runs after everything else is written.
    """
    input:
        modules=modules("gate"),
        verdicts="results/verdicts.csv",
        ledger="results/ledger.csv",
        page="figures/report.html",
        problems="results/problems.csv",
        residuals=expand("results/residuals/{judged}.csv", judged=JUDGED),
        made=MADE,
    output:
        "results/PASSED",
    params:
        comparisons=EXPECTED_ROWS,
        entries=EXPECTED_ENTRIES,
        config=config,
    log:
        "results/logs/gate.log",
    benchmark:
        "results/benchmarks/gate.tsv"
    message:
        "Judging"
    conda:
        "../envs/planarimpact.yaml"
    script:
        "../scripts/gate.py"
