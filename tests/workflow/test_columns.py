"""Every column that a run judges is held by something independent of it: it cannot be scaled."""

import re
from collections import Counter
from pathlib import Path

import numpy as np
import pytest

from planarimpact import lumped, models
from stronge1994 import plan, reference_data
from stronge1994.curve_names import SCENE
from stronge1994.figures.inelastic import curves as inelastic
from stronge1994.figures.shared.curves import solving
from stronge1994.judging import compare, points
from stronge1994.judging import rows as judging_rows
from stronge1994.plan import config as configuration
from stronge1994.verdict_tables.verdict_table import FAILS

ROOT = Path(__file__).parents[2]
SCHEMAS = ROOT / "workflow/schemas"
CONFIG = configuration.load(ROOT)
INVENTORY = reference_data.load_all(
    ROOT / "data", reference_data.load_yaml(SCHEMAS / "source.schema.yaml")
)
# What nothing independent can hold, as patterns of "judged: curve: column", and why.
NOT_HELD = {
    r".*: (time\w*|scatter_\w+|build_time) \[(s|1)\]": "measured on this machine",
    r"trade: .*: (steps|circles|knots|tolerance|reference_error) .*": "what was asked for",
    r"trade: (spline|continuum|annuli|spheres).*: (rms|max|rest)\w* .*": "an error, bounded",
    r"stability: contacts: (incidence|mass_ratio|stiffness_ratio|restitution) .*": "as in impacts",
    r"stability: .*: (omega|phases|digits_allowed_\w+) .*": "tells where, and what could be had",
    r"stability: .*: (digits_lost|friction_excess|energy_residual) .*": "an error, bounded",
    r"scene_\w+: impacts: error_bound .*": "a bound of the error",
    r"trade: .*: (input_spread\w*|seen) .*": "held by tests/unit/test_models.py, by random inputs",
}

READ = {}  # series of reference, which each comparison reads again
CAUGHT = Counter()  # how many faults each comparison has seen: the most successful is asked first


def _read_once(series, arrays=reference_data.arrays):
    """The columns of a series, for whoever may change what they are called."""
    key = series["path"]
    if key not in READ:
        READ[key] = arrays(series)
    return dict(READ[key])


def _fails(name, path, only=None, curve=None):
    """Whether a comparison of what is judged under a name fails, or only one of them.

    Those of one `curve` come first.
    """

    def order(item):
        title, entry = item
        return entry.get("curve") != curve, -CAUGHT[title]

    references = plan.references(CONFIG, INVENTORY, name)
    for title, entry in sorted(plan.comparisons(CONFIG, name).items(), key=order):
        if only in (None, title):
            rows = compare(name, {title: entry}, references, path, CONFIG["significance"])
            if any(row["verdict"] in FAILS for row in rows):
                CAUGHT[title] += 1
                return True
    return False


@pytest.fixture(scope="module")
def tables(first_run):
    """Folder of a finished run."""
    return first_run[0].folder


def _columns(name, curves):
    """What can be wrong: curves and columns of numbers that are not all 0."""
    for curve, columns in curves.items():
        for column, values in columns.items():
            where = f"{name}: {curve}: {column}"
            # Curves off by a sigma only say how uncertain another one is.
            held = "1 sigma" not in curve and column not in _inputs(name)
            held &= values.dtype.kind == "f" and values.any()
            if held and not any(re.fullmatch(pattern, where) for pattern in NOT_HELD):
                yield curve, column


def _inputs(name):
    """Columns that are copies of what a scene was given."""
    if name.startswith(SCENE):
        table = ROOT / f"data/scenes/{name.removeprefix(SCENE)}.csv"
        return {"row [1]", *table.read_text(encoding="utf-8").splitlines()[0].split(",")}
    return set()


@pytest.mark.parametrize("name", configuration.judged(CONFIG))
@pytest.mark.parametrize("factor", [1.3, pytest.param(-1.0, marks=pytest.mark.long)])
def test_no_column_can_be_scaled_or_flipped(name, factor, tables, monkeypatch):
    path = tables / configuration.table_of(name)
    curves, missed = judging_rows.read(path), []
    monkeypatch.setattr(reference_data, "arrays", _read_once)
    for curve, column in _columns(name, curves):
        wrong = curves | {curve: curves[curve] | {column: factor * curves[curve][column]}}
        monkeypatch.setattr(judging_rows, "read", lambda _, wrong=wrong: wrong)
        if not _fails(name, path, curve=curve):
            missed.append((curve, column))
    assert missed == []


@pytest.mark.parametrize(
    ("name", "curve", "rows"),
    [
        ("fig5", "lumped", slice(703, 704)),
        ("fig6", "e = 0", [300]),
        ("inelastic", "continuum.viscous, e = 0.6", [37]),
    ],
)
def test_a_fault_between_the_points_of_reference_is_seen(name, curve, rows, tables, monkeypatch):
    path, column = tables / configuration.table_of(name), "velocity [mu v2(0)]"
    curves = judging_rows.read(path)
    velocity = curves[curve][column].copy()
    velocity[rows] = -velocity[rows] - 0.1
    wrong = curves | {curve: curves[curve] | {column: velocity}}
    monkeypatch.setattr(judging_rows, "read", lambda _: wrong)
    assert _fails(name, path, only=f"{name}-contraction")


@pytest.mark.parametrize("power", [1, 0, -2])
def test_a_wrong_repair_of_the_lumped_model_is_seen(power, tables, monkeypatch):
    """The model has e^2 zeta^2; here e has another power."""
    path, model = tables / configuration.table_of("inelastic"), "lumped.unloading-stiffness"
    settings = plan.settings(CONFIG, INVENTORY, "inelastic")
    settings |= solving.read_nodes(plan.nodes_of(CONFIG, INVENTORY, "inelastic"))
    monkeypatch.setattr(inelastic, "MODELS", (model,))
    monkeypatch.setattr(
        models,
        "rebound",
        lambda _, x, beta, zeta2, e: lumped.rebound(x, beta, np.power(e, power) * zeta2, e),
    )
    wrong = judging_rows.read(path) | inelastic.curves(**settings)
    monkeypatch.setattr(judging_rows, "read", lambda _: wrong)
    for name in (f"{model}-pairs", "pairs", "rebound", "tangential-restitution"):
        assert _fails("inelastic", path, only=f"inelastic-{name}"), name


SLIDING = "chung_ooi2011/rebound"


def test_sigmas_do_not_come_from_the_points_they_judge():
    """The velocity of the finite elements: from points that nothing looks at."""
    limits = points.limits_of_regimes(3.5, 1.2143, 1.0)
    sheet = INVENTORY["chung_ooi2011"]["series"]["rebound"]
    columns = reference_data.arrays(sheet)
    x, w = (columns[reference_data.column_name(sheet[axis])] for axis in "xy")
    off = (w - (x - 7.0))[x > limits[1]]
    assert sheet["x"]["sigma"] == sheet["y"]["sigma"] == round(np.sqrt(np.mean(off**2) / 2), 3)
    judged = [c for c in CONFIG["comparisons"].values() if c.get("reference") == SLIDING]
    assert {c["regime"] for c in judged} == {"initial stick", "slip and stick"}


READ_AGAIN = [
    ("chung_ooi2011", "spin", 0.1),
    ("kharaz2001", "spin", 1.0),
    ("kharaz2001", "tangential_restitution", 1.0),
]


@pytest.mark.parametrize(("source", "name", "near"), READ_AGAIN)
def test_sigmas_are_the_spread_of_readings_of_which_one_is_judged(source, name, near):
    """Readings of one point are at most `near` apart; what only one person read tells nothing."""
    sheet = INVENTORY[source]["series"][name]
    columns = reference_data.arrays(sheet)
    reader = columns["digitiser"]
    xy = np.transpose([columns[reference_data.column_name(sheet[axis])] for axis in "xy"])
    squares, degrees = np.zeros(2), 0
    for point in xy[reader == "kratos"]:
        readings = xy[np.abs(xy[:, 0] - point[0]) < near]
        squares += np.sum((readings - readings.mean(axis=0)) ** 2, axis=0)
        degrees += len(readings) - 1
    sigma = [sheet[axis]["sigma"] for axis in "xy"]
    assert [float(f"{size:.2g}") for size in np.sqrt(squares / degrees)] == sigma
    assert sheet["sigma_values"] == degrees
    judged = [c for c in CONFIG["comparisons"].values() if c.get("reference") == f"{source}/{name}"]
    assert judged and all(len(entry["points"]) == 1 for entry in judged)
