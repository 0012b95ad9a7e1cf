"""At both ends of what a setting allows, and between, a figure is drawn and judged.

Where the solver does not reach its tolerance, its error is one sentence that says so: then the rows
of the figure diverge.
"""

import math
import warnings

import pytest

from planarimpact.ground.checks import ConvergenceError
from stronge1994 import judging, plan, reference_data
from stronge1994.figures.shared import drawing as drawings
from stronge1994.figures.shared.curves import solving
from stronge1994.plan import config as configuration
from stronge1994.plan import figures
from tests.workflow.project import ROOT, ledger

SCHEMA = configuration.schema()
# What only makes a picture finer, and its table more exact, while another setting is tried.
QUICK = {
    "samples": 12,
    "solved": 16,
    "restitutions": 10,
    "tolerance": 0.01,
    "loss_tolerance": 0.01,
    "tolerances": [0.01],
    "steps": [16, 32],
    "circles": [4, 8],
    "batches": [1, 100],
    "budget": 0.05,
}
# Values beyond which a setting only makes a figure take longer.
LARGE = {"samples": 1000, "solved": 100, "steps": 64, "circles": 16, "most_phases": 100}
UNLIMITED = 1e6  # instead of an end that is not limited
# Between the ends of the two groups that figures share; those of the paper's sphere are 3.5, 1.21.
SHARED = {"mass_ratio": [1.0, 1.2, 20.0], "stiffness_ratio": [0.01, 2.5, 100.0]}
# A figure whose curves take less than a second; all others are `long`.
DAILY = ["fig3"]


def _resolved(node):
    """A node of the schema, in place of a reference to it."""
    while "$ref" in node:
        base = SCHEMA["$defs"][node["$ref"].split("/")[-1]]
        items = {"items": base.get("items", {}) | node["items"]} if "items" in node else {}
        node = base | {key: value for key, value in node.items() if key != "$ref"} | items
    return node


def _numbers(node, key):
    """Both ends of what a number may be, and one between."""
    node = _resolved(node)
    if "enum" in node or node["type"] == "boolean":
        return node.get("enum", [True, False])
    whole = node["type"] == "integer"
    step = node.get("multipleOf", 1) if whole else 1e-6
    low = node.get("minimum", node.get("exclusiveMinimum", -UNLIMITED) + step)
    high = node.get("maximum", node.get("exclusiveMaximum", UNLIMITED) - step)
    high = min(high, LARGE.get(key, high))
    middle = math.sqrt(low * high) if low > 0 else (low + high) / 2
    if whole:
        low, middle = (math.ceil(number / step) * step for number in (low, middle))
    return [low, middle, high]


def _values(node, key):
    """Values of a setting to be tried; lists of one and of several numbers."""
    node = _resolved(node)
    if node.get("type") != "array":
        return _numbers(node, key)
    if "prefixItems" in node:
        ends = [_numbers(part, key) for part in node["prefixItems"]]
        return [list(pair) for pair in zip(*ends, strict=True)]
    numbers = _numbers(node["items"], key)
    low, high = node.get("minItems", 0), node.get("maxItems", 3)
    if low == high == 2:
        return [numbers[:2], numbers[-2:], [numbers[0], numbers[-1]]]
    return [*([n] for n in numbers if low <= 1), *([[]] if not low else []), numbers[:high]]


def _cases(settings, path=()):
    for key, node in settings.items():
        kind = node.get("allowed")
        if kind is None:
            yield from _cases(node, (*path, key))
        elif kind not in ("source", "table"):
            allowed = {"$ref": f"#/$defs/{kind}"} if isinstance(kind, str) else kind
            for value in _values(allowed, key):
                yield (*path, key), value


def _quick(group):
    """Settings of a figure that take little time."""
    own = {key: QUICK.get(key, value) for key, value in group.items()}
    return own | {key: _quick(value) for key, value in group.items() if isinstance(value, dict)}


def _with(group, path, value):
    key, *rest = path
    return group | {key: _with(group[key], rest, value) if rest else value}


def _tried():
    """Each figure with each value of the groups that it shares, and of its own settings."""
    for name, stated in figures.stated().items():
        shared = [((key,), value) for key in stated.get("shared", []) for value in SHARED[key]]
        for path, value in [*shared, *_cases(stated["settings"])]:
            daily = name in DAILY and path[0] in SHARED
            marks = () if daily else pytest.mark.long
            yield pytest.param(name, path, value, id=f"{name}-{path}-{value}", marks=marks)


@pytest.mark.parametrize(("name", "path", "value"), list(_tried()))
def test_a_setting_that_is_allowed_is_drawn_and_judged(
    name, path, value, inventory, tmp_path, monkeypatch
):
    monkeypatch.chdir(ROOT)
    whole = reference_data.load_yaml(configuration.FILE)  # as a user has it, short
    own = _with(_quick(figures.values(figures.stated()[name]["settings"])), path, value)
    change = {path[0]: own.pop(path[0])} if path[0] in SHARED else {}
    config = configuration.complete(whole | change | {"figures": {name: own}})
    configuration.check_config(config, inventory, ledger())
    planned = plan.plan_of_figure(config, inventory, name)
    judged = plan.plan_of_judgement(config, inventory, name)["settings"]
    curves = str(tmp_path / "curves.csv")
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            solving.solve(name, planned["settings"], planned["nodes"], curves)
    except Exception as error:
        assert isinstance(error, ConvergenceError) or "allowed are" in f"{error}", repr(error)
        return
    pictures = {key: str(tmp_path / f"{key}.png") for key in ("png", "light", "dark")}
    pictures["svg"] = str(tmp_path / "a.svg")
    planned["slide"] = figures.stated()[name].get("slide")
    drawings.draw(name, planned, curves, pictures)
    parts = judged["comparisons"], judged["references"]
    rows = judging.compare(name, *parts, curves, judged["significance"])
    assert [row["comparison"] for row in rows] == [f"{name}-solved", *judged["comparisons"]]
    assert all(row["reason"] for row in rows)
