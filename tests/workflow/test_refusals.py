"""Bad config, data and modules are refused before any work, in one line."""

import re

import pytest

BAD_CONFIG = [
    ("figures={fig6: {as_printed: perhaps}}", "as_printed: 'perhaps' is not of type 'boolean'"),
    ("stifness_ratio=1.5", "'stifness_ratio' was unexpected"),
    ("figures={fig5: {sample: 3}}", "figures.fig5: .*'sample' was unexpected"),
    ("figures={fig8: {ball: {colour: 1}}}", "figures.fig8.ball: .*'colour' was unexpected"),
    ("stiffness_ratio=-1", "stiffness_ratio: -1 is less than"),
    ("stiffness_ratio=nan", "stiffness_ratio: nan is not a finite number"),
    ("stiffness_ratio=stiff", "stiffness_ratio: 'stiff' is not of type 'number'"),
    ("mass_ratio=0.5", "mass_ratio: 0.5 is less than the minimum of 1"),
    ("figures={fig6: {restitution: [1.5]}}", "figures.fig6.restitution.0: 1.5 is greater"),
    ("figures={fig5: {incidence: [8, 0]}}", r"figures.fig5.incidence = \[8, 0\]"),
    ("figures={fig5: {experiment: nobody}}", "'nobody' is not in data/; allowed are"),
    ("figures={fig5: {tolerance: 0}}", "figures.fig5.tolerance: 0 is less than the minimum"),
    ("figures={convergence: {steps: [32, 33]}}", "figures.convergence.steps.1: 33 is not a mult"),
    ("comparisons={fig5-maw-rubber: {reference: maw1976/no}}", "'maw1976/no' is neither"),
    ("figures={stability: {points: maw1976/slip_throughout_limit}}", "limit' is no series"),
    ("comparisons={fig5-maw-rubber: {tolerance: 3}}", "'tolerance' was unexpected"),
]


@pytest.mark.parametrize(("change", "words"), BAD_CONFIG, ids=[c for c, _ in BAD_CONFIG])
def test_bad_config_is_refused_before_any_work(fresh, change, words):
    fresh.refuses(words, "--config", change)


def test_a_module_that_is_no_python_is_refused_by_its_line(fresh):
    (fresh / "src/planarimpact/laws.py").write_text("x = = 2\n")
    fresh.refuses(r"src/planarimpact/laws.py, line 1: invalid syntax")


BAD_DATA = [
    (
        "0.586,-0.027",
        "0.586,-O.027",
        "rebound.csv, line 4, column 'velocity .*': '-O.027' is not a",
    ),
    ("0.586,-0.027", "0.586,-99", "rebound.csv, line 4, .*: -99 is outside -5 to 20"),
    ("0.586,-0.027", "0.586,nan", "rebound.csv, line 4, .*: nan is outside"),
    ("0.586,-0.027", "0.586", "rebound.csv, line 4: 1 cells where 2 belong"),
    ("incidence [mu v2(0)]", "x", r"column 'incidence \[mu v2\(0\)\]' is missing; found x"),
]


@pytest.mark.parametrize(("old", "new", "words"), BAD_DATA, ids=[c[1] for c in BAD_DATA])
def test_bad_data_is_refused_before_any_work(fresh, old, new, words):
    fresh.edit("data/chung_ooi2011/rebound.csv", old, new)
    fresh.refuses(words)


def test_missing_and_stray_series_are_refused(fresh):
    (fresh / "data/chung_ooi2011/rebound.csv").rename(fresh / "data/chung_ooi2011/rebounds.csv")
    assert "rebound.csv: missing" in fresh.run().stdout
    fresh.edit("data/chung_ooi2011/source.yaml", "  rebound:", "  rebounds:")
    assert "'chung_ooi2011/rebound' is neither" in fresh.run().stdout
    (fresh / "data/kharaz2001/more.csv").write_text("a\n")
    assert "more.csv: no series of that name" in fresh.run().stdout


def test_source_without_provenance_is_refused(fresh):
    fresh.edit("data/chung_ooi2011/source.yaml", "citation:", "quotation:")
    assert re.search("source.yaml: top level: .*quotation", fresh.run().stdout)
