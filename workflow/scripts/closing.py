"""What a run prints last: the tables that it made, whether it was judged, and what to do next."""

from pathlib import Path

import csv_tables
import ledger_table
import verdict_table

VERDICTS, LEDGER = "results/verdicts.csv", "results/ledger.csv"
REPORT = "figures/report.html"
NEXT = [
    f"Look:     {REPORT}, open it in a browser; everything above, with its reasons",
    "Play:     figures/explorer.html",
    "Change:   workflow/config.yaml, and run again: only what depends on it is redone",
]
AFTER_A_FAILURE = [
    f"Why, row by row:  {REPORT}, open it in a browser",
    "On purpose? To draw without being judged:  snakemake --cores 2 figures",
]
STOPPED = [
    "A job stopped. What it said is above, and in results/logs/. Mend it and type the same command",
    "again: finished work is kept. README.md, Troubleshooting, has the usual causes.",
]


def words(started, stopped=False):
    """The end of a run that began at the time `started`; older tables would mislead.

    Parameters
    ----------
    started : float
        Seconds since the epoch.
    stopped : bool, optional
        A job failed, or the run was interrupted.
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
        parts += [f"PASSED. All columns: {VERDICTS}, {LEDGER}; pictures: figures/", *NEXT]
    else:
        parts.append("No verdict in this run as a whole. Pictures: figures/")
    if judged and bad:
        parts += AFTER_A_FAILURE
    elif stopped and not judged:
        parts += STOPPED
    return "\n" + "\n".join(parts) + "\n"


def _ran(rule, started):
    """A rule has ended since then: its benchmark is written last, and only where it succeeds.

    The gate leaves none when it fails: its log will do.
    """
    mark = Path(f"results/logs/{rule}.log")
    if rule != "gate":
        mark = Path(f"results/benchmarks/{rule}.tsv")
    return mark.exists() and mark.stat().st_mtime >= started
