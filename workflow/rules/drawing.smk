# Where `snakemake --report` shows a picture.
IN_REPORT = {"category": "Figures", "labels": {"figure": "{figure}"}, "caption": "../report/figure.rst"}


rule draw:
    """Draw one figure from its curves; never solves."""
    input:
        code=["workflow/scripts/draw.py", *DRAWING],
        own=of_folder(without="curves.py"),
        curves="results/curves/{figure}.csv",
        series=lambda wildcards: FIGURES[wildcards.figure]["series"],
    output:
        svg=report("figures/{figure}.svg", **IN_REPORT),
        png="figures/{figure}.png",
    log:
        "results/logs/draw_{figure}.log",
    wildcard_constraints:
        figure="|".join(figure for figure in FIGURES if figure not in SLIDES) or "none",
    priority: priority
    conda:
        "../envs/planarimpact.yaml"
    params:
        settings=lambda wildcards: FIGURES[wildcards.figure]["drawing"],
    script:
        "../scripts/draw.py"


use rule draw as draw_with_slide with:
    # Also one panel of the figure for a projector, on a light and on a dark ground.
    output:
        svg=report("figures/{figure}.svg", **IN_REPORT),
        png="figures/{figure}.png",
        light="figures/slides/{figure}_light.png",
        dark="figures/slides/{figure}_dark.png",
    wildcard_constraints:
        figure="|".join(SLIDES) or "none",
