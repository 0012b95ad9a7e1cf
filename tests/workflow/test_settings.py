"""At both ends of what the groups allow that figures share, and between, one is drawn and judged.

Where the solver does not reach its tolerance, its error is one sentence that says so. A setting
that a reference is not for is never a fault of the solver.
"""

import warnings

import pytest

from planarimpact.common.checks import ConvergenceError
from stronge1994 import judging, reference_data, solving
from stronge1994 import settings as figure_settings
from stronge1994.figures.shared import drawing as drawings
from stronge1994.settings import config as configuration
from stronge1994.settings import figures
from tests.workflow.project import ROOT, ledger

# What only makes a picture finer, and its table more exact, while another setting is tried.
QUICK = {
    "samples": 12,
    "solved": 16,
    "restitutions": 10,
    "tolerance": 0.01,
    "loss_tolerance": 0.01,
    "tolerances": [0.01],
    "steps": [16, 32],
    "batches": [1, 100],
    "budget": 0.05,
}
# Between the ends of the two groups that figures share; those of the paper's sphere are 3.5, 1.21.
SHARED = {"mass_ratio": [1.0, 1.2, 20.0], "stiffness_ratio": [0.01, 2.5, 100.0]}
# A figure whose curves take less than a second; all others are `long`.
DAILY = ["fig3"]


def _quick(group):
    """Settings of a figure that take little time."""
    own = {key: QUICK.get(key, value) for key, value in group.items()}
    return own | {key: _quick(value) for key, value in group.items() if isinstance(value, dict)}


def _tried():
    """Each figure with each value of the groups that it shares."""
    for name, stated in figures.stated().items():
        for key in stated.get("shared", []):
            for value in SHARED[key]:
                marks = () if name in DAILY else pytest.mark.long
                yield pytest.param(name, {key: value}, id=f"{name}, {key} {value}", marks=marks)


@pytest.mark.parametrize(("name", "change"), list(_tried()))
def test_a_setting_that_is_allowed_is_drawn_and_judged(
    name, change, inventory, tmp_path, monkeypatch
):
    monkeypatch.chdir(ROOT)
    whole = reference_data.load_yaml(configuration.FILE)  # as a user has it, short
    quick = {"figures": {name: _quick(figures.values(figures.stated()[name]["settings"]))}}
    config = configuration.overridden(configuration.complete(whole | quick), change)
    comparisons = configuration.comparisons(config, inventory, ledger())
    own = figure_settings.of_figure(config, inventory, comparisons, name)
    judged = figure_settings.of_judgement(config, comparisons, name)["settings"]
    curves = str(tmp_path / "curves.csv")
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            solving.solve(name, **own["curves"], output=curves)
    except Exception as error:
        assert isinstance(error, ConvergenceError) or "allowed are" in f"{error}", repr(error)
        return
    pictures = {key: str(tmp_path / f"{key}.png") for key in ("png", "light", "dark")}
    pictures["svg"] = str(tmp_path / "a.svg")
    drawings.draw(name, own["drawing"], curves, pictures)
    rows = judging.compare(name, curves, **judged)
    assert [row["comparison"] for row in rows] == [one.name for one in judged["comparisons"]]
    assert all(row["reason"] for row in rows)
    assert [row["note"] for row in rows if row["verdict"] == "FAILS"] == []
