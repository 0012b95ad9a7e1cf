"""Gather the verdicts of all figures into one table."""

from stronge1994 import job
from stronge1994.judging import verdict_table

with job.recorded(snakemake):
    rows = verdict_table.gather(snakemake.input.verdicts)
    verdict_table.write(snakemake.output[0], rows, verdict_table.COLUMNS)
    print(verdict_table.text(rows))
