"""Compare one table of a run with reference data; always succeeds."""

from stronge1994 import job
from stronge1994.judging import compare

with job.recorded(snakemake):
    rows = compare.compare(
        snakemake.wildcards.judged,
        snakemake.params.comparisons,
        snakemake.params.references,
        snakemake.input.table,
        dict(zip(snakemake.params.sources, snakemake.input.series, strict=True)),
        snakemake.params.significance,
    )
    compare.write(rows, snakemake.output.verdicts, snakemake.output.residuals)
