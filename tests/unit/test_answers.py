"""Questions and answers: what they make of the rows of a run."""

from stronge1994 import answers, ledger_table, verdict_table


def row(**cells):
    return dict.fromkeys(verdict_table.COLUMNS, "") | {"group": "others"} | cells


def entry(name, **cells):
    return dict.fromkeys(ledger_table.COLUMNS, "") | {"entry": name, "verdict": "wrong"} | cells


def told(verdicts, ledger=()):
    return {one.question: one for one in answers.of_run(verdicts, ledger)}


def test_measurements_are_told_by_their_verdicts_on_the_paper_s_model():
    verdicts = [
        row(reference="kharaz2001/spin", verdict="cannot be judged", model="lumped.hysteretic"),
        row(reference="kharaz2001/angle", verdict="agrees", model="lumped.hysteretic"),
        row(reference="kharaz2001/angle", verdict="differs", model="continuum"),
        row(reference="cornell1999/pairs", verdict="differs"),
        row(reference="mine2026/shots", verdict="cannot tell"),
        row(reference="johnson1983/a", verdict="not compared"),
        row(reference="maw1976/limit", verdict="agrees"),  # computed
        row(reference="inelastic_models/a", verdict="passed", group="solver checked"),
    ]
    assert told(verdicts)["Do measurements agree with the model?"].told == [
        "Agrees: Kharaz 2001 in part",
        "Differs: Cornell 1999 (pairs of materials)",
        "Cannot tell: Mine 2026",
        "Cannot be judged, no scatter published: Kharaz 2001 in part",
    ]


def test_printed_curves_are_counted_but_no_ratio_of_two():
    curves = ["agrees", "not compared", "differs", "not compared", "agrees", "FAILS"]
    prints = [row(group="printed figure", curve="lumped", verdict=one) for one in curves]
    prints.append(row(group="printed figure", verdict="FAILS"))  # a ratio
    asked = "Are our curves the printed ones?"
    (found,) = told(prints)[asked].told
    assert found == "4 of 6 were compared: agrees 2, differs 1, FAILS 1"
    for rows in (prints[1:2], prints[-1:]):
        assert told(rows)[asked].told[0].startswith("Not known: ")


def test_errors_that_change_the_same_result_are_one_row_and_are_all_counted():
    energy = {"quantity": "energy lost", "printed": "none", "by model": "off by 1 J"}
    ledger = [
        entry("eq-38", **energy),
        entry("eq-20", verdict="confirmed", only_if="e > 0"),
        entry("eq-39", **energy),
        entry("angle", quantity="angle", printed="35 deg", **{"by model": "27.8 deg"}),
        entry("why", verdict="not testable"),
    ]
    found = told([], ledger)
    grave = found["Which errors change a result?"]
    assert grave.told == ["3 statements:"]
    assert [(one.quantity, one.entries) for one in grave.table] == [
        ("energy lost", ["eq-38", "eq-39"]),
        ("angle", ["angle"]),
    ]
    right = found["Are the paper's statements right, by its own model?"].told
    assert right == ["1 of 5 are, 1 of these if a condition is added; 3 are not; 1 not testable"]
    lines = answers.text([grave]).splitlines()
    assert lines[1:] == [
        "  3 statements:  printed  by the model",
        "  energy lost    none     off by 1 J",
        "  angle          35 deg   27.8 deg",
    ]
