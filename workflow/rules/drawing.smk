rule draw:
    """Draw one figure from its curves; never solves."""
    input:
        plan=planned("draw_{figure}", "draw", "figures/shared/drawing", "figures/{figure}",
            "reference_data",
            settings=of_drawing, reads=lambda figure: FIGURES[figure]["series"]),
        curves="results/curves/{figure}.csv",
        series=of_figure("series"),
    output:
        svg="figures/{figure}.svg",
        png="figures/{figure}.png",
        record="results/records/draw_{figure}.json",
    wildcard_constraints:
        figure="|".join(figure for figure in FIGURES if figure not in SLIDES) or "none",
    log:
        "results/logs/draw_{figure}.log",
    priority: priority
    message:
        "Drawing {wildcards.figure}"
    conda:
        "../envs/planarimpact.yaml"
    script:
        "../scripts/draw.py"


use rule draw as draw_with_slide with:
    # Also one panel of the figure for a projector, on a light and on a dark ground.
    output:
        svg="figures/{figure}.svg",
        png="figures/{figure}.png",
        light="figures/slides/{figure}_light.png",
        dark="figures/slides/{figure}_dark.png",
        record="results/records/draw_{figure}.json",
    wildcard_constraints:
        figure="|".join(SLIDES) or "none",
