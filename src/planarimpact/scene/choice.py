"""The model for the impacts of a pair, and the way to its answer: the cheapest that is good enough.

A model together with a way (by formula, by table, solved, compiled) is a rung. The reference is
`planarimpact.models.reference`: the continuum, elastic or with the loss of the pair. An error is
the larger one of velocity (mu v2(0)) and peak friction (mu F2max).

`spheres` has a table of all three continua. It is taken wherever it holds and is fine enough, for
impacts of any number of pairs at once: no model is both cheaper and as good.

Other impacts are sorted by pair. For e = 1 `gaps` has the measured errors of the cheaper models.
For e < 1 they are not tried: a compiled continuum is as fast, and for a solid sphere at e = 0.8 the
lumped model of the same loss is up to 0.2 (viscous) and 0.5 (plastic) off.
"""

from collections import Counter
from collections.abc import Callable, Iterable
from typing import NamedTuple, TypeAlias, TypeVar

import numpy as np
import pandas as pd

from planarimpact import continuum, lumped, models, response, rigid, spheres
from planarimpact.ground import checks
from planarimpact.ground.arrays import Array, Booleans, Integers, Numbers
from planarimpact.ground.results import Rebound
from planarimpact.response import Response
from planarimpact.scene import gaps

# Seconds for the first impact of a pair and for each further one, by tests/benchmarks/
# scene_speed.py. They decide between equally good ways, so that only their ratios matter, and
# only for speed.
COST = {
    ("rigid", "formula"): (1e-4, 5e-8),
    ("lumped", "solved"): (5e-4, 2.5e-7),
    ("lumped", "compiled"): (2e-2, 6e-8),
    ("continuum", "solved"): (3e-2, 2e-4),
    ("continuum", "compiled"): (1e-1, 6e-8),
    ("continuum.viscous", "solved"): (3e-2, 6e-4),
    ("continuum.viscous", "compiled"): (4e-1, 6e-8),
    ("continuum.plastic", "solved"): (3e-2, 6e-4),
    ("continuum.plastic", "compiled"): (3e-1, 6e-8),
}
# Below this restitution the peak friction of plastic spheres bends sharply, and compiling takes so
# many times as long.
SHARP, SHARPLY = 0.75, 30.0
# Above this beta/zeta^2 peak friction has more bends, and compiling a continuum takes so many times
# as long.
BENT, BENDS = 5.5, 20.0
# These costs hold for this beta/zeta^2, and grow with it.
ORDINARY = 3.0
# A pair with fewer impacts than this is solved together with other such pairs.
FEW = 64
FEW_OF_EACH = f"fewer than {FEW} impacts of each m2/m1, zeta^2 and e"
# A cheaper model is taken if its error is below this share of the tolerance.
MOST = 0.99
# Error for a unit of the mass ratio, of the lumped model and of groups rounded to 12 digits.
EXACT = 1e-12
# The largest number below 1 among those of 12 digits.
BELOW_ONE = 1 - 2.0**-41
# Tolerance of a compiled lumped response, which costs little more than a coarse one.
FINE = 1e-9


Answer = TypeVar("Answer")
# By model and groups.
Responses: TypeAlias = dict[tuple[str, float, float, float], Response]


class Rung(NamedTuple):
    """A model, the way to its answer, its error against the reference, and why it was taken.

    `way` is "formula", "table", "solved" or "compiled"; what that adds to the error, `solve` tells.
    """

    model: str
    way: str
    error: float
    why: str

    @property
    def name(self) -> str:
        """Model and way, in words."""
        return self.model if self.way == "formula" else f"{self.model}, {self.way}"


class Job(NamedTuple):
    """Impacts of a table, by row, that one rung solves together; groups are numbers or arrays."""

    rung: Rung
    rows: Integers
    groups: tuple[Numbers, ...]
    pair: str
    alike: bool  # whether all of them are one pair, but for rounding

    def of(self, which: Integers) -> "Job":
        """The same job for some of its impacts."""
        groups = tuple(g if isinstance(g, float) else g[which] for g in self.groups)
        return self._replace(rows=self.rows[which], groups=groups)


REFERENCE = "errors are measured against it"
# Of elastic, viscous and plastic pairs.
REFERENCES = ("continuum", *(f"continuum.{loss}" for loss in continuum.LOSSES))
# The loss for which the table of spheres has them: at e = 1 either will do.
TABLED = dict(zip(REFERENCES, (continuum.LOSSES[0], *continuum.LOSSES), strict=True))
MODELS = ("rigid", "lumped", *REFERENCES)
SLIDING = Rung("slip throughout", "formula", 0.0, "Coulomb's line, as in every compliant model")
HEAD_ON = Rung("head-on", "formula", 0.0, "no tangential motion, the same in every model")
HELD = "all pairs in its range"


def jobs(
    mass_ratio: Array,
    stiffness_ratio: Array,
    restitution: Array,
    plastic: Booleans,
    rows: Integers,
    tolerance: float,
    responses: Responses,
    seen: Counter[tuple[str, tuple[float, ...]]],
) -> list[Job]:
    """Divide impacts that do not slide throughout among the rungs.

    Parameters
    ----------
    mass_ratio, stiffness_ratio, restitution : ndarray, shape (n,)
    plastic : ndarray of bool, shape (n,)
        Whether the loss is plastic. It has no meaning for e = 1.
    rows : ndarray of int
        Those of them that are to be solved.
    tolerance : float
    responses : dict
        Those compiled so far, as `solve` keeps them.
    seen : Counter
        Impacts of each pair so far: these are added.

    Returns
    -------
    list of Job
    """
    groups = np.stack([group[rows] for group in (mass_ratio, stiffness_ratio, restitution)])
    kinds = np.where(groups[2] == 1, 0, np.where(plastic[rows], 2, 1))
    tabled, chosen = spheres.covers(*groups), []
    errors = np.array([spheres.ERROR_BOUND[loss] for loss in TABLED.values()])[kinds]
    yields = np.flatnonzero(tabled & (kinds == 2))
    errors[yields[spheres.loses_little(*groups[:, yields])]] = spheres.LITTLE_BOUND
    tabled &= MOST * tolerance >= errors
    for kind, name in enumerate(REFERENCES):
        for error in np.unique(errors[tabled & (kinds == kind)]):
            which = np.flatnonzero(tabled & (kinds == kind) & (errors == error))
            why = f"the table of spheres differs by {error:.2g} at most, as measured"
            chosen.append((which, Rung(name, "table", float(error), why)))
    found = _each(chosen, groups, rows, HELD)
    left = np.flatnonzero(~tabled)
    return found + _pair_by_pair(
        groups[:, left], kinds[left], rows[left], tolerance, responses, seen
    )


def _each(
    chosen: Iterable[tuple[Integers, Rung]], groups: Array, rows: Integers, pair: str
) -> list[Job]:
    """A job for each rung that has impacts."""
    return [
        Job(rung, rows[some], tuple(groups[:, some]), pair, False)
        for some, rung in chosen
        if some.size
    ]


def _pair_by_pair(
    groups: Array,
    kinds: Integers,
    rows: Integers,
    tolerance: float,
    responses: Responses,
    seen: Counter[tuple[str, tuple[float, ...]]],
) -> list[Job]:
    """Jobs for impacts that the table does not hold: one for each pair of many."""
    if not rows.size:
        return []
    rounded = _rounded(groups)
    # Only e = 1 is elastic, so no other e may be rounded to it.
    rounded[2] = np.where(groups[2] < 1, np.minimum(rounded[2], BELOW_ONE), rounded[2])
    code = kinds.astype(np.int64)
    for group in rounded:
        own, values = pd.factorize(group)
        code, _ = pd.factorize(code * len(values) + own)
    order = np.argsort(code, kind="stable")
    counts = np.bincount(code)
    found, few = [], []
    for member in np.split(order, np.cumsum(counts)[:-1]):
        if member.size < FEW:
            few.append(member)
            continue
        beta, zeta2, e = rounded[:, member[0]].tolist()
        pair, reference = (beta, zeta2, e), REFERENCES[kinds[member[0]]]
        name = "m2/m1 = {:.4g}, zeta^2 = {:.4g}, e = {:.4g}".format(*pair)
        seen[reference, pair] += member.size
        taken = rung(*pair, tolerance, seen[reference, pair], reference, responses)
        own = pair if taken.way == "compiled" else tuple(groups[:, member])
        found.append(Job(taken, rows[member], own, name, True))
    if few:
        found += _together(groups, kinds, rows, np.concatenate(few), tolerance)
    return found


def _rounded(groups: Array) -> Array:
    """Groups to 12 digits: what differs by rounding alone is one pair."""
    bits = groups.view(np.int64)
    return ((bits + 2**11) & -(2**12)).view(np.float64)


def _together(
    groups: Array, kinds: Integers, rows: Integers, members: Integers, tolerance: float
) -> list[Job]:
    """Jobs for impacts of pairs that have few each."""
    elastic = kinds[members] == 0
    gap = gaps.elastic("lumped", *groups[:2, members])
    coarse = elastic & (gap <= MOST * tolerance)
    largest = float(np.max(gap[coarse], initial=0.0))
    cheaper = Rung("lumped", "solved", largest, "differs by less than allowed")
    chosen = [(members[coarse], cheaper)]
    for kind, reference in enumerate(REFERENCES):
        same = (kinds[members] == kind) & ~coarse
        chosen.append((members[same], Rung(reference, "solved", 0.0, REFERENCE)))
    return _each(chosen, groups, rows, FEW_OF_EACH)


def rung(
    mass_ratio: float,
    stiffness_ratio: float,
    restitution: float,
    tolerance: float,
    count: int,
    reference: str = "continuum",
    responses: Responses | None = None,
) -> Rung:
    """The cheapest rung for impacts of one pair outside the table that do not slide throughout.

    Parameters
    ----------
    mass_ratio, stiffness_ratio, restitution : float
    tolerance : float
    count : int
        How many: compiling pays for many.
    reference : str
        One of `REFERENCES`.
    responses : dict, optional
        Those compiled so far, as `solve` keeps them.

    Returns
    -------
    Rung

    Examples
    --------
    >>> rung(3.5, 1.21, 1.0, 0.3, 100)[:2], rung(3.5, 1.21, 1.0, 1e-3, 1000)[:2]
    (('lumped', 'solved'), ('continuum', 'compiled'))
    >>> rung(3.5, 1.21, 0.9, 1e-3, 100, "continuum.viscous")[:2]
    ('continuum.viscous', 'solved')
    """
    groups = mass_ratio, stiffness_ratio, restitution
    gap = {reference: 0.0}
    if restitution == 1:
        gap |= {name: float(gaps.elastic(name, *groups[:2])) for name in ("rigid", "lumped")}
    costs = []
    oscillates = max(1.0, mass_ratio / stiffness_ratio / ORDINARY)
    for (model, way), (first, each) in COST.items():
        if gap.get(model, np.inf) <= MOST * tolerance:
            # A compiled response has a kink for every half-wave of the tangential oscillation.
            if model in REFERENCES and way == "solved":
                each = each * oscillates
            elif way == "compiled":
                first = first * (oscillates**2 if model in REFERENCES else oscillates**0.5)
                if model == "continuum.plastic" and restitution < SHARP:
                    first = first * SHARPLY
                if model in REFERENCES and mass_ratio > BENT * stiffness_ratio:
                    first = first * BENDS
            ready = way == "compiled" and (model, *groups) in (responses or {})
            costs.append(((0.0 if ready else first) + count * each, model, way))
    _, model, way = min(costs)
    why = f"differs by {gap[model]:.2g} at most, as measured" if gap[model] else REFERENCE
    if way == "solved" and not gap[model]:
        why += "; compiling it would take longer"
    return Rung(model, way, gap[model], why)


def solve(
    rung: Rung,
    incidence: Array,
    mass_ratio: Numbers,
    stiffness_ratio: Numbers,
    restitution: Numbers,
    tolerance: float,
    responses: Responses,
) -> tuple[Rebound, Numbers]:
    """Impacts by a rung.

    Parameters
    ----------
    rung : Rung
    incidence : ndarray, shape (n,)
        At least 0.
    mass_ratio, stiffness_ratio, restitution : float or ndarray, shape (n,)
        Numbers where the rung is compiled.
    tolerance : float
    responses : dict
        Those compiled so far, by model and groups; a new one is added.

    Returns
    -------
    rebound : Rebound
    error : float or ndarray, shape (n,)
        Of velocity (mu v2(0)) and peak friction (mu F2max), against the reference.
    """
    groups = mass_ratio, stiffness_ratio, restitution
    if rung.way == "compiled":
        key = rung.model, float(mass_ratio), float(stiffness_ratio), float(restitution)
        if key not in responses:
            responses[key] = _compiled(*key, tolerance)
        error = rung.error + max(responses[key].error_bound) + EXACT * mass_ratio
        return responses[key](incidence), error
    if rung.way == "table":
        found = spheres.rebound(incidence, *groups, loss=TABLED[rung.model])
        return found, rung.error + EXACT * np.asarray(mass_ratio)
    if rung.model in REFERENCES:
        return models.rebound(rung.model, incidence, *groups, tolerance=tolerance), tolerance
    model = {"lumped": lumped, "rigid": rigid}[rung.model]
    return model.rebound(incidence, *groups), rung.error + EXACT * np.asarray(mass_ratio)


def without_unsolved(
    solve: Callable[[Integers], Answer], count: int
) -> tuple[Answer, Integers, dict[int, str]]:
    """Solve as many impacts as have an answer.

    Parameters
    ----------
    solve : callable
        Takes the indices of impacts; raises `ConvergenceError` if some of them have no answer.
    count : int
        Of all impacts.

    Returns
    -------
    answer
        What `solve` returned for those that have one.
    left : ndarray of int
        Their indices.
    without : dict
        `{index: words}` of the others.
    """
    left = np.arange(count)
    without: dict[int, str] = {}
    while True:
        try:
            return solve(left), left, without
        except checks.ConvergenceError as error:
            lost = error.impacts if isinstance(error, checks.Unsolved) else slice(None)
            without |= dict.fromkeys(left[lost].tolist(), str(error))
            left = np.delete(left, lost)


def _compiled(
    model: str, mass_ratio: float, stiffness_ratio: float, restitution: float, tolerance: float
) -> Response:
    loss = model.partition(".")[2] or None
    groups = mass_ratio, stiffness_ratio, restitution
    limit = float(continuum.slip_throughout_limit(*groups, loss=loss))
    wanted = tolerance if model in REFERENCES else min(tolerance, FINE)
    return response.compile(
        model,
        incidence_max=limit,
        tolerance=max(wanted, response.ROUNDING * limit),
        mass_ratio=mass_ratio,
        stiffness_ratio=stiffness_ratio,
        restitution=restitution,
    )
