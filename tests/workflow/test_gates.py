"""Each comparison passes with the right solver, and a wrong solver trips it."""

import csv
import functools
import importlib
from pathlib import Path

import numpy as np
import pytest

from planarimpact import lumped, noncollinear
from stronge1994 import csv_tables, curve_names, plan
from stronge1994.figures.shared.curves import solving
from stronge1994.judging import compare
from stronge1994.judging import rows as judging_rows
from stronge1994.plan import config as configuration
from stronge1994.verdict_tables.verdict_table import FAILS

ROOT = Path(__file__).parents[2]

# Two columns of one solver, which a fault of its settings changes alike: the solver, and the
# field of its rebound that must forget a little.
BALANCES = {
    "fig9-energy-balance": (lumped, "dissipation"),
    "rod-energy-balance": (noncollinear, "friction_work"),
    "stability-energy-balance": (lumped, "dissipation"),
}
# Parameters of the figures of the paper. Each is wrong by a share of it; restitution is lower by a
# difference, or higher if it is 0.
PARAMETERS = ("stiffness_ratio", "mass_ratio", "restitution", "friction")
# For each of these figures, the comparison with 40 digits that notices if any parameter is wrong
# by `SMALL`. Every other comparison notices if one of them is wrong by `LARGE`.
SMALL, LARGE = 1e-10, 0.1
EXACT = {
    "fig2": "fig2-elements",
    "fig3": "fig3-events",
    "fig4": "fig4-events",
    "fig5": "fig5-lumped-experiment-exact",
    "fig6": "fig6-rebound",
    "fig7": "fig7-peak-force",
    "fig8": "fig8-peak-force",
    "fig9": "fig9-dissipation",
}
# These notice only what is larger still, each in one parameter: stated angles have wide tolerances.
COARSE = {
    "fig5-continuum-fem-initial-stick": ("mass_ratio", 0.2, -0.2),
    "fig7-peak-angle-mu-0.1": ("friction", 0.6, -0.2),
    "fig7-peak-angle-mu-1": ("friction", 0.6, -0.2),
    "fig8-friction-below-limit": ("friction", -0.99),
    "fig8-friction-reverses": ("friction", -0.99),
}
# Formulas as printed stay as they are: their columns are scaled in test_columns.py.
PRINTED = {"fig6-printed", "fig7-printed", "fig9-printed"}
# Fewer samples of figures that take long. The points of reference are added to them.
SAMPLES = {"fig5": 10, "fig6": 10, "fig8": 90, "fig9": 10}
SHORT_TABLE = 100  # rows; so few are all solved


@pytest.fixture(scope="module")
def config():
    return configuration.load(ROOT)


def _nodes(config, inventory, figure, folder):
    """Reference tables of a figure; of a long one that is read whole, every fortieth row."""
    nodes = plan.nodes_of(config, inventory, figure)
    if None not in nodes.values():
        return nodes
    with open(*nodes, newline="", encoding="utf-8") as file:
        header, *rows = csv.reader(file)
    if len(rows) < SHORT_TABLE:
        return nodes
    short = folder / "points.csv"
    with open(short, "w", newline="", encoding="utf-8") as file:
        csv.writer(file).writerows([header, *rows[::40]])
    return {str(short): None}


def _wrong(settings, parameter, size):
    """Settings in which one of `PARAMETERS` is wrong by `size`, wherever it stands."""

    def number(right):
        if parameter == "restitution":
            return right - size if right >= size else right + size
        return right * (1 + size)

    def wrong(key, value):
        if isinstance(value, dict):
            return _wrong(value, parameter, size)
        if key != parameter:
            return value
        return [number(right) for right in value] if isinstance(value, list) else number(value)

    return {key: wrong(key, value) for key, value in settings.items()}


def _settings(figure, config, inventory):
    """Settings of a figure, without formulas as printed and curves off by one sigma."""
    settings = plan.settings(config, inventory, figure)
    settings |= solving.read_nodes(plan.nodes_of(config, inventory, figure))
    less = {"as_printed": False, "samples": SAMPLES.get(figure)}
    settings |= {key: new for key, new in less.items() if key in settings and new is not None}
    settings.pop("uncertainty", None)
    return settings


READ = functools.cache(csv_tables.read)


@pytest.fixture
def diverging(first_run, config, inventory, monkeypatch):
    """Function: the comparisons that diverge if a parameter of a figure's curves is wrong.

    Curves as printed, and those off by one sigma, stay as the run made them.
    """

    def comparisons(asked, figure, parameter, size):
        wrong = _wrong(_settings(figure, config, inventory), parameter, size)
        module = importlib.import_module(f"stronge1994.figures.{figure}.curves")
        curves = READ(first_run[0] / f"results/curves/{figure}.csv")
        own = [n for n in curves if not (curve_names.is_shifted(n) or curve_names.AS_PRINTED in n)]
        solved = curves | dict(zip(own, module.curves(**wrong).values(), strict=True))
        monkeypatch.setattr(judging_rows, "read", lambda _: solved)
        entries = {name: config["comparisons"][name] for name in asked}
        references = plan.references(config, inventory, figure)
        rows = compare(figure, entries, references, "", config["significance"])
        return {row["comparison"] for row in rows if row["verdict"] in FAILS}

    return comparisons


@pytest.mark.parametrize("figure", EXACT)
def test_every_comparison_notices_a_wrong_parameter(figure, diverging, config, inventory):
    """That none diverges if all are right is what the whole run says."""
    entries, settings = plan.comparisons(config, figure), _settings(figure, config, inventory)
    laws = {name for name, entry in entries.items() if entry["metric"] in ("range", "contraction")}
    # What is awaited is tried with a made-up series in test_awaited_series.py.
    rows = plan.plan_of_judgement(config, inventory, figure)["rows"]
    awaited = {name for name, waits in rows.items() if waits}
    left = set(entries) - laws - awaited - PRINTED - set(BALANCES) - set(COARSE)
    for parameter in PARAMETERS:
        if _wrong(settings, parameter, LARGE) == settings:
            continue
        assert diverging([EXACT[figure]], figure, parameter, SMALL), parameter
        ways = (1,) if parameter == "restitution" else (1, -1)
        if left:
            seen = [diverging(left, figure, parameter, way * LARGE) for way in ways]
            left -= set.intersection(*seen)
    assert left == set()
    for name in set(entries) & set(COARSE):
        parameter, *sizes = COARSE[name]
        assert all(diverging([name], figure, parameter, size) for size in sizes), name


@pytest.mark.parametrize("name", BALANCES)
def test_energy_that_does_not_balance_trips_the_gate(name, config, inventory, tmp_path):
    model, field = BALANCES[name]
    figure, path, rebound = name.split("-")[0], tmp_path / "curves.csv", model.rebound

    def forgetful(*args, **kwargs):
        found = rebound(*args, **kwargs)
        return found._replace(**{field: getattr(found, field) * (1 - 1e-10)})

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(model, "rebound", forgetful)
        settings = plan.settings(config, inventory, figure)
        solving.solve(figure, settings, _nodes(config, inventory, figure, tmp_path), path)
    rows = compare(figure, {name: config["comparisons"][name]}, {}, path, 0.01)
    assert [row["verdict"] for row in rows] == ["as before", "wrong"]


def _more_restitution(rebound):
    return lambda x, beta, zeta2, e: rebound(x, beta, zeta2, np.minimum(e + 1e-9, 1))


def _lost_root(rebound):
    """In one corner the contact goes on to the next root, and leaves in the other direction."""

    def wrong(x, beta, zeta2, e):
        found = rebound(x, beta, zeta2, e)
        corner = (e > 0) & (e < 1e-8) & (zeta2 < 1e-4)
        return found._replace(velocity=np.where(corner, -found.velocity, found.velocity))

    return wrong


def _crash(rebound):
    def wrong(x, *groups):
        if np.max(x) > 1e100:
            raise ArithmeticError("oh")
        return rebound(x, *groups)

    return wrong


def _too_much_friction(history):
    def wrong(*group, samples):
        found = history(*group, samples)
        events = [event._replace(friction=(1 + 1e-12) * event.friction) for event in found.events]
        return found._replace(events=events)

    return wrong


@pytest.mark.parametrize(
    ("name", "function", "fault"),
    [
        ("stability-digits", "rebound", _more_restitution),
        ("stability-digits", "rebound", _lost_root),
        ("stability-digits", "rebound", _crash),
        ("stability-friction-limit", "history", _too_much_friction),
    ],
)
def test_a_fault_anywhere_in_the_box_trips_the_gate(
    name, function, fault, config, inventory, tmp_path, monkeypatch
):
    path, settings = tmp_path / "curves.csv", plan.settings(config, inventory, "stability")
    monkeypatch.setattr(lumped, function, fault(getattr(lumped, function)))
    solving.solve("stability", settings, _nodes(config, inventory, "stability", tmp_path), path)
    rows = compare("stability", {name: config["comparisons"][name]}, {}, path, 0.01)
    assert [row["verdict"] for row in rows] == ["as before", "wrong"]


def test_curves_that_are_not_finite_diverge(config, inventory, tmp_path):
    path = tmp_path / "fig6.csv"
    path.write_text(
        "curve,incidence [mu v2(0)],velocity [mu v2(0)]\ne = 1,0.0,0.0\ne = 1,1.0,nan\n"
    )
    rows = compare("fig6", {}, {}, path, 0.01)
    assert rows[0]["verdict"] == "wrong" and "allowed are finite numbers" in rows[0]["note"]
