rule judge:
    """Compare a figure's curves or a scene with reference data."""
    input:
        plan=planned("judge_{judged}", "judge", "judging", "verdict_tables", "reference_data",
            settings=lambda name: JUDGED[name]["settings"],
            reads=lambda name: JUDGED[name]["series"]),
        table=of_figure("table", JUDGED, "judged"),
        series=of_figure("series", JUDGED, "judged"),
    output:
        verdicts="results/verdicts/{judged}.csv",
        residuals="results/residuals/{judged}.csv",
        record="results/records/judge_{judged}.json",
    log:
        "results/logs/judge_{judged}.log",
    priority: priority
    message:
        "Comparing {wildcards.judged} with references"
    conda:
        "../envs/planarimpact.yaml"
    script:
        "../scripts/judge.py"


rule gather:
    """One table of all verdicts."""
    input:
        plan=planned("gather", "gather", "verdict_tables"),
        verdicts=expand("results/verdicts/{judged}.csv", judged=JUDGED),
    output:
        verdicts="results/verdicts.csv",
        record="results/records/gather.json",
    log:
        "results/logs/gather.log",
    message:
        "Gathering the verdicts"
    conda:
        "../envs/planarimpact.yaml"
    script:
        "../scripts/gather.py"
