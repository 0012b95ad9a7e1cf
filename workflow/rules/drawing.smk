rule draw:
    """Draw one figure from its curves; never solves."""
    input:
        modules=of_figure("drawing"),
        curves="results/curves/{figure}.csv",
        series=of_figure("series"),
    output:
        svg=report(
            "figures/{figure}.svg",
            caption="../report/figures.rst",
            category="Figures",
            labels={"figure": "{figure}"},
        ),
        png="figures/{figure}.png",
    params:
        settings=of_figure("settings"),
        overlays=of_figure("overlays"),
        sources=of_figure("sources"),
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
