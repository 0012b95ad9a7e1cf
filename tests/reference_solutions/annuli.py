"""Oblique impact of elastic spheres by concentric annuli, the scheme of Maw et al. (1976).

Fixed concentric circles and the edge of contact divide the contact into annuli. The tangential
traction is a sum of elliptic distributions over the circles, whose surface displacements are known
in closed form. At every small step in time each annulus either sticks (its surface moves with the
body) or slips (its traction is mu times the pressure). Trial decides which: a stuck annulus whose
traction exceeds friction slips, and one that slips against its friction sticks. As in the original,
traction and displacement have one direction, and the small part of the displacement that depends on
the angle around the contact is left out.

It is slower and less accurate than the row of springs of `planarimpact.continuum`. The error falls
with the square of the number of circles. It falls with the power 1.2 of the steps only, since a
ring that comes into contact within a step counts from the next one. With 32 circles and 512 steps
it is at most about 0.001 for a solid sphere. Fewer steps than pi times the square root of
beta/zeta^2 are unstable. Units: radius a_max, time d_max/|v2(0)|, force its largest normal value
(times mu for traction and friction), tangential displacement zeta^2 mu d_max.

N. Maw, J. R. Barber, J. N. Fawcett, The oblique impact of elastic spheres, Wear 38 (1976) 101-114.
"""

from typing import Any, NamedTuple

import numpy as np
from scipy import special

# Entries of the systems of equations that are solved together: this bounds the memory.
CELLS = 2**18
MOST_TRIALS = 100
ROUNDING = 1e-12


class Separation(NamedTuple):
    """State at separation, each an array of the broadcast shape, in the units of the package.

    The peak is the largest at a step. The regime is a name of `planarimpact.Regime`.
    """

    velocity: Any
    peak_friction: Any
    dissipation: Any
    regime: Any
    reversals: Any


def rebound(incidence, mass_ratio, stiffness_ratio, *, circles, steps):
    """Solve impacts, x >= 0, with some circles over the largest contact and equal steps in time.

    >>> round(float(rebound(2.0, 3.5, 1.21, circles=32, steps=512).velocity), 3)
    -0.666
    """
    groups = np.broadcast_arrays(*map(np.float64, (incidence, mass_ratio, stiffness_ratio)))
    flat = [group.reshape(-1) for group in groups]
    together = max(1, CELLS // circles**2)
    cuts = range(together, flat[0].size, together)
    parts = [
        _impacts(*part, circles, steps)
        for part in zip(*(np.split(group, cuts) for group in flat), strict=True)
    ]
    columns = map(np.concatenate, zip(*parts, strict=True))
    return Separation(*(column.reshape(groups[0].shape)[()] for column in columns))


def friction(radius, displacement, circles):
    """Tangential force along a path of contact radius and tangential displacement (quasi-static).

    Both of shape (steps,), after each step; no contact before the first one. The circles are spread
    over the radius 1, and the force is in mu times the normal force at that radius.

    >>> round(float(friction([1.0, 1.0], [0.0, 0.75], 32)[1]), 3)  # Mindlin: 0.875
    0.875
    """
    contact, travel = _Contact(1, circles), np.diff(displacement, prepend=0.0)
    return np.array([contact.move(a, u)[0] for a, u in zip(radius, travel[:, None], strict=True)])


def _impacts(x, beta, zeta2, circles, steps):
    """Columns of `Separation` for impacts that are solved together."""
    radius, step = _contact_radius(steps)
    contact = _Contact(x.size, circles)
    force, impulse, last_sign, reversals, gross_slips, peak = np.zeros((6, x.size))
    started = False
    starts_in_slip, slipped = np.zeros((2, x.size), bool)
    kick = 1.25 * step  # F2max = (5/4) m2 v2(0)^2/d_max
    for edge in radius:
        impulse += kick / 2 * force
        force = contact.move(edge, (x - beta * impulse) / zeta2 * step)
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
    velocity = x - beta * impulse
    work = (x - velocity) * (x + velocity) / (2 * beta)  # what the body has lost
    regime = np.where(starts_in_slip, "SLIP_STICK_SLIP", "STICK_SLIP")
    regime = np.where(starts_in_slip & (gross_slips == 0), "SLIP_THROUGHOUT", regime)
    regime = np.where(gross_slips > 1, "MULTIPLE", regime)
    return velocity, np.minimum(peak, 1.0), work, regime, reversals.astype(int)


def _contact_radius(steps):
    """Radius at the instants between equal steps of a Hertz contact, and the step in time.

    With d^(5/2) = y, time is an incomplete beta function of y: t = (2/5) B(2/5, 1/2; y).
    """
    to_maximum = 0.4 * special.beta(0.4, 0.5)
    share = np.arange(1, steps) * (2 / steps)
    y = special.betaincinv(0.4, 0.5, np.minimum(share, 2 - share))
    return y**0.2, 2 * to_maximum / steps


class _Contact:
    """Tractions of many contacts that share their normal motion."""

    def __init__(self, contacts, circles):
        self._fixed = np.arange(1, circles + 1) / circles
        self._circles = np.ones(1)  # radii of the elliptic distributions, the edge last
        self._strength = np.zeros((1, contacts))  # of each distribution at its centre
        self.slip = np.zeros((0, contacts), dtype=np.int8)  # direction in each annulus, 0 stick

    def move(self, edge, travel):
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

    def _try(self, influence, goal, limit):
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
        raise ArithmeticError(
            f"no distribution of stick and slip over {annuli} annuli in {MOST_TRIALS} trials"
        )


def _displacement(radius, circles):
    """Surface displacement at each radius for unit elliptic traction over each circle.

    Johnson, Contact Mechanics, Eqs 3.42: inside a circle of radius a it is proportional to
    (2 a^2 - r^2)/a; outside it falls as written here. Shape (radii, circles).
    """
    ratio = radius[:, None] / circles
    beyond = np.maximum(ratio, 1.0)
    outer = (2 - beyond**2) * np.arcsin(1 / beyond) + np.sqrt(beyond**2 - 1)
    inner = np.pi / 2 * (2 - np.minimum(ratio, 1.0) ** 2)
    return 2 / 3 * circles * np.where(ratio < 1, inner, outer)
