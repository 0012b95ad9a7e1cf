"""Decide whether a run is good by its tables, and tell it at the end."""

import shlex
from collections.abc import Collection, Mapping, Sequence

from stronge1994 import csv_tables
from stronge1994.csv_tables import Row
from stronge1994.ledger import outcome
from stronge1994.verdict_tables import figure_table, verdict_table

LEDGER, REPORT = "results/ledger.csv", "figures/report.html"
MOST_FAULTS = 8  # that are told at the end; the log of the gate has all
KNOWN = (
    "Solved right: our own check only; largest difference in the axis' unit, and in sigmas,\n"
    "of which 1 is allowed. Beside others: the paper's model. A run also fails if one of the\n"
    f"{{}} known differences changes: {REPORT}#known has cause, size and bound of each."
)
NEXT = f"""\
PASSED. Each comparison: results/verdicts.csv, {LEDGER}; pictures: figures/
Look:     {REPORT}, open it in a browser: the table above, with reasons
Play:     figures/explorer.html
Change:   workflow/config.yaml, and run again: only what depends on it is redone"""
STOPPED = """\
Stopped before the end: pages and pictures that are not made anew are of an earlier run. Type
the same command again: what was finished is kept. Usual causes: workflow/README.md, Troubleshooting."""


def faults(
    verdicts: Sequence[Row],
    ledger: Sequence[Row],
    comparisons: Collection[str],
    entries: Collection[str],
) -> list[str]:
    """Why a run must not pass, by its tables, one line for each fault.

    `comparisons` and `entries` name the rows that the tables of verdicts and of the ledger must
    have.

    >>> row = {"comparison": "fig6-rebound", "verdict": "agrees"}
    >>> faults([row], [], ["fig6-rebound", "fig6-printed"], [])
    ['missing: fig6-printed']
    """
    there = {row["comparison"] for row in verdicts} | {row["entry"] for row in ledger}
    return [
        *(f"missing: {name}" for name in [*comparisons, *entries] if name not in there),
        *(
            f"{row['verdict']}: {row['comparison']}: {verdict_table.why(row)}"
            for row in verdicts
            if row["verdict"] in verdict_table.FAILS
        ),
        *(f"no longer holds: {row['entry']}: {row['problem']}" for row in outcome.failing(ledger)),
    ]


def last_words(
    verdicts: Sequence[str],
    comparisons: Collection[str],
    entries: Collection[str] | None,
    failed: Mapping[str, str],
    stopped: bool,
    config: Sequence[str],
) -> str:
    """What a run says at its end, by the tables that it has made or found up to date.

    `verdicts` are the tables, `comparisons` and `entries` as for `faults`, None if the ledger has
    not been checked. `failed` names jobs with their logs; `stopped` says that
    the run did not get to its end. `config` are the arguments of --config, to be repeated.
    """
    rows = verdict_table.gather(verdicts)
    ledger = [] if entries is None else csv_tables.read_rows(LEDGER, outcome.COLUMNS)
    wrong = faults(rows, ledger, comparisons, entries or ())
    parts = ["" if rows else "No verdict in this run. Pictures: figures/"]
    if len(verdicts) > 1:
        known = sum(row["verdict"] in verdict_table.DIFFERENCES for row in rows)
        parts += [figure_table.text(figure_table.of_run(rows)), "", verdict_table.counts(rows)]
        parts += [KNOWN.format(known)]
    elif verdicts:
        parts += [verdict_table.text(rows), f"All columns: {verdicts[0]}"]
    parts += [outcome.summary(ledger)] if ledger else []
    if wrong:
        again = ["snakemake", "--cores", "2", "figures", *(["--config", *config] if config else [])]
        parts += [f"On purpose? To draw without being judged:  {shlex.join(again)}"]
        parts += [
            f"FAILED. Reasons: {len(wrong)}",
            *(f"  {fault}" for fault in wrong[:MOST_FAULTS]),
        ]
        parts += [f"  and more: {', '.join(failed.values())}"] if len(wrong) > MOST_FAULTS else []
    elif stopped:
        parts += [f"failed: {job} (log: {log})" for job, log in failed.items()] + [STOPPED]
    elif entries is not None:
        parts += [NEXT]
    elif rows:
        parts += ["No comparison fails. The verdict of all: snakemake --cores 2"]
    return "\n".join(parts) + "\n"
