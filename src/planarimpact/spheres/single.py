"""The velocity of one impact from the table, in Python's own floats.

NumPy takes a microsecond for each operation on arrays of one number, and an answer of `table` has
hundreds. Event-driven codes ask for one impact at a time. The operations and their order are those
of the code that `export` writes.
"""

from functools import cache
from math import sqrt
from typing import NamedTuple

from planarimpact.spheres import table
from planarimpact.spheres.table import B_LEAST, B_MOST, E_LEAST, LEFT, NEARLY, ORDER, RIGHT, ROOTS


class Panel(NamedTuple):
    """A panel of the table as lists of numbers."""

    name: str
    roots: tuple[int, ...]
    intervals: list[int]
    first: list[int]  # first coefficient over s of each patch
    edges: list[list[list[float]]]
    velocity: list[float]
    over_t: int
    over_u: int


@cache
def _panels() -> tuple[list[list[float]], list[Panel]]:
    """Limits between the plastic panels, and all panels."""
    shipped = table.shipped()
    panels = []
    for name, panel in shipped.panels.items():
        intervals, first = panel.intervals.tolist(), [0]
        for count in intervals:
            first.append(first[-1] + count + ORDER - 1)
        _, over_t, over_u = panel.velocity.shape
        velocity = panel.velocity.ravel().tolist()
        edges = panel.edges.tolist()
        panels.append(Panel(name, ROOTS[name], intervals, first, edges, velocity, over_t, over_u))
    return shipped.limits.tolist(), panels


def velocity(y: float, b: float, e: float, plastic: bool) -> tuple[float, float]:
    """Velocity over zeta^2 of an impact that the table covers, and from which y on it slides.

    From there on the velocity has no meaning.

    Parameters
    ----------
    y, b, e : float
        Incidence over zeta^2, from 0; mass over stiffness ratio; restitution.
    plastic : bool
        The loss, else viscous.

    Returns
    -------
    float, float

    Examples
    --------
    >>> share, slides_from = velocity(2.0 / 1.2, 3.5 / 1.2, 0.8, True)
    >>> round(1.2 * share, 4), round(1.2 * slides_from, 4)
    (-0.1733, 5.34)
    """
    _, panels = _panels()
    u = (b - B_LEAST) / (B_MOST - B_LEAST)
    low, high = _limits(u)
    alike = b + e * (b - 1)
    if not plastic:
        panel, t = panels[0], (e - E_LEAST) / (1 - E_LEAST)
    elif e < low:
        loss = max(E_LEAST / e - E_LEAST / low, 0.0) / (1 - E_LEAST / low)
        panel, t = panels[1], 1 - sqrt(loss)
    elif e < high:
        panel, t = panels[2], (e - low) / (high - low)
    else:
        panel, t = panels[3], sqrt(sqrt((1 - e) / (1 - high)))
    varying = _between(panel.edges, t, u)
    if not plastic:
        edges = [0.0, 1.0, varying[0], min(varying[1], b), b, alike]
    else:
        third = b if panel.name == "plastic_high" else varying[0]
        last = varying[1] if panel.name == "plastic_low" else alike
        edges = [0.0, 1.0, (1 + third) / 2, third, last]
    slides_from, patch = edges[-1] * NEARLY, 0
    if y >= slides_from:
        return 0.0, slides_from
    for k in range(1, len(edges) - 1):
        if y >= edges[k]:
            patch = k
    width = edges[patch + 1] - edges[patch]
    s = min(max((y - edges[patch]) / (width if width > 0 else 1.0), 0.0), 1.0)
    root = panel.roots[patch]
    if root == RIGHT:
        s = 1 - sqrt(1 - s)
    elif root == LEFT:
        s = sqrt(s)
    row, x = _place(s, panel.intervals[patch])
    over_s = _weights(x)
    column, x = _place(t, panel.over_t - ORDER + 1)
    over_t = _weights(x)
    depth, x = _place(u, panel.over_u - ORDER + 1)
    u0, u1, u2, u3 = _weights(x)
    values, total = panel.velocity, 0.0
    base = ((panel.first[patch] + row) * panel.over_t + column) * panel.over_u + depth
    for weight_s in over_s:
        middle, c = 0.0, base
        for weight_t in over_t:
            inner = values[c] * u0 + values[c + 1] * u1 + values[c + 2] * u2 + values[c + 3] * u3
            middle += inner * weight_t
            c += panel.over_u
        total += middle * weight_s
        base += panel.over_t * panel.over_u
    return total if patch else total * y, slides_from


def loses_little(b: float, e: float) -> bool:
    """Whether plastic spheres lose little, as `spheres.loses_little` of arrays.

    Examples
    --------
    >>> loses_little(3.0, 0.7), loses_little(3.0, 0.6)
    (True, False)
    """
    return e >= _limits((b - B_LEAST) / (B_MOST - B_LEAST))[1]


def _limits(u: float) -> tuple[float, float]:
    """Restitutions between the plastic panels."""
    (low, high), _ = _panels()
    index, part = _place(u, len(low) - 1)
    return (
        (1 - part) * low[index] + part * low[index + 1],
        (1 - part) * high[index] + part * high[index + 1],
    )


def _place(value: float, count: int) -> tuple[int, float]:
    """The interval, one of `count`, that a value from 0 to 1 is in, and the place in it."""
    at = value * count
    index = min(max(int(at), 0), count - 1)
    return index, at - index


def _weights(x: float) -> tuple[float, float, float, float]:
    """The four B-splines of an interval at x, from 0 to 1 in it."""
    left = 1 - x
    return (
        left * left * left / 6,
        (x * x * (x - 2) * 3 + 4) / 6,
        (left * left * (left - 2) * 3 + 4) / 6,
        x * x * x / 6,
    )


def _between(grids: list[list[list[float]]], t: float, u: float) -> list[float]:
    """Linear interpolation of grids over t and u."""
    if not grids:
        return []
    i, over = _place(t, len(grids[0]) - 1)
    j, across = _place(u, len(grids[0][0]) - 1)
    less = 1 - across
    values = []
    for grid in grids:
        low, high = grid[i], grid[i + 1]
        before = less * low[j] + across * low[j + 1]
        after = less * high[j] + across * high[j + 1]
        values.append((1 - over) * before + over * after)
    return values
