rule compare:
    """Compare the curves of one figure with reference data; always succeeds."""
    input:
        modules=run_plan.modules("compare"),
        curves="results/curves/{figure}.csv",
        series=compared_series,
    output:
        verdicts="results/verdicts/{figure}.csv",
        residuals="results/residuals/{figure}.csv",
    params:
        comparisons=comparisons,
        references=references,
        sources=compared_sources,
    log:
        "results/logs/compare_{figure}.log",
    benchmark:
        "results/benchmarks/compare_{figure}.tsv"
    message:
        "Comparing {wildcards.figure} with its references"
    conda:
        "../envs/planarimpact.yaml"
    script:
        "../scripts/compare.py"


rule verdicts:
    """One table of all verdicts, worst first."""
    input:
        modules=run_plan.modules("gather_verdicts"),
        verdicts=expand("results/verdicts/{figure}.csv", figure=run_plan.FIGURES),
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


rule gate:
    """Fail the run if a comparison diverges or an entry of the ledger no longer holds.

    Runs after everything else is written.
    """
    input:
        modules=run_plan.modules("gate"),
        verdicts="results/verdicts.csv",
        ledger="results/ledger.csv",
        page="figures/ledger.html",
        report=rules.report.output,
        explorer=rules.explorer.output,
        trade=rules.trade.output,
        stability=rules.stability.output,
        scenes=scene_tables,
        study=rules.study.output,
        figures=rules.figures.input,
        notebooks=notebook_pages,
    output:
        "results/PASSED",
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
