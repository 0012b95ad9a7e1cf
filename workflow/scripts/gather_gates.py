"""Gather what the comparisons of all figures catch into one table."""

import csv_tables
import job
from verdict_table import GATES

if "snakemake" in globals():
    with job.recorded(snakemake):  # noqa: F821
        parts = snakemake.input.parts  # noqa: F821
        rows = [row for path in parts for row in csv_tables.read_rows(path, GATES)]
        cells = [[row[column] for column in GATES] for row in rows]
        csv_tables.write_rows(snakemake.output[0], GATES, cells)  # noqa: F821
