"""Oblique impact of elastic spheres by concentric annuli, the scheme of Maw et al. (1976).

Fixed concentric circles and the edge of contact divide the contact into annuli. The tangential
traction is a sum of elliptic distributions over the circles, whose surface displacements are known
in closed form. At every small step in time each annulus either sticks (its surface moves with the
body) or slips (its traction is mu times the pressure). Trial decides which: a stuck annulus whose
traction exceeds friction slips, and one that slips against its friction sticks. As in the original,
traction and displacement have one direction, and the small part of the displacement that depends on
the angle around the contact is left out.

This solver checks `planarimpact.continuum`, with which it shares no code. It is slower and less
accurate. Units: radius a_max, time d_max/|v2(0)|, force its largest normal value (times mu for
traction and friction), tangential displacement zeta^2 mu d_max.
"""

import numpy as np

from planarimpact.common import checks
from planarimpact.common.arrays import Array, ArrayLike, Integers
from planarimpact.common.results import Rebound, Regime

# Entries of the systems of equations that are solved together: this bounds the memory.
CELLS = 2**18
MOST_CIRCLES = 1000
MOST_TRIALS = 100
# Fewest steps in a radian of the tangential oscillation. Below some 0.6 they are unstable.
STEPS_A_RADIAN = 1
ROUNDING = 1e-12
# Bounds of the velocity over zeta^2 that is solved. Below the least the contact sticks to its last
# step and the answer is in proportion to x. Above the largest it slides throughout.
LEAST, LARGEST = 1e-100, 1e100


@checks.default_errors
def rebound(
    incidence: ArrayLike,
    mass_ratio: ArrayLike = 3.5,
    stiffness_ratio: ArrayLike = 1.21,
    restitution: ArrayLike = 1.0,
    *,
    circles: int = 32,
    steps: int = 512,
) -> Rebound:
    """State at separation; the groups broadcast.

    Parameters
    ----------
    incidence, mass_ratio, stiffness_ratio, restitution : array_like
        As in `planarimpact.continuum.rebound`.
    circles : int
        1 to 1000: circles over the largest contact, equally spaced.
    steps : int
        Equal steps in time over the contact, at least pi times the square root of beta/zeta^2:
        with fewer the tangential oscillation may grow. Accuracy takes many times more.

    Returns
    -------
    Rebound
        As `planarimpact.continuum.rebound`; peak_friction is the largest at a step.

    Raises
    ------
    InputError
        If an argument is not a finite real number in its range, or shapes do not broadcast.
    ConvergenceError
        If no distribution of stick and slip is found for a step.

    Notes
    -----
    The error falls with the square of the number of circles. It falls with the power 1.2 of the
    steps only, since a ring that comes into contact within a step counts from the next one. With
    the default numbers it is at most about 0.001 for a solid sphere.

    References
    ----------
    N. Maw, J. R. Barber, J. N. Fawcett, The oblique impact of elastic spheres, Wear 38 (1976)
    101-114.

    Examples
    --------
    >>> round(float(rebound(2.0).velocity), 3)
    -0.666
    """
    allowed = "numbers equal to 1, as this contact is elastic"
    e = checks.checked("restitution", restitution, allowed, 1, 1)
    signed, beta, zeta2, _ = checks.impact(incidence, mass_ratio, stiffness_ratio, e)
    circles = _checked_circles(circles)
    with np.errstate(over="ignore"):
        needed = STEPS_A_RADIAN * np.pi * (np.sqrt(beta) / np.sqrt(zeta2))
    steps = checks.explicit_steps(steps, needed)
    x, beta, zeta2 = (a.reshape(-1) for a in (np.abs(signed), beta, zeta2))
    together = max(1, CELLS // circles**2)
    cuts = range(together, x.size, together)
    parts = [
        _impacts(*groups, circles=circles, steps=steps)
        for groups in zip(*(np.split(a, cuts) for a in (x, beta, zeta2)), strict=True)
    ]
    return Rebound.of(signed, *map(np.concatenate, zip(*parts, strict=True)))


@checks.default_errors
def friction(radius: ArrayLike, displacement: ArrayLike, circles: int = 32) -> Array:
    """Tangential force along a given path of contact radius and displacement (quasi-static).

    Parameters
    ----------
    radius : array_like, shape (steps,)
        Radius of contact after each step, in a_max; 1e-6 to 1. No contact before the first step.
    displacement : array_like, shape (steps,)
        Tangential displacement of the body in zeta^2 mu d_max, counted from first contact.
    circles : int
        As in `rebound`; they are spread over the radius 1.

    Returns
    -------
    ndarray, shape (steps,)
        Tangential force in mu times the normal force at radius 1; positive for a positive
        displacement of the body.

    Raises
    ------
    InputError
        If an argument is not finite or out of its range, or the shapes do not fit.
    ConvergenceError
        If no distribution of stick and slip is found for a step.

    Examples
    --------
    >>> round(float(friction([1.0, 1.0], [0.0, 0.75])[1]), 3)  # Mindlin: 0.875
    0.875
    """
    radius, displacement = checks.path(radius, displacement)
    contact = _Contact(1, _checked_circles(circles))
    travel = np.diff(displacement, prepend=0.0)
    return np.array([contact.move(a, u)[0] for a, u in zip(radius, travel[:, None], strict=True)])


def _checked_circles(circles: int) -> int:
    return checks.count("circles", circles, 1, MOST_CIRCLES)


def _impacts(
    x: Array, beta: Array, zeta2: Array, *, circles: int, steps: int
) -> tuple[Array, Array, Array, Integers, Integers]:
    """Velocity, impulse, peak friction, regime and reversals of impacts solved together."""
    radius, step = _contact_radius(steps)
    contact = _Contact(x.size, circles)
    force, impulse, last_sign, reversals, gross_slips, peak = np.zeros((6, x.size))
    started = False
    starts_in_slip, slipped = np.zeros((2, x.size), bool)
    kick = 1.25 * step  # F2max = (5/4) m2 v2(0)^2/d_max
    with np.errstate(over="ignore"):
        start = np.clip(x / zeta2, LEAST, LARGEST)
        share = np.minimum(x / zeta2 / LEAST, 1.0)  # below 1 where LEAST is solved instead
    slowing = beta / zeta2
    for edge in radius:
        impulse += kick / 2 * force
        force = contact.move(edge, (start - slowing * impulse) * step)
        impulse += kick / 2 * force
        peak = np.maximum(peak, np.abs(force))
        sign = np.where(force == 0, last_sign, np.sign(force))
        reversals += sign * last_sign < 0
        last_sign = sign
        slips = (contact.slip != 0).all(axis=0)
        # The first few annuli are too coarse to tell how the contact starts.
        if started:
            gross_slips += slips & ~slipped
        elif len(contact.slip) > circles / 8:
            started, starts_in_slip = True, slips
        slipped = slips
    impulse += kick / 2 * force  # of the last step, at whose end there is no force any more
    usual = np.where(starts_in_slip, Regime.SLIP_STICK_SLIP, Regime.STICK_SLIP)
    usual = np.where(starts_in_slip & (gross_slips == 0), Regime.SLIP_THROUGHOUT, usual)
    slides = usual == Regime.SLIP_THROUGHOUT
    usual = np.where(x == 0, Regime.STICK, usual)
    regime = np.where(gross_slips > 1, Regime.MULTIPLE, usual).astype(np.uint8)
    velocity_kept = 1 - slowing * (impulse / start)  # the velocity at separation over x
    velocity = np.where(slides, x - beta * impulse, x * velocity_kept)
    impulse = np.where(slides, impulse, impulse * share)
    peak = np.minimum(peak * share, 1.0)
    return velocity, impulse, peak, regime, reversals.astype(np.int64) * (x > 0)


def _contact_radius(steps: int) -> tuple[Array, float]:
    """Radius at the instants between equal steps of a Hertz contact, and the step in time.

    With d^(5/2) = y, time is an incomplete beta function of y: t = (2/5) B(2/5, 1/2; y).
    """
    from scipy import special  # here, as it takes longer to import than this package

    to_maximum = 0.4 * special.beta(0.4, 0.5)
    share = np.arange(1, steps) * (2 / steps)
    y = special.betaincinv(0.4, 0.5, np.minimum(share, 2 - share))
    return y**0.2, 2 * to_maximum / steps


class _Contact:
    """Tractions of many contacts that share their normal motion."""

    def __init__(self, contacts: int, circles: int) -> None:
        self._fixed = np.arange(1, circles + 1) / circles
        self._circles = np.ones(1)  # radii of the elliptic distributions, the edge last
        self._strength = np.zeros((1, contacts))  # of each distribution at its centre
        self.slip = np.zeros((0, contacts), dtype=np.int8)  # direction in each annulus, 0 stick

    def move(self, edge: float, travel: Array) -> Array:
        """Bring the edge to a radius and the bodies on by `travel`; return tangential forces."""
        inside = self._fixed[self._fixed < edge * (1 - 1e-9)]
        circles = np.append(inside, edge)
        middle = circles - np.diff(circles, prepend=0.0) / 2
        shape = np.sqrt(np.maximum(0.0, 1 - (middle[:, None] / circles) ** 2))
        shape = np.linalg.inv(shape)  # strengths from tractions
        influence = _displacement(middle, circles) @ shape
        before = _displacement(middle, self._circles) @ self._strength
        limit = 1.5 / np.pi * np.sqrt(edge**2 - middle**2)[:, None]  # pressure
        traction = self._try(influence, before + travel, limit)
        self._circles, self._strength = circles, shape @ traction
        return 2 / 3 * np.pi * circles**2 @ self._strength

    def _try(self, influence: Array, goal: Array, limit: Array) -> Array:
        """Tractions such that stuck annuli move with the body and none exceeds friction.

        Each turn of the loop solves for the tractions, and changes the state of annuli that do not
        fit it. A contact leaves the loop when no state changes.
        """
        annuli, contacts = goal.shape
        # Annuli are counted from the middle: those that were there before keep their state.
        slip = np.zeros((annuli, contacts), dtype=np.int8)
        kept = min(annuli, len(self.slip))
        slip[:kept] = self.slip[:kept]
        traction = np.empty(goal.shape)
        unsettled = np.arange(contacts)
        for _ in range(MOST_TRIALS):
            state, moved = slip[:, unsettled], goal[:, unsettled]
            stuck = state == 0
            system = np.where(stuck.T[:, :, None], influence, np.eye(annuli))
            known = np.where(stuck, moved, state * limit)
            solved = np.linalg.solve(system, known.T[:, :, None])[:, :, 0].T
            traction[:, unsettled] = solved
            exceeds = np.abs(solved) > limit * (1 + ROUNDING)
            resists = state * (moved - influence @ solved) < -ROUNDING * np.abs(moved)
            new = np.where(stuck, np.sign(solved) * exceeds, np.where(resists, 0, state))
            slip[:, unsettled] = new
            unsettled = unsettled[(new != state).any(axis=0)]
            if not unsettled.size:
                self.slip = slip
                return traction
        raise checks.ConvergenceError(
            f"no distribution of stick and slip over {annuli} annuli in {MOST_TRIALS} trials"
        )


def _displacement(radius: Array, circles: Array) -> Array:
    """Surface displacement at each radius for unit elliptic traction over each circle.

    Johnson, Contact Mechanics, Eqs 3.42: inside a circle of radius a it is proportional to
    (2 a^2 - r^2)/a; outside it falls as written here. Shape (radii, circles).
    """
    ratio = radius[:, None] / circles
    beyond = np.maximum(ratio, 1.0)
    outer = (2 - beyond**2) * np.arcsin(1 / beyond) + np.sqrt(beyond**2 - 1)
    inner = np.pi / 2 * (2 - np.minimum(ratio, 1.0) ** 2)
    return 2 / 3 * circles * np.where(ratio < 1, inner, outer)
