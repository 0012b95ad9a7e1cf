"""Draw the slide of one figure, light and dark, from its curves."""

from stronge1994.run import record

with record.recorded(snakemake) as plan:
    from stronge1994.figures.shared import drawing as drawings

    drawings.draw_slide(
        snakemake.wildcards.slide,
        plan["settings"],
        plan["overlays"],
        snakemake.input.curves,
        dict(zip(plan["sources"], snakemake.input.series, strict=True)),
        {"light": snakemake.output.light, "dark": snakemake.output.dark},
    )
