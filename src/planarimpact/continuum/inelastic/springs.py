"""The springs of an inelastic contact, moved sideways from instant to instant."""

from abc import ABC, abstractmethod

import numpy as np

from planarimpact.continuum.inelastic.motion import NormalMotion
from planarimpact.ground.arrays import Array, Booleans


class SpringRow(ABC):
    """The springs of many contacts, innermost first, moved together from instant to instant.

    Attributes
    ----------
    stick_radius : ndarray, shape (n,)
        Radius inside which no spring slipped in the last step.
    """

    def __init__(self, motion: NormalMotion) -> None:
        self._motion = motion
        # Limit L and tangential density of the springs that touch.
        self._limit, self._density = np.zeros((2, 1, motion.largest_force.size))
        self._tried = self._limit, self._density

    @abstractmethod
    def slide(self, k: int, which: Booleans, u: Array) -> None:
        """Put contacts in the state of gross slip at instant k, which is the last one."""

    @abstractmethod
    def move(
        self, k: int, step: Array, start: tuple[Array, Array], end: tuple[Array, Array]
    ) -> Array:
        """Tangential force at instant k if the body moves from one (u, u') to another; a trial.

        `step` is the time since the last instant, 0 for contacts that still slide from the start.
        """

    @abstractmethod
    def settle(self, k: int) -> Array:
        """Keep the last trial; return the work of friction over zeta^2 in its step, if known."""

    def _keep(self, slid: Booleans) -> None:
        """Keep the last trial, where each spring `slid` or not, innermost first."""
        first = np.argmax(slid, axis=0)
        column = np.arange(first.size)
        self._limit, self._density = self._tried
        edge = len(self._density) - 1
        self.stick_radius = self._motion.radius[np.where(slid[first, column], first, edge), column]

    def _sum(self, k: int) -> Array:
        """Friction at instant k: mu times the normal force times the share of the limits."""
        limit, density = self._tried
        width = self._motion.width[: len(limit)].copy()
        width[-1] = self._motion.edge_width[len(limit) - 1]
        whole = np.sum(width * limit, axis=0)
        share = np.sum(width * density, axis=0) / np.where(whole > 0, whole, 1.0)
        return share * self._motion.force[k]
