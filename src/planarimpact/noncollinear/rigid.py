"""Non-collinear impact without compliance: velocities against normal impulse (Stronge 1990).

The contact point slides until friction stops it, then sticks if friction can hold it, or slides
back. Tangential and normal velocity are piecewise linear in the normal impulse. The law of
restitution gives the impulse at separation:

- energetic (Stronge): the work of the normal force in restitution is e^2 of that in compression;
- kinematic (Newton): the normal velocity is -e times what it was;
- kinetic (Poisson): the impulse of restitution is e times that of compression.

They agree if the direction of slip does not change. If it does, only Newton's law may create
energy. Per unit of normal impulse the impact loses G = v2 + mu |v1| where it slides and G = v2
where it sticks. With the direction g of slip, the slope of G is -(1/m2 - 2 g mu c + mu^2/m1) in
slip and -(1/m2 - c^2 m1) in stick. So G always falls, and never more steeply after a halt than
before: G is convex in the impulse J.

- Poisson's: G >= 0 at maximum compression, where v2 = 0. The impulse of restitution is at most e
  times that of compression. So the energy that restitution creates is, by convexity, at most the
  energy that compression lost: G(J + s) + G(J - s) >= 2 G(J) >= 0.
- Stronge's: the normal force returns e^2 of the work that it took, and friction dissipates.
- Newton's: the impulse of restitution may be larger than that of compression, and the energy that
  is created where G < 0 may be more than compression lost.

Symbols: v1, v2 tangential and normal velocity, 1/m1, c and 1/m2 the inverse mass, mu friction, e
restitution, beta = m2/m1, C = m2 c.
"""

from __future__ import annotations

from enum import StrEnum
from typing import NamedTuple

import numpy as np

from planarimpact.common import checks
from planarimpact.common.arrays import Array, ArrayLike, Booleans
from planarimpact.common.records import Members, record
from planarimpact.noncollinear.configuration import InverseMass, checked_impact


class Law(StrEnum, metaclass=Members):
    """Law of restitution, by what its coefficient e is a ratio of.

    Examples
    --------
    >>> print(Law.ENERGETIC)
    energetic
    """

    ENERGETIC = "energetic"
    KINEMATIC = "kinematic"
    KINETIC = "kinetic"


@record
class ImpulsiveRebound(NamedTuple):
    """The state at separation: fields of `NoncollinearRebound`.

    Only the first slip, before a halt, decides whether an impact jams.
    """

    tangential: Array
    normal: Array
    tangential_impulse: Array
    normal_impulse: Array
    jams: Booleans


@checks.default_errors
def rebound(
    tangential: ArrayLike,
    normal: ArrayLike,
    inverse_mass: InverseMass,
    friction: ArrayLike,
    restitution: ArrayLike = 1.0,
    law: Law | str = Law.ENERGETIC,
) -> ImpulsiveRebound:
    """State at separation; all arguments but `law` broadcast.

    `law` is a `Law` or its text, "energetic", "kinematic" or "kinetic"; the coefficient e of that
    law is 0 to 1. Refused is also a result beyond 1e100 in size. Other arguments and errors:
    `planarimpact.noncollinear`.

    Examples
    --------
    >>> from planarimpact.noncollinear import InverseMass
    >>> rod = InverseMass(2.5, 1.5, 2.5)
    >>> energetic = rebound(1.0, 1.0, rod, 0.5, 0.5)
    >>> newton = rebound(1.0, 1.0, rod, 0.5, 0.5, law="kinematic")
    >>> [round(float(result.normal), 3) for result in (energetic, newton)]
    [-0.5, -0.5]
    """
    law = Law(checks.word("law", law, list(Law)))
    v1, v2, mu, e, inverse_m1, c, inverse_m2 = checked_impact(
        tangential, normal, inverse_mass, friction, restitution
    )
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        beta, coupling = inverse_m1 / inverse_m2, c / inverse_m2
        *fields, jams = _rebound(v1 / v2, mu, e, beta, coupling, law)
        units = v2, v2, v2 / inverse_m2, v2 / inverse_m2
        fields = [(field * unit)[()] for field, unit in zip(fields, units, strict=True)]
    for name, field in zip(ImpulsiveRebound._fields, fields, strict=False):
        checks.in_range(name, field, 0.0)
    return ImpulsiveRebound._make([*fields, jams[()]])


def _rebound(
    v1: Array, mu: Array, e: Array, beta: Array, coupling: Array, law: Law
) -> tuple[Array, Array, Array, Array, Booleans]:
    """The fields of the result in units of v2 and m2."""
    # Rates of change with the normal impulse: `drift` of v1 and `slowing` of -v2. First while the
    # contact slides as at first ...
    slides_back = np.abs(coupling) > mu * beta
    direction = np.where(v1 != 0, np.sign(v1), np.where(slides_back, np.sign(coupling), 0.0))
    # Friction over normal force.
    first_share = np.where(direction != 0, direction * mu, coupling / beta)
    first_drift, first_slowing = coupling - first_share * beta, 1 - first_share * coupling
    # ... then after the halt of the contact point.
    later_share = np.where(slides_back, np.sign(coupling) * mu, coupling / beta)
    later_drift = np.where(slides_back, coupling - later_share * beta, 0.0)
    later_slowing = 1 - later_share * coupling
    # The halt: impulse and normal velocity.
    halts = first_drift * v1 < 0
    halt = np.where(halts, -v1 / np.where(halts, first_drift, 1.0), np.inf)
    v2_halt = np.where(halts, 1 - first_slowing * np.where(halts, halt, 0.0), -np.inf)
    halts_in_compression = v2_halt > 0

    # Impulse and work of compression.
    compression = np.where(halts_in_compression, halt + v2_halt / later_slowing, 1 / first_slowing)
    work = np.where(
        halts_in_compression,
        halt * (1 + v2_halt) / 2 + v2_halt**2 / (2 * later_slowing),
        compression / 2,
    )
    # Impulse of restitution, as if the contact point did not halt in it; then with the halt.
    slowing = np.where(halts_in_compression, later_slowing, first_slowing)
    until_halt = np.where(halts_in_compression, np.inf, halt - compression)
    if law is Law.KINETIC:
        returned = e * compression
    elif law is Law.KINEMATIC:
        returned = e / slowing
        with_halt = until_halt + (e - slowing * until_halt) / later_slowing
        returned = np.where(returned > until_halt, with_halt, returned)
    else:
        returned = e * np.sqrt(2 * work / slowing)
        work_after_halt = e**2 * work - slowing * until_halt**2 / 2
        speed = slowing * until_halt  # of separation at the halt
        root = np.sqrt(np.maximum(speed**2 + 2 * later_slowing * work_after_halt, 0))
        with_halt = until_halt + 2 * work_after_halt / (speed + root)
        returned = np.where(returned > until_halt, with_halt, returned)
    total = compression + returned
    before, after = np.minimum(total, halt), np.maximum(total - halt, 0.0)
    tangential = np.where(total >= halt, later_drift * after, v1 + first_drift * before)
    normal = 1 - first_slowing * before - np.where(after > 0, later_slowing * after, 0.0)
    friction = first_share * before + np.where(after > 0, later_share * after, 0.0)
    return tangential, np.minimum(normal, 0.0), friction, total, first_slowing < 0
