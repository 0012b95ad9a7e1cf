"""The gate: pass only if no comparison diverges. Runs last, so nothing else is lost."""

import sys

import job
import verdict_table


def gate(verdicts, passed):
    """Write `passed` if no row diverges; the number of diverging rows."""
    bad = verdict_table.failing(verdict_table.read(verdicts))
    for row in bad:
        print(f"diverges: {row['comparison']}: {row['note']}")
    if not bad:
        with open(passed, "w", encoding="utf-8") as file:
            file.write("no comparison diverges\n")
    return len(bad)


if "snakemake" in globals():
    with job.log_to(snakemake.log[0]):  # noqa: F821
        count = gate(snakemake.input.verdicts, snakemake.output[0])  # noqa: F821
    sys.exit(min(count, 1))
