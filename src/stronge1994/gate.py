"""Decide whether a run passes by its tables, and tell what it found."""

import textwrap
from collections.abc import Collection, Mapping, Sequence

from stronge1994 import accepted, answers, figure_table, ledger_table, verdict_table
from stronge1994.tables import Row
from stronge1994.verdict_table import Group, Verdict, Why

MOST_FAULTS = 8  # that are told at the end; the tables have all
BY_FIGURE = "By figure: results/verdicts.txt"
PASSED = f"""\
PASSED: {{}} is as accepted, known differences included.
This does not mean that the paper is right.
Look: figures/report.html in a browser. {BY_FIGURE}"""
UNMADE = (
    "NOT JUDGED: the figures are drawn, but {} comparisons cannot be made with these settings "
    "({}). To draw without judging, with your --config: snakemake --cores 2 figures"
)
NEW = "New: nobody has accepted {} yet. To accept: snakemake --cores 2 accept"
ON_PURPOSE = "Other settings on purpose? To draw without judging: snakemake --cores 2 figures"


def faults(
    verdicts: Sequence[Row],
    ledger: Sequence[Row],
    comparisons: Collection[str],
    entries: Collection[str],
    known: Sequence[Row],
) -> list[str]:
    """Why a run must not pass, by its tables, one line for each fault.

    `comparisons` and `entries` name the rows that the tables of verdicts and of the ledger must
    have, and `known` has the rows of the accepted table. A whole run, which has both, has all of
    these, a part of it those of its figures, and the ledger alone those of its entries.

    >>> faults([], [], ["fig6-printed"], [], [])
    ['missing: fig6-printed']
    """
    there = {row["comparison"] for row in verdicts} | {row["entry"] for row in ledger}
    asked, figures = {*comparisons, *entries}, {row["figure"] for row in verdicts}
    whole, own = comparisons and entries, ledger_table.VERDICTS if entries else ()
    return [
        *(
            f"accepted, but no longer compared: {row['name']}"
            for row in known
            if row["name"] not in asked
            and (whole or row["verdict"] in own or row["name"].partition("-")[0] in figures)
        ),
        *(f"missing: {name}" for name in [*comparisons, *entries] if name not in there),
        *(
            f"FAILS: {row['comparison']}: {verdict_table.problem(row)}"
            for row in verdicts
            if row["verdict"] == Verdict.FAILS
        ),
        *(
            f"no longer holds: {row['entry']}: {row['problem']}"
            for row in ledger_table.failing(ledger)
        ),
        *accepted.changes(verdicts, ledger, known),
    ]


def unmade(verdicts: Sequence[Row]) -> list[Row]:
    """Comparisons that cannot be made with the settings of the run, and are with ours.

    A printed curve may be of an incidence that the paper does not state.
    """
    others = [row for row in verdicts if row["why"] == Why.SETTINGS]
    return [row for row in others if row["group"] != Group.PRINTED]


def summary(
    verdicts: Sequence[Row],
    ledger: Sequence[Row],
    wrong: Sequence[str],
    shows: Mapping[str, str],
    grades: Mapping[str, str],
    new: Sequence[str] = (),
) -> str:
    """What a run says at its end: what it has found, and whether it has passed.

    `wrong` are its `faults`, and `new` the comparisons that `accepted.new` names; `shows` says what
    each figure shows, `grades` are those of the ledger's entries. A run without a ledger, or with
    it alone, is one of a part, of Fig. 6 for example.
    """
    figures, others = {row["figure"] for row in verdicts}, unmade(verdicts)
    whole, parts = verdicts and ledger, []
    same = "every other result" if new else "every result"
    fresh = [_filled(NEW.format(", ".join(new)))] if new else []
    if whole and not wrong and not others:
        found = answers.text(answers.of_run(verdicts, ledger))
        return "\n".join(["", found, *fresh, PASSED.format(same)])
    if whole:
        parts = [BY_FIGURE]
    elif len(figures) > 1:
        shown = {name: words for name, words in shows.items() if name in figures}
        parts = [figure_table.text(figure_table.of_run(verdicts, shown, grades))]
    elif verdicts:
        parts = [verdict_table.text(verdicts), "All columns: results/verdicts/"]
    else:
        parts = [ledger_table.summary(ledger)] if ledger else []
    if others:
        settings = "; ".join(list(dict.fromkeys(row["note"] for row in others))[:2])
        parts += [_filled(UNMADE.format(len(others), settings))]
    if wrong:
        parts += [ON_PURPOSE, f"FAILED. Reasons: {len(wrong)}"]
        parts += [_filled(fault) for fault in wrong[:MOST_FAULTS]]
        more = len(wrong) - MOST_FAULTS
        parts += [f"  and {more} more: results/verdicts/, results/ledger.csv"] if more > 0 else []
        parts += [] if accepted.refused(verdicts, ledger) else [accepted.ACCEPT]
    elif not others:
        same = f"{same.capitalize()} is as accepted."
        parts += [*fresh, same if verdicts or ledger else "There is nothing to compare."]
        parts += ["The verdict of all: snakemake --cores 2"]
    return "\n".join(["", *parts])


def _filled(text: str) -> str:
    """A sentence in lines for a terminal of 80: the logger would break it anywhere."""
    return textwrap.fill(text, 79, subsequent_indent="  ", break_on_hyphens=False)
