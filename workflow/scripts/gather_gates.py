"""Gather what the comparisons of all figures catch into one table."""

import csv_tables
import job
from verdict_table import GROUPS

COLUMNS = ["comparison", *GROUPS]

if "snakemake" in globals():
    with job.recorded(snakemake):  # noqa: F821
        parts = snakemake.input.parts  # noqa: F821
        rows = [row for path in parts for row in csv_tables.read_rows(path, COLUMNS)]
        cells = [[row[column] for column in COLUMNS] for row in rows]
        csv_tables.write_rows(snakemake.output[0], COLUMNS, cells)  # noqa: F821
