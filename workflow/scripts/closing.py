"""What a run prints last: the tables that it made, and whether it was judged."""

from pathlib import Path

import csv_tables
import ledger_table
import verdict_table

VERDICTS, LEDGER = "results/verdicts.csv", "results/ledger.csv"


def words(started):
    """The end of a run that began at the time `started`; older tables would mislead.

    Parameters
    ----------
    started : float
        Seconds since the epoch.
    """
    judged = _ran("gate", started)
    parts, failed = [], []
    if judged or _ran("verdicts", started):
        rows = csv_tables.read_rows(VERDICTS)
        parts.append(verdict_table.text(rows))
        failed.append(("diverging comparisons, listed first", verdict_table.failing(rows)))
    if judged or _ran("ledger", started):
        rows = csv_tables.read_rows(LEDGER)
        parts.append(ledger_table.summary(rows))
        failed.append(("entries of the ledger that no longer hold", ledger_table.failing(rows)))
    bad = ", ".join(f"{len(rows)} {what}" for what, rows in failed if rows)
    if bad:
        parts.append(f"FAILED: {bad}. All columns: {VERDICTS}, {LEDGER}")
    elif judged:
        parts.append(f"PASSED. All columns: {VERDICTS}, {LEDGER}; pictures: figures/")
    else:
        parts.append("No verdict in this run. Pictures: figures/")
    return "\n" + "\n".join(parts) + "\n"


def _ran(rule, started):
    """A rule has ended since then: its benchmark is written last, and only where it succeeds.

    The gate leaves none when it fails: its log will do.
    """
    mark = Path(f"results/logs/{rule}.log")
    if rule != "gate":
        mark = Path(f"results/benchmarks/{rule}.tsv")
    return mark.exists() and mark.stat().st_mtime >= started
