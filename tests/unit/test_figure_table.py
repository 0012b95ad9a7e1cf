"""The table with a row for each figure: what stands in its cells."""

import pytest

from stronge1994.verdict_tables import figure_table, verdict_table
from stronge1994.verdict_tables.verdict_table import QUESTIONS

SOLVED, PRINTED, OTHERS = QUESTIONS
SIZES = {
    "points": "4", "rms [sigma]": "2", "max [sigma]": "3", "rms [axis units]": "0.02",
    "max [axis units]": "0.03", "unit": "mu v2(0)",
}  # fmt: skip
# What a run says of a figure whose curves could not be made.
CRASHED = dict.fromkeys(SIZES, "") | {"note": "no curves: ArithmeticError: oh"}


def row(question, verdict, figure="fig6", **cells):
    cells = {"figure": figure, "question": question, "verdict": verdict} | SIZES | cells
    cells = {"comparison": f"{figure}-rebound", "reference": "maw1976/rebound"} | cells
    return dict.fromkeys(verdict_table.COLUMNS, "") | cells


def cells(*rows):
    """The cells of the only figure: solved right, as printed, beside others, awaited."""
    ((_, *found),) = figure_table.of_run(rows)
    return found


@pytest.mark.parametrize(
    ("question", "verdict"), [(SOLVED, "wrong"), (PRINTED, "diverges"), (OTHERS, "diverges")]
)
@pytest.mark.parametrize("how", [{}, CRASHED], ids=["solved", "crashed"])
def test_a_failing_row_shows_in_its_cell(question, verdict, how):
    good = "right" if question == SOLVED else "agrees"
    bad = row(question, verdict, comparison="fig6-bad", **how)
    found = dict(zip(QUESTIONS, cells(row(question, good), bad), strict=False))
    item = found.pop(question)[-1]
    assert item.verdict == verdict and "fig6-bad" in item.rows
    assert not any(found.values())
    words = figure_table.text(figure_table.of_run([row(question, good), bad]))
    assert verdict.upper() in words


def test_other_models_do_not_stand_beside_others_unless_they_fail_and_then_first():
    paper = row(OTHERS, "explained difference", curve="lumped, e = 0.5", comparison="fig6-paper")
    curves = [f"{model}, e = 0.5" for model in figure_table.OTHER_MODELS]
    other = [
        row(OTHERS, "agrees", curve=curve, comparison=f"fig6-{place}")
        for place, curve in enumerate(curves)
    ]
    (item,) = cells(paper, *other)[2]
    assert item.rows == ["fig6-paper"] and item.verdict == "explained difference"
    assert cells(*other)[2] == []
    fails = other[0] | {"verdict": "diverges"}
    (item,) = cells(paper, fails, *other[1:])[2]
    assert item.rows == ["fig6-0", "fig6-paper"] and item.verdict == "diverges"
