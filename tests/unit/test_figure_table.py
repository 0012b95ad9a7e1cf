"""The table for a reader: what stands in it for each figure of the paper."""

from stronge1994 import figure_table, verdict_table
from stronge1994.names import MODELS
from stronge1994.verdict_table import Group, Why

PAPER, PRINTED, OTHERS, SOLVER = Group
SIZES = {"points": "4", "rms": "0.02", "max": "0.03", "unit": "mu v2(0)"}
MAW, CROSS = {"reference": "maw1976/rebound"}, {"reference": "cross2014/spin"}
STATED = {
    "found": "4.6",
    "stated": "5.8 deg",
    "unit": "deg",
    "says": "peak at",
    "reference": "maw1976/peak",
}
LIKE = {"says": "like the continuum,", "reference": "maw1976/rebound", "entry": "eq-15"}
KNOWN, UNKNOWN = {"why": Why.KNOWN}, {"why": Why.UNKNOWN}
LOST = dict.fromkeys(SIZES, "")  # what could not be compared
OTHER_MODEL = {"model": MODELS[1]}
ALONE = {"reference": "cross2014/e_t", "note": "not published: scatter"}
ROWS = [
    ("fig6", SOLVER, "passed", {}),
    ("fig6", SOLVER, "passed", {}),
    ("fig6", SOLVER, "passed", {}),
    ("fig6", PAPER, "agrees", STATED | {"says": "peaks at"}),
    ("fig6", PAPER, "agrees", STATED | {"says": "peaks at", "stated": "9 deg"}),
    ("fig6", PAPER, "differs", LIKE | KNOWN),
    ("fig6", PAPER, "differs", LIKE | KNOWN | {"max": "0.3", "points": "12"}),
    ("fig6", PAPER, "differs", STATED | UNKNOWN | {"entry": "eq-16"}),
    ("fig6", OTHERS, "agrees", MAW),
    ("fig6", OTHERS, "differs", MAW | UNKNOWN | {"points": "12", "rms": "0.04"}),
    ("fig6", OTHERS, "cannot tell", CROSS | {"unit": "1", "model": MODELS[0]}),
    ("fig6", OTHERS, "cannot be judged", ALONE | {"model": MODELS[0]}),
    ("fig6", OTHERS, "agrees", STATED | {"stated": "< 0 N", "says": "friction reverses"}),
    ("fig6", OTHERS, "not compared", LOST | {"reference": "johnson1983/a", "why": Why.AWAITED}),
    ("fig6", OTHERS, "differs", OTHER_MODEL | MAW | KNOWN),
    ("fig6", OTHERS, "cannot be judged", OTHER_MODEL | ALONE),
    ("fig6", OTHERS, "cannot be judged", {"model": MODELS[2]} | ALONE),
    ("fig6", PRINTED, "not compared", LOST | {"why": Why.AWAITED}),
    ("fig7", SOLVER, "FAILS", LOST),
    ("fig7", PAPER, "FAILS", LIKE | {"entry": ""}),
    ("fig7", OTHERS, "FAILS", LOST | MAW),
    ("fig7", OTHERS, "FAILS", OTHER_MODEL | CROSS),
    ("rod", OTHERS, "agrees", MAW),
    ("rod", OTHERS, "differs", OTHER_MODEL | KNOWN),
    ("rod", SOLVER, "not compared", {"why": Why.SETTINGS}),
]
TEXT = """\
Fig. 2  springs; not compared: printed curve
Fig. 6  rebound; not compared: printed curve, points of Johnson 1983
 agrees           paper: peaks at 5.8 and 9 deg, model 4.6 and 4.6
 differs          paper: like the continuum, 0.3 mu v2(0); changes a result
 differs          paper: peak at 5.8 deg, model 4.6; matter of judgement, cause
                  unknown
 agrees           Maw 1976: rebound, 4 of 16 points, rms 0.02 mu v2(0)
 differs          Maw 1976: rebound, 12 of 16 points, rms 0.04 mu v2(0); cause
                  unknown; 1 other model: differs
 cannot tell      Cross 2014: spin, 4 points, rms 0.02
 cannot be judged Cross 2014: e t, 4 points, rms 0.02 mu v2(0); not published:
                  scatter; none of 3 models agrees within the error of reading
 agrees           Maw 1976: friction reverses
Fig. 7  forces; not compared: printed curve
 FAILS            paper: like the continuum, 0.03 mu v2(0)
 FAILS            Maw 1976:
 FAILS            Cross 2014: spin, 4 points, rms 0.02 mu v2(0)
Rod  a rod
 agrees           Maw 1976: rebound, 4 points, rms 0.02 mu v2(0)"""
GRADES = {"eq-15": "changes a result", "eq-16": "matter of judgement"}
SHOWS = {"fig2": "springs", "fig6": "rebound", "fig7": "forces", "rod": "a rod", "trade": "time"}
# Printed curves of a figure, and what is told of them.
PRINTS = [
    ("agrees", SIZES),
    ("not compared", LOST | {"why": Why.AWAITED}),
    ("differs", SIZES | KNOWN | {"entry": "eq-15"}),
    ("not compared", LOST | {"why": Why.SETTINGS}),
    ("agrees", SIZES | {"rms": "0.04", "points": "12"}),
    ("FAILS", SIZES | {"unit": "N"}),
]
TOLD = """\
Fig. 6  rebound
 FAILS            printed curve: 1 of 6, rms 0.02 N
 differs          printed curve: 1 of 6, rms 0.02 mu v2(0); cause known
 not compared     printed curve: 1 of 6; other settings
 agrees           printed curve: 2 of 6, rms 0.036 mu v2(0)"""


def test_the_table_says_what_every_comparison_has_found():
    """Of the paper the largest distance, of points the rms; of other models whether they agree."""
    rows = [
        dict.fromkeys(verdict_table.COLUMNS, "")
        | {"figure": figure, "group": group, "verdict": verdict, **SIZES, **cells}
        | {"comparison": f"{figure}-{place}"}
        for place, (figure, group, verdict, cells) in enumerate(ROWS)
    ]
    table = figure_table.of_run(rows, SHOWS, GRADES)
    assert figure_table.text(table) == TEXT
    assert table[2].others[0].rows == ["fig7-20"]
    assert table[1].paper[1].entry == "eq-15"
    assert figure_table.counted(rows[:6]) == "passed 3, agrees 2, differs 1"


def test_of_statements_that_say_the_same_the_worst_gives_the_verdict():
    cells = dict.fromkeys(verdict_table.COLUMNS, "") | STATED | {"figure": "fig6", "group": PAPER}
    rows = [
        cells | {"verdict": verdict, "comparison": f"{place}"}
        for place, verdict in enumerate(("agrees", "differs"))
    ]
    (row,) = figure_table.of_run(rows, {"fig6": "rebound"}, {})
    assert [(item.verdict, item.rows) for item in row.paper] == [("differs", ["1", "0"])]


def test_printed_curves_that_were_read_stand_first_the_worst_on_top():
    empty = dict.fromkeys(verdict_table.COLUMNS, "") | {
        "figure": "fig6",
        "group": PRINTED,
        "curve": "lumped",
    }
    rows = [
        empty | {"verdict": verdict, "comparison": f"{place}"} | cells
        for place, (verdict, cells) in enumerate(PRINTS)
    ]
    (row,) = table = figure_table.of_run(rows, {"fig6": "rebound"}, {})
    assert figure_table.text(table) == TOLD
    assert row.awaited == 1 and row.printed[1].entry == "eq-15"
    assert [item.rows for item in row.printed] == [["5"], ["2"], ["3"], ["0", "4"]]


def test_a_ratio_of_two_printed_curves_is_no_curve():
    ratio = {"figure": "fig8", "group": PRINTED, "unit": "1", "rms": "0.15", "points": "1"}
    ratio |= {"says": "friction over normal force", "comparison": "ratio", "verdict": "FAILS"}
    rows = [dict.fromkeys(verdict_table.COLUMNS, "") | ratio]
    told = figure_table.text(figure_table.of_run(rows, {"fig8": "forces"}, {}))
    assert (
        told
        == "Fig. 8  forces\n FAILS            printed curve: friction over normal force, rms 0.15"
    )
