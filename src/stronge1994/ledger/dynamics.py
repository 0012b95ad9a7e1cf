"""Checks of Eqs 1 to 9 and Table 1, and of what pp. 435 to 440 say of them."""

import numpy as np

from planarimpact import bodies, lumped, noncollinear
from planarimpact.common.arrays import Array, ArrayLike
from planarimpact.common.results import EventKind
from stronge1994.ledger import contact
from stronge1994.ledger.contact import Contact, NormalMotion
from stronge1994.ledger.finding import Gaps, corrected_over, largest, over
from stronge1994.printed import dynamics

# A plate struck away from its normal: mass, radius of gyration, and C from the centre. And one
# struck along it.
PLATE = {"mass": 2.3, "gyration": 0.7, "x1": 0.4, "x2": -0.9}
COLLINEAR = PLATE | {"x1": 0.0}
BODY = bodies.Body(2.3, 0.7, 0.9)


def _change_of_velocity(
    impulse: Array, mass: float, gyration: float, x1: float, x2: float
) -> Array:
    """Change of velocity of C of a free rigid body, from the balances of momentum and spin."""
    spin = (x1 * impulse[1] - x2 * impulse[0]) / (mass * gyration**2)
    return np.array([impulse[0] / mass - spin * x2, impulse[1] / mass + spin * x1])


def inverse_mass() -> float:
    """Eq. 1 against the response of a free rigid body to unit impulses, and `bodies`."""
    columns = [_change_of_velocity(unit, **PLATE) for unit in np.eye(2)]
    free = dynamics.eq_1_inverse_mass(**PLATE) - np.array(columns).T
    collinear = np.diag(dynamics.eq_1_inverse_mass(**COLLINEAR)) * bodies.effective_masses(BODY)
    return largest([free, collinear - 1])


def effective_masses() -> float:
    """Eq. 2 against `bodies` for a collinear impact, and against a free rigid body."""
    masses = np.array(dynamics.eq_2_effective_masses(**COLLINEAR))
    response = [_change_of_velocity(unit, **PLATE)[i] for i, unit in enumerate(np.eye(2))]
    free = np.array(dynamics.eq_2_effective_masses(**PLATE)) * response
    return largest([masses / bodies.effective_masses(BODY) - 1, free - 1])


@over(contact.of_sphere(0.7, 2.0, 4.5, 9.0, restitution=0.6))
def velocity_change(impact: Contact) -> Gaps:
    """Eq. 3 against a free rigid body; along contacts $m_1 dv_1$ is the impulse of friction."""
    impulse = np.array([0.3, 1.1])
    inverse = dynamics.eq_1_inverse_mass(**PLATE)
    yield dynamics.eq_3_velocity_change(inverse, impulse) - _change_of_velocity(impulse, **PLATE)
    of_friction = impact.integral(impact.path.force_1)
    change = dynamics.eq_3_velocity_change(np.array([[1 / impact.m1]]), [of_friction])[0]
    yield (impact.v1 + change - impact.path.v1) / impact.velocity_scale


def off_diagonal() -> float:
    """The coupling of Eq. 1 over its diagonal for $x_1 = 0$."""
    inverse = dynamics.eq_1_inverse_mass(**COLLINEAR)
    ratio = inverse[0, 0] / inverse[1, 1] / float(bodies.mass_ratio(BODY))
    return largest([inverse[0, 1], ratio - 1])


@over(lambda: [Contact(zeta2 / 2, beta, zeta2, samples=2001) for beta, zeta2 in contact.PAIRS])
def frequencies(impact: Contact) -> Gaps:
    r"""Eq. 4: compression takes up the normal momentum in $t_c$; stick swings with $\omega$."""
    normal, tangential = impact.printed(dynamics.eq_4_frequencies)
    top = impact.top
    impulse = impact.integral(impact.path.force_2)[impact.path.t == top.t]
    yield impulse / impact.compression_impulse - 1
    yield top.t * normal / (np.pi / 2) - 1
    yield top.v1 / impact.v1 - np.cos(tangential * top.t)


@over(contact.normal_motions)
def restitution(motion: NormalMotion) -> Gaps:
    """Eq. 5: works of the normal force along exact contacts give $e$ back."""
    absorbed = motion.work[motion.at_top]
    e = dynamics.eq_5_restitution(absorbed, motion.work[-1] - absorbed)
    yield e - motion.restitution


@over(contact.normal_motions)
def table_1(motion: NormalMotion) -> Gaps:
    """All rows of Table 1, and Eqs 6a and 6b, against the exact normal force and its integrals."""
    t = motion.path.t
    force = motion.printed(dynamics.table_1_force, t=t)
    early = motion.printed(dynamics.eq_6a_normal_velocity, t=t)
    late = motion.printed(dynamics.eq_6b_normal_velocity, t=t)
    displacement = motion.printed(dynamics.table_1_displacement, t=t)
    yield (force - motion.path.force_2) / motion.force_scale
    yield (motion.impulse(t) - motion.brought) / motion.compression_impulse
    yield (motion.printed(dynamics.table_1_velocity, t=t) - motion.velocity) / motion.v2
    yield (np.where(t <= motion.compression_time, early, late) - motion.velocity) / motion.v2
    yield (displacement - motion.displacement) * motion.normal_frequency / motion.v2


@over(contact.normal_motions)
def final_indentation(motion: NormalMotion) -> Gaps:
    """$u_2(t_f)$ over $u_2(t_c)$ by quadrature of the exact force, against $1 - e^2$."""
    left = motion.displacement[-1] / motion.displacement[motion.at_top]
    yield left - (1 - motion.restitution**2)


@over(contact.normal_motions)
def stored_work(motion: NormalMotion) -> Gaps:
    r"""Work at $t_c$ over $F_2(t_c) u_2(t_c)/2$, slope of unloading over $\kappa/e^2$, less 1."""
    force, depth = motion.top.force_2, motion.displacement
    yield motion.work[motion.at_top] / (force * depth[motion.at_top] / 2) - 1
    unloading = force / (depth[-1] - depth[motion.at_top])
    yield unloading / (motion.stiffness / motion.restitution**2) - 1


@over(contact.normal_motions)
def velocity_continuous(motion: NormalMotion) -> Gaps:
    """Eqs 6a and 6b at $t_c$, over $v_2(0)$, and the momentum brought till then."""
    for formula in (dynamics.eq_6a_normal_velocity, dynamics.eq_6b_normal_velocity):
        yield motion.printed(formula, t=motion.compression_time) / motion.v2
    yield motion.velocity[motion.at_top] / motion.v2


@corrected_over(lambda: contact.normal_motions((0.3, 0.6, 0.9)))
def hysteresis_caption(motion: NormalMotion) -> tuple[ArrayLike, float]:
    """Share of the absorbed energy that is lost, less the ratio of areas, $e^2$ (Fig. 2)."""
    lost, kept = motion.work[-1] / motion.work[motion.at_top], motion.restitution**2
    return lost - kept, lost - (1 - kept)


@over(lambda: contact.RESTITUTIONS)
def normal_independence(e: float) -> Gaps:
    """Difference that incidence and stiffness ratio make to the exact normal force."""
    base = lumped.history(0.7, restitution=e)
    for x, zeta2 in ((2.0, 1.21), (8.0, 1.21), (2.0, 0.3)):
        other = lumped.history(x, contact.MASS_RATIO, zeta2, e)
        _, ours, theirs = np.intersect1d(base.time, other.time, return_indices=True)
        yield other.normal[theirs] - base.normal[ours]


@over(contact.with_stick)
def stick(impact: Contact) -> Gaps:
    """Eqs 7a to 7c along the first stick of exact contacts."""
    path, omega = impact.between(impact.t2, impact.t3), impact.tangential_frequency
    initial = {"elapsed": path.t - impact.t2, "u1": impact.u1_t2, "v1": impact.v1_t2}
    u1 = impact.printed(dynamics.eq_7a_deflection, **initial)
    v1 = impact.printed(dynamics.eq_7b_velocity, **initial)
    force = impact.printed(dynamics.eq_7c_force, **initial)
    yield (u1 - path.u1) * omega / impact.velocity_scale
    yield (v1 - path.v1) / impact.velocity_scale
    yield (force - path.force_1) / impact.friction_scale


def noncollinear_stick() -> float:
    """Part of the second derivative of $F_2$ that no single frequency explains, root mean square.

    Over compression of a slender rod that sticks with its tip, $v_1/v_2 = -0.5$: tilted by 25°,
    less upright.
    """
    return _not_harmonic(25.0) - _not_harmonic(0.0)


def _not_harmonic(tilt: float) -> float:
    place = np.sin(np.radians(tilt)) / 2, np.cos(np.radians(tilt)) / 2
    rod = noncollinear.inverse_mass(1.0, 12**-0.5, *place)
    history = noncollinear.history(-0.5, 1.0, rod, friction=1.0, samples=2001)
    end = next(e.time for e in history.events if e.kind == EventKind.MAXIMUM_COMPRESSION)
    sticks = history.time <= end
    impulse = contact.cumulative(history.normal_force[sticks], history.time[sticks])
    # F2' = kappa v2 in compression: over each step, the second derivative over kappa, and F2.
    change, force = np.diff(history.normal[sticks]), np.diff(impulse)
    unexplained = change - force * (change @ force) / (force @ force)
    return float(np.linalg.norm(unexplained) / np.linalg.norm(change))


@over(contact.with_stick)
def friction_cone(impact: Contact) -> Gaps:
    r"""Largest excess of $|F_1|$ over $\mu F_2$ along exact contacts, in the largest $\mu F_2$."""
    excess = np.abs(impact.path.force_1) - impact.friction * impact.path.force_2
    yield np.maximum(excess, 0.0) / impact.friction_scale


@over(contact.with_stick)
def slip_force(impact: Contact) -> Gaps:
    """Eq. 8 along the last slip, with $s$ from the velocity of the particle."""
    path = impact.between(impact.t3, impact.end.t)
    tangential, normal = impact.printed(dynamics.eq_8_impulse, normal_impulse=path.force_2)
    yield (tangential - path.force_1) / impact.friction_scale
    yield normal / path.force_2.max() - path.force_2 / path.force_2.max()
    slipped = path.v1[:-1] * np.diff(path.t) + np.diff(path.u1)
    yield np.minimum(impact.slip_direction * np.sum(slipped), 0.0)


@over(contact.with_stick)
def velocity_slope(impact: Contact) -> Gaps:
    """Eq. 9 along the last slip: $dv_1/dp$, with $p(t)$ of Table 1."""
    path = impact.between(impact.t3, impact.end.t)
    impulse = impact.impulse(path.t) - impact.impulse(path.t[0])
    inverse = np.diag([1 / impact.m1, 1 / impact.m2])
    slope = impact.printed(dynamics.eq_9_velocity_slope, inverse_mass=inverse)
    yield (path.v1[0] + slope[0] * impulse - path.v1) / impact.velocity_scale
    v2 = impact.printed(dynamics.table_1_velocity, t=path.t)
    yield (slope[1] * impulse[-1] - (v2[-1] - v2[0])) / impact.v2
