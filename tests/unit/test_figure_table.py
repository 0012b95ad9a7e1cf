"""The table with a row for each figure: what stands in its cells."""

from stronge1994 import figure_table, verdict_table
from stronge1994.names import MODELS
from stronge1994.verdict_table import Question

SOLVED, PRINTED, OTHERS = Question
OTHER_MODELS = MODELS[1:4]
SIZES = {
    "points": "4", "rms [sigma]": "2", "max [sigma]": "3", "rms [axis units]": "0.02",
    "max [axis units]": "0.03", "unit": "mu v2(0)", "reference": "maw1976/rebound",
}  # fmt: skip
# What could not be compared.
LOST = dict.fromkeys(SIZES, "") | {"note": "no curve has e = 1"}
# Of entries of the ledger; of more points in other units; of a law; of a stated sign that is right.
LIMIT = {"note": "ledger: limit", "found": "4.6", "stated": "5.8 mu v2(0)"}
EQ_15 = {"note": "ledger: eq-15; largest at 3"}
FAR = {"points": "12", "rms [axis units]": "0.04", "rms [sigma]": "1"}
LAW = {"reference": "", "unit": "", "max [sigma]": "9", "max [axis units]": "7"}
SIGN = {"reference": "cross2014/sign", "points": "1", "rms [sigma]": "0"}
EXACT = {"max [sigma]": "0.0009", "max [axis units]": "0"}
ROWS = [
    ("fig6", SOLVED, "right", {"max [sigma]": "0.4", "max [axis units]": "4e-3"}),
    ("fig6", SOLVED, "right", {"max [sigma]": "0.1"}),
    ("fig6", SOLVED, "right", LAW),
    ("fig6", SOLVED, "unexplained difference", {}),
    ("fig6", PRINTED, "agrees", {}),
    ("fig6", PRINTED, "agrees", {}),
    ("fig6", PRINTED, "explained difference", EQ_15),
    ("fig6", PRINTED, "explained difference", EQ_15 | FAR),
    ("fig6", PRINTED, "explained difference", LIMIT),
    ("fig6", OTHERS, "agrees", {}),
    ("fig6", OTHERS, "untested difference", FAR),
    ("fig6", OTHERS, "inconclusive", FAR | {"reference": "maw1976/spin", "unit": "1"}),
    ("fig6", OTHERS, "agrees", SIGN),
    ("fig6", OTHERS, "agrees", SIGN | {"reference": "maw1976/sign"}),
    ("fig6", OTHERS, "awaited", LOST | {"reference": "johnson1983/sphere"}),
    *(("fig6", OTHERS, "agrees", {"model": model}) for model in OTHER_MODELS),
    ("rod", SOLVED, "right", {}),
    ("rod", SOLVED, "wrong", {}),
    ("rod", PRINTED, "diverges", {"note": "largest at 3"}),
    ("rod", OTHERS, "explained difference", {}),
    ("rod", OTHERS, "diverges", {"model": OTHER_MODELS[0]}),
    ("fig7", SOLVED, "wrong", LOST),
    ("fig7", PRINTED, "diverges", LOST),
    ("fig7", OTHERS, "diverges", LOST | {"reference": "maw1976/rebound"}),
    ("scene_a", SOLVED, "right", EXACT),
    ("scene_b", SOLVED, "right", EXACT),
]
# Solved right: the largest difference; a law has no sigma. As printed: of all points of an entry.
# Beside others: of the first series, and of all in sigmas; other models only where they fail.
TEXT = """\
fig6   3e-02 0.4   2 agree                 maw1976 29 0.036 1.2 untested
       1 known     eq-15: rms 0.036        cross2014 1 agrees
                   limit: 4.6, not 5.8     awaited: johnson1983
rod           1 WRONG     DIVERGES 20: rms maw1976 8 0.02 2 DIVERGES
                          0.02
fig7   1 WRONG     DIVERGES 24             maw1976 DIVERGES
scenes        0     0     -                -"""
COUNTS = """\
solved right: 2 wrong, 1 unexplained, 6 right
as printed: 2 diverges, 3 explained, 2 agrees
beside others: 2 diverges, 1 untested, 1 explained, 1 awaited, 1 inconclusive, 6 agrees"""


def test_the_table_says_what_every_comparison_has_found():
    rows = [
        dict.fromkeys(verdict_table.COLUMNS, "")
        | {"figure": figure, "question": question, "verdict": verdict, **SIZES, **cells}
        | {"comparison": f"{figure}-{place}"}
        for place, (figure, question, verdict, cells) in enumerate(ROWS)
    ]
    table = figure_table.of_run(rows)
    assert figure_table.text(table) == f"{figure_table.HEADER}\n{TEXT}"
    places = [[int(name.split("-")[1]) for name in part.rows] for part in table[0].others]
    assert places == [[10, 11, 9, 13], [12]]  # the worst first
    assert [item.rows for item in table[1].others] == [["rod-22", "rod-21"]]
    assert table[0].others[0].unit == "mu v2(0)" and verdict_table.counts(rows) == COUNTS
