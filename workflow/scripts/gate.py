"""The gate: pass only if no comparison diverges and every entry of the ledger holds.

Runs last, so nothing else is lost.
"""

import sys

import csv_tables
import job
import ledger_table
import verdict_table


def gate(verdicts, ledger, passed):
    """Write `passed` if no row of either table fails; the number of failing rows."""
    diverging = verdict_table.failing(csv_tables.read_rows(verdicts))
    lapsed = ledger_table.failing(csv_tables.read_rows(ledger))
    for row in diverging:
        print(f"diverges: {row['comparison']}: {row['note']}")
    for row in lapsed:
        print(f"no longer holds: {row['entry']}: {row['problem']}")
    bad = len(diverging) + len(lapsed)
    if not bad:
        with open(passed, "w", encoding="utf-8") as file:
            file.write("no comparison diverges, every entry of the ledger holds\n")
    return bad


if "snakemake" in globals():
    with job.log_to(snakemake.log[0]):  # noqa: F821
        count = gate(
            snakemake.input.verdicts,  # noqa: F821
            snakemake.input.ledger,  # noqa: F821
            snakemake.output[0],  # noqa: F821
        )
    sys.exit(min(count, 1))
