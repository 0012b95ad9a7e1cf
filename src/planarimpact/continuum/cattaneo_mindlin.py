"""Closed forms of partial slip under a constant normal force (Cattaneo 1938, Mindlin 1949).

A Hertz contact is pushed sideways, back and forth, by less than it takes to slip as a whole. These
forms check `micro_slip` and `annuli`. An argument that is not finite or out of its range is an
`InputError`. Units: force mu times the normal force, radius that of the contact, displacement the
one at which the contact slips as a whole, zeta^2 mu times the approach.
"""

import numpy as np

from planarimpact.common import checks
from planarimpact.common.arrays import Array, ArrayLike


@checks.default_errors
def friction(displacement: ArrayLike) -> Array:
    """Tangential force of a contact that is pushed sideways for the first time.

    Parameters
    ----------
    displacement : array_like
        Any finite numbers; beyond 1 the contact slips as a whole. Odd in its argument.

    Returns
    -------
    ndarray of float64 or float
        1 - (1 - |u|)^(3/2) with the sign of u.

    Examples
    --------
    >>> float(friction(0.75))
    0.875
    """
    u = checks.checked("displacement", displacement, "finite numbers")
    return np.copysign(_loading(np.minimum(np.abs(u), 1.0)), u)[()]


@checks.default_errors
def unloading(displacement: ArrayLike, turned_at: ArrayLike) -> Array:
    """Tangential force on the way back (Mindlin & Deresiewicz 1953).

    Parameters
    ----------
    displacement : array_like
        At most `turned_at` and not beyond -`turned_at`, where the first loading is met again.
    turned_at : array_like
        Displacement of the first loading at which the motion turned round, 0 to 1.

    Returns
    -------
    ndarray of float64 or float

    Notes
    -----
    Slip starts again at the edge. The traction there must change its sign, that is by twice the
    limit of friction. So the force falls by 2 f(change/2), with f of `friction`.

    Examples
    --------
    >>> float(unloading(-0.75, 0.75))
    -0.875
    """
    u, top = checks.broadcast(
        displacement=checks.checked("displacement", displacement, "finite numbers"),
        turned_at=checks.checked("turned_at", turned_at, "numbers from 0 to 1", 0, 1),
    )
    beyond = np.abs(u) > top
    if beyond.any():
        raise checks.InputError(
            f"displacement = {u[beyond][0]}: allowed are numbers from -turned_at to turned_at, "
            f"{top[beyond][0]}"
        )
    return (_loading(top) - 2 * _loading((top - u) / 2))[()]


@checks.default_errors
def stick_radius(force: ArrayLike) -> Array:
    """Radius inside which the contact sticks, at a force of first loading.

    Parameters
    ----------
    force : array_like
        -1 to 1.

    Returns
    -------
    ndarray of float64 or float
        (1 - |T|)^(1/3).

    Examples
    --------
    >>> round(float(stick_radius(0.875)), 9)
    0.5
    """
    force = checks.checked("force", force, "numbers from -1 to 1", -1, 1)
    return np.cbrt(1 - np.abs(force))[()]


def _loading(displacement: Array) -> Array:
    """1 - (1 - u)^(3/2) without cancellation at small u."""
    with np.errstate(divide="ignore"):  # the logarithm of 0 where all of the contact slips
        return -np.expm1(1.5 * np.log1p(-displacement))
