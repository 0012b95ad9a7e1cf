"""Why a run fails, and what it says at its end."""

import pytest

from stronge1994 import gate, tables, verdict_table
from stronge1994.ledger import outcome

VERDICT = {
    **dict.fromkeys(verdict_table.COLUMNS, ""),
    "figure": "fig6", "comparison": "fig6-rebound", "group": "others", "verdict": "agrees",
    "reference": "a/b", "points": 5, "rms": 0.1, "max": 0.2, "unit": "N", "allowed": "max <= 1 N",
}  # fmt: skip
ENTRY = dict.fromkeys(outcome.COLUMNS, "") | {"entry": "eq-25", "verdict": "wrong", "holds": "yes"}


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
        (({}, {"entry": "eq-26"}), "missing: eq-25"),
    ],
)
def test_a_row_that_fails_or_is_missing_is_a_fault(changes, fault):
    verdict, entry = VERDICT | changes[0], ENTRY | changes[1]
    found = gate.faults([verdict], [entry], ["fig6-rebound"], ["eq-25"], [])
    assert len(found) == bool(fault) and all(words.startswith(fault) for words in found)


@pytest.fixture
def words(tmp_path, monkeypatch):
    """Function: the summary of a run that judges two figures and the ledger, or a part of it."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "results").mkdir()
    tables.write_rows(gate.LEDGER, [ENTRY], outcome.COLUMNS)

    def told(
        verdict="agrees", judged=2, failed=None, passed=(), config=(), whole=True, made=(), **cells
    ):
        cells |= {"verdict": verdict}
        rows = [VERDICT | cells | {"comparison": f"row-{i}"} for i in range(10)]
        for i in range(2):
            tables.write_rows(f"{i}.csv", rows[5 * i :][:5], verdict_table.COLUMNS)
        names, paths = [row["comparison"] for row in rows], [f"{i}.csv" for i in range(judged)]
        logs, stopped = {job: f"{job}.log" for job in failed or ()}, failed is not None
        entries = ["eq-25"] if whole else []
        rows = names[: 5 * judged], entries, {"fig6": "rebound"}
        return gate.summary(paths, *rows, logs, passed, stopped, config, made)

    return told


def test_a_passed_run_says_where_to_look_and_what_next(words):
    said = words(passed=["all"])
    assert (
        "\n agrees       A: b, 50 points, rms 0.1 N\n" in said
        and "sentences of the paper: 1 wrong; 0 no" in said
    )
    assert "PASSED: nothing has changed, 11 checks hold.\nPrinted curves: not compared (w" in said
    assert "one of 0 known differences leaves its bounds, or if one of 1\nverdicts" in said
    for path in ("figures/report.html", "figures/explorer.html", "workflow/config.yaml"):
        assert path in said
    said = words(passed=["paper"], judged=1, whole=False)
    assert "row-4" in said and "No comparison fails" in said and "PASSED" not in said


def test_printed_curves_are_counted_and_fail_no_run(words):
    """A print that follows a misprint has no bounds, one of another incidence is for no run."""
    said = words("differs", passed=["all"], group="printed figure", curve="lumped")
    assert "\nPrinted curves: 10 of 10 compared.\n" in said and "one of 0 known" in said
    said = words(
        "not compared", passed=["all"], group="printed figure", curve="lumped", why="other settings"
    )
    assert "PASSED: nothing has changed, 1 checks hold." in said  # the ledger's
    assert "Printed curves: not compared" in said


def test_a_failed_run_names_its_rows_last_and_repeats_the_config(words):
    said = words("FAILS", config=["a=1", "figures={fig6: {restitution: [0, 1]}}"])
    assert "PASSED" not in said and "Play" not in said
    assert "figures --config a=1 'figures={fig6: {restitution: [0, 1]}}'" in said
    last = said.strip().splitlines()[-gate.MOST_FAULTS - 2 :]
    assert last[0] == "FAILED. Reasons: 10" and last[1].startswith("FAILS: row-0: rms 0.1")
    assert last[-1].startswith("  and 2 more: results/")


def test_a_run_with_other_settings_is_not_judged_and_says_how_to_draw(words):
    """It accuses nobody: the reference is for other settings."""
    note = "the reference is for mu 0.5, this run has 0.4"
    cells = {"why": "other settings", "note": note}
    said = words("not compared", failed=[], config=["mu=0.4"], **cells)
    last = " ".join(said.split("NOT JUDGED: ")[1].split())
    assert last.startswith("the figures are drawn, but 10 comparisons cannot be made with these ")
    assert f"({note}); to draw" in last and last.endswith("2 figures --config mu=0.4")
    assert "FAIL" not in said and "PASSED" not in said
    said = words("not compared", failed=["draw fig6"], **cells)  # not all is drawn
    assert "NOT JUDGED" not in said and "failed: draw fig6" in said and "is kept" in said


def test_a_run_that_judges_nothing_says_what_it_made(words):
    asked = {"judged": 0, "whole": False}
    assert words(**asked, made=["results/site", "b.zip"]) == "\nMade: results/site, b.zip\n"
    assert words(**asked) == "\nNot judged. Pictures and pages: figures/\n"
    assert "Made: " not in words(**asked, made=["b.zip"], failed=["curves fig9"])


def test_a_run_that_stopped_names_its_jobs_and_what_was_judged(words):
    said = words(judged=1, failed=["curves fig9"], passed=["fig6"], whole=False)
    assert "failed: curves fig9 (log: curves fig9.log)" in said and "row-4" in said
    assert "No comparison fails" not in said
    nothing = words(judged=0, failed=[], whole=False)
    assert "row-" not in nothing
    for told in (said, nothing):
        assert "PASSED" not in told and "what was finished is kept" in " ".join(told.split())
