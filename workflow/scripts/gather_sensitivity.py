"""Gather what the comparisons of all figures catch into one table."""

from stronge1994 import csv_tables, job
from stronge1994.judging.verdict_table import SENSITIVITY, write

with job.recorded(snakemake):
    parts = [csv_tables.read_rows(path, SENSITIVITY) for path in snakemake.input.parts]
    rows = [row for part in parts for row in part]
    write(snakemake.output[0], rows, SENSITIVITY)
