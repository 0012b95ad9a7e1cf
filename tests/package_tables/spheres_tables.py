"""How the table of spheres is made: the continuum is solved at nodes, splines run through them.

Each patch has nodes evenly over s, t and u. The continuum is solved with a fixed number of steps
and with twice as many, and extrapolated: then neighbours have neighbouring errors.

    python -m tests.package_tables.spheres_tables

makes both tables of `src/planarimpact/spheres` anew, in some minutes.
"""

from pathlib import Path
from typing import IO, Any, NamedTuple

import numpy as np

from planarimpact import continuum
from planarimpact.common import losses
from planarimpact.common.arrays import Array
from planarimpact.continuum import inelastic
from planarimpact.spheres import table
from planarimpact.spheres.table import EVEN, LEFT, RIGHT, ROOTS, Panel, Table
from tests.package_tables import spheres_thresholds

# Steps of the continuum, and impacts solved together.
STEPS, TOGETHER = 128, 256
# Below this y slip is not much thicker than a spring, and twice the steps are needed.
THIN = 0.1
# Friction of an impact with no incidence has no shape: this one is solved instead.
LEAST_INCIDENCE = 1e-6
# Error of elastic impacts, over y where that is below 1.
TOLERANCE = 1e-6
# An impact nearer to e = 1 than this is elastic.
ELASTIC = 1 - 1e-9
# The largest restitution for which viscous spheres have edges of their own.
VISCOUS = 1 - 1e-13
# Functions at a node: velocity, peak friction and work.
FUNCTIONS = 3


class Plan(NamedTuple):
    """How fine a table is.

    Attributes
    ----------
    exponent : int
        Numbers are multiples of 2^-exponent.
    edges : dict
        By loss the intervals of t and u between which edges are interpolated.
    nodes : dict
        For each panel the nodes over s of each patch, those over t, and those over u.
    """

    exponent: int
    edges: dict[str, tuple[int, int]]
    nodes: dict[str, tuple[tuple[int, ...], int, int]]


PLANS = {
    "fine": Plan(
        18,
        {"viscous": (128, 64), "plastic": (128, 80)},
        {
            "viscous": ((25, 21, 13, 13, 17), 29, 31),
            "plastic_low": ((13, 21, 33, 49), 49, 37),
            "plastic_middle": ((17, 25, 33, 13), 33, 51),
            "plastic_high": ((13, 25, 33, 17), 65, 21),
        },
    ),
    "coarse": Plan(
        12,
        {"viscous": (64, 32), "plastic": (64, 40)},
        {
            "viscous": ((9, 13, 7, 5, 9), 17, 17),
            "plastic_low": ((9, 9, 13, 17), 17, 11),
            "plastic_middle": ((7, 9, 13, 9), 9, 11),
            "plastic_high": ((7, 9, 13, 9), 17, 11),
        },
    ),
}


def make(name: str = "fine") -> Table:
    """Make a table, one of `PLANS`; the fine one takes some minutes."""
    plan = PLANS[name]
    u = np.linspace(0.0, 1.0, plan.edges["plastic"][1] + 1)
    limits = spheres_thresholds.limits(b_at("plastic", u))
    panels = {}
    for panel, (over_s, *_) in plan.nodes.items():
        edges = edges_over(panel, plan, limits)
        patches = []
        for number in range(len(over_s)):
            values = nodes_of(panel, plan, edges, limits, number)
            patches.append([splined(function) for function in values])
            print(f"{panel}, patch {number + 1} of {len(over_s)}: {values[0].size} nodes")
        panels[panel] = _joined(panel, plan, edges, patches)
    return Table(plan.exponent, limits, panels)


def _joined(name: str, plan: Plan, edges: Array, patches: list[list[Array]]) -> Panel:
    """A panel from the coefficients of its patches, rounded."""
    velocity, peak, work = (np.concatenate(parts) for parts in zip(*patches, strict=True))
    splines = velocity, peak, work if name == "viscous" else work[:0]
    return Panel(
        name,
        np.array(plan.nodes[name][0]) - 1,
        edges,
        *(_rounded(values, plan.exponent) for values in splines),
    )


def _rounded(values: Array, exponent: int) -> Array:
    return table.real(table.whole(values, exponent), exponent)


def b_at(loss: str, u: Array) -> Array:
    """b = beta/zeta^2 at u, the inverse of `table.over_b`."""
    least, most, _ = table.SPANS[loss]
    return least + u * (most - least)


def e_at(name: str, t: Array, limits: Array) -> Array:
    """Restitution at t, the inverse of `table.over_e`."""
    (low, high), (*_, least) = limits, table.SPANS[table.loss_of(name)]
    if name == "viscous":
        return least + t * (1 - least)
    if name == "plastic_low":
        return least / (1 - (1 - (1 - t) ** 2) * (1 - least / low))
    if name == "plastic_middle":
        return low + t * (high - low)
    return 1 - t**4 * (1 - high)


def edges_over(name: str, plan: Plan, limits: Array) -> Array:
    """Edges of a panel that vary, rounded, as `Panel` has them."""
    loss = table.loss_of(name)
    even = (np.linspace(0.0, 1.0, count + 1) for count in plan.edges[loss])
    t, u = np.meshgrid(*even, indexing="ij")
    b = b_at(loss, u).ravel()
    e = e_at(name, t, limits[:, None]).ravel()
    if name == "viscous":
        e = np.minimum(e, VISCOUS)
        edges = [
            spheres_thresholds.friction_falls(b, e),
            spheres_thresholds.lasts_to_largest_force(b, e),
        ]
    else:
        edges = [] if name == "plastic_high" else [spheres_thresholds.slides_at_the_end(b, e)]
        if name == "plastic_low":
            edges.append(spheres_thresholds.slides_from(b, e))
    return _rounded(np.reshape(edges, (len(edges), *t.shape)), plan.exponent)


def nodes_of(name: str, plan: Plan, edges: Array, limits: Array, number: int) -> Array:
    """What the splines of a panel's patch run through, shape (3, s, t, u)."""
    over_s, over_t, over_u = plan.nodes[name]
    shape = over_s[number], over_t, over_u
    s, t, u = np.meshgrid(*(np.linspace(0.0, 1.0, count) for count in shape), indexing="ij")
    y, b, e = impacts(name, edges, limits, number, s.ravel(), t.ravel(), u.ravel())
    y = np.maximum(y, LEAST_INCIDENCE)
    values = solved(table.loss_of(name), y, b, e)
    if number == 0:
        values /= np.stack([y, y, y * y])
    return values.reshape(FUNCTIONS, *shape)


def impacts(
    name: str, edges: Array, limits: Array, number: int, s: Array, t: Array, u: Array
) -> tuple[Array, Array, Array]:
    """y, b and e at places of a patch."""
    b = b_at(table.loss_of(name), u)
    even = np.linspace(0.0, 1.0, limits.shape[1])
    e = e_at(name, t, np.stack([np.interp(u, even, limit) for limit in limits]))
    ends = table.edges_of(name, table.varying_edges(edges, t, u), b, e)
    low, high = ends[number : number + 2]
    share = {EVEN: s, LEFT: s**2, RIGHT: 1 - (1 - s) ** 2}[ROOTS[name][number]]
    return low + (high - low) * share, b, e


def solved(loss: str, y: Array, b: Array, e: Array) -> Array:
    """Velocity, peak friction and work of friction over zeta^2 = 1, shape (3, n)."""
    functions, parts = np.empty((FUNCTIONS, y.size)), []
    elastic = e >= ELASTIC
    y_elastic = y[elastic]
    tolerance = TOLERANCE * np.minimum(y_elastic, 1.0)
    result = continuum.rebound(y_elastic, b[elastic], 1.0, tolerance=tolerance)
    functions[:, elastic] = result.velocity, result.peak_friction, result.dissipation
    thin = y < THIN
    # Impacts of the same e together: one motion.
    order = np.lexsort((b, e))
    for steps, solve in ((STEPS, ~elastic & ~thin), (2 * STEPS, ~elastic & thin)):
        lossy = order[solve[order]]
        parts += [(steps, lossy[i : i + TOGETHER]) for i in range(0, lossy.size, TOGETHER)]
    for steps, rows in parts:
        solutions = (
            inelastic.path(
                y[rows],
                b[rows],
                np.ones(rows.size),
                e[rows],
                inelastic.MOTIONS[losses.SPHERES[loss]],
                count,
            )
            for count in (steps, 2 * steps)
        )
        coarse, fine = (np.stack([path.velocity[-1], path.peak, path.work]) for path in solutions)
        # The error falls with the square of the steps, but where slip is thinner than the distance
        # of two springs with the steps alone.
        functions[:, rows] = fine + (fine - coarse) / np.where(y[rows] > LEAST_INCIDENCE, 3, 1)
    return functions


def splined(values: Array) -> Array:
    """Coefficients of uniform B-splines whose sum runs through values at evenly spread nodes.

    Each variable has two coefficients more than nodes. As with a spline that is "not a knot", the
    third derivative does not jump at the second node and the last but one. There are at least four
    nodes along each axis.

    Examples
    --------
    >>> splined(np.arange(5.0) ** 3).round(9) + 0.0
    array([  0.,   0.,   0.,   6.,  24.,  60., 120.])
    """
    for axis, count in enumerate(values.shape):
        matrix, node = np.zeros((count + 2, count + 2)), np.arange(count)
        for place, weight in enumerate((1 / 6, 2 / 3, 1 / 6)):
            matrix[node, node + place] = weight
        matrix[count, :5] = matrix[count + 1, -5:] = 1, -4, 6, -4, 1
        rows = np.moveaxis(values, axis, 0)
        right = np.concatenate([rows, np.zeros((2, *rows.shape[1:]))]).reshape(count + 2, -1)
        coefficients = np.linalg.solve(matrix, right).reshape(count + 2, *rows.shape[1:])
        values = np.moveaxis(coefficients, 0, axis)
    return values


def write(file: IO[bytes], made: Table) -> None:
    """Write a table, compressed: numbers are stored as `steps` of whole numbers."""
    arrays: dict[str, Any] = {
        "exponent": made.exponent,
        "limits": made.limits,
        "laws": table.laws(),
    }
    for name, panel in made.panels.items():
        arrays[f"{name}.intervals"] = panel.intervals
        for key in table.PACKED:
            difference = table.steps(table.whole(getattr(panel, key), made.exponent))
            # The low bytes side by side, then the others: similar bytes compress well.
            arrays[f"{name}.{key}"] = np.moveaxis(
                difference.astype("<i4")[..., None].view(np.uint8), -1, 0
            )
    np.savez_compressed(file, **arrays)


if __name__ == "__main__":
    for name in PLANS:
        with open(Path(table.__file__).with_name(f"{name}.npz"), "wb") as file:
            write(file, make(name))
