"""A row is as somebody has accepted it, or the run fails and says what has changed."""

import pytest

from stronge1994 import accepted, ledger_table, tables, verdict_table

ROW = dict.fromkeys(verdict_table.COLUMNS, "") | {
    "figure": "fig6", "comparison": "fig6-far", "verdict": "differs", "why": "cause known",
    "points": "5", "size": "0.15", "unit": "N", "rms": "0.15", "max": "0.2",
    "allowed": "max <= 0.1 N",
}  # fmt: skip
ENTRY = dict.fromkeys(ledger_table.COLUMNS, "") | {
    "entry": "eq-25", "verdict": "wrong", "holds": "yes", "found": "3.5",
}  # fmt: skip
NOT_JUDGED = {"verdict": "not compared", "why": "other settings", "size": "", "points": ""}
AWAITED = NOT_JUDGED | {"why": "points awaited"}


@pytest.mark.parametrize(
    ("was", "now", "told"),
    [
        ({}, {}, ""),
        # Sizes of another machine, and what is only rounding.
        ({}, {"size": "0.150149"}, ""),
        ({}, {"size": "0.150151"}, "size 0.15 N -> 0.150151 N"),
        ({"size": "3e-14"}, {"size": "-9e-13"}, ""),
        ({}, {"size": "0.1", "points": "4"}, "points 5 -> 4; size 0.15 N -> 0.1 N"),
        ({}, {"unit": "1"}, "size 0.15 N -> 0.15"),
        ({}, {"verdict": "agrees"}, "differs, cause known -> agrees, cause known"),
        ({}, {"why": ""}, "differs, cause known -> differs"),
        ({}, AWAITED, "differs, cause known -> not compared, points awaited; "
         "points 5 -> none; size 0.15 N -> none"),
        # The gate tells of these by itself.
        ({}, {"verdict": "FAILS"}, ""),
        ({}, NOT_JUDGED, ""),
        # Points that were awaited are new: they may say anything but that they differ.
        (AWAITED, {"verdict": "agrees", "why": ""}, ""),
        (AWAITED, AWAITED, ""),
    ],
)  # fmt: skip
def test_what_has_changed_is_told(was, now, told):
    known = accepted.of_run([ROW | was], [ENTRY])
    expected = [f"changed: fig6-far: {told}"] if told else []
    assert accepted.changes([ROW | now], [ENTRY], known) == expected


def test_a_figure_with_other_settings_has_not_changed():
    other = ROW | NOT_JUDGED | {"comparison": "fig6-near"}
    known = accepted.of_run([ROW, other], [])
    for figure, count in (("fig6", 0), ("fig7", 1)):
        rows = [ROW | {"size": "9"}, other | {"figure": figure}]
        assert len(accepted.changes(rows, [], known)) == count


def test_a_new_row_may_not_differ_and_an_entry_keeps_its_number():
    new = [ROW | {"verdict": verdict} for verdict in ("agrees", "cannot tell", "not compared")]
    assert accepted.changes(new, [], []) == []
    told = accepted.changes(new, [ENTRY], [])
    assert told == ["new, and nobody has accepted it: eq-25: wrong"]
    for known in ([], accepted.of_run([ROW | AWAITED], [])):
        (told,) = accepted.changes([ROW], [], known)
        assert told.startswith("differs, and nobody has accepted it: fig6-far: rms 0.15, max 0.2 N")
    found = accepted.changes([], [ENTRY | {"found": "3.4"}], accepted.of_run([], [ENTRY]))
    assert found == ["changed: eq-25: size 3.5 -> 3.4"]


def test_what_a_run_found_is_accepted_unless_it_fails_or_is_of_other_settings(
    tmp_path, monkeypatch
):
    monkeypatch.chdir(tmp_path)
    (tmp_path / accepted.PATH).parent.mkdir(parents=True)
    accepted.write([ROW], [ENTRY])
    known = tables.read_rows(accepted.PATH)
    assert accepted.changes([ROW], [ENTRY], known) == []
    lapsed = [ROW], [ENTRY | {"holds": "no"}]
    for rows, ledger in (([ROW | {"verdict": "FAILS"}], []), ([ROW | NOT_JUDGED], []), lapsed):
        with pytest.raises(ValueError, match="1 rows cannot be accepted"):
            accepted.write(rows, ledger)
    assert tables.read_rows(accepted.PATH) == known
    path = tmp_path / accepted.PATH
    path.write_text(path.read_text().replace("3.5", "3.S"))
    with pytest.raises(ValueError, match="verdicts.csv, line 3, column 'size': '3.S' is no number"):
        accepted.read()
