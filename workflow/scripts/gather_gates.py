"""Gather what the comparisons of all figures catch into one table."""

from stronge1994 import csv_tables, job
from stronge1994.judging.verdict_table import GATES, write

with job.recorded(snakemake):
    rows = [row for path in snakemake.input.parts for row in csv_tables.read_rows(path, GATES)]
    write(snakemake.output[0], rows, GATES)
