"""Gather the verdicts of all figures into one table."""

from stronge1994 import csv_tables, job
from stronge1994.judging import verdict_table

with job.recorded(snakemake):
    rows = verdict_table.gather(snakemake.input.verdicts)
    csv_tables.write_table(snakemake.output[0], rows, verdict_table.COLUMNS)
    print(verdict_table.text(rows))
