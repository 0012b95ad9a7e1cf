"""Gather what the comparisons of all figures catch into one table."""

from stronge1994 import csv_tables, job
from stronge1994.judging.verdict_table import SENSITIVITY

with job.recorded(snakemake):
    parts = [csv_tables.read_rows(path, SENSITIVITY) for path in snakemake.input.parts]
    rows = [row for part in parts for row in part]
    csv_tables.write_table(snakemake.output[0], rows, SENSITIVITY)
