"""The continuum, solved for as many impacts as have an answer."""

from typing import NamedTuple

import numpy as np

from planarimpact import continuum
from planarimpact.ground.arrays import Array, Integers
from planarimpact.ground.checks import ConvergenceError, Unsolved
from planarimpact.ground.results import Rebound

# Of elastic impacts, and of those with each loss.
MODELS = ("continuum", *(f"continuum.{loss}" for loss in continuum.LOSSES))
# Below this incidence the answer is in proportion to it, to 1e-9: slip is too narrow to matter.
LINEAR = 1e-8


class Solved(NamedTuple):
    """Answers, the indices of the impacts that have one, and `{index: message}` of the others."""

    rebound: Rebound
    rows: Integers
    messages: dict[int, str]


def rebound(model: str, incidence: Array, groups: tuple[Array, ...], tolerance: Array) -> Solved:
    """Impacts x > 0 solved by one of `MODELS`, to the tolerance of each, in mu v2(0)."""
    rows, messages = np.arange(incidence.size), dict[int, str]()
    loss = model.partition(".")[2] or None
    solved_at = np.maximum(incidence, LINEAR)
    share = incidence / solved_at
    allowed = tolerance / share
    while True:
        try:
            arguments = solved_at[rows], *(group[rows] for group in groups)
            answer = continuum.rebound(*arguments, loss=loss, tolerance=allowed[rows])
            return Solved(_in_proportion(answer, share[rows]), rows, messages)
        except ConvergenceError as error:
            # An error that names no impacts concerns all of them.
            unsolved = error.impacts if isinstance(error, Unsolved) else slice(None)
            messages |= dict.fromkeys(rows[unsolved].tolist(), str(error))
            rows = np.delete(rows, unsolved)


def _in_proportion(rebound: Rebound, share: Array) -> Rebound:
    """The answer at shares of the incidence, where it is linear."""
    return rebound._replace(
        velocity=rebound.velocity * share,
        peak_friction=rebound.peak_friction * share,
        dissipation=rebound.dissipation * share * share,
    )
