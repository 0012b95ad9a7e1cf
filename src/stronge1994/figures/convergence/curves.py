"""Beyond the paper: two methods for one continuum, their errors and what they cost."""

import time
from collections.abc import Callable, Sequence

import numpy as np

from planarimpact import continuum, lumped
from planarimpact.continuum import annuli
from planarimpact.ground.arrays import Array
from stronge1994.csv_tables import Columns, Curves
from stronge1994.figures.shared.curves.sampling import NO_NODES, Nodes, vertices


def curves(
    mass_ratio: float,
    stiffness_ratio: Sequence[float],
    samples: int,
    tolerance: float,
    steps: Sequence[int],
    circles: Sequence[int],
    fixed: dict[str, int],
    nodes: Nodes = NO_NODES,
) -> Curves:
    """Both methods against the finest answer, and the continuum where it is tabulated.

    Errors are for the first stiffness ratio: root mean squares over incidences that stick at some
    time. The observed order is that of the whole curve. `time` is how long the processor of this
    machine works for an impact that is solved together with the others.

    >>> named = curves(3.5, [1.21], 5, 1e-4, [32, 64], [4, 8], {"steps": 64, "circles": 4})
    >>> list(named)[:2]
    ['row of springs', 'row of springs, extrapolated']
    """
    zeta2 = stiffness_ratio[0]
    limit = float(lumped.slip_throughout_limit(mass_ratio, zeta2))
    x = np.linspace(0, limit, samples + 2)[1:-1]
    groups = x, mass_ratio, zeta2
    exact = continuum.rebound(*groups, tolerance=tolerance).velocity

    def plain(n: int) -> Array:
        return continuum.fixed_steps(*groups, n)

    def extrapolated(n: int) -> Array:
        return continuum.fixed_steps(*groups, n, extrapolate=True)

    def by_circles(n: int) -> Array:
        return annuli.rebound(*groups, circles=n, steps=fixed["steps"]).velocity

    def by_steps(n: int) -> Array:
        return annuli.rebound(*groups, circles=fixed["circles"], steps=n).velocity

    named = {
        "row of springs": _errors(plain, "steps [1]", steps, exact),
        "row of springs, extrapolated": _errors(extrapolated, "steps [1]", steps, exact),
        "annuli, circles": _errors(by_circles, "circles [1]", circles, exact),
        "annuli, steps": _errors(by_steps, "steps [1]", steps, exact),
    }
    at = vertices((0.0, 10.0), 2, nodes.get("incidence", ()))
    # Solved together all ratios take hardly longer than one of them.
    ratios = np.array(stiffness_ratio)[:, None]
    for ratio, velocity in zip(
        stiffness_ratio, continuum.rebound(at, mass_ratio, ratios).velocity, strict=True
    ):
        columns = {"incidence [mu v2(0)]": at, "velocity [mu v2(0)]": velocity}
        named[f"continuum, zeta2 = {ratio:.4f}"] = columns
    return named


def _errors(
    method: Callable[[int], Array], column: str, numbers: Sequence[int], exact: Array
) -> Columns:
    """Error and time of a method at each number, and the order from the first to the last."""
    errors, times = [], []
    for number in numbers:
        start = time.process_time()
        velocity = method(number)
        times.append((time.process_time() - start) / exact.size)
        errors.append(np.sqrt(np.mean((velocity - exact) ** 2)))
    slope = -np.polyfit(np.log(numbers), np.log(errors), 1)[0]
    return {
        column: np.array(numbers),
        "error [mu v2(0)]": np.array(errors),
        "observed_order [1]": np.full(len(errors), slope),
        "time [s]": np.array(times),
    }
