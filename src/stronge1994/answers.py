"""What a run has found, as questions and answers: for a terminal, README.md and the report."""

import textwrap
from collections import Counter
from collections.abc import Sequence
from typing import NamedTuple

from stronge1994 import figure_table, ledger_table, words
from stronge1994.ledger_table import CONFIRMED, NOT_TESTABLE, ROUNDED, WRONG
from stronge1994.tables import Row, with_unit
from stronge1994.verdict_table import WIDTH, Group, Verdict

# What was measured, where the name of a source says too little.
MEASURED = {
    "osakue_rogers2001": "two inequalities",
    "cornell1999": "pairs of materials",
    "lewis_rogers1988": "peak angle",
}
COMPUTED = ("maw1976", "chung_ooi2011")  # by others, and so no measurements
ASKED = (Verdict.AGREES, Verdict.DIFFERS, Verdict.CANNOT_TELL, Verdict.CANNOT_JUDGE)
UNPUBLISHED = "no scatter published"
# The paper's model and the continuum, where the contact sticks first.
STICKS_FIRST = "fig5-lumped-maw-initial-stick"
COPY = "figures/your_copy.html"


class Change(NamedTuple):
    """What an error of the paper changes: the result as printed, and by the paper's own model."""

    quantity: str
    printed: str
    by_model: str
    entries: list[str]


class Answer(NamedTuple):
    """A question of a reader, the answer in sentences, and what changes a result."""

    question: str
    told: list[str]
    table: Sequence[Change] = ()


def changes(ledger: Sequence[Row]) -> list[Change]:
    """The errors that change a result; entries that change the same one stand together."""
    found: dict[tuple[str, str, str], list[str]] = {}
    for row in ledger:
        if row["quantity"]:
            key = row["quantity"], row["printed"], row["by model"]
            found.setdefault(key, []).append(row["entry"])
    return [Change(*key, entries) for key, entries in found.items()]


def of_run(verdicts: Sequence[Row], ledger: Sequence[Row]) -> list[Answer]:
    """Questions and answers, from the tables of a whole run that has passed."""
    found = Counter(row["verdict"] for row in ledger)
    right, under = found[CONFIRMED] + found[ROUNDED], ledger_table.conditional(ledger)
    grave = changes(ledger)
    count = sum(len(change.entries) for change in grave)
    return [
        Answer("Does the solver solve the paper's model?", [_of_solver(verdicts)]),
        Answer(
            "Are the paper's statements right, by its own model?",
            [
                f"{right} of {len(ledger)} are, {under} of these if a condition is added; "
                f"{found[WRONG]} are not; {found[NOT_TESTABLE]} not testable"
            ],
        ),
        Answer("Which errors change a result?", [f"{count} statements:"], grave),
        Answer("Are our curves the printed ones?", [_of_prints(verdicts)]),
        Answer(
            'Is the model "practically identical" with Maw\'s continuum?',
            [_from_continuum(row, ledger) for row in verdicts if row["comparison"] == STICKS_FIRST],
        ),
        Answer("Do measurements agree with the model?", _of_measurements(verdicts)),
        Answer(
            "What makes a run fail?",
            ["A check of the solver outside its tolerance, or a result that is not as accepted"],
        ),
    ]


def _of_solver(verdicts: Sequence[Row]) -> str:
    own = [row for row in verdicts if row["verdict"] == Verdict.PASSED]
    exact = sum("_40_digits/" in row["reference"] for row in own)
    return f"Yes: {len(own)} checks pass, by our second codes ({exact} with 40 digits) or laws"


def _from_continuum(row: Row, ledger: Sequence[Row]) -> str:
    """How wrong the ledger calls it, and how far apart the speeds along the surface are."""
    grade = next((own["grade"] for own in ledger if own["entry"] == row["entry"]), "")
    size = with_unit(float(row["max"]), row["unit"])
    told = f"speeds up to {size} apart where it sticks first"
    return words.sentence(f"{grade}: {told}" if grade else told)


def _of_prints(verdicts: Sequence[Row]) -> str:
    curves = [row for row in verdicts if row["group"] == Group.PRINTED and row["curve"]]
    read = [row for row in curves if row["verdict"] != Verdict.NOT_COMPARED]
    if not read:
        return f"Not known: our copy has no figures. With a copy: {COPY}"
    return f"{len(read)} of {len(curves)} were compared: {figure_table.counted(read)}"


def _of_measurements(verdicts: Sequence[Row]) -> list[str]:
    """Sources of measurements by their verdicts on the paper's model."""
    found: dict[str, dict[str, None]] = {}
    for row in verdicts:
        source = row["reference"].split("/")[0]
        if row["group"] != Group.OTHERS or source in COMPUTED:
            continue
        if row["model"] in figure_table.MODELS_OF_PAPER and row["verdict"] in ASKED:
            found.setdefault(source, {})[row["verdict"]] = None
    told = []
    for verdict in ASKED:
        named = []
        for source, own in found.items():
            if verdict in own:
                what = f" ({MEASURED[source]})" if source in MEASURED else ""
                part = " in part" if len(own) > 1 else ""
                named.append(f"{words.source(source)}{part}{what}")
        why = f", {UNPUBLISHED}" if verdict == Verdict.CANNOT_JUDGE else ""
        told += [f"{words.sentence(verdict)}{why}: {'; '.join(named)}"] if named else []
    return told


def text(answers: Sequence[Answer]) -> str:
    """Questions and answers for a terminal."""
    lines = []
    for answer in answers:
        lines.append(answer.question)
        for told in answer.told:
            lines += textwrap.wrap(told, WIDTH, initial_indent="  ", subsequent_indent="    ")
        if answer.table:
            rows = [(row.quantity, row.printed, row.by_model) for row in answer.table]
            rows.insert(0, (lines.pop().strip(), "printed", "by the model"))
            first, second, _ = (max(map(len, column)) for column in zip(*rows, strict=True))
            lines += [f"  {a:<{first}}  {b:<{second}}  {c}" for a, b, c in rows]
    return "\n".join(lines)
