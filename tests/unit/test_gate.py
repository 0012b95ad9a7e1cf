"""Why a run fails, and what it says at its end."""

import pytest

from stronge1994 import accepted, gate, ledger_table, verdict_table

VERDICT = {
    **dict.fromkeys(verdict_table.COLUMNS, ""),
    "figure": "fig6", "comparison": "fig6-rebound", "group": "others", "verdict": "agrees",
    "reference": "a/b", "points": 5, "rms": 0.1, "max": 0.2, "unit": "N", "allowed": "max <= 1 N",
}  # fmt: skip
ENTRY = dict.fromkeys(ledger_table.COLUMNS, "") | {
    "entry": "eq-25",
    "verdict": "wrong",
    "holds": "yes",
}


@pytest.mark.parametrize(
    ("changes", "fault"),
    [
        (({}, {}), None),
        (
            ({"verdict": "FAILS"}, {}),
            "FAILS: fig6-rebound: rms 0.1, max 0.2 N; 5 points; allowed is",
        ),
        (({"verdict": "FAILS", "note": "oh"}, {}), "FAILS: fig6-rebound: oh: rms 0.1"),
        (({"comparison": "fig6-other"}, {}), "missing: fig6-rebound"),
        (({}, {"holds": "no", "problem": "oh"}), "no longer holds: eq-25: oh"),
        (({}, None), "missing: eq-25"),
    ],
)
def test_a_row_that_fails_or_is_missing_is_a_fault(changes, fault):
    verdict, entries = VERDICT | changes[0], [] if changes[1] is None else [ENTRY | changes[1]]
    known = accepted.of_run([], [ENTRY])
    found = gate.faults([verdict], entries, ["fig6-rebound"], ["eq-25"], known)
    assert len(found) == bool(fault) and all(words.startswith(fault) for words in found)


def test_an_accepted_row_that_is_gone_is_told_by_its_figure_and_by_a_whole_run():
    known = [{**row, "verdict": "agrees", "why": ""} for row in accepted.of_run([VERDICT], [])]
    known += [row | {"name": "fig7-other"} for row in known] + accepted.of_run([], [ENTRY])
    there = [VERDICT | {"comparison": "fig6-new"}], ["fig6-new"]
    told = gate.faults(there[0], [], there[1], [], known)
    assert told == ["accepted, but no longer compared: fig6-rebound"]
    assert len(gate.faults(there[0], [ENTRY], there[1], ["eq-25"], known)) == 2


def test_the_ledger_alone_is_judged_by_its_own_rows():
    known = [{**row, "why": ""} for row in accepted.of_run([VERDICT], [ENTRY])]
    assert gate.faults([], [ENTRY], [], ["eq-25"], known) == []
    gone = {**known[-1], "name": "eq-26"}
    told = gate.faults([], [ENTRY], [], ["eq-25"], [*known, gone])
    assert told == ["accepted, but no longer compared: eq-26"]
    lapsed = ENTRY | {"holds": "no", "problem": "oh"}
    assert gate.faults([], [lapsed], [], ["eq-25"], known) == ["no longer holds: eq-25: oh"]
    said = gate.summary([], [ENTRY], [], {}, {})
    assert "1 equations and sentences" in said and "Every result is as accepted." in said
    assert "PASSED" not in said and "nothing to compare" not in said


def told(wrong=(), ledger=(ENTRY,), figures=("fig6", "fig7"), **cells):
    """What is said of a run of ten rows, of the ledger or not."""
    rows = [VERDICT | cells | {"comparison": f"row-{i}"} for i in range(10)]
    rows = [row | {"figure": figures[i % len(figures)]} for i, row in enumerate(rows)]
    return gate.summary(rows, ledger, wrong, {"fig6": "rebound"}, {})


def test_a_passed_run_says_where_to_look_and_what_next():
    said = told()
    assert "Do measurements agree with the model?\n  Agrees: A\n" in said
    assert "\n  0 of 1 are, 0 of these if a condition is added; 1 are not; 0 not testable\n" in said
    assert "PASSED: every result is as accepted, known differences included." in said
    for path in ("figures/your_copy.html", "figures/report.html", "results/verdicts.txt"):
        assert path in said


@pytest.mark.parametrize("figures", [("fig6",), ("fig6", "fig7")])
def test_a_part_of_a_run_names_its_rows_and_is_not_the_whole(figures):
    said = told(ledger=(), figures=figures)
    assert ("row-4" in said) == (len(figures) == 1) and "PASSED" not in said
    assert "Every result is as accepted." in said and "The verdict of all: " in said


def test_a_new_comparison_is_told_until_somebody_accepts_it():
    """One that agrees fails no run; but a later run is held only to what was accepted."""
    rows = [VERDICT | {"comparison": name, "verdict": "agrees"} for name in ("known", "new")]
    known = accepted.of_run(rows[:1], [])
    awaited = VERDICT | {"comparison": "later", "verdict": "not compared", "why": "points awaited"}
    new = accepted.new([*rows, awaited], [row | {"why": ""} for row in known])
    assert new == ["new"]
    for ledger, wanted in (
        ([], "Every other result is"),
        ([ENTRY], "PASSED: every other result is"),
    ):
        said = gate.summary(rows, ledger, [], {}, {}, new)
        assert "New: nobody has accepted new yet." in said and wanted in said


def test_printed_curves_are_counted_and_fail_no_run():
    cells = {"group": "printed figure", "curve": "lumped"}
    assert "\n  10 of 10 were compared: differs 10\n" in told(verdict="differs", **cells)
    said = told(verdict="not compared", why="other settings", **cells)
    assert "PASSED" in said and "\n  Not known: " in said


def test_a_failed_run_names_its_rows_last_and_how_to_accept_them():
    said = told([f"changed: row-{i}: size 1 -> 2" for i in range(10)], verdict="differs")
    assert "PASSED" not in said and "Play" not in said
    last = said.strip().splitlines()[-gate.MOST_FAULTS - 4 :]
    assert last[0] == "FAILED. Reasons: 10" and last[1] == "changed: row-0: size 1 -> 2"
    assert last[-3].startswith("  and 2 more: results/") and last[-1].endswith("accept")
    said = told(["FAILS: row-0: rms 0.1"], verdict="FAILS")  # which nobody can accept
    assert said.endswith("FAILED. Reasons: 1\nFAILS: row-0: rms 0.1")


def test_a_run_with_other_settings_is_not_judged_and_says_how_to_draw():
    """It accuses nobody: the reference is for other settings."""
    note = "the reference is for mu 0.5, this run has 0.4"
    said = told(verdict="not compared", why="other settings", note=note)
    last = " ".join(said.split("NOT JUDGED: ")[1].split())
    assert last.startswith("the figures are drawn, but 10 comparisons cannot be made with these ")
    assert f"({note}). To draw" in last and last.endswith("snakemake --cores 2 figures")
    assert "FAIL" not in said and "PASSED" not in said
