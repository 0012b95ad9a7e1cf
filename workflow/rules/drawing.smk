rule draw:
    """Draw one figure from its curves; never solves."""
    input:
        modules=drawing_modules,
        curves="results/curves/{figure}.csv",
        series=compared_series,
    output:
        svg=report(
            "figures/{figure}.svg",
            caption="../report/figures.rst",
            category="Figures",
            labels={"figure": "{figure}"},
        ),
        png="figures/{figure}.png",
    params:
        settings=settings,
        overlays=overlays,
        sources=compared_sources,
    log:
        "results/logs/draw_{figure}.log",
    benchmark:
        "results/benchmarks/draw_{figure}.tsv"
    message:
        "Drawing {wildcards.figure}"
    conda:
        "../envs/planarimpact.yaml"
    script:
        "../scripts/draw.py"
