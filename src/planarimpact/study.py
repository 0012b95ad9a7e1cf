"""A parameter study: a grid over the four groups of an impact, solved part by part.

The points of a grid are numbered as in C, with the last axis fastest. A part, `start` to `stop`,
needs only the axes of the grid, so parts can be solved anywhere and in any order. The division of
a grid may change the last digits: the lumped model, which solves many impacts together, was found
to move by up to 7e-16.
"""

import math
from collections.abc import Callable, Iterable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from planarimpact.ground import checks
from planarimpact.ground.results import Rebound

AnyArray = NDArray[Any]

# Points solved together: their memory stays small however large a part is.
BLOCK = 65536
# Fields of a Rebound that every model fills.
OUTPUTS = {
    "velocity": np.float64,
    "peak_friction": np.float64,
    "dissipation": np.float64,
    "regime": np.uint8,
}


def axes_of(grid: Mapping[str, Any]) -> dict[str, AnyArray]:
    """Values along every axis of a grid.

    Parameters
    ----------
    grid : dict
        The four groups of `planarimpact.models` by name, each one number, ascending
        numbers, or `{"from": a, "to": b, "points": n}`, n >= 2 evenly spread from a to b.

    Returns
    -------
    dict of ndarray
        incidence in mu v2(0), mass_ratio, stiffness_ratio and restitution, in this order, one
        dimension each.

    Raises
    ------
    InputError
        If an axis is unknown, missing, empty, not ascending or out of range.

    Examples
    --------
    >>> grid = {"incidence": {"from": 0, "to": 8, "points": 3}, "restitution": [0.5, 1]}
    >>> for name, values in axes_of(grid | {"mass_ratio": 3.5, "stiffness_ratio": 1.21}).items():
    ...     print(name, values)
    incidence [0. 4. 8.]
    mass_ratio [3.5]
    stiffness_ratio [1.21]
    restitution [0.5 1. ]
    """
    if not isinstance(grid, Mapping) or set(grid) != set(checks.RULES):
        found = ", ".join(map(str, grid)) if isinstance(grid, Mapping) else checks.brief(grid)
        raise checks.InputError(
            f"axes = {found}: allowed are {', '.join(checks.RULES)}, each once, in a dict"
        )
    return {name: _axis(name, grid[name]) for name in checks.RULES}


def _axis(name: str, given: Any) -> AnyArray:
    if isinstance(given, dict):
        checks.record(name, given, ("from", "to", "points"))
        points = checks.count(f"{name}.points", given["points"], 2)
        low, high = checks.RULES[name]([given["from"], given["to"]])
        values = np.linspace(low, high, points)
    else:
        values = np.atleast_1d(checks.RULES[name](given))
    if values.ndim != 1 or not values.size or not (np.diff(values) > 0).all():
        raise checks.InputError(f"{name} = {given!r}: allowed are ascending numbers, at least one")
    return values


def points(axes: Mapping[str, AnyArray], start: int, stop: int) -> dict[str, AnyArray]:
    """The four groups at the points `start` to `stop` (exclusive) of a grid.

    Parameters
    ----------
    axes : dict of ndarray
        As `axes_of` returns them.
    start, stop : int
        Numbers of points, 0 <= start < stop <= their count.

    Returns
    -------
    dict of ndarray, shape (stop - start,)

    Raises
    ------
    InputError
        If there are no such points.

    Examples
    --------
    >>> grid = {"incidence": [1, 2], "mass_ratio": 3.5, "stiffness_ratio": 1, "restitution": [0, 1]}
    >>> some = points(axes_of(grid), 1, 4)
    >>> some["incidence"], some["restitution"]
    (array([1., 2., 2.]), array([1., 0., 1.]))
    """
    shape = _shape(axes)
    _refuse_outside(shape, start, stop)
    places = np.unravel_index(np.arange(start, stop), shape)
    return {name: values[place] for (name, values), place in zip(axes.items(), places, strict=True)}


def solve(
    rebound: Callable[..., Rebound],
    axes: Mapping[str, AnyArray],
    start: int,
    stop: int,
    **settings: object,
) -> dict[str, AnyArray]:
    """State at separation at the points `start` to `stop` (exclusive) of a grid.

    Parameters
    ----------
    rebound : callable
        The `rebound` of a model of `planarimpact.models`.
    axes : dict of ndarray
        As `axes_of` returns them.
    start, stop : int
        As in `points`.
    **settings
        Settings of the model.

    Returns
    -------
    dict of ndarray, shape (stop - start,)
        velocity, peak_friction, dissipation and regime, as in `planarimpact.Rebound`.

    Raises
    ------
    InputError, ConvergenceError
        If there are no such points; or as the model does. The message then names the points of
        the block in which it happened. If the error has `impacts`, they are points of the grid.

    Examples
    --------
    >>> from planarimpact import lumped
    >>> grid = axes_of({"incidence": [2, 8], "mass_ratio": 3.5, "stiffness_ratio": 1.21,
    ...                 "restitution": 1})
    >>> solve(lumped.rebound, grid, 1, 2)["velocity"]
    array([1.])
    """
    _refuse_outside(_shape(axes), start, stop)
    fields = {name: np.empty(stop - start, dtype) for name, dtype in OUTPUTS.items()}
    for first in range(start, stop, BLOCK):
        last = min(first + BLOCK, stop)
        groups = points(axes, first, last)
        try:
            found = rebound(**groups, **settings)
        except (checks.InputError, checks.ConvergenceError) as error:
            error.args = (f"points {first} to {last} of the grid: {error}",)
            if isinstance(error, checks.Unsolved):
                error.impacts = first + error.impacts
            raise
        for name, field in fields.items():
            field[first - start : last - start] = getattr(found, name)
    return fields


def gather(
    axes: Mapping[str, AnyArray], parts: Iterable[tuple[int, Mapping[str, AnyArray]]]
) -> dict[str, AnyArray]:
    """Put parts together in the shape of their grid.

    Parameters
    ----------
    axes : dict of ndarray
        As `axes_of` returns them.
    parts : iterable of (int, dict of ndarray)
        First point of each part, and what `solve` returned for it; in order and without gaps.
        They are taken one by one.

    Returns
    -------
    dict of ndarray
        The outputs, each with one dimension an axis.

    Raises
    ------
    InputError
        If a part is missing, comes twice, is too long, or its outputs are not what `solve` returns.

    Examples
    --------
    >>> from planarimpact import lumped
    >>> grid = axes_of({"incidence": [2, 8], "mass_ratio": 3.5, "stiffness_ratio": 1.21,
    ...                 "restitution": 1})
    >>> parts = [(i, solve(lumped.rebound, grid, i, i + 1)) for i in range(2)]
    >>> whole = gather(grid, parts)
    >>> whole["velocity"].shape, float(whole["velocity"][1, 0, 0, 0])
    ((2, 1, 1, 1), 1.0)
    """
    shape = _shape(axes)
    count, done = math.prod(shape), 0
    fields = {name: np.empty(count, dtype) for name, dtype in OUTPUTS.items()}
    for start, part in parts:
        if start != done:
            raise checks.InputError(f"a part starts at point {start}: allowed is {done}, the next")
        checks.record(f"the part from point {start}", part, OUTPUTS)
        length = np.size(part["velocity"])
        expected = {name: ((length,), np.dtype(dtype)) for name, dtype in OUTPUTS.items()}
        found = {name: (np.shape(value), np.asarray(value).dtype) for name, value in part.items()}
        if found != expected or done + length > count:
            words = ", ".join(f"{name} {shape} {kind}" for name, (shape, kind) in found.items())
            raise checks.InputError(
                f"the part from point {start} has {words}: allowed are {', '.join(OUTPUTS)}, as "
                f"`solve` returns them for up to {count - done} points"
            )
        for name, field in fields.items():
            field[done : done + length] = part[name]
        done += length
    if done != count:
        raise checks.InputError(f"the parts end at point {done}: allowed is {count}, the last")
    return {name: field.reshape(shape) for name, field in fields.items()}


def _refuse_outside(shape: tuple[int, ...], start: int, stop: int) -> None:
    """Refuse points that a grid of this shape does not have."""
    whole = all(isinstance(n, (int, np.integer)) and not isinstance(n, bool) for n in (start, stop))
    count = math.prod(shape)
    if not whole or not 0 <= start < stop <= count:
        raise checks.InputError(f"points {start} to {stop}: allowed are some of 0 to {count}")


def _shape(axes: Mapping[str, AnyArray]) -> tuple[int, ...]:
    return tuple(map(len, axes.values()))
