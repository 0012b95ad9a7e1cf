"""Gather the verdicts of all figures into one table."""

import csv_tables
import job
import verdict_table

if "snakemake" in globals():
    with job.recorded(snakemake):  # noqa: F821
        rows = verdict_table.gather(snakemake.input.verdicts)  # noqa: F821
        csv_tables.write_rows(
            snakemake.output[0],  # noqa: F821
            verdict_table.COLUMNS,
            [[row[column] for column in verdict_table.COLUMNS] for row in rows],
        )
        print(verdict_table.text(rows))
