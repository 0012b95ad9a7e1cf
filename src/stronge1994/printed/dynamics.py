"""Equations 1 to 9 and Table 1: effective masses, frequencies, normal motion, stick, slip."""

from collections.abc import Callable

import numpy as np

from planarimpact.common.arrays import Array, ArrayLike, Numbers


def eq_1_inverse_mass(mass: Numbers, gyration: Numbers, x1: Numbers, x2: Numbers) -> Array:
    """Eq. 1: inverse of the mass matrix of the contact point C at (x1, x2) from the centre.

    >>> eq_1_inverse_mass(1.0, 1.0, 0.5, 2.0).tolist()
    [[5.0, -1.0], [-1.0, 1.25]]
    """
    m1, m2 = eq_2_effective_masses(mass, gyration, x1, x2)
    coupling = -x1 * x2 / (mass * gyration**2)
    return np.array([[1 / m1, coupling], [coupling, 1 / m2]])


def eq_2_effective_masses(
    mass: Numbers, gyration: Numbers, x1: Numbers, x2: Numbers
) -> tuple[Numbers, Numbers]:
    """Eq. 2: m1 = M k^2/(k^2 + x2^2), m2 = M k^2/(k^2 + x1^2).

    >>> eq_2_effective_masses(1.0, 1.0, 0.0, 2.0)
    (0.2, 1.0)
    """
    k2 = gyration**2
    return mass * k2 / (k2 + x2**2), mass * k2 / (k2 + x1**2)


def eq_3_velocity_change(inverse_mass: Array, impulse: ArrayLike) -> Array:
    """Eq. 3: dv = m^-1 dp.

    >>> eq_3_velocity_change(np.diag([2.0, 3.0]), [1.0, 1.0]).tolist()
    [2.0, 3.0]
    """
    return inverse_mass @ np.asarray(impulse)


def eq_4_frequencies(
    m1: Numbers, m2: Numbers, stiffness: Numbers, stiffness_ratio: Numbers
) -> tuple[Array, Array]:
    """Eq. 4: Omega = sqrt(kappa/m2), omega = sqrt(kappa/(zeta^2 m1)); t_c = pi/(2 Omega).

    >>> [float(f) for f in eq_4_frequencies(1.0, 4.0, 1.0, 4.0)]
    [0.5, 0.5]
    """
    return np.sqrt(stiffness / m2), np.sqrt(stiffness / (stiffness_ratio * m1))


def eq_5_restitution(work_in_compression: Numbers, work_in_restitution: Numbers) -> Array:
    """Eq. 5: e from the works of the normal force, integrals of F2 v2 dt.

    >>> float(eq_5_restitution(-4.0, 1.0))
    0.5
    """
    return np.sqrt(-work_in_restitution / work_in_compression)


def eq_6a_normal_velocity(t: Numbers, v2: Numbers, normal_frequency: Numbers) -> Array:
    """Eq. 6a: v2(t) in compression.

    >>> float(eq_6a_normal_velocity(0.0, -1.0, 2.0))
    -1.0
    """
    return v2 * np.cos(normal_frequency * t)


def eq_6b_normal_velocity(
    t: Numbers, v2: Numbers, normal_frequency: Numbers, restitution: Numbers
) -> Array:
    """Eq. 6b: v2(t) in restitution.

    >>> float(eq_6b_normal_velocity(1.5 * np.pi / 2, -1.0, 1.0, 0.5))  # at separation
    0.5
    """
    return restitution * v2 * np.cos(restitution_angle(t, normal_frequency, restitution))


def restitution_angle(t: Numbers, normal_frequency: Numbers, restitution: Numbers) -> Numbers:
    """Argument of Table 1 in restitution, Omega t/e + (pi/2)(1 - 1/e): pi/2 to pi.

    >>> round(float(restitution_angle(1.5 * np.pi / 2, 1.0, 0.5) / np.pi), 12)
    1.0
    """
    return normal_frequency * t / restitution + np.pi / 2 * (1 - 1 / restitution)


def _halves(
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


def table_1_displacement(
    t: Numbers, v2: Numbers, normal_frequency: Numbers, restitution: Numbers
) -> Array:
    """Table 1: u2(t).

    >>> float(table_1_displacement(np.pi / 2, -1.0, 1.0, 0.5))
    -1.0
    """
    e2 = restitution**2
    scale = v2 / normal_frequency
    return scale * _halves(
        t, normal_frequency, restitution, np.sin, lambda angle: 1 - e2 + e2 * np.sin(angle)
    )


def table_1_velocity(
    t: Numbers, v2: Numbers, normal_frequency: Numbers, restitution: Numbers
) -> Array:
    """Table 1: v2(t), as Eqs 6a and 6b.

    >>> round(float(table_1_velocity(np.pi, -1.0, 1.0, 1.0)), 12)
    1.0
    """
    e = restitution
    return v2 * _halves(t, normal_frequency, e, np.cos, lambda angle: e * np.cos(angle))


def table_1_force(
    t: Numbers, v2: Numbers, m2: Numbers, normal_frequency: Numbers, restitution: Numbers
) -> Array:
    """Table 1: F2(t) > 0.

    >>> float(table_1_force(np.pi / 2, -1.0, 2.0, 1.0, 0.5))
    2.0
    """
    scale = -m2 * normal_frequency * v2
    return scale * _halves(t, normal_frequency, restitution, np.sin, np.sin)


def table_1_impulse(
    t: Numbers, v2: Numbers, m2: Numbers, normal_frequency: Numbers, restitution: Numbers
) -> Array:
    """Table 1: normal impulse p(t) >= 0.

    >>> round(float(table_1_impulse(1.5 * np.pi / 2, -1.0, 2.0, 1.0, 0.5)), 12)
    3.0
    """
    e = restitution
    scale = -m2 * v2
    return scale * _halves(
        t, normal_frequency, e, lambda a: 1 - np.cos(a), lambda a: 1 - e * np.cos(a)
    )


def eq_7a_deflection(
    elapsed: Numbers, u1: Numbers, v1: Numbers, tangential_frequency: Numbers
) -> Array:
    """Eq. 7a: u1 in stick, `elapsed` t - tau after it began with deflection u1, velocity v1.

    >>> float(eq_7a_deflection(0.0, 0.3, -1.0, 2.0))
    0.3
    """
    angle = tangential_frequency * elapsed
    return u1 * np.cos(angle) - v1 * np.sin(angle) / tangential_frequency


def eq_7b_velocity(
    elapsed: Numbers, u1: Numbers, v1: Numbers, tangential_frequency: Numbers
) -> Array:
    """Eq. 7b: v1 in stick.

    >>> float(eq_7b_velocity(0.0, 0.3, -1.0, 2.0))
    -1.0
    """
    angle = tangential_frequency * elapsed
    return tangential_frequency * u1 * np.sin(angle) + v1 * np.cos(angle)


def eq_7c_force(
    elapsed: Numbers, u1: Numbers, v1: Numbers, m1: Numbers, tangential_frequency: Numbers
) -> Array:
    """Eq. 7c: F1 in stick.

    >>> float(eq_7c_force(0.0, 0.5, -1.0, 1.0, 2.0))
    2.0
    """
    angle = tangential_frequency * elapsed
    pull = m1 * tangential_frequency
    return pull * (tangential_frequency * u1 * np.cos(angle) - v1 * np.sin(angle))


def eq_8_impulse(normal_impulse: Numbers, friction: Numbers, slip_direction: Numbers) -> Array:
    """Eq. 8: dp = (-mu s, 1) dp in slip.

    >>> eq_8_impulse(2.0, 0.25, -1).tolist()
    [0.5, 2.0]
    """
    return np.array([-friction * slip_direction * normal_impulse, normal_impulse])


def eq_9_velocity_slope(inverse_mass: Array, friction: Numbers, slip_direction: Numbers) -> Array:
    """Eq. 9: dv/dp = m^-1 (-mu s, 1) in slip.

    >>> eq_9_velocity_slope(np.diag([2.0, 1.0]), 0.25, 1).tolist()
    [-0.5, 1.0]
    """
    return inverse_mass @ np.array([-friction * slip_direction, 1.0])
