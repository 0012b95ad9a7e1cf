"""The smallest change of each group of the physics that a comparison catches.

The curves are solved once more with each group slightly changed. Distances change in proportion to
the change, so they are extrapolated until the verdict is `diverges`. Fewer vertices than in the
figure are enough for that.
"""

import functools
import importlib
import operator
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, TypeAlias, TypeVar

import numpy as np

from stronge1994 import curve_names, verdict_table
from stronge1994.csv_tables import Curves
from stronge1994.figures.shared.curves import solving
from stronge1994.judging import judged_tables
from stronge1994.judging.distances import Residuals
from stronge1994.judging.metrics import Measured, measure
from stronge1994.judging.points import Entry, Reference, is_published
from stronge1994.judging.verdicts import Verdict, judge, notices

Settings: TypeAlias = dict[str, Any]
# The keys under which settings have each group.
KEYS = [("stiffness_ratio", "poisson_ratio"), ("mass_ratio",), ("restitution",), ("friction",)]
GROUPS = dict(zip(verdict_table.GROUPS, KEYS, strict=True))
# A curve has this many times fewer vertices than in its figure, but at least `FEWEST`.
COARSER, FEWEST = 20, 10
# The groups are changed by this: distances change in proportion to it, and rounding is far smaller.
STEP = 1e-4
# Sizes of change that are tried on the extrapolated distances.
SIZES = 10.0 ** np.arange(-15, -0.25, 0.1)
# Metrics that hold for all parameters.
LAWS = ("balance", "range", "contraction")
# Sizes that are solved one by one where distances do not change in proportion.
TRIAL_SIZES = 10.0 ** np.arange(-15, -2)
# Sigmas by which all published points are moved.
SIGMAS_MOVED = range(1, 10)


def sensitivities(
    figure: str,
    settings: Settings,
    nodes: solving.Tables,
    path: str,
    comparisons: Mapping[str, Entry],
    references: Mapping[str, Reference],
    series: Mapping[str, str],
    significance: float,
    options: Mapping[str, Any] | None,
) -> list[list[str]]:
    """Rows of the table: what each comparison of one figure catches; `options` are of figure.yaml.

    A row has the name of the comparison, by how many whole sigmas all published points must be
    moved, and the sizes of the changes of `GROUPS`: relative ones, of e an absolute one. `none`
    stands where even the largest change is not caught. A cell is empty where the figure does not
    depend on the group, or the comparison cannot be made. If `options` is None, all are empty: the
    solver takes long, and other figures show what it solves.
    """
    tried, options = options is not None, options or {}
    settings = settings | solving.read_nodes(nodes) | options.get("settings", {})
    settings.pop("uncertainty", None)
    if "samples" in settings:
        settings["samples"] = max(FEWEST, settings["samples"] // COARSER)
    if "as_printed" in settings:
        settings["as_printed"] = False
    try:
        curves = judged_tables.read(path) if tried else {}
    except Exception:  # the row `...-solved` has the error
        curves = {}
    if not curves:
        return [[title, *[""] * len(verdict_table.SENSITIVITY[1:])] for title in comparisons]
    # A change of size 0 gives the same curves for every group: they are solved once.
    solve = _once(functools.partial(_solve, figure, curves), operator.eq)
    solved = {group: _solver(solve, settings, group, options) for group in GROUPS}
    rows = []
    for title, entry in comparisons.items():
        reference = references.get(entry.get("reference", ""))

        measured: _Measure = _once(
            functools.partial(measure, entry, reference, series_paths=series), operator.is_
        )

        def caught(
            result: Measured, entry: Entry = entry, reference: Reference | None = reference
        ) -> bool:
            return judge(entry, reference, result, significance) == Verdict.DIVERGES

        if entry["metric"] in LAWS:
            sizes = ["none"] * len(GROUPS)
        elif not options.get("by_trial"):
            sizes = [
                _in_proportion(curves, solved[group], measured, caught, one_way=group == "e")
                for group in GROUPS
            ]
        elif entry["metric"] == "largest":
            sizes = [_by_trial(solved[group], measured, caught) for group in GROUPS]
        else:  # every single impact, of which the trial solves too few
            sizes = [""] * len(GROUPS)
        moved = ""
        if is_published(reference):
            noticed = functools.partial(notices, entry, reference, significance=significance)
            moved = _by_moving(curves, measured, noticed)
        rows.append([title, moved, *sizes])
    return rows


_Argument = TypeVar("_Argument")
_Result = TypeVar("_Result")
_Solved: TypeAlias = Callable[[float], Curves]
_Measure: TypeAlias = Callable[[Curves], Measured]
_Caught: TypeAlias = Callable[[Measured], bool]


def _once(
    function: Callable[[_Argument], _Result], same: Callable[[_Argument, _Argument], bool]
) -> Callable[[_Argument], _Result]:
    """A function that is called once for all arguments that are the same."""
    known: list[tuple[_Argument, _Result]] = []

    def answer(argument: _Argument) -> _Result:
        for earlier, result in known:
            if same(earlier, argument):
                return result
        known.append((argument, function(argument)))
        return known[-1][1]

    return answer


def _solve(figure: str, curves: Curves, settings: Settings) -> Curves:
    """Curves of other settings, under the names of `curves`; printed ones stay as they are."""
    module = importlib.import_module(f"stronge1994.figures.{figure}.curves")
    printed = {name: curves[name] for name in curves if curve_names.is_printed(name)}
    own = [name for name in curves if not curve_names.is_shifted(name) and name not in printed]
    return printed | dict(zip(own, module.curves(**settings).values(), strict=True))


def _solver(
    solve: Callable[[Settings], Curves], settings: Settings, group: str, options: Mapping[str, Any]
) -> _Solved | None:
    """Function that solves curves with a group changed by a size; None if the group is absent."""
    without = (*options.get("without", ()), "nodes")
    if changed(settings, group, STEP, without) == settings:
        return None

    def solved(size: float) -> Curves:
        changed_settings = changed(settings, group, size, without)
        if "every" in options:
            columns = changed_settings["points"].items()
            changed_settings["points"] = {
                key: column[:: options["every"]] for key, column in columns
            }
        return solve(changed_settings)

    return solved


def changed(settings: Settings, group: str, size: float, without: Sequence[str] = ()) -> Settings:
    """Settings with one group off by `size`, relative to the group; for restitution absolute.

    Restitution is lowered, but 0 is raised. Where Poisson's ratio gives the stiffness ratio, that
    is lowered: it cannot be raised where Poisson's ratio is 1/2, the largest. Settings that
    `without` names are left alone.

    >>> changed({"restitution": [1.0, 0.0], "samples": 9}, "e", 0.25)
    {'restitution': [0.75, 0.25], 'samples': 9}
    >>> changed({"throw": {"friction": 0.5}}, "mu", 0.5)
    {'throw': {'friction': 0.75}}
    """
    changed_settings: Settings = {}
    for key, value in settings.items():
        if key in without:
            changed_settings[key] = value
        elif isinstance(value, dict):
            changed_settings[key] = changed(value, group, size, without)
        elif key in GROUPS[group]:
            numbers = [_changed_number(key, number, size) for number in np.ravel(value).tolist()]
            changed_settings[key] = numbers if isinstance(value, list) else numbers[0]
        else:
            changed_settings[key] = value
    return changed_settings


def _changed_number(key: str, number: float, size: float) -> float:
    if key == "restitution":
        return number - size if number > size else number + size
    if key == "poisson_ratio":
        ratio = (2 - number) / (2 * (1 - number)) * (1 - size)
        return 2 * (ratio - 1) / (2 * ratio - 1)
    return number * (1 + size)


def _in_proportion(
    curves: Curves, solved: _Solved | None, measure: _Measure, caught: _Caught, one_way: bool
) -> str:
    """Size that is caught in both directions, by extrapolation from one small change."""
    try:
        measured = measure(curves)
        if not solved or all(map(curve_names.is_printed, measured.columns)):
            return ""
        unchanged, stepped = measure(solved(0.0)), measure(solved(STEP))
    except Exception:  # the reference is awaited, or the row of the comparison gives the reason
        return ""

    def extrapolated(size: float) -> Measured:
        share = size / STEP
        triples = zip(measured.residuals, unchanged.residuals, stepped.residuals, strict=True)
        parts = [a + share * (c - b) for a, b, c in triples]
        gap = measured.gap
        if gap is not None:
            gap += share * ((stepped.gap or 0.0) - (unchanged.gap or 0.0))
        return measured._replace(residuals=Residuals(*parts), gap=gap)

    directions = (1,) if one_way else (1, -1)
    return _first_size(
        size
        for size in SIZES
        if all(caught(extrapolated(direction * size)) for direction in directions)
    )


def _by_trial(solved: _Solved | None, measure: _Measure, caught: _Caught) -> str:
    """Size that is caught, by solving with each size."""
    if not solved:
        return ""
    return _first_size(size for size in TRIAL_SIZES if caught(measure(solved(float(size)))))


def _by_moving(curves: Curves, measure: _Measure, noticed: Callable[..., bool]) -> str:
    """Whole number of sigmas by which all points must be moved in either direction."""
    try:
        measured = measure(curves)
    except Exception:  # the reference is awaited, or the row of the comparison gives the reason
        return ""
    return _first_size(size for size in SIGMAS_MOVED if noticed(measured, sigmas=size))


def _first_size(sizes: Iterable[float]) -> str:
    return next((f"{size:.1g}" for size in sizes), "none")
