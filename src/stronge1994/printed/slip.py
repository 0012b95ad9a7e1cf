"""Equations 10 to 27: when stick and slip begin, and the tangential velocity at separation."""

import numpy as np

from planarimpact.common.arrays import Array, Numbers
from stronge1994.printed.dynamics import eq_7b_velocity, eq_7c_force, restitution_angle


def eq_10a_force_ratio(
    t1: Numbers,
    incidence: Numbers,
    stiffness_ratio: Numbers,
    normal_frequency: Numbers,
    tangential_frequency: Numbers,
) -> Array:
    """Eq. 10a: |F1|/(mu F2) of initial stick in compression; stick ends where it reaches 1.

    >>> round(float(eq_10a_force_ratio(1e-9, 1.21, 1.21, 1.0, 1.7)), 9)
    1.0
    """
    swing = normal_frequency / tangential_frequency * np.sin(tangential_frequency * t1)
    normal = np.sin(normal_frequency * t1)
    return np.abs(incidence * swing / (stiffness_ratio * normal))


def eq_10b_force_ratio(
    t1: Numbers,
    incidence: Numbers,
    stiffness_ratio: Numbers,
    normal_frequency: Numbers,
    tangential_frequency: Numbers,
    restitution: Numbers,
) -> Array:
    """Eq. 10b: |F1|/(mu F2) of initial stick in restitution.

    >>> round(float(eq_10b_force_ratio(np.pi / 2, 1.0, 1.0, 1.0, 1.0, 0.5)), 12)
    1.0
    """
    swing = normal_frequency / tangential_frequency * np.sin(tangential_frequency * t1)
    normal = np.sin(restitution_angle(t1, normal_frequency, restitution))
    return np.abs(incidence * swing / (stiffness_ratio * normal))


def eq_11_stick_limit(friction: Numbers, stiffness_ratio: Numbers) -> Numbers:
    """Eq. 11: v1(0)/v2(0) below which the contact sticks at first.

    >>> eq_11_stick_limit(0.5, 1.5)
    0.75
    """
    return friction * stiffness_ratio


def eq_12_velocity_at_slip(v1: Numbers, tangential_frequency: Numbers, t1: Numbers) -> Array:
    """Eq. 12: v1(t1) where initial stick ends.

    >>> float(eq_12_velocity_at_slip(-2.0, 1.7, 0.0))
    -2.0
    """
    return v1 * np.cos(tangential_frequency * t1)


def eq_13_final_velocity(
    v1_t1: Numbers, slip_direction: Numbers, impulse_left: Numbers, friction: Numbers, m1: Numbers
) -> Numbers:
    """Eq. 13: v1(tf) after slip in one direction; `impulse_left` is p(tf) - p(t1).

    >>> eq_13_final_velocity(1.0, 1, 2.0, 0.25, 1.0)
    0.5
    """
    return v1_t1 - friction * slip_direction / m1 * impulse_left


def impulse_ratio(t1: Numbers, normal_frequency: Numbers, restitution: Numbers) -> Array:
    """Formula after Eq. 14 (p. 441): g1, impulse left after t1 >= t_c over that of compression.

    >>> round(float(impulse_ratio(np.pi / 2, 1.0, 0.5)), 12)
    0.5
    """
    return restitution * (1 + np.cos(restitution_angle(t1, normal_frequency, restitution)))


def eq_14_impulse_left(g1: Numbers, m2: Numbers, v2: Numbers) -> Numbers:
    """Eq. 14: p(tf) - p(t1) = -g1 m2 v2(0).

    >>> eq_14_impulse_left(0.5, 2.0, -1.0)
    1.0
    """
    return -g1 * m2 * v2


def eq_15_rebound(v1_t1: Numbers, g1: Numbers, mass_ratio: Numbers) -> Numbers:
    """Eq. 15: v1(tf)/(mu v2(0)) after initial stick, from v1(t1)/(mu v2(0)), with s = +1.

    >>> eq_15_rebound(-1.0, 0.25, 4.0)
    0.0
    """
    return v1_t1 + mass_ratio * g1


def eq_16_velocity_in_slip(
    v1: Numbers, slip_direction: Numbers, impulse: Numbers, friction: Numbers, m1: Numbers
) -> Numbers:
    """Eq. 16: v1(t) in the first slip, after the impulse p(t).

    >>> eq_16_velocity_in_slip(-1.0, -1, 2.0, 0.25, 1.0)
    -0.5
    """
    return v1 - friction * slip_direction * impulse / m1


def eq_17_excess_rate(force_1_rate: Numbers, force_2_rate: Numbers, friction: Numbers) -> Numbers:
    """Eq. 17: dF1/dt - mu dF2/dt, which vanishes where stick begins.

    >>> eq_17_excess_rate(1.0, 2.0, 0.5)
    0.0
    """
    return force_1_rate - friction * force_2_rate


def stick_force_rate(
    elapsed: Numbers, u1_t2: Numbers, v1_t2: Numbers, m1: Numbers, tangential_frequency: Numbers
) -> Array:
    """Formula after Eq. 17 (p. 442): dF1/dt in stick, `elapsed` t - t2.

    >>> float(stick_force_rate(0.0, 0.0, -1.0, 2.0, 3.0))
    18.0
    """
    turned = eq_7b_velocity(elapsed, u1_t2, v1_t2, tangential_frequency)
    return -m1 * tangential_frequency**2 * turned


def eq_18a_deflection(
    t2: Numbers,
    v2: Numbers,
    friction: Numbers,
    m1: Numbers,
    m2: Numbers,
    normal_frequency: Numbers,
    tangential_frequency: Numbers,
) -> Array:
    """Eq. 18a: u1(t2) where stick begins in compression.

    The scan does not show the sign; this is the one that F1 = (kappa/zeta^2) u1 asks for.

    >>> float(eq_18a_deflection(np.pi / 2, -1.0, 0.5, 1.0, 2.0, 1.0, 2.0))
    0.25
    """
    scale = m2 * normal_frequency * v2 / (m1 * tangential_frequency**2)
    return -friction * scale * np.sin(normal_frequency * t2)


def eq_18b_deflection(
    t2: Numbers,
    v2: Numbers,
    friction: Numbers,
    m1: Numbers,
    m2: Numbers,
    normal_frequency: Numbers,
    tangential_frequency: Numbers,
    restitution: Numbers,
) -> Array:
    """Eq. 18b: u1(t2) where stick begins in restitution; sign as in Eq. 18a.

    >>> float(eq_18b_deflection(np.pi / 2, -1.0, 0.5, 1.0, 2.0, 1.0, 2.0, 0.5))
    0.25
    """
    scale = m2 * normal_frequency * v2 / (m1 * tangential_frequency**2)
    return -friction * scale * np.sin(restitution_angle(t2, normal_frequency, restitution))


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


def eq_20_normal_force_rate(
    t: Numbers, v2: Numbers, m2: Numbers, normal_frequency: Numbers, restitution: Numbers
) -> Array:
    """Eq. 20: dF2/dt, in compression up to t_c and in restitution beyond.

    >>> float(eq_20_normal_force_rate(0.0, -1.0, 2.0, 1.0, 0.5))
    2.0
    """
    angle = normal_frequency * np.asarray(t, dtype=float)
    scale = -m2 * normal_frequency**2 * v2
    later = np.cos(restitution_angle(t, normal_frequency, restitution)) / restitution
    return scale * np.where(angle <= np.pi / 2, np.cos(angle), later)


def eq_21_incidence(
    t2: Numbers,
    mass_ratio: Numbers,
    stiffness_ratio: Numbers,
    normal_frequency: Numbers,
    restitution: Numbers,
) -> Array:
    """Eq. 21: the incidence v1(0)/(mu v2(0)) whose first slip ends at t2.

    The scan has lost the factors e of restitution. They are read as Eqs 17 to 20 ask for.

    >>> round(float(eq_21_incidence(np.pi / 2, 3.5, 1.21, 1.0, 1.0)), 12)
    3.5
    """
    angle = normal_frequency * np.asarray(t2, dtype=float)
    late = angle > np.pi / 2
    e = np.where(late, restitution, 1.0)
    cosine = np.cos(np.where(late, restitution_angle(t2, normal_frequency, restitution), angle))
    return mass_ratio * (1 - e * cosine) + stiffness_ratio / e * cosine


def eq_22a_velocity(
    elapsed: Numbers, u1_t2: Numbers, v1_t2: Numbers, tangential_frequency: Numbers
) -> Array:
    """Eq. 22a: v1 in the stick that begins at t2, Eq. 7b from there; `elapsed` is t - t2.

    >>> float(eq_22a_velocity(0.0, 0.3, -1.0, 2.0))
    -1.0
    """
    return eq_7b_velocity(elapsed, u1_t2, v1_t2, tangential_frequency)


def eq_22b_force(
    elapsed: Numbers, u1_t2: Numbers, v1_t2: Numbers, m1: Numbers, tangential_frequency: Numbers
) -> Array:
    """Eq. 22b: F1 in the stick that begins at t2, Eq. 7c from there.

    >>> float(eq_22b_force(0.0, 0.5, -1.0, 1.0, 2.0))
    2.0
    """
    return eq_7c_force(elapsed, u1_t2, v1_t2, m1, tangential_frequency)


def eq_23_sides(
    t3: Numbers,
    t2: Numbers,
    u1_t2: Numbers,
    v1_t2: Numbers,
    v2: Numbers,
    friction: Numbers,
    stiffness_ratio: Numbers,
    normal_frequency: Numbers,
    tangential_frequency: Numbers,
    restitution: Numbers,
) -> tuple[Array, Array]:
    """Eq. 23: its two sides at t3, where the second slip begins; equal for slip with s = +1.

    >>> left, right = eq_23_sides(np.pi / 2, 0.0, 0.0, 1.0, -1.0, 0.5, 1.21, 1.0, 1.0, 1.0)
    >>> round(float(left), 12), round(float(right), 12)
    (2.0, 1.21)
    """
    angle = tangential_frequency * (t3 - t2)
    stretch = normal_frequency * u1_t2 / (friction * v2) * np.cos(angle)
    swing = normal_frequency * v1_t2 / (tangential_frequency * friction * v2) * np.sin(angle)
    normal = np.sin(restitution_angle(t3, normal_frequency, restitution))
    return stretch - swing, stiffness_ratio * normal


def eq_24_final_velocity(
    v1_t3: Numbers, impulse_left: Numbers, friction: Numbers, m1: Numbers
) -> Numbers:
    """Eq. 24: v1(tf) after the second slip, with s = +1; `impulse_left` is p(tf) - p(t3).

    >>> eq_24_final_velocity(1.0, 2.0, 0.25, 1.0)
    0.5
    """
    return v1_t3 - friction / m1 * impulse_left


def eq_25_rebound(
    v1_t3: Numbers, impulse_share: Numbers, mass_ratio: Numbers, restitution: Numbers
) -> Numbers:
    """Eq. 25: v1(tf)/(mu v2(0)), from v1(t3)/(mu v2(0)) and p(t3)/p(t_c), with s = +1.

    >>> eq_25_rebound(-1.0, 1.75, 4.0, 1.0)
    0.0
    """
    return v1_t3 + mass_ratio * (1 + restitution - impulse_share)


def eq_26_final_velocity(
    v1: Numbers, compression_impulse: Numbers, friction: Numbers, m1: Numbers, restitution: Numbers
) -> Numbers:
    """Eq. 26: v1(tf) after slip throughout; `compression_impulse` is p(t_c).

    >>> eq_26_final_velocity(-3.0, 2.0, 0.5, 1.0, 1.0)
    -1.0
    """
    return v1 + friction / m1 * (1 + restitution) * compression_impulse


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
