"""Closed forms of partial slip under a constant normal force (Cattaneo 1938, Mindlin 1949).

A Hertz contact is pushed sideways, back and forth, by less than it takes to slip as a whole. Units:
force mu times the normal force, radius that of the contact, displacement the one at which the
contact slips as a whole, zeta^2 mu times the approach.
"""

import numpy as np


def friction(displacement):
    """Tangential force of a contact that is pushed sideways for the first time.

    1 - (1 - |u|)^(3/2) with the sign of u; beyond |u| = 1 the contact slips as a whole.

    >>> float(friction(0.75))
    0.875
    """
    return np.copysign(_loading(np.minimum(np.abs(displacement), 1.0)), displacement)


def unloading(displacement, turned_at):
    """Tangential force on the way back from the displacement `turned_at`, up to its negative.

    Slip starts again at the edge. The traction there must change its sign, that is by twice the
    limit of friction. So the force falls by 2 f(change/2), with f of `friction` (Mindlin &
    Deresiewicz 1953).

    >>> float(unloading(-0.75, 0.75))
    -0.875
    """
    return _loading(turned_at) - 2 * _loading((turned_at - displacement) / 2)


def stick_radius(force):
    """Radius inside which the contact sticks at a force of first loading: (1 - |T|)^(1/3).

    >>> round(float(stick_radius(0.875)), 9)
    0.5
    """
    return np.cbrt(1 - np.abs(force))


def _loading(displacement):
    """1 - (1 - u)^(3/2) without cancellation at small u."""
    with np.errstate(divide="ignore"):  # the logarithm of 0 where all of the contact slips
        return -np.expm1(1.5 * np.log1p(-displacement))
