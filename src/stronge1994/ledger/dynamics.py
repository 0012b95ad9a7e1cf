"""Checks of Eqs 1 to 9 and Table 1, and of what pp. 435 to 440 say of them."""

from collections.abc import Iterator

import numpy as np
from scipy.integrate import cumulative_simpson, solve_ivp

from planarimpact import bodies, lumped, noncollinear
from planarimpact.ground.arrays import Array
from planarimpact.ground.results import EventKind
from stronge1994.ledger import contact
from stronge1994.ledger.contact import Contact, State
from stronge1994.ledger.finding import Finding, largest
from stronge1994.printed import dynamics

# A plate struck away from its normal: mass, radius of gyration, and C from the centre.
PLATE = {"mass": 2.3, "gyration": 0.7, "x1": 0.4, "x2": -0.9}


def _change_of_velocity(
    impulse: Array, mass: float, gyration: float, x1: float, x2: float
) -> Array:
    """Change of velocity of C of a free rigid body, from the balances of momentum and spin."""
    spin = (x1 * impulse[1] - x2 * impulse[0]) / (mass * gyration**2)
    return np.array([impulse[0] / mass - spin * x2, impulse[1] / mass + spin * x1])


def inverse_mass() -> Finding:
    """Eq. 1 against the response of a free rigid body to unit impulses, and `bodies`."""
    columns = [_change_of_velocity(unit, **PLATE) for unit in np.eye(2)]
    free = dynamics.eq_1_inverse_mass(**PLATE) - np.array(columns).T
    collinear = np.diag(dynamics.eq_1_inverse_mass(2.3, 0.7, 0.0, -0.9))
    ours = bodies.effective_masses(bodies.Body(2.3, 0.7, 0.9))
    return Finding(largest([free, collinear * ours - 1]))


def effective_masses() -> Finding:
    """Eq. 2 against `bodies` for a collinear impact, and against a free rigid body."""
    masses = dynamics.eq_2_effective_masses(2.3, 0.7, 0.0, -0.9)
    collinear = np.array(masses) / bodies.effective_masses(bodies.Body(2.3, 0.7, 0.9)) - 1
    response = [_change_of_velocity(unit, **PLATE)[i] for i, unit in enumerate(np.eye(2))]
    free = np.array(dynamics.eq_2_effective_masses(**PLATE)) * response - 1
    return Finding(largest([collinear, free]))


def velocity_change() -> Finding:
    """Eq. 3 against a free rigid body, and along contacts: $m_1 dv_1$ is the friction impulse."""
    impulse = np.array([0.3, 1.1])
    inverse = dynamics.eq_1_inverse_mass(**PLATE)
    gap = dynamics.eq_3_velocity_change(inverse, impulse) - _change_of_velocity(impulse, **PLATE)
    gaps = [gap]
    for x in (0.7, 2.0, 4.5, 9.0):
        impact = contact.contact(x, restitution=0.6, samples=2001)
        impulse = contact.integral(impact, impact.path.force_1)
        change = dynamics.eq_3_velocity_change(np.array([[1 / impact.m1]]), [impulse])[0]
        gaps.append((impact.v1 + change - impact.path.v1) / impact.velocity_scale)
    return Finding(largest(gaps))


def off_diagonal() -> Finding:
    """The coupling of Eq. 1 over its diagonal for $x_1 = 0$."""
    inverse = dynamics.eq_1_inverse_mass(2.3, 0.7, 0.0, -0.9)
    beta = float(bodies.mass_ratio(bodies.Body(2.3, 0.7, 0.9)))
    return Finding(largest([inverse[0, 1], inverse[0, 0] / inverse[1, 1] / beta - 1]))


def frequencies() -> Finding:
    r"""Eq. 4: compression takes up the normal momentum in $t_c$; stick swings with $\omega$."""
    gaps = []
    for beta, zeta2 in contact.PAIRS:
        impact = contact.contact(zeta2 / 2, beta, zeta2, 1.0, samples=2001)
        groups = impact.m1, impact.m2, impact.stiffness, zeta2
        normal, tangential = dynamics.eq_4_frequencies(*groups)
        top = impact.first(EventKind.MAXIMUM_COMPRESSION)
        impulse = contact.integral(impact, impact.path.force_2)[impact.path.t == top.t]
        gaps += [
            impulse / (-impact.m2 * impact.v2) - 1,
            top.t * normal / (np.pi / 2) - 1,
            top.v1 / impact.v1 - np.cos(tangential * top.t),
        ]
    return Finding(largest(gaps))


def restitution() -> Finding:
    """Eq. 5: works of the normal force along exact contacts give $e$ back."""
    gaps = []
    for e, motion in contact.normal_motions():
        absorbed = motion.work[motion.top]
        gaps.append(dynamics.eq_5_restitution(absorbed, motion.work[-1] - absorbed) - e)
    return Finding(largest(gaps))


def normal_velocity() -> Finding:
    """Eqs 6a and 6b against the momentum that the exact normal force has brought."""
    gaps = []
    for e, motion in contact.normal_motions():
        impact, t = motion.impact, motion.impact.path.t
        groups = impact.v2, impact.normal_frequency
        early = dynamics.eq_6a_normal_velocity(t, *groups)
        late = dynamics.eq_6b_normal_velocity(t, *groups, e)
        printed = np.where(t <= impact.compression_time, early, late)
        gaps.append((printed - motion.velocity) / impact.v2)
    return Finding(largest(gaps))


def table_1() -> Finding:
    """All rows of Table 1 against the exact normal force and its integrals."""
    gaps = []
    for e, motion in contact.normal_motions():
        impact, t, force = motion.impact, motion.impact.path.t, motion.impact.path.force_2
        v2, m2, omega = impact.v2, impact.m2, impact.normal_frequency
        displacement = dynamics.table_1_displacement(t, v2, omega, e)
        gaps += [
            (dynamics.table_1_force(t, v2, m2, omega, e) - force) / impact.force_scale,
            (dynamics.table_1_impulse(t, v2, m2, omega, e) - motion.impulse) / (m2 * v2),
            (dynamics.table_1_velocity(t, v2, omega, e) - motion.velocity) / v2,
            (displacement - motion.displacement) * omega / v2,
        ]
    return Finding(largest(gaps))


def duration() -> Finding:
    """$t_f/t_c$ of the solver against $1 + e$."""
    gaps = [
        lumped.history(x, restitution=e, samples=2).time[-1] - (1 + e)
        for e in contact.RESTITUTIONS
        for x in (0.5, 2.0, 8.0)
    ]
    return Finding(largest(gaps))


def final_indentation() -> Finding:
    """$u_2(t_f)$ over $u_2(t_c)$ by quadrature of the exact force, against $1 - e^2$."""
    gaps = []
    for e, motion in contact.normal_motions():
        left = motion.displacement[-1] / motion.displacement[motion.top]
        gaps.append(left - (1 - e**2))
    return Finding(largest(gaps))


def stored_work() -> Finding:
    r"""Work at $t_c$ over $F_2(t_c) u_2(t_c)/2$, slope of unloading over $\kappa/e^2$, less 1."""
    gaps = []
    for e, motion in contact.normal_motions():
        impact, force = motion.impact, motion.impact.path.force_2
        top, depth = motion.top, motion.displacement
        gaps.append(motion.work[top] / (force[top] * depth[top] / 2) - 1)
        unloading = force[top] / (depth[-1] - depth[top])
        gaps.append(unloading / (impact.stiffness / e**2) - 1)
    return Finding(largest(gaps))


def velocity_continuous() -> Finding:
    """Eqs 6a and 6b at $t_c$, over $v_2(0)$, and the momentum brought till then."""
    gaps = []
    for e, motion in contact.normal_motions():
        impact = motion.impact
        groups = impact.compression_time, impact.v2, impact.normal_frequency
        gaps += [
            dynamics.eq_6a_normal_velocity(*groups) / impact.v2,
            dynamics.eq_6b_normal_velocity(*groups, e) / impact.v2,
            motion.velocity[motion.top] / impact.v2,
        ]
    return Finding(largest(gaps))


def hysteresis_caption() -> Finding:
    """Share of the absorbed energy that is lost, less the ratio of areas, $e^2$ (Fig. 2)."""
    printed, corrected = [], []
    for e in (0.3, 0.6, 0.9):
        motion = contact.normal_motion(e)
        lost = motion.work[-1] / motion.work[motion.top]
        printed.append(lost - e**2)
        corrected.append(lost - (1 - e**2))
    return Finding(largest(printed), largest(corrected))


def normal_independence() -> Finding:
    """Difference that incidence and stiffness ratio make to the exact normal force."""
    gaps = []
    for e in contact.RESTITUTIONS:
        base = lumped.history(0.7, restitution=e)
        for x, zeta2 in ((2.0, 1.21), (8.0, 1.21), (2.0, 0.3)):
            other = lumped.history(x, contact.MASS_RATIO, zeta2, e)
            _, ours, theirs = np.intersect1d(base.time, other.time, return_indices=True)
            gaps.append(other.normal[theirs] - base.normal[ours])
    return Finding(largest(gaps))


def stick() -> Finding:
    """Eqs 7a to 7c along the first stick of exact contacts, and against numerical integration."""
    gaps = _integrated_stick()
    for impact in contact.with_stick():
        start, end = impact.first(EventKind.STICK), impact.last(EventKind.SLIP)
        path = impact.between(start.t, end.t)
        elapsed, omega = path.t - start.t, impact.tangential_frequency
        speed, force = -impact.velocity_scale, impact.friction_scale
        initial = start.u1, start.v1
        gaps += [
            (dynamics.eq_7a_deflection(elapsed, *initial, omega) - path.u1) * omega / speed,
            (dynamics.eq_7b_velocity(elapsed, *initial, omega) - path.v1) / speed,
            (dynamics.eq_7c_force(elapsed, *initial, impact.m1, omega) - path.force_1) / force,
        ]
    return Finding(largest(gaps))


def noncollinear_stick() -> Finding:
    """Part of the second derivative of $F_2$ that no single frequency explains, root mean square.

    Over compression of a slender rod that sticks with its tip, $v_1/v_2 = -0.5$: tilted by 25°,
    less upright.
    """
    return Finding(_not_harmonic(25.0) - _not_harmonic(0.0))


def _not_harmonic(tilt: float) -> float:
    place = np.sin(np.radians(tilt)) / 2, np.cos(np.radians(tilt)) / 2
    rod = noncollinear.inverse_mass(1.0, 12**-0.5, *place)
    history = noncollinear.history(-0.5, 1.0, rod, friction=1.0, samples=2001)
    end = next(e.time for e in history.events if e.kind == EventKind.MAXIMUM_COMPRESSION)
    sticks = history.time <= end
    impulse = cumulative_simpson(history.normal_force[sticks], x=history.time[sticks], initial=0)
    # F2' = kappa v2 in compression: over each step, the second derivative over kappa, and F2.
    change, force = np.diff(history.normal[sticks]), np.diff(impulse)
    unexplained = change - force * (change @ force) / (force @ force)
    return float(np.linalg.norm(unexplained) / np.linalg.norm(change))


def _integrated_stick() -> list[Array]:
    """Distance of Eqs 7a and 7b from du1/dt = -v1, m1 dv1/dt = (kappa/zeta^2) u1, integrated."""
    start = 0.3, -0.8
    stiffness, m1 = contact.STIFFNESS / contact.STIFFNESS_RATIO, 0.6
    omega, end = np.sqrt(stiffness / m1), 2.0
    solution = solve_ivp(
        lambda _, state: [-state[1], stiffness / m1 * state[0]],
        (0, end),
        start,
        method="DOP853",
        rtol=1e-12,
        atol=1e-13,
    )
    elapsed = solution.t
    printed = (
        dynamics.eq_7a_deflection(elapsed, *start, omega),
        dynamics.eq_7b_velocity(elapsed, *start, omega),
    )
    return [value - exact for value, exact in zip(printed, solution.y, strict=True)]


def friction_cone() -> Finding:
    r"""Largest excess of $|F_1|$ over $\mu F_2$ along exact contacts, over its largest value."""
    excess = [
        np.max(np.abs(impact.path.force_1) - impact.friction * impact.path.force_2)
        / impact.friction_scale
        for impact in contact.with_stick()
    ]
    return Finding(max(0.0, float(np.max(excess))))


def _last_slips() -> Iterator[tuple[Contact, State, float]]:
    for impact in contact.with_stick():
        start, end = impact.last(EventKind.SLIP), impact.last(EventKind.SEPARATION)
        yield impact, impact.between(start.t, end.t), impact.last_slip_direction


def slip_force() -> Finding:
    """Eq. 8 along the last slip, with $s$ from the velocity of the particle."""
    gaps = []
    for impact, path, direction in _last_slips():
        tangential, normal = dynamics.eq_8_impulse(path.force_2, impact.friction, direction)
        gaps.append((tangential - path.force_1) / impact.friction_scale)
        gaps.append(normal / path.force_2.max() - path.force_2 / path.force_2.max())
        slipped = path.v1[:-1] * np.diff(path.t) + np.diff(path.u1)
        gaps.append(np.minimum(direction * np.sum(slipped), 0.0))
    return Finding(largest(gaps))


def velocity_slope() -> Finding:
    """Eq. 9 along the last slip: $dv_1/dp$, with $p(t)$ of Table 1."""
    gaps = []
    for impact, path, direction in _last_slips():
        impulse = impact.impulse(path.t)
        inverse = np.diag([1 / impact.m1, 1 / impact.m2])
        slope = dynamics.eq_9_velocity_slope(inverse, impact.friction, direction)
        change = slope[0] * (impulse - impulse[0])
        gaps.append((path.v1[0] + change - path.v1) / impact.velocity_scale)
        gaps.append(slope[1] * (impulse[-1] - impulse[0]) / impact.v2 + _restored(impact, path))
    return Finding(largest(gaps))


def _restored(impact: Contact, path: State) -> float:
    """Fall of v2 from the start of a path to its end, over v2(0), by Eq. 6."""
    groups = impact.v2, impact.normal_frequency, impact.restitution
    velocity = dynamics.table_1_velocity(path.t, *groups)
    return (velocity[0] - velocity[-1]) / impact.v2
