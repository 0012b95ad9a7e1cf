"""Draw one figure from its curves. Curves that failed become a picture that says so."""

from stronge1994 import drawings, job

with job.recorded(snakemake):
    drawings.draw(
        snakemake.wildcards.figure,
        snakemake.params.settings,
        snakemake.params.overlays,
        snakemake.input.curves,
        dict(zip(snakemake.params.sources, snakemake.input.series, strict=True)),
        snakemake.output.svg,
        snakemake.output.png,
    )
