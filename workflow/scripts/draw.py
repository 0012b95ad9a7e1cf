"""Draw one figure from its curves, and its slide if it has one."""

from stronge1994.run import record

with record.recorded(snakemake) as plan:
    from stronge1994.figures.shared import drawing as drawings

    made = snakemake.output
    slide = {ground: made[ground] for ground in ("light", "dark") if made.get(ground)}
    drawings.draw(
        snakemake.wildcards.figure,
        plan["settings"],
        plan["overlays"],
        snakemake.input.curves,
        (made.svg, made.png),
        slide,
    )
