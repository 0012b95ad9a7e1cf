"""Compare one table of a run with reference data; always succeeds."""

from stronge1994 import job, judging

with job.recorded(snakemake):
    rows = judging.compare(
        snakemake.wildcards.judged,
        snakemake.params.comparisons,
        snakemake.params.references,
        snakemake.input.table,
        dict(zip(snakemake.params.sources, snakemake.input.series, strict=True)),
        snakemake.params.significance,
    )
    judging.write(rows, snakemake.output.verdicts, snakemake.output.residuals)
