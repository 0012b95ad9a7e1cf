"""Compare one table of a run with reference data."""

from stronge1994 import logs

logs.to(snakemake.log[0])

from stronge1994 import judging

rows = judging.compare(
    snakemake.wildcards.judged, snakemake.input.table, **snakemake.params.settings
)
judging.write(rows, snakemake.output.verdicts, snakemake.output.residuals)
