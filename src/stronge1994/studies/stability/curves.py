"""Beyond the paper: with how many digits the lumped model is solved, for all parameters."""

import warnings
from collections.abc import Callable, Mapping, Sequence
from typing import Any, TypeVar

import numpy as np

from planarimpact import lumped
from planarimpact.common.arrays import Array
from stronge1994 import tables
from stronge1994.tables import Table

GROUPS = {
    "incidence": "mu v2(0)",
    "mass_ratio": "1",
    "stiffness_ratio": "1",
    "restitution": "1",
}
OUTPUTS = ("velocity", "peak_friction", "dissipation")
ROUNDING = 2.0**-52
# Smaller numbers count as zero: outputs that happen to be zero have no size.
FLOOR = 1e-300
# Friction of contacts that are followed, in mu F2max: forces on the way have the rounding error of
# the largest normal force, so weaker friction has not enough digits for a balance of energy.
LEAST_FRICTION = 0.01
# Instants of a contact besides its events.
SAMPLES = 20
# Excess of friction, and share of energy, of a contact that cannot be followed.
UNKNOWN = 1.0
# Largest number of digits that is counted.
DIGITS = 16.0


_Result = TypeVar("_Result")


def curves(points: Mapping[str, Sequence[float]], most_frequency: float) -> Table:
    """Digits of every output at given impacts, and the balances of their contacts.

    `points` has answers of many digits and their conditions, see data/lumped_extremes/source.yaml.
    Allowed are the digits that the condition of an output leaves if every number is rounded once;
    `digits_lost` says how many fewer the worst output has. An impact that raises, warns or gives
    NaN has no digits and loses 16. These are in the variant `impacts`. The contacts of up to
    `most_frequency` are followed, but for those with friction below LEAST_FRICTION: in `contacts`,
    `friction_excess` is how far friction exceeds the Coulomb limit at the worst instant;
    `energy_residual` is how far the work of friction along the contact differs from the balance of
    energy, over the most work that friction could do plus the condition.

    >>> table = {"incidence": [8.0], "mass_ratio": [3.5], "stiffness_ratio": [1.21]}
    >>> table |= {"restitution": [1.0], "velocity": [1.0], "peak_friction": [1.0]}
    >>> table |= {"dissipation": [9.0], "condition_velocity": [18.5], "phases": [1]}
    >>> table |= {"condition_peak_friction": [0.0], "condition_dissipation": [29.0]}
    >>> tables.select(curves(table, 10), variant="impacts")["digits_lost [1]"].tolist()
    [0.0]
    """
    table = {name: np.asarray(values, float) for name, values in points.items()}
    groups = np.stack([table[name] for name in GROUPS])
    labelled = {f"{name} [{unit}]": table[name] for name, unit in GROUPS.items()}
    labelled["omega [Omega]"] = np.sqrt(table["mass_ratio"] / table["stiffness_ratio"])
    labelled["phases [1]"] = table["phases"].astype(int)

    columns, lost = {}, []
    solved = _solved(lambda *own: lumped.rebound(*own)[:3], groups, len(OUTPUTS))
    for name, output in zip(OUTPUTS, solved, strict=True):
        digits = _digits(output, table[name], table[f"condition_{name}"])
        columns[f"digits_{name} [1]"], columns[f"digits_allowed_{name} [1]"] = digits[:2]
        lost.append(digits[2])
    columns["digits_lost [1]"] = np.max(lost, axis=0)

    few = (table["phases"] > 1) & (labelled["omega [Omega]"] <= most_frequency)
    few &= table["peak_friction"] >= LEAST_FRICTION
    followed = {name: values[few] for name, values in labelled.items()}
    excess = np.array([_excess(*row) for row in groups[:, few].T])
    [work] = _solved(lambda *own: [lumped.friction_work(*own)], groups[:, few], 1)
    lost_energy = np.broadcast_to(solved[-1], few.shape)[few]
    gap, e = np.abs(work - lost_energy), groups[-1, few]
    size = np.maximum(_most_work(*groups) + table["condition_dissipation"], FLOOR)[few]
    # For e = 0 the tangential spring loses energy too.
    residual = np.where((e == 0) | (gap <= FLOOR), 0.0, np.fmin(gap / size, 1.0))
    residual = np.where(excess == UNKNOWN, 1.0, residual)
    followed |= {"friction_excess [mu F2max]": excess, "energy_residual [1]": residual}
    variants = {"impacts": labelled | columns, "contacts": followed}
    return tables.join(tables.curve(own, "lumped", variant) for variant, own in variants.items())


def _solved(solve: Callable[..., Sequence[Any]], groups: Array, count: int) -> Array:
    """Outputs of impacts, shape (count, n); NaN only for those that raise or warn."""
    outputs = _attempt(lambda: np.stack(solve(*groups)))
    if outputs is not None:
        return outputs
    if groups.shape[1] == 1:
        return np.full((count, 1), np.nan)
    halves = np.array_split(groups, 2, axis=1)
    return np.concatenate([_solved(solve, half, count) for half in halves], axis=1)


def _attempt(call: Callable[[], _Result]) -> _Result | None:
    """Result of a call; None if it raises or warns."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            return call()
    except Exception:
        return None


def _digits(solved: Array, exact: Array, condition: Array) -> tuple[Array, Array, Array]:
    """Correct, allowed and lost digits of one output."""
    size = np.maximum(np.abs(exact), FLOOR)
    error = np.abs(solved - exact)
    error = np.where(error <= FLOOR, 0.0, error)  # NaN stays
    limit = ROUNDING * (np.abs(exact) + condition)
    with np.errstate(divide="ignore", over="ignore"):
        correct, allowed = -np.log10(error / size), -np.log10(limit / size)
        lost = np.log10(error / np.maximum(limit, FLOOR))
    lost = np.where(np.isnan(error), DIGITS, np.clip(lost, 0.0, DIGITS))
    correct = np.where(np.isnan(error), 0.0, np.clip(correct, 0.0, DIGITS))
    return correct + 0.0, np.clip(allowed, 0.0, DIGITS) + 0.0, lost  # no -0.0


def _excess(x: float, beta: float, zeta2: float, e: float) -> float:
    """Excess of friction over the Coulomb limit at the worst instant; UNKNOWN without a history."""
    history = _attempt(lambda: lumped.history(x, beta, zeta2, e, samples=SAMPLES))
    if history is None:
        return UNKNOWN
    excess = np.max(np.abs(history.friction_force) - history.normal, initial=0.0)
    return float(np.nan_to_num(excess, nan=UNKNOWN))


def _most_work(x: Array, beta: Array, zeta2: Array, e: Array) -> Array:
    """All tangential energy, or the work of friction at its limit throughout if that is less."""
    return np.minimum(x, 2 * (1 + e) * beta) * (x / (2 * beta))
