rule series:
    """Bring the series of one source into one table; WebPlotDigitizer's exports are converted."""
    input:
        modules=modules("convert_series"),
        files=files_of_source,
    output:
        "results/series/{source}.csv",
    params:
        source=source_of,
    log:
        "results/logs/series_{source}.log",
    benchmark:
        "results/benchmarks/series_{source}.tsv"
    message:
        "Reading the series of {wildcards.source}"
    conda:
        "../envs/planarimpact.yaml"
    script:
        "../scripts/convert_series.py"
