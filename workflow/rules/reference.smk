rule series:
    """Bring the series of one source into one table; WebPlotDigitizer's exports are converted."""
    input:
        plan=planned("series_{source}", "convert_series", "reference_data",
            settings=lambda source: SOURCES[source],
            reads=lambda source: plan.files_of_source(SOURCES, source)),
        files=lambda wildcards: plan.files_of_source(SOURCES, wildcards.source),
    output:
        table="results/series/{source}.csv",
        record="results/records/series_{source}.json",
    log:
        "results/logs/series_{source}.log",
    message:
        "Reading the series of {wildcards.source}"
    conda:
        "../envs/planarimpact.yaml"
    script:
        "../scripts/convert_series.py"
