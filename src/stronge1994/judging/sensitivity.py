"""The smallest change of each group of the physics that a comparison catches.

The curves are solved once more with each group off by a little. The distances change in proportion
to it, so they are extrapolated until the verdict is `diverges`. Fewer vertices than in the figure
are enough for that.
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
# Metrics that hold whatever the parameters are.
LAWS = ("balance", "range", "contraction")
# Tried one by one where distances do not change in proportion.
TRIED = 10.0 ** np.arange(-15, -2)
# All published points are moved by so many sigmas.
MOVED = range(1, 10)


def sensitivities(
    figure: str,
    settings: Settings,
    nodes: solving.Tables,
    path: str,
    comparisons: Mapping[str, Entry],
    references: Mapping[str, Reference],
    series: Mapping[str, str],
    significance: float,
    how: Mapping[str, Any] | None,
) -> list[list[str]]:
    """Rows of the table: what each comparison of one figure catches; `how` is as in figure.yaml.

    A row has the name of the comparison, by how many whole sigmas all published points must be
    moved, and the sizes of the changes of `GROUPS`: relative ones, of e an absolute one. `none`
    stands where even the largest change that is tried is not caught. A cell is empty where the
    figure does not depend on the group, or the comparison cannot be made. If `how` is None all are:
    the solver takes long, and what it solves is in other figures too.
    """
    tried, how = how is not None, how or {}
    settings = settings | solving.read_nodes(nodes) | how.get("settings", {})
    settings.pop("uncertainty", None)
    if "samples" in settings:
        settings["samples"] = max(FEWEST, settings["samples"] // COARSER)
    if "as_printed" in settings:
        settings["as_printed"] = False
    try:
        curves = judged_tables.read(path) if tried else {}
    except Exception:  # the row `...-solved` says so
        curves = {}
    if not curves:
        return [[title, *[""] * len(verdict_table.SENSITIVITY[1:])] for title in comparisons]
    # A group that is off by nothing has the same curves as every other: they are solved once.
    solve = _once(functools.partial(_solve, figure, curves), operator.eq)
    solved = {group: _solver(solve, settings, group, how) for group in GROUPS}
    rows = []
    for title, entry in comparisons.items():
        known = references.get(entry.get("reference", ""))

        measured: _Measure = _once(
            functools.partial(measure, entry, known, series_paths=series), operator.is_
        )

        def caught(found: Measured, entry: Entry = entry, known: Reference | None = known) -> bool:
            return judge(entry, known, found, significance) == Verdict.DIVERGES

        if entry["metric"] in LAWS:
            sizes = ["none"] * len(GROUPS)
        elif not how.get("by_trial"):
            sizes = [
                _in_proportion(curves, solved[group], measured, caught, one_way=group == "e")
                for group in GROUPS
            ]
        elif entry["metric"] == "largest":
            sizes = [_by_trial(solved[group], measured, caught) for group in GROUPS]
        else:  # the impacts themselves, of which only some are tried
            sizes = [""] * len(GROUPS)
        moved = ""
        if is_published(known):
            noticed = functools.partial(notices, entry, known, significance=significance)
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
        for before, found in known:
            if same(before, argument):
                return found
        known.append((argument, function(argument)))
        return known[-1][1]

    return answer


def _solve(figure: str, curves: Curves, settings: Settings) -> Curves:
    """Curves of other settings, under the names that `curves` have.

    Those of the printed equations are left as they are.
    """
    module = importlib.import_module(f"stronge1994.figures.{figure}.curves")
    printed = {name: curves[name] for name in curves if curve_names.is_printed(name)}
    own = [name for name in curves if not curve_names.is_shifted(name) and name not in printed]
    return printed | dict(zip(own, module.curves(**settings).values(), strict=True))


def _solver(
    solve: Callable[[Settings], Curves], settings: Settings, group: str, how: Mapping[str, Any]
) -> _Solved | None:
    """Function that solves curves with a group off by a size; None if there is no such group."""
    without = (*how.get("without", ()), "nodes")
    if changed(settings, group, STEP, without) == settings:
        return None

    def solved(size: float) -> Curves:
        wrong = changed(settings, group, size, without)
        if "every" in how:
            columns = wrong["points"].items()
            wrong["points"] = {key: column[:: how["every"]] for key, column in columns}
        return solve(wrong)

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
    wrong: Settings = {}
    for key, value in settings.items():
        if key in without:
            wrong[key] = value
        elif isinstance(value, dict):
            wrong[key] = changed(value, group, size, without)
        elif key in GROUPS[group]:
            several = [_off(key, number, size) for number in np.ravel(value).tolist()]
            wrong[key] = several if isinstance(value, list) else several[0]
        else:
            wrong[key] = value
    return wrong


def _off(key: str, number: float, size: float) -> float:
    if key == "restitution":
        return number - size if number > size else number + size
    if key == "poisson_ratio":
        ratio = (2 - number) / (2 * (1 - number)) * (1 - size)
        return 2 * (ratio - 1) / (2 * ratio - 1)
    return number * (1 + size)


def _in_proportion(
    curves: Curves, solved: _Solved | None, measure: _Measure, caught: _Caught, one_way: bool
) -> str:
    """Size that is caught in either direction, by extrapolation from one small change."""
    try:
        found = measure(curves)
        if not solved or all(map(curve_names.is_printed, found.columns)):
            return ""
        same, other = measure(solved(0.0)), measure(solved(STEP))
    except Exception:  # the reference is awaited, or the row of the comparison gives the reason
        return ""

    def off(size: float) -> Measured:
        share = size / STEP
        three = zip(found.residuals, same.residuals, other.residuals, strict=True)
        parts = [a + share * (c - b) for a, b, c in three]
        gap = found.gap
        if gap is not None:
            gap += share * ((other.gap or 0.0) - (same.gap or 0.0))
        return found._replace(residuals=Residuals(*parts), gap=gap)

    ways = (1,) if one_way else (1, -1)
    return _words(size for size in SIZES if all(caught(off(way * size)) for way in ways))


def _by_trial(solved: _Solved | None, measure: _Measure, caught: _Caught) -> str:
    """Size that is caught, by solving with each size."""
    if not solved:
        return ""
    return _words(size for size in TRIED if caught(measure(solved(float(size)))))


def _by_moving(curves: Curves, measure: _Measure, noticed: Callable[..., bool]) -> str:
    """Whole number of sigmas by which all points must be moved, whichever way."""
    try:
        found = measure(curves)
    except Exception:  # the reference is awaited, or the row of the comparison gives the reason
        return ""
    return _words(size for size in MOVED if noticed(found, sigmas=size))


def _words(sizes: Iterable[float]) -> str:
    return next((f"{size:.1g}" for size in sizes), "none")
