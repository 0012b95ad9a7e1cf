"""The same impact without compliance: velocities against normal impulse (Stronge 1990).

The contact point slides until friction stops it, then sticks if friction can hold it, or slides
back. Tangential and normal velocity are piecewise linear in the normal impulse. Where the impulse
ends is a matter of the law of restitution:

- energetic (Stronge): the work of the normal force in restitution is e^2 of that in compression;
- kinematic (Newton): the normal velocity is -e times what it was;
- kinetic (Poisson): the impulse of restitution is e times that of compression.

They agree if the direction of slip does not change. If it does, only Newton's law may create
energy. Per unit of normal impulse the impact loses G = v2 + mu |v1| where it slides and G = v2
where it sticks. With a = 1/m1, b = 1/m2 and the direction g of slip, the slope of G is
-(b - 2 g mu c + mu^2 a) in slip and -(b - c^2/a) in stick. So G always falls, and never more
steeply after a halt than before: G is convex.

- Poisson's: G >= 0 at maximum compression, where v2 = 0. What restitution gives back is no more
  than e of the impulse that compression took, and by convexity no more than it lost:
  G(p + s) + G(p - s) >= 2 G(p) >= 0.
- Stronge's: the normal force gives back e^2 of the work it took, and friction dissipates.
- Newton's: restitution may take more impulse than compression did, and nothing makes up for the
  part of it where G < 0.
"""

from enum import StrEnum
from typing import NamedTuple

import numpy as np

from planarimpact.ground.arrays import Array, ArrayLike, Booleans
from planarimpact.ground.checks import InputError, default_errors
from planarimpact.noncollinear.configuration import InverseMass, checked_impact, refuse_overflow


class Law(StrEnum):
    """Law of restitution, by what its coefficient e is a ratio of.

    Examples
    --------
    >>> print(Law.ENERGETIC)
    energetic
    """

    ENERGETIC = "energetic"
    KINEMATIC = "kinematic"
    KINETIC = "kinetic"


class ImpulsiveRebound(NamedTuple):
    """The state at separation, one entry an impact; scalars where all arguments were scalars.

    Attributes
    ----------
    tangential, normal : ndarray of float64 or float
        Velocity of the contact point [m/s]; normal is negative or 0.
    tangential_impulse, normal_impulse : ndarray of float64 or float
        Of friction and normal force [N s].
    jams : ndarray of bool or bool
        Whether friction presses the body into the surface, more than the normal force holds it
        off, while it slides at first.
    """

    tangential: Array
    normal: Array
    tangential_impulse: Array
    normal_impulse: Array
    jams: Booleans


@default_errors
def rebound(
    tangential: ArrayLike,
    normal: ArrayLike,
    inverse_mass: InverseMass,
    friction: ArrayLike,
    restitution: ArrayLike = 1.0,
    law: Law | str = Law.ENERGETIC,
) -> ImpulsiveRebound:
    """State at separation; all arguments but `law` broadcast.

    Parameters
    ----------
    tangential, normal : array_like
        Velocity of the contact point before the impact [m/s]; normal > 0 is approach.
    inverse_mass : InverseMass
        Of one body or, combined, of two [1/kg].
    friction : array_like
        Coulomb's mu, from 0.
    restitution : array_like
        Coefficient e of the law, 0 to 1.
    law : Law or str
        "energetic", "kinematic" or "kinetic".

    Returns
    -------
    ImpulsiveRebound

    Raises
    ------
    InputError
        If an argument is not a finite real number in its range, if shapes do not broadcast, or
        if a result is beyond float64.

    Examples
    --------
    >>> from planarimpact.noncollinear import InverseMass
    >>> rod = InverseMass(2.5, 1.5, 2.5)
    >>> energetic = rebound(1.0, 1.0, rod, 0.5, 0.5)
    >>> newton = rebound(1.0, 1.0, rod, 0.5, 0.5, law="kinematic")
    >>> [round(float(result.normal), 3) for result in (energetic, newton)]
    [-0.5, -0.5]
    """
    if not isinstance(law, str) or law not in list(Law):
        raise InputError(f"law = {law!r}: allowed are {', '.join(Law)}")
    v1, v2, mu, e, a, c, b = checked_impact(tangential, normal, inverse_mass, friction, restitution)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore", under="ignore"):
        *fields, jams = _rebound(v1 / v2, mu, e, a / b, c / b, Law(law))
        units = v2, v2, v2 / b, v2 / b
        fields = [(field * unit)[()] for field, unit in zip(fields, units, strict=True)]
    refuse_overflow(ImpulsiveRebound._fields, fields)
    return ImpulsiveRebound._make([*fields, jams[()]])


def _rebound(
    v1: Array, mu: Array, e: Array, a: Array, c: Array, law: Law
) -> tuple[Array, Array, Array, Array, Booleans]:
    """The fields of the result for v2 = 1 and an inverse normal mass of 1."""
    # Rates of change with the normal impulse: of v1 and, times -1, of v2, sliding at first ...
    slides_back = np.abs(c) > mu * a
    direction = np.where(v1 != 0, np.sign(v1), np.where(slides_back, np.sign(c), 0.0))
    share = np.where(direction != 0, direction * mu, c / a)  # friction over normal force
    drift, first = c - share * a, 1 - share * c
    # ... and after it has come to rest at the impulse `halt`.
    later_share = np.where(slides_back, np.sign(c) * mu, c / a)
    later_drift, second = np.where(slides_back, c - later_share * a, 0.0), 1 - later_share * c
    slows = drift * v1 < 0
    halt = np.where(slows, -v1 / np.where(slows, drift, 1.0), np.inf)
    v2_halt = np.where(slows, 1 - first * np.where(slows, halt, 0.0), -np.inf)

    early = v2_halt > 0  # at rest before maximum compression
    compression = np.where(early, halt + v2_halt / second, 1 / first)
    work = np.where(
        early,
        halt * (1 + v2_halt) / 2 + v2_halt**2 / (2 * second),
        compression / 2,
    )
    # Sliding on through restitution as at first, or late: at rest within it.
    rate = np.where(early, second, first)
    until_halt = np.where(early, np.inf, halt - compression)
    if law is Law.KINETIC:
        end = e * compression
    elif law is Law.KINEMATIC:
        end = e / rate
        late = end > until_halt
        end = np.where(late, until_halt + (e - rate * until_halt) / second, end)
    else:
        end = e * np.sqrt(2 * work / rate)
        late = end > until_halt
        missing = e**2 * work - rate * until_halt**2 / 2
        speed = rate * until_halt
        rest = 2 * missing / (speed + np.sqrt(np.maximum(speed**2 + 2 * second * missing, 0)))
        end = np.where(late, until_halt + rest, end)
    total = compression + end
    before, after = np.minimum(total, halt), np.maximum(total - halt, 0.0)
    halted = total >= halt
    tangential = np.where(halted, later_drift * after, v1 + drift * before)
    normal = 1 - first * before - np.where(after > 0, second * after, 0.0)
    friction = share * before + np.where(after > 0, later_share * after, 0.0)
    return tangential, np.minimum(normal, 0.0), friction, total, first < 0
