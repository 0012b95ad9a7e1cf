"""What takes the normal energy of a lumped contact: each loss by its name.

A loss has four functions of impacts x >= 0. At e = 1 all losses are the same model.
"""

import numpy as np

from planarimpact.common import checks, sliding
from planarimpact.common.arrays import Array
from planarimpact.common.results import History
from planarimpact.lumped import hysteretic, stick_slip, viscous
from planarimpact.lumped.stick_slip import Impacts, Outcome

# Largest omega/Omega. A contact has up to as many phases; with more it is as good as rigid.
LARGEST_FREQUENCY = 1e4


class Hysteretic:
    """The paper's element, of which only the normal direction loses energy."""

    # Impacts solved together: few enough for the cache, enough to hide Python's overhead.
    chunk = 32768

    def stiffness_ratio(self, zeta2: Array, e: Array) -> Array:
        """Stiffness ratio of the element of the paper that is solved."""
        return zeta2

    def slides_from(self, beta: Array, zeta2: Array, e: Array) -> Array:
        """Incidence from which the contact slides throughout."""
        return sliding.limit(beta, self.stiffness_ratio(zeta2, e), e)

    def solve(self, impacts: Impacts) -> Outcome:
        """Outcome of impacts, arrays of shape (n,), chunk by chunk."""
        size = impacts.x.size
        velocity, peak, work = (np.empty(size) for _ in range(3))
        outcome = Outcome(velocity, peak, work, np.empty(size, np.uint8))
        for start in range(0, size, self.chunk):
            part = slice(start, start + self.chunk)
            solved = self.solve_chunk(Impacts(*(group[part] for group in impacts)))
            for field, values in zip(outcome, solved, strict=True):
                field[part] = values
        return outcome

    def solve_chunk(self, impacts: Impacts) -> Outcome:
        """Outcome of impacts, arrays of shape (n,), all at once."""
        return stick_slip.solve(self._element(impacts))

    def history(self, mirror: float, impacts: Impacts, samples: int) -> History:
        """One contact, its arrays of shape (1,)."""
        return hysteretic.history(mirror, self._element(impacts), samples)

    def friction_work(self, impacts: Impacts) -> float:
        """Work of friction in one contact, computed in another way than by `solve`, if possible."""
        return hysteretic.friction_work(self._element(impacts))

    def _element(self, impacts: Impacts) -> Impacts:
        """Impacts of the element of the paper; refused is one that is too stiff."""
        element = impacts._replace(zeta2=self.stiffness_ratio(impacts.zeta2, impacts.e))
        stiff = element.beta > LARGEST_FREQUENCY**2 * element.zeta2
        if stiff.any():
            _, beta, zeta2, e = (float(group[stiff][0]) for group in impacts)
            raise checks.InputError(
                f"stiffness_ratio = {zeta2}: at mass_ratio = {beta:g}, restitution = {e:g} allowed "
                f"are tangential frequencies omega/Omega up to {LARGEST_FREQUENCY:g} (for no "
                "tangential compliance use planarimpact.rigid)"
            )
        return element


class UnloadingStiffness(Hysteretic):
    """The paper's element with the tangential stiffness kappa/(e^2 zeta^2), that of unloading."""

    def stiffness_ratio(self, zeta2: Array, e: Array) -> Array:
        """Stiffness ratio e^2 zeta^2 of unloading, rounded as in `sliding.restick_coefficient`."""
        return e * (e * zeta2)


class Viscous(Hysteretic):
    """Two Kelvin-Voigt elements with one relaxation time: a dashpot beside each spring."""

    chunk = 131072  # of up to four kinds, each of them solved together

    def slides_from(self, beta: Array, zeta2: Array, e: Array) -> Array:
        """Incidence from which slip never ends where both directions lose energy alike."""
        return sliding.limit_alike(beta, zeta2, e)

    def solve_chunk(self, impacts: Impacts) -> Outcome:
        """Outcome of a chunk: at e = 1 that of `Hysteretic`, below it that of damped elements."""
        damped = impacts.e < 1
        if damped.all():
            return viscous.solve(impacts)
        outcome = super().solve_chunk(impacts)
        if damped.any():
            solved = viscous.solve(impacts.take(np.flatnonzero(damped)))
            for field, values in zip(outcome, solved, strict=True):
                field[damped] = values
        return outcome

    def history(self, mirror: float, impacts: Impacts, samples: int) -> History:
        """One contact, its arrays of shape (1,): at e = 1 that of `Hysteretic`."""
        if impacts.e[0] == 1:
            return super().history(mirror, impacts, samples)
        return viscous.history(mirror, impacts, samples)

    def friction_work(self, impacts: Impacts) -> float:
        """Work of friction in one contact; below e = 1 by the closed form of `solve`."""
        if impacts.e[0] == 1:
            return super().friction_work(impacts)
        return float(self.solve(impacts).dissipation[0])


LOSSES: dict[str, Hysteretic] = {
    "hysteretic": Hysteretic(),
    "unloading-stiffness": UnloadingStiffness(),
    "viscous": Viscous(),
}


def loss_of(name: str) -> Hysteretic:
    """The loss with this name."""
    return LOSSES[checks.loss(name, tuple(LOSSES))]
