"""The continuum, solved for as many impacts as have an answer."""

from typing import NamedTuple

import numpy as np

from planarimpact import continuum
from planarimpact.ground.arrays import Array, Integers
from planarimpact.ground.checks import ConvergenceError
from planarimpact.ground.results import Rebound


class Solved(NamedTuple):
    """Answers, the indices of the impacts that have one, and `{index: message}` of the others."""

    rebound: Rebound
    rows: Integers
    messages: dict[int, str]


def rebound(model: str, incidence: Array, groups: tuple[Array, ...], tolerance: Array) -> Solved:
    """Impacts solved by a continuum, to the tolerance of each, in mu v2(0)."""
    rows, messages = np.arange(incidence.size), dict[int, str]()
    loss = model.partition(".")[2] or None
    while True:
        try:
            arguments = incidence[rows], *(group[rows] for group in groups)
            answer = continuum.rebound(*arguments, loss=loss, tolerance=tolerance[rows])
            return Solved(answer, rows, messages)
        except ConvergenceError as error:
            # An error that names no impacts concerns all of them.
            unsolved = error.impacts if isinstance(error, continuum.Unsolved) else slice(None)
            messages |= dict.fromkeys(rows[unsolved].tolist(), str(error))
            rows = np.delete(rows, unsolved)
