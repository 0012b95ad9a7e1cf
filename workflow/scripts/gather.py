"""Gather the verdicts of all figures into one table."""

from stronge1994.run import record

with record.recorded(snakemake):
    from stronge1994 import csv_tables
    from stronge1994.verdict_tables import verdict_table

    rows = verdict_table.gather(snakemake.input.verdicts)
    csv_tables.write_table(snakemake.output.verdicts, rows, verdict_table.COLUMNS)
