"""A fault is noticed: tests/mutations.yaml says what is wrong, and which rows must notice it.

Each fault is planted in a finished run, whose figure alone is solved and judged again. That no row
fails without a fault is what the run itself says.
"""

import importlib
import inspect
import re
from collections import Counter
from fnmatch import fnmatchcase

import numpy as np
import pytest
import yaml

from planarimpact import continuum, lumped, models
from stronge1994 import csv_tables, curve_names, plan, reference_data
from stronge1994.figures.inelastic import curves as inelastic
from stronge1994.figures.shared.curves import beside, solving
from stronge1994.judging import compare
from stronge1994.judging import rows as judging_rows
from stronge1994.ledger import checking
from stronge1994.ledger import entries as ledger_entries
from stronge1994.plan import config as configuration
from stronge1994.verdict_tables.verdict_table import FAILS
from tests.workflow.project import ROOT

TABLE = yaml.safe_load((ROOT / "tests/mutations.yaml").read_text(encoding="utf-8"))
FAULTS = TABLE["faults"]
CONFIG = configuration.load(ROOT)
SCHEMA = reference_data.load_yaml(ROOT / "workflow/schemas/ledger.schema.yaml")
LEDGER = ledger_entries.load(ROOT / "data/stronge1994/ledger.yaml", SCHEMA)
CLAIMS = {name: entry["in_nature"] for name, entry in LEDGER.items() if "in_nature" in entry}
# What a run judges; an entry of the ledger may have a verdict by its equations, and one in nature.
JUDGED = {
    "comparisons": list(CONFIG["comparisons"]),
    "entries": [name for name, entry in LEDGER.items() if "check" in entry],
    "in nature": [name for name, claim in CLAIMS.items() if "check" in claim],
}
MANY = 4000  # rows; of more, every fortieth is enough
READ = {}  # series of reference, which each comparison reads again


def noticed_by(fault, kind):
    """Names of what must notice a fault, by the patterns of the table."""
    names = {}
    for pattern in fault.get(kind, []):
        fitting = [name for name in JUDGED[kind] if fnmatchcase(name, pattern.removeprefix("!"))]
        assert fitting, f"{pattern}: no such row"
        if pattern.startswith("!"):
            names = {name: None for name in names if name not in fitting}
        else:
            names |= dict.fromkeys(fitting)
    return list(names)


def by_figure(fault):
    """Comparisons that must notice a fault, by the figure or scene whose table they judge."""
    found = {}
    for name in noticed_by(fault, "comparisons"):
        found.setdefault(CONFIG["comparisons"][name]["figure"], []).append(name)
    return found


def test_every_row_of_a_run_notices_a_fault(inventory):
    """What is awaited has no points yet; test_awaited_series.py makes some up."""
    for kind, names in JUDGED.items():
        noticed = {name for fault in FAULTS.values() for name in noticed_by(fault, kind)}
        left = set(names) - noticed
        if kind == "comparisons":
            left = {name for name in left if not _is_awaited(name, inventory)}
        assert not left, kind


def _is_awaited(name, inventory):
    figure = CONFIG["comparisons"][name]["figure"]
    return plan.plan_of_judgement(CONFIG, inventory, figure)["rows"][name]


def changed(expression, value, given):
    """A value changed by an expression of the table, in the names of what was given beside it."""
    value = value if isinstance(value, str | tuple) else np.asarray(value)
    names = {key: one if isinstance(one, tuple) else np.asarray(one) for key, one in given.items()}
    return eval(str(expression), {"np": np, "value": value, **names})


def found_by(name):
    """Module, and name in it, of a full name."""
    module, _, attribute = name.rpartition(".")
    return importlib.import_module(module), attribute


def wrong_of(function, change):
    """A function with arguments, fields of its result (or it all, `result`) changed.

    With `instead` another function is asked, which takes what was given by position.
    """
    instead = getattr(*found_by(change["instead"])) if "instead" in change else None
    signature = inspect.signature(function)
    of_arguments = change.keys() & signature.parameters.keys()
    of_fields = change.keys() - of_arguments - {"instead", "result"}

    def wrong(*args, **kwargs):
        given = signature.bind(*args, **kwargs)
        given.apply_defaults()
        right = dict(given.arguments)
        for name in of_arguments:
            given.arguments[name] = changed(change[name], right[name], right)
        found = instead(*args) if instead else function(*given.args, **given.kwargs)
        if "result" in change:
            return changed(change["result"], found, right)
        if of_fields and hasattr(found, "events"):
            events = tuple(with_fields(event, right) for event in found.events)
            found = found._replace(events=events)
        return with_fields(found, right)

    def with_fields(found, given):
        if not of_fields:
            return found
        own = [name for name in of_fields if name in found._fields]
        return found._replace(**{n: changed(change[n], getattr(found, n), given) for n in own})

    return wrong


def plant(fault, patch):
    """Put the wrong functions of a fault in place of the right ones."""
    wrong = {
        found_by(name): wrong_of(getattr(*found_by(name)), change)
        for name, change in fault.get("solver", {}).items()
    }
    for (module, attribute), function in wrong.items():
        patch.setattr(module, attribute, function)


def wrong_settings(settings, changes):
    """Settings in which parameters are changed wherever they stand."""

    def wrong(key, value):
        if isinstance(value, dict):
            return wrong_settings(value, changes)
        return changed(changes[key], value, {}).tolist() if key in changes else value

    return {key: wrong(key, value) for key, value in settings.items()}


def wrong_columns(curves, changes):
    """Curves whose columns are changed by the first pattern that fits."""

    def wrong(where, values):
        fitting = [new for pattern, new in changes.items() if fnmatchcase(where, pattern)]
        is_number = values.dtype.kind == "f"
        return changed(fitting[0], values, {}) if fitting and is_number else values

    return {
        curve: {column: wrong(f"{curve}: {column}", values) for column, values in own.items()}
        for curve, own in curves.items()
    }


def thin(columns):
    """Every fortieth row of a very long table: the impacts of `stability`, and their reference."""
    if len(next(iter(columns.values()), ())) > MANY:
        columns |= {name: values[::40] for name, values in columns.items()}
    return columns


@pytest.fixture(scope="module")
def table_of(first_run):
    """The table of a figure or scene as the run made it; each is read once."""
    read = {}

    def table(name):
        if name not in read:
            read[name] = judging_rows.read(first_run[0] / configuration.table_of(name))
            thin(read[name].get("impacts", {}))
        return read[name]

    return table


@pytest.fixture
def judged(inventory, monkeypatch):
    """The rows of some comparisons of a figure that fail with these curves."""

    def read_once(series, arrays=reference_data.arrays):
        if series["path"] not in READ:
            READ[series["path"]] = thin(arrays(series))
        return dict(READ[series["path"]])

    monkeypatch.setattr(reference_data, "arrays", read_once)

    def failing(figure, names, curves):
        monkeypatch.setattr(judging_rows, "read", lambda _: curves)
        entries = {name: CONFIG["comparisons"][name] for name in names}
        references = plan.references(CONFIG, inventory, figure)
        with np.errstate(over="ignore"):  # distances of the largest numbers of `stability`
            rows = compare(figure, entries, references, "", CONFIG["significance"])
        return {row["comparison"]: row for row in rows if row["verdict"] in FAILS}

    return failing


def points_of(figure, inventory):
    """Settings with the points of reference of a figure; only some of those of a long table."""
    settings = solving.read_nodes(plan.nodes_of(CONFIG, inventory, figure))
    thin(settings.get("points", {}))
    return settings


def solved_anew(figure, fault, right, inventory):
    """The curves of a figure with wrong settings, or by a wrong solver: with few samples.

    Continua take long, and stay as the run made them. So do the printed equations, and curves
    off by one sigma.
    """
    settings = plan.settings(CONFIG, inventory, figure) | points_of(figure, inventory)
    less = {"as_printed": False, "samples": TABLE["samples"].get(figure)}
    settings |= {key: new for key, new in less.items() if key in settings and new is not None}
    settings.pop("uncertainty", None)
    module = importlib.import_module(f"stronge1994.figures.{figure}.curves")
    found = module.curves(**wrong_settings(settings, fault.get("settings", {})))
    kept = curve_names.AS_PRINTED, " 1 sigma"
    own = [name for name in right if not any(word in name for word in kept)]
    wrong = dict(zip(own, found.values(), strict=True))
    return right | {n: curve for n, curve in wrong.items() if not n.startswith("continuum")}


@pytest.fixture
def solved(table_of, inventory, monkeypatch):
    """The curves of a figure with a fault, without the continua, which are not looked at."""
    rebound = beside.rebound

    def quick(model, tolerance, *groups):
        model = "lumped.hysteretic" if model.startswith("continuum") else model
        return rebound(model, tolerance, *groups)

    def elastic(*groups, **_):
        return lumped.rebound(*groups)

    def curves(figure, fault):
        monkeypatch.setattr(beside, "rebound", quick)
        monkeypatch.setattr(continuum, "rebound", elastic)
        plant(fault, monkeypatch)
        return solved_anew(figure, fault, table_of(figure), inventory)

    return curves


OF_FIGURES = {
    f"{words}: {figure}": (fault, figure, names)
    for words, fault in FAULTS.items()
    for figure, names in by_figure(fault).items()
}
SOLVED = {figure for fault, figure, _ in OF_FIGURES.values() if "columns" not in fault}


@pytest.mark.parametrize("figure", sorted(SOLVED))
def test_no_comparison_fails_without_a_fault(figure, solved, judged):
    """With the few samples, too: else it could be they that are noticed."""
    assert not judged(figure, plan.comparisons(CONFIG, figure), solved(figure, {}))


@pytest.mark.parametrize(("fault", "figure", "names"), OF_FIGURES.values(), ids=OF_FIGURES)
def test_comparisons_notice(fault, figure, names, table_of, solved, judged):
    if "columns" in fault:
        curves = wrong_columns(table_of(figure), fault["columns"])
    else:
        curves = solved(figure, fault)
    rows = judged(figure, names, curves)
    # One that has measured nothing has not noticed this fault.
    assert {name for name, row in rows.items() if row["points"]} == set(names)


OF_LEDGER = [words for words, fault in FAULTS.items() if "entries" in fault]
IN_NATURE = [words for words, fault in FAULTS.items() if "in nature" in fault]


@pytest.mark.slow
@pytest.mark.parametrize("words", OF_LEDGER)
def test_entries_of_the_ledger_notice(words, monkeypatch):
    names = noticed_by(FAULTS[words], "entries")
    asked = {name: {k: v for k, v in LEDGER[name].items() if k != "in_nature"} for name in names}
    plant(FAULTS[words], monkeypatch)
    with np.errstate(all="ignore"):
        rows = checking.check(asked)
    # A check that only crashes with a fault has not compared anything.
    noticed = {
        row["entry"] for row in rows if row["holds"] == "no" and row["found"] not in ("", "nan")
    }
    assert noticed == set(names)


@pytest.mark.slow
@pytest.mark.parametrize("words", IN_NATURE)
def test_claims_in_nature_notice(words, monkeypatch):
    names = noticed_by(FAULTS[words], "in nature")
    plant(FAULTS[words], monkeypatch)
    measured = checking.measure({name: {"in_nature": CLAIMS[name]} for name in names})
    noticed = {name for name in names if checking.judge(CLAIMS[name], measured)}
    assert noticed == set(names)


def held(name, curves):
    """Curves and columns of numbers, not all 0, that something independent can hold."""
    for curve, columns in curves.items():
        for column, values in columns.items():
            where = f"{name}: {curve}: {column}"
            # Curves off by a sigma only say how uncertain another one is.
            free = "1 sigma" in curve or column in inputs(name)
            free |= any(re.fullmatch(entry["columns"], where) for entry in TABLE["not_held"])
            if values.dtype.kind == "f" and values.any() and not free:
                yield curve, column


def inputs(name):
    """Columns that are copies of what a scene was given."""
    if not name.startswith(curve_names.SCENE):
        return set()
    table = ROOT / f"data/scenes/{name.removeprefix(curve_names.SCENE)}.csv"
    return {"row [1]", *table.read_text(encoding="utf-8").splitlines()[0].split(",")}


def looks_at(entry, references, curve, column):
    """Whether a comparison looks at a column of a curve."""
    named = entry.get("columns") or [entry.get("landmark", {}).get(axis) for axis in "xy"]
    if "reference" in entry and "landmark" not in entry:
        series = references[entry["reference"]]
        axes = series["x"], *reference_data.ordinates(series)
        named = [reference_data.column_name(axis) for axis in axes]
    return entry.get("curve", curve) == curve and column in named


def at_nodes(curves, figure, inventory):
    """Curves at the points of reference alone: all that is needed to judge their vertices."""
    nodes = solving.read_nodes(plan.nodes_of(CONFIG, inventory, figure)).get("nodes", {})
    short = dict(curves)
    for curve, columns in curves.items():
        for column, values in columns.items():
            kept = np.isin(values, nodes.get(column.split(" [")[0], ()))
            if kept.any():
                short[curve] = {name: own[kept] for name, own in columns.items()}
    return short


@pytest.mark.parametrize("name", configuration.judged(CONFIG))
@pytest.mark.parametrize("factor", [1.3, pytest.param(-1.0, marks=pytest.mark.long)])
def test_no_column_can_be_scaled_or_flipped(name, factor, table_of, judged, inventory):
    missed, caught = [], Counter()
    whole, entries = table_of(name), plan.comparisons(CONFIG, name)
    references = plan.references(CONFIG, inventory, name)
    short = at_nodes(whole, name, inventory) if name in CONFIG["figures"] else whole
    of_vertices = [title for title, entry in entries.items() if entry["metric"] == "vertices"]
    assert not judged(name, of_vertices, short)
    for curve, column in held(name, whole):
        asked = [
            (-caught[title], "curve" not in entry, title)
            for title, entry in entries.items()
            if looks_at(entry, references, curve, column)
        ]
        # The one that has seen most faults comes first.
        for *_, title in sorted(asked):
            right = short if title in of_vertices else whole
            wrong = right | {curve: right[curve] | {column: factor * right[curve][column]}}
            if any(row["points"] for row in judged(name, [title], wrong).values()):
                caught[title] += 1
                break
        else:
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
def test_a_fault_between_the_points_of_reference_is_noticed(name, curve, rows, table_of, judged):
    curves, column = table_of(name), "velocity [mu v2(0)]"
    velocity = curves[curve][column].copy()
    velocity[rows] = -velocity[rows] - 0.1
    wrong = curves | {curve: curves[curve] | {column: velocity}}
    assert judged(name, [f"{name}-contraction"], wrong)


@pytest.mark.parametrize("power", [1, -2])
def test_a_wrong_repair_of_the_lumped_model_is_noticed(
    power, table_of, judged, inventory, monkeypatch
):
    """The model has e^2 zeta^2; here e has another power."""
    model = "lumped.unloading-stiffness"

    def rebound(_, x, beta, zeta2, e):
        return lumped.rebound(x, beta, np.power(e, power) * zeta2, e)

    monkeypatch.setattr(inelastic, "MODELS", (model,))
    monkeypatch.setattr(models, "rebound", rebound)
    settings = plan.settings(CONFIG, inventory, "inelastic") | points_of("inelastic", inventory)
    wrong = table_of("inelastic") | inelastic.curves(**settings)
    names = [f"inelastic-{n}" for n in (f"{model}-pairs", "pairs", "rebound")]
    names.append("inelastic-tangential-restitution")
    assert set(judged("inelastic", names, wrong)) == set(names)


def test_curves_that_are_not_finite_are_wrong(tmp_path):
    path = tmp_path / "fig6.csv"
    columns = {"incidence [mu v2(0)]": [0.0, 1.0], "velocity [mu v2(0)]": [0.0, np.nan]}
    csv_tables.write(path, {"e = 1": {name: np.array(values) for name, values in columns.items()}})
    row = compare("fig6", {}, {}, path, 0.01)[0]
    assert row["verdict"] == "wrong" and "allowed are finite numbers" in row["note"]
