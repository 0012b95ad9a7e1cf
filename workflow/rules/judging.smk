rule judge:
    """Compare a figure's curves or a scene with reference data.

    Also the smallest change of the physics that each comparison of a figure catches.
    """
    input:
        plan=planned("judge_{judged}", "judge", "judging", "reference_data", "figures/shared/curves",
            "figures/{figure}/curves.py", "printed",
            settings=lambda name: JUDGED[name]["settings"]),
        table=of_figure("table", JUDGED, "judged"),
        series=of_figure("series", JUDGED, "judged"),
        nodes=lambda wildcards: FIGURES.get(wildcards.judged, {"tables": []})["tables"],
    output:
        verdicts="results/verdicts/{judged}.csv",
        residuals="results/residuals/{judged}.csv",
        sensitivity="results/sensitivity/{judged}.csv",
        record="results/records/judge_{judged}.json",
    log:
        "results/logs/judge_{judged}.log",
    message:
        "Comparing {wildcards.judged} with references"
    conda:
        "../envs/planarimpact.yaml"
    script:
        "../scripts/judge.py"


rule gather:
    """One table of all verdicts, worst first, and one of what the comparisons catch."""
    input:
        plan=planned("gather", "gather", "judging", "reference_data"),
        verdicts=expand("results/verdicts/{judged}.csv", judged=JUDGED),
        sensitivity=expand("results/sensitivity/{judged}.csv", judged=JUDGED),
    output:
        verdicts="results/verdicts.csv",
        sensitivity="results/sensitivity.csv",
        record="results/records/gather.json",
    log:
        "results/logs/gather.log",
    message:
        "Gathering the verdicts"
    conda:
        "../envs/planarimpact.yaml"
    script:
        "../scripts/gather.py"
