"""A fault is noticed: tests/mutations.yaml says what is wrong, and which rows must notice it.

Each fault is planted in a finished run, whose figure alone is solved and judged again. That no row
fails without a fault is what the run itself says.
"""

import importlib
import inspect
import re
from fnmatch import fnmatchcase
from pkgutil import resolve_name

import numpy as np
import pandas as pd
import pytest
import yaml

from planarimpact import continuum, lumped
from stronge1994 import names as of_models
from stronge1994 import settings as figure_settings
from stronge1994 import solving, tables
from stronge1994.figures.shared.curves import curves_below_one
from stronge1994.judging import compare
from stronge1994.judging import rows as judging_rows
from stronge1994.ledger import checking
from stronge1994.names import home
from stronge1994.settings import config as configuration
from stronge1994.verdict_table import Verdict
from tests.workflow.project import ROOT, awaited, config, ledger

TABLE = yaml.safe_load((ROOT / "tests/mutations.yaml").read_text(encoding="utf-8"))
FAULTS = TABLE["faults"]
CONFIG = config()
LEDGER = ledger()
CLAIMS = {name: entry["in_nature"] for name, entry in LEDGER.items() if "in_nature" in entry}
# What a run judges; an entry of the ledger may have a verdict by its equations, and one in nature.
JUDGED = {
    "comparisons": list(CONFIG["comparisons"]),
    "entries": [name for name, entry in LEDGER.items() if "check" in entry],
    "in nature": [name for name, claim in CLAIMS.items() if "check" in claim],
}


def noticed_by(fault, kind):
    """Names of what must notice a fault: of the patterns that fit, the last one decides."""
    decides = {
        name: pattern
        for pattern in fault.get(kind, [])
        for name in JUDGED[kind]
        if fnmatchcase(name, pattern.removeprefix("!"))
    }
    return [name for name, pattern in decides.items() if not pattern.startswith("!")]


# Faults with the figure, or scene, whose table is judged, and the rows of it that must notice.
OF_FIGURES = {}
for words, fault in FAULTS.items():
    for name in noticed_by(fault, "comparisons"):
        figure = CONFIG["comparisons"][name]["figure"]
        OF_FIGURES.setdefault(f"{words}: {figure}", (fault, figure, set()))[2].add(name)
# Figures that are solved with a fault, and all rows that must notice one of these faults.
SOLVED = {}
for fault, figure, names in OF_FIGURES.values():
    if "columns" not in fault:
        SOLVED[figure] = SOLVED.get(figure, set()) | names


def test_every_row_of_a_run_notices_a_fault():
    """What is awaited has no points yet; test_awaited_series.py makes some up."""
    for kind, names in JUDGED.items():
        noticed = {name for fault in FAULTS.values() for name in noticed_by(fault, kind)}
        assert set(names) - noticed <= set(awaited()), kind


def changed(expression, value, given):
    """A value changed by an expression of the table, in the names of what was given beside it."""
    value = value if isinstance(value, str | tuple) else np.asarray(value)
    names = {key: one if isinstance(one, tuple) else np.asarray(one) for key, one in given.items()}
    return eval(str(expression), {"np": np, "value": value, **names})


def wrong_of(name, change):
    """A function with arguments, fields of its result (or it all, `result`) changed.

    With `instead` another function is asked, which takes what was given by position.
    """
    function, instead = resolve_name(name), change.get("instead")
    asked = resolve_name(instead or name)
    signature = inspect.signature(function)
    of_arguments = change.keys() & signature.parameters.keys()
    of_fields = change.keys() - of_arguments - {"instead", "result"}

    def wrong(*args, **kwargs):
        given = signature.bind(*args, **kwargs)
        given.apply_defaults()
        right = dict(given.arguments)
        for argument in of_arguments:
            given.arguments[argument] = changed(change[argument], right[argument], right)
        found = asked(*args) if instead else asked(*given.args, **given.kwargs)
        if "result" in change:
            return changed(change["result"], found, right)
        if of_fields and hasattr(found, "events"):
            events = tuple(with_fields(event, right) for event in found.events)
            found = found._replace(events=events)
        return with_fields(found, right)

    def with_fields(found, given):
        own = of_fields & set(getattr(found, "_fields", ()))
        new = {field: changed(change[field], getattr(found, field), given) for field in own}
        return found._replace(**new) if new else found

    return wrong


def plant(fault, patch):
    """Put the wrong functions of a fault in place of the right ones."""
    wrong = {name: wrong_of(name, change) for name, change in fault.get("solver", {}).items()}
    for name, function in wrong.items():
        patch.setattr(name, function)


def wrong_settings(settings, changes):
    """Settings in which parameters are changed wherever they stand."""

    def wrong(key, value):
        if isinstance(value, dict):
            return wrong_settings(value, changes)
        return changed(changes[key], value, {}).tolist() if key in changes else value

    return {key: wrong(key, value) for key, value in settings.items()}


def wrong_columns(curves, changes):
    """Curves whose columns of numbers are changed by the first pattern that fits."""

    def wrong(where, values):
        fitting = [new for pattern, new in changes.items() if fnmatchcase(where, pattern)]
        return changed(fitting[0], values, {}) if fitting else values

    def wrong_curve(name, own):
        columns = list(filter(tables.is_quantity, own))
        new = {column: wrong(f"{name}: {column}", own[column]) for column in columns}
        for column, sigma in ((column, tables.sigma_name(column)) for column in columns):
            if sigma in columns:  # what the fault makes of a parameter that is off by its sigma
                new[sigma] = wrong(f"{name}: {column}", own[column] + own[sigma]) - new[column]
        return own.assign(**new)

    return pd.concat(wrong_curve(*one) for one in curves.groupby("curve", sort=False))


@pytest.fixture(scope="module")
def table_of(first_run):
    """The table of a figure or scene as the run made it; each is read once."""
    read = {}

    def table(name):
        if name not in read:
            read[name] = judging_rows.read(first_run[0] / configuration.table_of(name))
        return read[name]

    return table


@pytest.fixture
def judged(inventory, monkeypatch):
    """The comparisons of a figure, of these names, that fail with these curves.

    One that has measured nothing has not noticed a fault. If one curve alone is wrong, it is named
    as `wrong`: of a second code only its points are compared.
    """

    def failing(figure, names, curves, wrong=None):
        monkeypatch.setattr(judging_rows, "read", lambda _: curves)
        references = figure_settings.references(CONFIG, inventory, figure)
        entries = {name: CONFIG["comparisons"][name] for name in names}
        if wrong is not None:
            entries = {name: beside(wrong, entry, references) for name, entry in entries.items()}
        with np.errstate(over="ignore"):  # distances of the largest numbers of `stability`
            rows = compare(figure, "", entries, references, CONFIG["significance"], {})
        return {
            row["comparison"] for row in rows if row["verdict"] == Verdict.FAILS and row["points"]
        }

    return failing


def selected(entry):
    """By what a comparison selects its curves."""
    return entry.get("curve", {})


def beside(wrong, entry, references):
    """A comparison with only the points of a second code that are beside this curve.

    The one that is farthest off decides there, so that the others cannot notice more.
    """
    reference = references.get(entry.get("reference"), {})
    if reference.get("kind") != "computed" or "differs" in entry:
        return entry
    labels = [key for key in reference.get("labels", []) if key not in selected(entry)]
    own = {key: wrong[key].unique() for key in labels if key in wrong and wrong[key].any()}
    return entry | {"points": own | entry.get("points", {})}


def settings_of(figure, inventory):
    """Settings of a figure with its points of reference, and with few samples."""
    settings = figure_settings.physics(CONFIG, inventory, figure)
    settings |= solving.read_nodes(figure_settings.nodes_of(CONFIG, inventory, figure))
    if figure in TABLE["samples"]:
        settings["samples"] = TABLE["samples"][figure]
    if figure == "stability":
        settings["points"] = {name: row[::10] for name, row in settings["points"].items()}
    return settings


@pytest.fixture
def solved(table_of, inventory, monkeypatch):
    """The curves of a figure with wrong settings, or by a wrong solver.

    Continua take long, and stay as the run made them. So do the printed equations, and curves
    off by one sigma.
    """
    rebound = curves_below_one.rebound

    def quick(model, *more):
        return rebound("lumped.hysteretic" if model.startswith("continuum") else model, *more)

    def curves(figure, fault):
        monkeypatch.setattr(curves_below_one, "rebound", quick)
        monkeypatch.setattr(continuum, "rebound", lambda *groups, **_: lumped.rebound(*groups))
        plant(fault, monkeypatch)
        settings = settings_of(figure, inventory)
        settings.pop("uncertainty", None)
        settings |= {"as_printed": False} if "as_printed" in settings else {}
        module = importlib.import_module(f"stronge1994.{home(figure)}.{figure}.curves")
        found = module.curves(**wrong_settings(settings, fault.get("settings", {})))
        return pd.concat(with_wrong_curves(table_of(figure), found), ignore_index=True)

    return curves


def with_wrong_curves(right, found):
    """The right curves of continua and of printed equations; of others the wrong ones in order."""
    right = right.assign(shifted=right.get("shifted", ""))
    kept = (right["model"] == of_models.PRINTED) | (right["shifted"] != "")
    yield right[kept]
    both = (table.groupby("curve", sort=False) for table in (right[~kept], found))
    for (_, own), (_, wrong) in zip(*both, strict=True):
        numbers = own.select_dtypes("number")
        keys = [*tables.KEYS, *(key for key in numbers if not tables.is_quantity(key)), "shifted"]
        model, variant = own[["model", "variant"]].iloc[0]
        is_continuum = model.startswith("continuum") and variant != "pushed"
        yield own if is_continuum else wrong.assign(**{key: own[key].iloc[0] for key in keys})


@pytest.mark.parametrize(("figure", "names"), SOLVED.items(), ids=SOLVED)
def test_no_comparison_fails_without_a_fault(figure, names, solved, judged):
    """With the few samples, too: else it could be they that are noticed."""
    assert not judged(figure, names, solved(figure, {}))


@pytest.mark.parametrize(("fault", "figure", "names"), OF_FIGURES.values(), ids=OF_FIGURES)
def test_comparisons_notice(fault, figure, names, table_of, solved, judged):
    if "columns" in fault:
        curves = wrong_columns(table_of(figure), fault["columns"])
    else:
        curves = solved(figure, fault)
    assert judged(figure, names, curves) == names


@pytest.mark.slow
@pytest.mark.parametrize("words", [words for words, fault in FAULTS.items() if "entries" in fault])
def test_entries_of_the_ledger_notice(words, monkeypatch):
    names = noticed_by(FAULTS[words], "entries")
    asked = {name: {k: v for k, v in LEDGER[name].items() if k != "in_nature"} for name in names}
    plant(FAULTS[words], monkeypatch)
    with np.errstate(all="ignore"):
        rows = [row for row in checking.check(asked) if row["holds"] == "no"]
    # A check that only crashes with a fault has not compared anything.
    assert {row["entry"] for row in rows if row["found"] not in ("", "nan")} == set(names)


@pytest.mark.slow
@pytest.mark.parametrize(
    "words", [words for words, fault in FAULTS.items() if "in nature" in fault]
)
def test_claims_in_nature_notice(words, monkeypatch):
    names = noticed_by(FAULTS[words], "in nature")
    plant(FAULTS[words], monkeypatch)
    measured = checking.measure({name: {"in_nature": CLAIMS[name]} for name in names})
    assert [name for name in names if checking.judge(CLAIMS[name], measured)] == names


def held(name, curves):
    """Curves and columns of numbers, not all 0, that something independent can hold."""
    free = [entry["columns"] for entry in TABLE["not_held"]]
    if name.startswith(of_models.SCENE):  # copies of what the scene was given
        table = ROOT / f"data/scenes/{name.removeprefix(of_models.SCENE)}.csv"
        given = ["row [1]", *table.read_text(encoding="utf-8").splitlines()[0].split(",")]
        free += [f".*: {re.escape(column)}" for column in given]
    # Curves off by a sigma, and sigmas, only say how uncertain another curve is.
    own = curves[curves["shifted"] == ""] if "shifted" in curves else curves
    for curve, columns in own.groupby("curve", sort=False):
        for column, values in columns.select_dtypes("number").items():
            is_free = not ("[" in column or name.startswith(of_models.SCENE))
            is_free |= "_sigma [" in column or any(
                re.fullmatch(pattern, f"{name}: {curve}: {column}") for pattern in free
            )
            if values.any() and not is_free:
                yield curve, column


@pytest.mark.parametrize("name", configuration.judged(CONFIG))
@pytest.mark.parametrize("factor", [1.3, pytest.param(-1.0, marks=pytest.mark.long)])
def test_no_column_can_be_scaled_or_flipped(name, factor, table_of, judged):
    right, entries, missed = table_of(name), figure_settings.comparisons(CONFIG, name), []
    titles = list(entries)
    for curve, column in held(name, right):
        rows = right["curve"] == curve
        own, wrong = right[rows], right[column].where(~rows, factor * right[column])
        wrong = right.assign(**{column: wrong})
        asked = (title for title in titles if tables.where(own, **selected(entries[title])).any())
        noticed = next((title for title in asked if judged(name, [title], wrong, own)), None)
        # The one that has noticed this fault is asked first about the next one.
        titles.sort(key=lambda title, noticed=noticed: title != noticed)
        missed += [] if noticed else [(curve, column)]
    assert missed == []


@pytest.mark.parametrize(
    ("name", "curve", "row"),
    [
        ("fig5", {"model": "lumped"}, 703),
        ("fig6", {"model": "lumped", "e": 0}, 300),
        ("inelastic", {"model": "continuum.viscous", "e": 0.6}, 37),
    ],
)
def test_a_fault_between_the_points_of_reference_is_noticed(name, curve, row, table_of, judged):
    wrong, column = table_of(name).copy(), "velocity [mu v2(0)]"
    place = np.flatnonzero(tables.where(wrong, **curve, variant=""))[row]
    wrong.loc[place, column] = -wrong.loc[place, column] - 0.1
    assert judged(name, [f"{name}-contraction"], wrong)
