"""Laws of impulses: velocity at separation without a history of the contact.

Each law gives the tangential impulse as a function of the incidence alone. Above one incidence it
is the line of slip throughout, as in every model; below that it is an assumption. The tangential
stiffness is no argument of these laws, so they miss the shape of the curve below that line. They
do not describe what happens during contact: there is no peak friction and no order of stick and
slip, except in slip throughout.

`of_velocity` makes a law of a velocity of your own.

Arguments and errors: `incidence`, `mass_ratio`, `stiffness_ratio` and `restitution` are those of
`planarimpact.lumped.rebound`, and `InputError` says what it refuses. The answer is a `Rebound`. In
slip throughout its regime is SLIP_THROUGHOUT and its peak_friction 1: friction is mu times the
normal force at every instant. Below, peak_friction is NaN and regime UNRESOLVED; STICK for x = 0.

Units as in `planarimpact.lumped`. Symbols: x incidence, w velocity at separation, e restitution,
b tangential restitution; B = (1 + e) beta, the change of velocity in slip throughout.
"""

from __future__ import annotations

import functools
import sys
from collections.abc import Callable
from typing import Any

import numpy as np

from planarimpact.common import checks, sliding
from planarimpact.common.arrays import Array, ArrayLike, Booleans
from planarimpact.common.results import Rebound, Regime, of_groups

# Least squares of velocity against `planarimpact.continuum.rebound` at beta = 3.5, zeta^2 = 17/14
# (Poisson's ratio 0.3), x = 0, 0.05 ... 8, among numbers from 0 to 1, rounded to two digits.
BRACH_TANGENTIAL_RESTITUTION = 0.40


@of_groups
def brach(
    incidence: ArrayLike,
    mass_ratio: ArrayLike = 3.5,
    stiffness_ratio: ArrayLike = 1.21,
    restitution: ArrayLike = 1.0,
    *,
    tangential_restitution: float = BRACH_TANGENTIAL_RESTITUTION,
) -> Rebound:
    """Two straight lines: w = -b x up to x = B/(1 + b), and slip throughout from there on.

    `tangential_restitution`, one number b from 0 to 1, is the share of the tangential velocity
    that comes back, reversed. The default is the best for solid elastic spheres of Poisson's ratio
    0.3. Other arguments and errors: `planarimpact.models.laws`.

    References
    ----------
    R. M. Brach, Rigid body collisions, J. Appl. Mech. 56 (1989) 133-138. O. R. Walton, in:
    M. C. Roco (ed.), Particulate Two-Phase Flow, Butterworth-Heinemann 1993, 884-911.

    Examples
    --------
    >>> [float(w) for w in brach([1.0, 8.0], tangential_restitution=0.5).velocity]
    [-0.5, 1.0]
    """
    b = checks.number("tangential_restitution", tangential_restitution, "numbers from 0 to 1", 0, 1)
    signed, beta, _, e = checks.impact(incidence, mass_ratio, stiffness_ratio, restitution)
    x, beta, e = (a.reshape(-1) for a in (np.abs(signed), beta, e))
    change = sliding.change(beta, e)
    slides = x >= change / (1 + b)
    velocity = np.where(slides, x - change, -b * x)
    return _rebound(signed, velocity, beta, e, slides)


@of_groups
def smith(
    incidence: ArrayLike,
    mass_ratio: ArrayLike = 3.5,
    stiffness_ratio: ArrayLike = 1.21,
    restitution: ArrayLike = 1.0,
) -> Rebound:
    """Friction by a mean direction of slip, weighted by the speed before and after.

    It slides throughout from x = B on; below, the velocity is negative. Arguments and errors:
    `planarimpact.models.laws`.

    Notes
    -----
    The impulse of friction is (1 + e)(x |x| + w |w|)/(x^2 + w^2), in mu m2 |v2(0)|. With
    w = -u x < 0 and s = x/B this becomes s (1 + u^2) = 1 - u, whose positive root is
    u = 2 (1 - s)/(1 + sqrt(1 + 4 s - 4 s^2)). Near normal incidence, s -> 0, nothing is
    lost: u = 1.

    References
    ----------
    C. E. Smith, Predicting rebounds using rigid-body dynamics, J. Appl. Mech. 58 (1991) 754-758.

    Examples
    --------
    >>> [round(float(w), 4) for w in smith([1.0, 8.0]).velocity]
    [-0.772, 1.0]
    """
    signed, beta, _, e = checks.impact(incidence, mass_ratio, stiffness_ratio, restitution)
    x, beta, e = (a.reshape(-1) for a in (np.abs(signed), beta, e))
    change = sliding.change(beta, e)
    slides = x >= change
    s = np.minimum(x / change, 1.0)
    u = 2 * (1 - s) / (1 + np.sqrt(1 + 4 * s * (1 - s)))
    velocity = np.where(slides, x - change, -u * x)
    return _rebound(signed, velocity, beta, e, slides)


class of_velocity:  # in small letters, as users call it, or decorate with it, like a function
    """Make a law of impulses of a function that gives only the velocity at separation.

    Parameters
    ----------
    velocity : callable
        A function of incidence, mass ratio, stiffness ratio and restitution, by position, and of
        settings by name. It gets arrays of one shape, (n,), and only incidences from 0 on. It
        returns w(tf) = v1(tf)/(mu v2(0)) of each impact, negative where the contact point has
        turned round.

    Returns
    -------
    callable
        A function `rebound` with the arguments of every model, which gives a `Rebound`. It answers
        negative incidences by symmetry. The dissipation follows from the velocity; peak_friction
        is NaN. The contact slides throughout where the velocity is x - (1 + e) m2/m1.

    Raises
    ------
    InputError
        When `rebound` is called and the function gives another number of velocities.

    Examples
    --------
    It may be used as a decorator.

    >>> @of_velocity
    ... def never_turns(x, mass_ratio, stiffness_ratio, restitution):
    ...     return np.maximum(x - (1 + restitution) * mass_ratio, 0.0)
    >>> never_turns([-2.0, 9.0]).velocity.tolist(), never_turns(9.0).regime.name
    ([-0.0, 2.0], 'SLIP_THROUGHOUT')
    """

    def __init__(self, velocity: Callable[..., ArrayLike]) -> None:
        functools.update_wrapper(self, velocity)
        self._velocity = velocity

    def __reduce__(self) -> str | tuple[Any, ...]:
        """Pickle it by its name if it is a decorated function, else by its velocity."""
        name = getattr(self, "__qualname__", "")
        decorated = getattr(sys.modules.get(self.__module__), name, None) is self
        return name if decorated else (of_velocity, (self._velocity,))

    @checks.default_errors
    def __call__(
        self,
        incidence: ArrayLike,
        mass_ratio: ArrayLike = 3.5,
        stiffness_ratio: ArrayLike = 1.21,
        restitution: ArrayLike = 1.0,
        **settings: float,
    ) -> Rebound[Any, Any, Any]:
        """State at separation by the velocity."""
        groups = checks.impact(incidence, mass_ratio, stiffness_ratio, restitution)
        signed, (x, beta, zeta2, e) = groups[0], (np.abs(a).reshape(-1) for a in groups)
        found = np.asarray(self._velocity(x, beta, zeta2, e, **settings), float)
        if found.shape != x.shape:
            raise checks.InputError(
                f"velocities, shape {found.shape}: allowed is that of the incidences, {x.shape}"
            )
        slides = np.isclose(found, sliding.velocity(x, beta, e), rtol=1e-12, atol=1e-12)
        result = _rebound(signed, found, beta, e, slides)
        return result._replace(peak_friction=np.full(signed.shape, np.nan)[()])


def _rebound(signed: Array, velocity: Array, beta: Array, e: Array, slides: Booleans) -> Rebound:
    """Rebound of a law from its velocity for |x|, and from where it slides throughout."""
    x = np.abs(signed).reshape(-1)
    # The difference of velocities would have few digits in slip throughout at large x.
    impulse = np.where(slides, 1 + e, (x / beta - velocity / beta))
    peak = np.where(slides, 1.0, np.nan)
    other_regime = np.where(x > 0, Regime.UNRESOLVED, Regime.STICK)
    regime = np.where(slides, Regime.SLIP_THROUGHOUT, other_regime).astype(np.uint8)
    return Rebound.of(signed, velocity, impulse, peak, regime)
