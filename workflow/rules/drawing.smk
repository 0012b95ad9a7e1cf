rule draw:
    """Draw one figure from its curves; never solves."""
    input:
        plan=planned("draw_{figure}", "draw", "figures/shared/drawing", "figures/{figure}/drawing.py",
            "reference_data",
            settings=of_drawing),
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


rule slide:
    """Draw one point of a figure for a projector, on a light and on a dark ground; never solves."""
    input:
        plan=planned("slide_{slide}", "draw_slide", "figures/shared/drawing", "figures/{figure}/drawing.py",
            "figures/{figure}/slide.py", "reference_data",
            settings=of_drawing),
        curves="results/curves/{slide}.csv",
        series=of_figure("series", wildcard="slide"),
    output:
        light="figures/slides/{slide}_light.png",
        dark="figures/slides/{slide}_dark.png",
        record="results/records/slide_{slide}.json",
    log:
        "results/logs/slide_{slide}.log",
    message:
        "Drawing the slide of {wildcards.slide}"
    conda:
        "../envs/planarimpact.yaml"
    script:
        "../scripts/draw_slide.py"
