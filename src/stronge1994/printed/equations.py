"""Formulas of Stronge (1994) as printed that figures draw, with `impact`, or that entries share."""

from collections.abc import Callable, Sequence

import numpy as np

from planarimpact.common.arrays import Array, Numbers


def restitution_angle(t: Numbers, normal_frequency: Numbers, restitution: Numbers) -> Numbers:
    """Argument of Table 1 in restitution, Omega t/e + (pi/2)(1 - 1/e): pi/2 to pi.

    >>> round(float(restitution_angle(1.5 * np.pi / 2, 1.0, 0.5) / np.pi), 12)
    1.0
    """
    return normal_frequency * t / restitution + np.pi / 2 * (1 - 1 / restitution)


def halves(
    t: Numbers,
    normal_frequency: Numbers,
    restitution: Numbers,
    in_compression: Callable[[Numbers], Array],
    in_restitution: Callable[[Numbers], Array],
) -> Array:
    """Each half of Table 1 where it applies; `in_...` are functions of the angle."""
    angle = normal_frequency * np.asarray(t, dtype=float)
    if restitution == 0:
        return in_compression(angle)
    later = restitution_angle(np.asarray(t), normal_frequency, restitution)
    return np.where(angle <= np.pi / 2, in_compression(angle), in_restitution(later))


def table_1_force(
    t: Numbers, v2: Numbers, m2: Numbers, normal_frequency: Numbers, restitution: Numbers
) -> Array:
    """Table 1: F2(t) > 0.

    >>> float(table_1_force(np.pi / 2, -1.0, 2.0, 1.0, 0.5))
    2.0
    """
    scale = -m2 * normal_frequency * v2
    return scale * halves(t, normal_frequency, restitution, np.sin, np.sin)


def table_1_impulse(
    t: Numbers, v2: Numbers, m2: Numbers, normal_frequency: Numbers, restitution: Numbers
) -> Array:
    """Table 1: normal impulse p(t) >= 0.

    >>> round(float(table_1_impulse(1.5 * np.pi / 2, -1.0, 2.0, 1.0, 0.5)), 12)
    3.0
    """
    e = restitution
    scale = -m2 * v2
    return scale * halves(
        t, normal_frequency, e, lambda a: 1 - np.cos(a), lambda a: 1 - e * np.cos(a)
    )


def eq_7b_velocity(
    elapsed: Numbers, u1: Numbers, v1: Numbers, tangential_frequency: Numbers
) -> Array:
    """Eq. 7b: v1 in stick.

    >>> float(eq_7b_velocity(0.0, 0.3, -1.0, 2.0))
    -1.0
    """
    angle = tangential_frequency * elapsed
    return tangential_frequency * u1 * np.sin(angle) + v1 * np.cos(angle)


def eq_12_velocity_at_slip(v1: Numbers, tangential_frequency: Numbers, t1: Numbers) -> Array:
    """Eq. 12: v1(t1) where initial stick ends.

    >>> float(eq_12_velocity_at_slip(-2.0, 1.7, 0.0))
    -2.0
    """
    return v1 * np.cos(tangential_frequency * t1)


def impulse_ratio(t1: Numbers, normal_frequency: Numbers, restitution: Numbers) -> Array:
    """Formula after Eq. 14 (p. 441): g1, impulse left after t1 >= t_c over that of compression.

    >>> round(float(impulse_ratio(np.pi / 2, 1.0, 0.5)), 12)
    0.5
    """
    return restitution * (1 + np.cos(restitution_angle(t1, normal_frequency, restitution)))


def eq_15_rebound(v1_t1: Numbers, g1: Numbers, mass_ratio: Numbers) -> Numbers:
    """Eq. 15: v1(tf)/(mu v2(0)) after initial stick, from v1(t1)/(mu v2(0)), with s = +1.

    >>> eq_15_rebound(-1.0, 0.25, 4.0)
    0.0
    """
    return v1_t1 + mass_ratio * g1


def eq_19a_velocity(
    t2: Numbers,
    v1: Numbers,
    v2: Numbers,
    friction: Numbers,
    mass_ratio: Numbers,
    normal_frequency: Numbers,
) -> Array:
    """Eq. 19a: v1(t2) where stick begins in compression.

    >>> round(float(eq_19a_velocity(np.pi / 2, -3.0, -1.0, 0.5, 4.0, 1.0)), 12)
    -1.0
    """
    return v1 - friction * mass_ratio * v2 * (1 - np.cos(normal_frequency * t2))


def eq_19b_velocity(
    t2: Numbers,
    v1: Numbers,
    v2: Numbers,
    friction: Numbers,
    mass_ratio: Numbers,
    normal_frequency: Numbers,
    restitution: Numbers,
) -> Array:
    """Eq. 19b: v1(t2) where stick begins in restitution.

    >>> round(float(eq_19b_velocity(np.pi / 2, -3.0, -1.0, 0.5, 4.0, 1.0, 0.5)), 12)
    -1.0
    """
    angle = restitution_angle(t2, normal_frequency, restitution)
    return v1 - friction * mass_ratio * v2 * (1 - restitution * np.cos(angle))


def eq_25_rebound(
    v1_t3: Numbers, impulse_share: Numbers, mass_ratio: Numbers, restitution: Numbers
) -> Numbers:
    """Eq. 25: v1(tf)/(mu v2(0)), from v1(t3)/(mu v2(0)) and p(t3)/p(t_c), with s = +1.

    >>> eq_25_rebound(-1.0, 1.75, 4.0, 1.0)
    0.0
    """
    return v1_t3 + mass_ratio * (1 + restitution - impulse_share)


def eq_27_rebound(incidence: Numbers, mass_ratio: Numbers, restitution: Numbers) -> Numbers:
    """Eq. 27: v1(tf)/(mu v2(0)) after slip throughout.

    >>> eq_27_rebound(8.0, 3.5, 1.0)
    1.0
    """
    return incidence - mass_ratio * (1 + restitution)


def slip_throughout_limit(mass_ratio: Numbers, restitution: Numbers) -> Numbers:
    """Heading of Eq. 26 (p. 443): v1(0)/(mu v2(0)) above which slip never ends.

    >>> slip_throughout_limit(3.5, 1.0)
    7.0
    """
    return (1 + restitution) * mass_ratio


def eq_28_normal(slope: Numbers) -> Array:
    """Eq. 28: F2max/(m2 Omega S), from slope = v1(0)/v2(0).

    >>> float(eq_28_normal(0.75))
    0.8
    """
    return (1 + np.square(slope)) ** -0.5


def eq_32_start(
    angle: Numbers, incidence: Numbers, mass_ratio: Numbers, stiffness_ratio: Numbers
) -> tuple[Array, Array]:
    """Eq. 32: Omega u1(t2)/(mu v2(0)) and v1(t2)/(mu v2(0)), from angle = Omega t2.

    >>> [float(value) for value in eq_32_start(0.0, 2.0, 3.5, 1.21)]
    [0.0, 2.0]
    """
    return stiffness_ratio * np.sin(angle), incidence - mass_ratio * (1 - np.cos(angle))


def eq_33_friction(slope: Numbers, friction: Numbers) -> Array:
    """Eq. 33: F1max/(m2 Omega S) of slip throughout.

    >>> float(eq_33_friction(0.75, 0.5))
    0.4
    """
    return friction * eq_28_normal(slope)


def eq_39_friction(
    incidence: Numbers, swing: Numbers, g1: Numbers, mass_ratio: Numbers, friction: Numbers
) -> Numbers:
    """Eq. 39: 2 D1/(m2 v2(0)^2) after initial stick; `swing` is cos(omega t1).

    With the sign that Eqs 38, 12 and 14 give; the scan does not show it.

    >>> eq_39_friction(1.0, -0.5, 0.25, 2.0, 0.5)
    0.03125
    """
    return -2 * friction**2 * g1 * (incidence * swing + mass_ratio * g1 / 2)


def eq_40_friction(
    incidence: Numbers,
    v1_t2: Numbers,
    v1_t3: Numbers,
    final: Numbers,
    mass_ratio: Numbers,
    friction: Numbers,
    signs: Sequence[int] = (-1, 1, -1),
) -> Numbers:
    """Eq. 40: 2 D1/(m2 v2(0)^2) after slip, stick, slip; velocities over mu v2(0).

    `signs` stand before the squares of the second to fourth velocity; the scan does not show
    them, and Eq. 38 over both slips asks for -, +, -.

    >>> eq_40_friction(2.0, 1.0, 2.0, 1.0, 2.0, 1.0)
    3.0
    """
    later = (sign * v1**2 for sign, v1 in zip(signs, (v1_t2, v1_t3, final), strict=True))
    return friction**2 / mass_ratio * (incidence**2 + sum(later))


def eq_41_friction(
    incidence: Numbers, mass_ratio: Numbers, friction: Numbers, restitution: Numbers
) -> Numbers:
    """Eq. 41: 2 D1/(m2 v2(0)^2) of slip throughout.

    >>> eq_41_friction(8.0, 3.5, 1.0, 1.0)
    18.0
    """
    share = 1 + restitution
    return 2 * friction**2 * share * (incidence - share * mass_ratio / 2)
