"""Draw one figure from its curves."""

from stronge1994.run import record

with record.recorded(snakemake) as plan:
    from stronge1994.figures.shared import drawing as drawings

    drawings.draw(
        snakemake.wildcards.figure,
        plan["settings"],
        plan["overlays"],
        snakemake.input.curves,
        dict(zip(plan["sources"], snakemake.input.series, strict=True)),
        snakemake.output.svg,
        snakemake.output.png,
    )
