"""Gather the verdicts of all figures, and what their comparisons catch, into two tables."""

import contextlib

from stronge1994.run import record

with record.recorded(snakemake):
    from stronge1994 import csv_tables, verdict_table
    from stronge1994.verdict_table import SENSITIVITY

    rows = verdict_table.gather(snakemake.input.verdicts)
    csv_tables.write_table(snakemake.output.verdicts, rows, verdict_table.COLUMNS)
    caught = []
    for path in snakemake.input.sensitivity:
        with contextlib.suppress(csv_tables.Failed):  # the row of its figure diverges
            caught += csv_tables.read_rows(path, SENSITIVITY)
    csv_tables.write_table(snakemake.output.sensitivity, caught, SENSITIVITY)
