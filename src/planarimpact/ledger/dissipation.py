"""Checks of Eqs 36 to 41, and of what pp. 435 and 447 to 449 say of the energy lost."""

import numpy as np

from planarimpact import lumped, rigid
from planarimpact.ledger import contact
from planarimpact.ledger.dynamics import PLATE
from planarimpact.ledger.finding import Finding, largest
from planarimpact.printed import dissipation, dynamics, slip
from planarimpact.results import EventKind

# Of Fig. 9.
FRICTIONS, RESTITUTIONS = (0.1, 0.5), (1.0, 0.5)
ANGLES = np.linspace(0.0, 89.95, 17991)[1:]  # degrees


def kinetic_energy():
    """K0 as scanned over the energy of a rigid body, spin clockwise; corrected by 1/2."""
    mass, gyration, x2 = PLATE["mass"], PLATE["gyration"], PLATE["x2"]
    v1, v2 = -0.8, -1.3
    ratios = []
    for clockwise in (0.0, 1.9):
        # Velocity of the centre: that of C less the part of turning, v = V + spin x r.
        centre = v1 - clockwise * x2, v2
        exact = mass * (centre[0] ** 2 + centre[1] ** 2 + (gyration * clockwise) ** 2) / 2
        ratios.append(dissipation.kinetic_energy(mass, gyration, x2, v1, v2, clockwise) / exact)
    return Finding(float(np.max(ratios)), largest([np.array(ratios) / 2 - 1]))


def hysteresis():
    """Eqs 36 and 37 against the normal kinetic energy that the exact contact loses."""
    gaps = []
    for e in contact.RESTITUTIONS:
        motion = contact.normal_motion(e)
        found = motion.found
        kinetic = found.m2 * found.v2**2 / 2
        lost = kinetic - found.m2 * motion.velocity[-1] ** 2 / 2
        gaps.append((dissipation.eq_36_hysteresis(found.m2, found.v2, e) - lost) / kinetic)
        gaps.append(dissipation.eq_37_hysteresis_share(e) - lost / kinetic)
    return Finding(largest(gaps))


def _unit(found):
    """Tangential kinetic energy m1 v1(0)^2/2, in which the gaps are measured."""
    return found.m1 * found.v1**2 / 2


def _exact(found):
    """Exact dissipation by friction, in the paper's units."""
    groups = found.mass_ratio, found.stiffness_ratio, found.restitution
    scale = found.m2 * (found.friction * found.v2) ** 2
    return float(lumped.rebound(found.incidence, *groups).dissipation) * scale


def _spring(found, state):
    """Tangential strain energy in a state."""
    return found.stiffness / found.stiffness_ratio * state.u1**2 / 2


def _share(found, state):
    """p(t)/p(t_c) by Table 1."""
    groups = found.normal_frequency, found.restitution
    return float(dynamics.table_1_impulse(state.t, -1.0, 1.0, *groups))


def _sphere(contacts):
    """Contacts of the paper's sphere with e from 0.6, where the printed sign of s is right."""
    groups = contact.SPHERE
    return [c for c in contacts if (c.mass_ratio, c.stiffness_ratio) == groups]


UPPER = tuple(e for e in contact.RESTITUTIONS if e >= 0.6)


def friction_after_stick():
    """Eq. 38 over the exact energy lost; corrected by the tangential strain energy at t1."""
    printed, corrected = [], []
    for found in _sphere(contact.initial_stick(UPPER)):
        onset = found.last(EventKind.SLIP)
        left = (1 + found.restitution - _share(found, onset)) * -found.m2 * found.v2
        given = onset.v1, left, found.friction, found.m1
        gap = dissipation.eq_38_friction(*given) - _exact(found)
        printed.append(gap / _unit(found))
        corrected.append((gap + _spring(found, onset)) / _unit(found))
    return Finding(largest(printed), largest(corrected))


def friction_after_stick_in_groups():
    """Eq. 39 the same way."""
    printed, corrected = [], []
    for found in _sphere(contact.initial_stick(UPPER)):
        onset, normal = found.last(EventKind.SLIP), found.m2 * found.v2**2
        swing = np.cos(found.tangential_frequency * onset.t)
        g1 = slip.impulse_ratio(onset.t, found.normal_frequency, found.restitution)
        groups = found.incidence, swing, g1, found.mass_ratio, found.friction
        gap = dissipation.eq_39_friction(*groups) * normal / 2 - _exact(found)
        printed.append(gap / _unit(found))
        # mu^2 zeta^2 (F2(t1)/(m2 Omega v2(0)))^2 is what Eq. 39 leaves out.
        missing = (found.friction * onset.force_2 / found.force_scale) ** 2
        corrected.append((gap + missing * found.stiffness_ratio * normal / 2) / _unit(found))
    return Finding(largest(printed), largest(corrected))


def friction_of_two_slips():
    """Eq. 40 the same way: strain energy at t3 comes in, that at t2 goes out."""
    printed, corrected = [], []
    for found in _sphere(contact.slip_stick_slip(UPPER)):
        scale, normal = found.friction * found.v2, found.m2 * found.v2**2
        start, onset = found.first(EventKind.STICK), found.last(EventKind.SLIP)
        velocities = [v / scale for v in (start.v1, onset.v1, found.final_velocity)]
        lost = dissipation.eq_40_friction(
            found.incidence, *velocities, found.mass_ratio, found.friction
        )
        gap = lost * normal / 2 - _exact(found)
        printed.append(gap / _unit(found))
        strain = _spring(found, onset) - _spring(found, start)
        corrected.append((gap + strain) / _unit(found))
    return Finding(largest(printed), largest(corrected))


def friction_of_slip_throughout():
    """Eq. 41 against the exact energy lost above the printed limit."""
    gaps = []
    for found in contact.slip_throughout():
        groups = found.incidence, found.mass_ratio, found.friction, found.restitution
        lost = dissipation.eq_41_friction(*groups) * found.m2 * found.v2**2 / 2
        gaps.append((lost - _exact(found)) / _unit(found))
    return Finding(largest(gaps))


def theorem():
    """The footnote's D1 of slip throughout over the exact one; corrected with a minus."""
    ratios = []
    for found in contact.slip_throughout():
        impulse = found.m1 * (found.final_velocity - found.v1)
        printed = dissipation.footnote_theorem(found.v1, found.final_velocity, impulse)
        ratios.append(printed / _exact(found))
    return Finding(float(np.mean(ratios)), largest([np.array(ratios) + 1]))


def only_in_slip():
    """Work of friction over the phases of slip against the exact balance of energy."""
    gaps = []
    for found in (*contact.initial_stick(), *contact.slip_stick_slip()):
        groups = found.incidence, found.mass_ratio, found.stiffness_ratio, found.restitution
        gap = lumped.friction_work(*groups) - lumped.rebound(*groups).dissipation
        gaps.append(gap / (found.incidence**2 / (2 * found.mass_ratio)))
    return Finding(largest(gaps))


def body_velocity_alone():
    """Work of friction with v1 alone over the last slip, over that with v1 + du1/dt.

    The lowest ratio over initial stick, e = 1: the sentence before Eq. 38 has it 1.
    """
    ratios = []
    for found in _sphere(contact.initial_stick((1.0,))):
        onset = found.last(EventKind.SLIP)
        change = found.m1 * (onset.v1**2 - found.final_velocity**2) / 2
        ratios.append(change / _exact(found))
    return Finding(float(min(ratios)))


def strain_recovered():
    """Tangential strain energy at separation, e > 0, over m1 v1(0)^2/2."""
    contacts = (*contact.initial_stick(), *contact.slip_stick_slip())
    left = [_spring(c, c.last(EventKind.SEPARATION)) / _unit(c) for c in contacts]
    return Finding(largest(left))


def small_incidence():
    """Share of the tangential energy m1 v1(0)^2/2 that friction takes as v1(0) -> 0.

    The smaller of e = 1 and 0.5, those of Fig. 9; without tangential compliance it is 1.
    """
    x, (beta, zeta2) = 1e-6, contact.SPHERE
    lost = [lumped.rebound(x, beta, zeta2, e).dissipation for e in RESTITUTIONS]
    return Finding(float(min(lost) / (x**2 / (2 * beta))))


def compliance_immaterial():
    """Difference that tangential compliance makes to the dissipation above the printed limit."""
    gaps = []
    for e in contact.RESTITUTIONS:
        x = slip.slip_throughout_limit(3.5, e) * np.array([1.0, 1.1, 3.0])
        hard = rigid.rebound(x, 3.5, e).dissipation
        gaps.append(lumped.rebound(x, *contact.SPHERE, e).dissipation / hard - 1)
    return Finding(largest(gaps))


def _dissipated(friction, restitution):
    """Share of m2 S^2/2 that friction takes at each of ANGLES."""
    theta = np.radians(ANGLES)
    lost = lumped.rebound(np.tan(theta) / friction, *contact.SPHERE, restitution).dissipation
    return 2 * (friction * np.cos(theta)) ** 2 * lost


def angle_of_largest():
    """Largest angle between most dissipation and the start of slip throughout, degrees.

    Over both frictions and restitutions of Fig. 9.
    """
    gaps = []
    for mu in FRICTIONS:
        for e in RESTITUTIONS:
            limit = lumped.slip_throughout_limit(*contact.SPHERE, e)
            onset = np.degrees(np.arctan(mu * limit))
            gaps.append(ANGLES[_dissipated(mu, e).argmax()] - onset)
    return Finding(float(max(gaps)))


def limited_by_restitution():
    """Smallest gain of the largest share dissipated from one e to the next larger."""
    largest_shares = [[_dissipated(mu, e).max() for e in np.linspace(0, 1, 11)] for mu in FRICTIONS]
    return Finding(float(np.min(np.diff(largest_shares, axis=1))))


def rigid_independence():
    """Rigid limit, slip halted: dissipation over x^2/(2 beta), less 1, for all e."""
    gaps = []
    for e in (0.0, *contact.RESTITUTIONS):
        x = (1 + e) * 3.5 * np.array([0.1, 0.5, 0.999])
        gaps.append(rigid.rebound(x, 3.5, e).dissipation / (x**2 / 7) - 1)
    return Finding(largest(gaps))
