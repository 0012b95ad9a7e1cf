"""The finder of events in a bracket: where a function passes from positive to negative.

Whoever calls it knows a bracket in which there is one such place, and derives that where the event
belongs. The search keeps the bracket, so it ends. It steps by as many derivatives as the function
returns, so it is fast. Where no bracket is known, `phases` has a search of its own.
"""

from collections.abc import Callable
from math import inf, sqrt
from typing import Any, TypeAlias

import numpy as np

from planarimpact.common.arrays import SMALLEST, Array, Booleans, Integers
from planarimpact.common.checks import ConvergenceError

# Takes an index of brackets (integers, or a slice for all) and a place in each. Returns a tuple:
# the value there, and none, one or two of its derivatives. No square of a derivative may leave the
# range of numbers.
Function: TypeAlias = Callable[[Any, Array], tuple[Array, ...]]

# A step is the last if it is below this share of the bracket and of the place, by the number of
# derivatives. With one or two of them it leaves what is of the order of the share squared or cubed.
LAST_STEP = 1e-15, 1e-8, 2e-6
# The slope may not change by more than this share over a last step: two zeros may be close.
LAST_BEND = 1e-5
# A secant counts as a slope where its places are nearer than this share of the place.
LAST_SECANT = 1e-6
# Rounding hides what is left of the bracket, as a share of its width or of the place.
ROUNDING = 1e-15
# After so many turns every other one halves the bracket: rounding can throw steps to and fro.
FREE_TURNS = 8
MOST_TURNS = 250


def crossing(
    function: Function,
    low: Array,
    high: Array,
    *,
    start: Array | None = None,
    unguarded: int = 0,
    resolution: float = ROUNDING,
) -> Array:
    """Place in each bracket where a function passes from positive to negative, once.

    Arrays have the shape (n,); the value of the `Function` may be 1 and -1 alone. It is positive
    behind `low`, where it may start from 0. It is not positive at `high`; if it is all the same,
    the answer is `high`.

    `start` is the first place that is tried; `high` by default. `unguarded` is a number of steps
    without the brackets, which saves time where that is nearly always enough; the function then has
    a derivative. The search ends when the bracket has this `resolution`, as a share of its width at
    first.

    Examples
    --------
    >>> square = np.array([2.0, 9.0])
    >>> crossing(lambda which, x: (square[which] - x * x, -2 * x), np.zeros(2), np.full(2, 5.0))
    array([1.41421356, 3.        ])
    >>> crossing(lambda which, x: (square[which] - x * x,), np.zeros(2), np.full(2, 5.0))
    array([1.41421356, 3.        ])
    """
    place, width = (high if start is None else start).copy(), np.maximum(high - low, 0.0)
    index: Integers = np.arange(place.size)
    if unguarded:
        place, index = _unguarded(function, low, high, place, width, unguarded)
        low, high, width = low[index], high[index], width[index]
    trial, turn = place[index], 0
    least = np.maximum(resolution * width, SMALLEST)
    before = value_before = np.full(index.size, np.nan)
    while index.size:
        if turn == MOST_TURNS:
            raise ConvergenceError(f"{index.size} events: not found in {MOST_TURNS} turns")
        # A turn moves one end of each bracket to the trial, and chooses the next trial.
        value, *slopes = function(index, trial)
        ahead = value > 0
        if turn == 0:  # where rounding may have the other sign
            ahead |= trial <= low
        low, high = np.where(ahead, trial, low), np.where(ahead, high, trial)
        size = np.abs(trial)
        if slopes:
            step = _step(value, *slopes)
        else:
            with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
                step = _step(value, (value - value_before) / (trial - before))
        hidden = np.maximum(least, ROUNDING * size)
        done = _is_last(step, slopes, np.minimum(width, size)) | (np.abs(step) <= hidden)
        if not slopes:  # the secant through a distant place says nothing
            done &= (np.abs(trial - before) <= LAST_SECANT * size) | (value == 0)
        before, value_before, trial = trial, value, trial + step
        inside = (trial >= low) & (trial <= high)
        if turn >= FREE_TURNS and turn % 2:
            inside[:] = False
        trial = np.where(inside, trial, (low + high) / 2)
        open_ = np.flatnonzero(~(done & inside) & (high - low > hidden))
        place[index] = trial
        if open_.size < index.size:  # searches that are done leave the arrays
            index, trial, low, high = index[open_], trial[open_], low[open_], high[open_]
            width, least = width[open_], least[open_]
            if not slopes:
                before, value_before = before[open_], value_before[open_]
        turn += 1
    return place


def crossing_of_one(
    function: Callable[[float], tuple[float, ...]],
    low: float,
    high: float,
    *,
    start: float,
    unguarded: int = 0,
    resolution: float = ROUNDING,
) -> float:
    """As `crossing` of one bracket by a function with derivatives: floats, with the same bits.

    Examples
    --------
    >>> round(crossing_of_one(lambda x: (2.0 - x * x, -2 * x), 0.0, 5.0, start=5.0), 9)
    1.414213562
    """
    place, width = start, max(high - low, 0.0)
    least = max(resolution * width, SMALLEST)
    for turn in range(-unguarded, MOST_TURNS):
        value, slope, *bends = function(place)
        size, above, below = abs(place), -value, slope
        if bends:
            root = sqrt(max(slope * slope - 2 * value * bends[0], 0.0))
            above, below = 2 * value, root - slope
        step = above / below if below else above * inf
        last = abs(step) <= LAST_STEP[1 + len(bends)] * min(width, size)
        last = last and all(abs(bend * step) <= LAST_BEND * abs(slope) for bend in bends)
        if turn < 0:
            place = min(high, max(low, place + step))  # no number becomes `low`
            if turn == -1 and last and slope < 0:
                return place
            continue
        if value > 0 or (turn == 0 and place <= low):
            low = place
        else:
            high = place
        hidden, place = max(least, ROUNDING * size), place + step
        inside = low <= place <= high and not (turn >= FREE_TURNS and turn % 2)
        if not inside:
            place = (low + high) / 2
        if (inside and (last or abs(step) <= hidden)) or not high - low > hidden:
            return place
    raise ConvergenceError(f"1 events: not found in {MOST_TURNS} turns")


def _unguarded(
    function: Function, low: Array, high: Array, place: Array, width: Array, turns: int
) -> tuple[Array, Integers]:
    """Places after steps that leave the brackets as they are, and which of them are not exact."""
    for _ in range(turns):
        value, *slopes = function(slice(None), place)
        step, before = _step(value, *slopes), place
        place = np.fmin(np.fmax(place + step, low), high)  # no number becomes `low`
    done = _is_last(step, slopes, np.minimum(width, np.abs(before)))
    return place, np.flatnonzero(~(done & (slopes[0] < 0)))


def _step(value: Array, slope: Array, bend: Array | None = None) -> Array:
    """The step to the zero of the tangent, or to the nearer zero of the Taylor parabola."""
    # A step that is infinite or no number lies outside every bracket.
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        if bend is None:
            return -value / slope
        # The parabola has its zero also where the slope vanishes.
        root = np.sqrt(np.maximum(slope * slope - 2 * value * bend, 0.0))
        return 2 * value / (root - slope)


def _is_last(step: Array, slopes: list[Array], size: Array) -> Booleans:
    """Whether the place after a step is exact to rounding."""
    small = np.abs(step) <= LAST_STEP[len(slopes)] * size
    if len(slopes) == 2:
        with np.errstate(invalid="ignore", over="ignore"):
            small &= np.abs(slopes[1] * step) <= LAST_BEND * np.abs(slopes[0])
    return small
