"""Decide whether a run is good by its tables, and tell it at the end."""

import shlex
import textwrap
from collections import Counter
from collections.abc import Collection, Mapping, Sequence

from stronge1994 import accepted, figure_table, tables, verdict_table
from stronge1994.ledger import outcome
from stronge1994.tables import Row
from stronge1994.verdict_table import Group, Verdict, Why

LEDGER = "results/ledger.csv"
MOST_FAULTS = 8  # that are told at the end; the tables have all
PASSED = """\
PASSED: every result is as accepted, known differences included; {checks} checks.
Printed curves: {printed}.
This does not mean that the paper is right. "wrong" says: not by its own model.
A run FAILS if a curve of ours leaves the tolerance of its reference in data/,
or if a result is not the one that was accepted: data/accepted/verdicts.csv.
Look:    figures/report.html in a browser: the table above, with reasons
Play:    figures/explorer.html
Tables:  results/verdicts.csv, results/ledger.csv
Change:  workflow/config.yaml, and run again. References for the old value are
         not compared. To draw without judging: snakemake --cores 2 figures"""
NO_PRINT = "not compared (with your copy: figures/your_copy.html)"
UNMADE = (
    "NOT JUDGED: the figures are drawn, but {} comparisons cannot be made with these settings "
    "({}); to draw without judging: {}"
)
STOPPED = (
    "Stopped before the end: what is not made anew is missing or of an earlier run. Type the same "
    "command again, what was finished is kept. Usual causes: workflow/README.md, Troubleshooting."
)


def faults(
    verdicts: Sequence[Row],
    ledger: Sequence[Row],
    comparisons: Collection[str],
    entries: Collection[str],
    known: Sequence[Row],
) -> list[str]:
    """Why a run must not pass, by its tables, one line for each fault.

    `comparisons` and `entries` name the rows that the tables of verdicts and of the ledger must
    have, and `known` has the rows of the accepted table. A whole run, which has entries, has all of
    these.

    >>> faults([], [], ["fig6-printed"], [], [])
    ['missing: fig6-printed']
    """
    there = {row["comparison"] for row in verdicts} | {row["entry"] for row in ledger}
    asked = {*comparisons, *entries}
    return [
        *(
            f"accepted, but no longer compared: {row['name']}"
            for row in known
            if entries and row["name"] not in asked
        ),
        *(f"missing: {name}" for name in [*comparisons, *entries] if name not in there),
        *(
            f"FAILS: {row['comparison']}: {verdict_table.problem(row)}"
            for row in verdicts
            if row["verdict"] == Verdict.FAILS
        ),
        *(f"no longer holds: {row['entry']}: {row['problem']}" for row in outcome.failing(ledger)),
        *accepted.changes(verdicts, ledger, known),
    ]


def unmade(verdicts: Sequence[Row]) -> list[Row]:
    """Comparisons that cannot be made with the settings of the run, and are with ours.

    A printed curve may be of an incidence that the paper does not state.
    """
    others = [row for row in verdicts if row["why"] == Why.SETTINGS]
    return [row for row in others if row["group"] != Group.PRINTED]


def summary(
    verdicts: Sequence[str],
    comparisons: Collection[str],
    entries: Collection[str],
    shows: Mapping[str, str],
    failed: Mapping[str, str],
    passed: Collection[str],
    stopped: bool,
    config: Sequence[str],
    made: Sequence[str] = (),
) -> str:
    """What a run says at its end, by the tables of what it judges that are up to date then.

    `verdicts` are these tables, `comparisons` and `entries` as for `faults`; no entries say that
    the ledger is not judged. `shows` says what each figure of the paper shows. `failed` names jobs,
    with their logs, and `passed` the targets that judge and have passed; `stopped` says that a job
    failed or that the run was interrupted. `config` are the arguments of --config, to be repeated.
    `made` are the files that were asked for by name, or by the name of a rule that makes them.
    """
    rows = verdict_table.gather(verdicts)
    ledger = tables.read_rows(LEDGER, outcome.COLUMNS) if entries else []
    known = tables.read_rows(accepted.PATH, accepted.COLUMNS)
    wrong = faults(rows, ledger, comparisons, entries, known)
    others = [] if failed else unmade(rows)  # else the figures are not all drawn
    again = ["snakemake", "--cores", "2", "figures", *(["--config", *config] if config else [])]
    parts = [""]
    if len(verdicts) > 1:
        judged = {row["figure"] for row in rows}
        shown = {name: words for name, words in shows.items() if name in judged}
        parts += [figure_table.text(figure_table.of_run(rows, shown))]
        parts += filter(None, [figure_table.beyond(rows), figure_table.of_solver(rows)])
        parts += [""]
    elif verdicts:
        parts += [verdict_table.text(rows), f"All columns: {verdicts[0]}"]
    parts += [outcome.summary(ledger)] if ledger else []
    parts += [f"failed: {job} (log: {log})" for job, log in failed.items()]
    if others:
        settings = "; ".join(list(dict.fromkeys(row["note"] for row in others))[:2])
        parts += [_filled(UNMADE.format(len(others), settings, shlex.join(again)))]
    if wrong:
        parts += [f"On purpose? To draw without being judged:  {shlex.join(again)}"]
        parts += [f"FAILED. Reasons: {len(wrong)}"]
        parts += [_filled(fault) for fault in wrong[:MOST_FAULTS]]
        more = len(wrong) - MOST_FAULTS
        parts += [f"  and {more} more: results/verdicts/, {LEDGER}"] if more > 0 else []
        parts += [accepted.ACCEPT]
    elif stopped and not others:
        parts += [_filled(STOPPED)]
    elif "all" in passed:
        found = Counter(row["verdict"] for row in rows)
        checks = len(rows) - found[Verdict.NOT_COMPARED] + len(ledger)
        printed = figure_table.of_printed(rows) or NO_PRINT
        parts += [PASSED.format(checks=checks, printed=printed)]
    elif passed:
        parts += ["No comparison fails." if rows else "There is nothing to compare."]
        parts += ["The verdict of all: snakemake --cores 2"]
    elif not others:
        parts += [
            f"Made: {', '.join(made)}" if made else "Not judged. Pictures and pages: figures/"
        ]
    return "\n".join(parts) + "\n"


def _filled(text: str) -> str:
    """A sentence in lines for a terminal of 80: the logger would break it anywhere."""
    return textwrap.fill(text, 79, subsequent_indent="  ", break_on_hyphens=False)
