rule judge:
    """Compare a figure's curves or a scene with reference data. A row that fails is no error here."""
    input:
        versions="results/versions.json",
        table=of_judged("table"),
        series=of_judged("series"),
    output:
        verdicts="results/verdicts/{judged}.csv",
        residuals="results/residuals/{judged}.csv",
    log:
        "results/logs/judge_{judged}.log",
    priority: priority
    conda:
        "../envs/planarimpact.yaml"
    params:
        settings=of_judged("settings"),
        content=digest("workflow/scripts/judge.py", of_judged("series")),
    script:
        "../scripts/judge.py"
