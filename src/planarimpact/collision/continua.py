"""The continuum, solved for as many impacts as have an answer."""

from typing import NamedTuple

import numpy as np

from planarimpact import continuum, models
from planarimpact.ground.arrays import Array, Integers
from planarimpact.ground.checks import ConvergenceError, Unsolved
from planarimpact.ground.results import Rebound

# Of elastic impacts, and of those with each loss.
MODELS = ("continuum", *(f"continuum.{loss}" for loss in continuum.LOSSES))


class Solved(NamedTuple):
    """Answers, the indices of the impacts that have one, and `{index: message}` of the others."""

    rebound: Rebound
    rows: Integers
    messages: dict[int, str]


def rebound(model: str, incidence: Array, groups: tuple[Array, ...], tolerance: float) -> Solved:
    """Impacts solved by one of `MODELS`; the tolerance of each is in mu v2(0)."""
    rows, messages = np.arange(incidence.size), dict[int, str]()
    while True:
        try:
            arguments = incidence[rows], *(group[rows] for group in groups)
            answer = models.rebound(model, *arguments, tolerance=tolerance)
            return Solved(answer, rows, messages)
        except ConvergenceError as error:
            # An error that names no impacts concerns all of them.
            unsolved = error.impacts if isinstance(error, Unsolved) else slice(None)
            messages |= dict.fromkeys(rows[unsolved].tolist(), str(error))
            rows = np.delete(rows, unsolved)
