"""Equations 36 to 41: energy lost in the normal element and to friction."""

from collections.abc import Sequence

from planarimpact.common.arrays import Numbers


def kinetic_energy(
    mass: Numbers, gyration: Numbers, x2: Numbers, v1: Numbers, v2: Numbers, spin: Numbers
) -> Numbers:
    """Formula before Eq. 36 (p. 447): initial kinetic energy K0; spin is positive clockwise.

    With the factor 1/2 that the scan does not show.

    >>> kinetic_energy(2.0, 1.0, 0.0, 3.0, 4.0, 0.0)
    25.0
    """
    return mass / 2 * (v1**2 + v2**2 - 2 * x2 * v1 * spin + (x2**2 + gyration**2) * spin**2)


def eq_36_hysteresis(m2: Numbers, v2: Numbers, restitution: Numbers) -> Numbers:
    """Eq. 36: D2(tf), lost in the normal element.

    >>> eq_36_hysteresis(2.0, -1.0, 0.5)
    0.75
    """
    return (1 - restitution**2) * m2 * v2**2 / 2


def eq_37_hysteresis_share(restitution: Numbers) -> Numbers:
    """Eq. 37: the same over M v2(0)^2/2.

    >>> eq_37_hysteresis_share(0.5)
    0.75
    """
    return 1 - restitution**2


def eq_38_friction(
    v1_t1: Numbers, impulse_left: Numbers, friction: Numbers, m1: Numbers, sign: int
) -> Numbers:
    """Eq. 38: D1(tf) = -integral of F1 v1 dt over the last slip, with s = +1.

    F1 dt = -mu dp and v1 = v1(t1) + sign (mu/m1) [p - p(t1)]. Eqs 13 and 39 ask for sign = -1;
    the scan shows a plus.

    >>> eq_38_friction(1.0, 2.0, 0.5, 1.0, sign=-1)
    0.5
    """
    return friction * impulse_left * (v1_t1 + sign * friction / m1 * impulse_left / 2)


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


def footnote_theorem(v1_before: Numbers, v1_after: Numbers, impulse: Numbers) -> Numbers:
    """Footnote of p. 448: D1 of slip in one direction, -[v1(tb) + v1(ta)] [p1(tb) - p1(ta)]/2.

    With the minus that Eq. 36 asks for and the scan does not show.

    >>> footnote_theorem(-2.0, -1.0, 1.0)
    1.5
    """
    return -(v1_after + v1_before) * impulse / 2
