"""Draw one figure from its curves, and its slide if it has one."""

from stronge1994.run import record

with record.recorded(snakemake) as plan:
    from stronge1994.figures.shared import drawing as drawings

    drawings.draw(
        snakemake.wildcards.figure, plan, snakemake.input.curves, dict(snakemake.output.items())
    )
