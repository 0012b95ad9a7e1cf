"""Decide whether a run is good by its tables, and tell it at the end."""

import shlex
import textwrap
from collections.abc import Collection, Mapping, Sequence

from stronge1994 import figure_table, tables, verdict_table
from stronge1994.ledger import outcome
from stronge1994.tables import Row
from stronge1994.verdict_table import Verdict

LEDGER, REPORT = "results/ledger.csv", "figures/report.html"
MOST_FAULTS = 8  # that are told at the end; the tables have all
KNOWN = (
    "Solved right: our own check only; largest difference in the axis' unit, and in sigmas, "
    "of which 1 is allowed. Beside others: the paper's model. A run also fails if one of the "
    f"{{}} known differences changes: {REPORT}#known has cause, size and bound of each."
)
PASSED = f"""\
PASSED. Each comparison: results/verdicts.csv, {LEDGER}
Look:    {REPORT} in a browser: the table above, with reasons
Play:    figures/explorer.html
Change:  workflow/config.yaml, and run again: only what depends on it is redone"""
STOPPED = (
    "Stopped before the end: what is not made anew is missing or of an earlier run. Type the same "
    "command again, what was finished is kept. Usual causes: workflow/README.md, Troubleshooting."
)


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
            if verdict_table.fails(row)
        ),
        *(f"no longer holds: {row['entry']}: {row['problem']}" for row in outcome.failing(ledger)),
    ]


def summary(
    verdicts: Sequence[str],
    comparisons: Collection[str],
    entries: Collection[str],
    failed: Mapping[str, str],
    passed: Collection[str],
    stopped: bool,
    config: Sequence[str],
) -> str:
    """What a run says at its end, by the tables of what it judges that are up to date then.

    `verdicts` are these tables, `comparisons` and `entries` as for `faults`; no entries say that
    the ledger is not judged. `failed` names jobs, with their logs, and `passed` the targets that
    judge and have passed; `stopped` says that a job failed or that the run was interrupted.
    `config` are the arguments of --config, to be repeated.
    """
    rows = verdict_table.gather(verdicts)
    ledger = tables.read_rows(LEDGER, outcome.COLUMNS) if entries else []
    wrong = faults(rows, ledger, comparisons, entries)
    parts = [""]
    if len(verdicts) > 1:
        known = sum(Verdict(row["verdict"]).differs for row in rows)
        parts += [figure_table.text(figure_table.of_run(rows)), ""]
        parts += [_filled(line) for line in verdict_table.counts(rows).splitlines()]
        parts += [_filled(KNOWN.format(known))]
    elif verdicts:
        parts += [verdict_table.text(rows), f"All columns: {verdicts[0]}"]
    parts += [outcome.summary(ledger)] if ledger else []
    parts += [f"failed: {job} (log: {log})" for job, log in failed.items()]
    if wrong:
        again = ["snakemake", "--cores", "2", "figures", *(["--config", *config] if config else [])]
        parts += [f"On purpose? To draw without being judged:  {shlex.join(again)}"]
        parts += [f"FAILED. Reasons: {len(wrong)}"]
        parts += [_filled(fault) for fault in wrong[:MOST_FAULTS]]
        more = len(wrong) - MOST_FAULTS
        parts += [f"  and {more} more: results/verdicts/, {LEDGER}"] if more > 0 else []
    elif stopped:
        parts += [_filled(STOPPED)]
    elif "all" in passed:
        parts += [PASSED]
    elif passed:
        parts += ["No comparison fails." if rows else "There is nothing to compare."]
        parts += ["The verdict of all: snakemake --cores 2"]
    else:
        parts += ["Not judged. Pictures and pages: figures/"]
    return "\n".join(parts) + "\n"


def _filled(text: str) -> str:
    """A sentence in lines for a terminal of 80: the logger would break it anywhere."""
    return textwrap.fill(text, 79, subsequent_indent="  ", break_on_hyphens=False)
