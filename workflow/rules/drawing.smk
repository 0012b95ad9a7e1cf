rule draw:
    """Draw one figure from its curves; never solves."""
    input:
        plan=planned("draw_{figure}", "draw", "figures/shared/drawing", "figures/{figure}/drawing.py",
            "reference_data",
            settings=lambda figure: {k: FIGURES[figure][k] for k in ("settings", "overlays", "sources")}),
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
        record="results/records/draw_{figure}.json",
    params:
        caption=lambda wildcards: CAPTIONS[wildcards.figure],
    log:
        "results/logs/draw_{figure}.log",
    message:
        "Drawing {wildcards.figure}"
    conda:
        "../envs/planarimpact.yaml"
    script:
        "../scripts/draw.py"
