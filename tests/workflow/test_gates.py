"""Each comparison passes with the right solver, and a wrong solver trips it."""

import csv
import importlib
from pathlib import Path

import numpy as np
import pytest

from planarimpact import lumped, noncollinear
from stronge1994 import csv_tables, plan
from stronge1994.figures.shared.curves import solving
from stronge1994.judging import compare, sensitivity
from stronge1994.plan import config as configuration
from stronge1994.reference_data import conversion

ROOT = Path(__file__).parents[2]

# Tables of 40 digits that must see the smallest fault.
SEE_THE_SMALL = ("fig3-events", "fig6-rebound", "fig9-dissipation")
# Two columns of one solver, which a fault of its settings changes alike: the solver, and the
# field of its rebound that must forget a little.
BALANCES = {
    "fig9-energy-balance": (lumped, "dissipation"),
    "rod-energy-balance": (noncollinear, "friction_work"),
    "stability-energy-balance": (lumped, "dissipation"),
}
# The table of sensitivity has changes by half at most. These comparisons see a larger change.
BY_TRIAL = {
    "fig8-friction-below-limit": {"friction": lambda mu: mu / 100},
    "fig8-friction-reverses": {"friction": lambda mu: mu / 100},
}
# The columns that these hold are scaled in test_columns.py; the impacts are what was asked for.
ELSEWHERE = ["fig6-printed", "fig7-printed", "fig9-printed", "stability-inputs"]
# These hold a law alone, which has no group in the settings: tests/unit/test_yielding.py.
ELSEWHERE += [
    f"yielding-pushed-{part}" for part in ("e-0.81", "e-0.66", "e-0.55", "e-0.45", "range")
]
SHORT_TABLE = 100  # rows; so few are all solved


@pytest.fixture(scope="module")
def config():
    return configuration.load(ROOT)


@pytest.fixture(scope="module")
def series(inventory, tmp_path_factory):
    folder = tmp_path_factory.mktemp("series")
    found = [
        n for n, s in inventory.items() if any(e["path"] for e in s.get("series", {}).values())
    ]
    for name in found:
        conversion.convert(inventory[name], folder / f"{name}.csv")
    return {name: str(folder / f"{name}.csv") for name in found}


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


def _changed(settings, change):
    wrong = dict(settings)
    for key, new in change.items():
        if key in settings:
            old = settings[key]
            values = [new(v) if callable(new) else new for v in np.ravel(old).tolist()]
            wrong[key] = values if isinstance(old, list) else values[0]
    return wrong


@pytest.fixture(scope="module")
def smallest(first_run):
    """The smallest change of a group that each comparison catches, by the run's own table."""
    rows = csv_tables.read_rows(first_run[0] / "results/sensitivity.csv")
    sizes = {row["comparison"]: [row[group] for group in sensitivity.GROUPS] for row in rows}
    return {
        name: min((float(size) for size in found if size not in ("", "none")), default=None)
        for name, found in sizes.items()
    }


def test_every_comparison_catches_wrong_physics(smallest, config, inventory):
    """That the right physics passes is what the whole run says."""
    awaited = {
        name for name, waits in plan.expected_rows(config, inventory).items() if waits
    }  # their gate is tried with a made-up series in test_awaited_series.py
    told = {*BY_TRIAL, *BALANCES, *ELSEWHERE, *awaited}
    for name, entry in config["comparisons"].items():
        figure = entry["figure"] in config["figures"] and entry["figure"] != "trade"
        if figure and entry["metric"] not in ("range", "contraction") and name not in told:
            assert smallest[name] is not None, f"{name}: a check that cannot fail"
    assert all(smallest[name] <= 1e-10 for name in SEE_THE_SMALL)


@pytest.mark.parametrize("name", BY_TRIAL)
def test_a_wrong_solver_trips_the_gate(name, config, inventory, series, tmp_path):
    figure, path = name.split("-")[0], tmp_path / "curves.csv"
    settings = plan.settings(config, inventory, figure)
    curves = importlib.import_module(f"stronge1994.figures.{figure}.curves").curves
    with pytest.MonkeyPatch.context() as patch:
        module = importlib.import_module(f"stronge1994.figures.{figure}.curves")
        wrong = _changed(settings, BY_TRIAL[name])
        patch.setattr(module, "curves", lambda **_: curves(**wrong))
        solving.solve(figure, settings, plan.nodes_of(config, inventory, figure), path)
    references = plan.references(config, inventory, figure)
    rows = compare(figure, {name: config["comparisons"][name]}, references, path, series, 0.01)
    assert [row["verdict"] for row in rows] == ["as before", "diverges"]


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
    rows = compare(figure, {name: config["comparisons"][name]}, {}, path, {}, 0.01)
    assert [row["verdict"] for row in rows] == ["as before", "diverges"]


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
    rows = compare("stability", {name: config["comparisons"][name]}, {}, path, {}, 0.01)
    assert [row["verdict"] for row in rows] == ["as before", "diverges"]


def test_curves_that_are_not_finite_diverge(config, inventory, series, tmp_path):
    path = tmp_path / "fig6.csv"
    path.write_text(
        "curve,incidence [mu v2(0)],velocity [mu v2(0)]\ne = 1,0.0,0.0\ne = 1,1.0,nan\n"
    )
    rows = compare("fig6", {}, {}, path, series, 0.01)
    assert rows[0]["verdict"] == "diverges" and "allowed are finite numbers" in rows[0]["note"]
