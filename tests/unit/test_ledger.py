"""The judgement of the ledger's entries, in both directions."""

import math

import numpy as np
import pytest

from planarimpact import bodies, ledger, lumped, noncollinear, rigid
from planarimpact.ledger import contact, finding
from planarimpact.ledger.finding import Finding
from planarimpact.printed import slip
from planarimpact.results import EventKind

RIGHT = {"verdict": "confirmed", "confirms": {"at_most": 1e-9}}
ROUNDED = {"verdict": "confirmed within rounding", "confirms": {"value": 1.7, "rounding": 0.05}}
WRONG = {"verdict": "wrong", "confirms": {"at_most": 1e-9}, "between": [0.9, 1.1]}


@pytest.mark.parametrize(
    ("entry", "found", "why"),
    [
        (RIGHT, Finding(0.0), ""),
        (RIGHT, Finding(0.1), "recorded as confirmed, found wrong"),
        (RIGHT, Finding(math.nan), "recorded as confirmed, found wrong"),
        (ROUNDED, Finding(1.7007), ""),
        (ROUNDED, Finding(1.7), "recorded as confirmed within rounding, found confirmed"),
        (ROUNDED, Finding(1.76), "recorded as confirmed within rounding, found wrong"),
        (WRONG, Finding(1.0), ""),
        (WRONG, Finding(1.0, 1e-14), ""),
        (WRONG, Finding(1.0, 1e-3), "the corrected formula is off by 0.001"),
        (WRONG, Finding(1.0, math.nan), "the corrected formula is off by nan"),
        (WRONG, Finding(1e-12), "recorded as wrong, found confirmed"),
        (WRONG, Finding(1.2), "1.2 lies outside 0.9 to 1.1"),
        (WRONG, Finding(math.nan), "nan lies outside 0.9 to 1.1"),
    ],
)
def test_an_entry_holds_or_says_why_not(entry, found, why):
    judged = ledger.judge(found, entry)
    assert judged.holds is (why == "")
    assert judged.why.startswith(why)


def test_at_least_is_a_bound_from_below():
    assert finding.verdict(1.0, {"at_least": 0.9}) == "confirmed"
    assert finding.verdict(0.8, {"at_least": 0.9}) == "wrong"


@pytest.mark.parametrize("name", ["slip.no_such_check", "no_such_module.check", "slip"])
def test_an_unknown_check_is_refused(name):
    with pytest.raises(LookupError, match=name):
        ledger.run(name)


def largest_peak(model, friction, *groups):
    """Largest friction of one mu over all angles, by a grid of its own."""
    theta = np.radians(np.linspace(0.1, 89.9, 3000))
    return (np.cos(theta) * model(np.tan(theta) / friction, *groups).peak_friction).max()


def test_stiffness_is_judged_over_all_poisson_ratios():
    """Over nu = 0 to 0.5 it matters more than Hertz' compliance; from 0.3 on alone it does not."""
    found = ledger.run("peak_force.stiffness_matters_more").found
    soft, paper, hard = (
        largest_peak(lumped.rebound, 0.1, 3.5, bodies.stiffness_ratio(bodies.Material(1.0, nu)))
        for nu in (0.5, 0.3, 0.0)
    )
    hertz = largest_peak(lambda x: contact.without_micro_slip(np.minimum(x, 8.0)), 0.1)
    base = largest_peak(lumped.rebound, 0.1, *contact.SPHERE)
    assert found == pytest.approx((1 - soft / hard) / abs(hertz / base - 1), rel=0.02)
    assert found > 1 > (1 - soft / paper) / abs(hertz / base - 1)


def test_dissipation_at_small_angles_is_judged_on_the_axes_of_fig_9():
    found = ledger.run("dissipation.small_incidence").found
    # No more than all tangential energy, m1 v1(0)^2/2, can go.
    assert 0 < found <= np.sin(np.radians(10)) ** 2 / 3.5 < 0.01


def test_the_reduction_of_the_largest_friction_grows_with_mu():
    less = [
        1 - largest_peak(lumped.rebound, mu, *contact.SPHERE) / largest_peak(rigid.rebound, mu, 3.5)
        for mu in (0.1, 1.0)
    ]
    assert ledger.run("peak_force.smallest_reduction").found == pytest.approx(less[0], rel=1e-2)
    assert ledger.run("peak_force.largest_reduction").found == pytest.approx(less[1], rel=1e-3)


def test_no_sign_saves_the_equations_of_dissipation():
    """Eqs 38 to 40 are judged by the best choice of the signs that the scan leaves open."""
    for check in ("after_stick", "after_stick_in_groups", "of_two_slips"):
        found = ledger.run(f"dissipation.friction_{check}")
        assert found.found > 0.8 and found.corrected < 1e-12
    gaps = {sign: [] for sign in (-1, 1)}
    for found in contact.initial_stick():
        onset = found.last(EventKind.SLIP)
        impulse = found.friction * found.impulse_left(onset.t)
        energy = found.m1 * np.array([found.v1, found.final_velocity]) ** 2 / 2
        for sign, gap in gaps.items():
            lost = impulse * onset.v1 + sign * impulse**2 / (2 * found.m1)
            gap.append(abs(lost - (energy[0] - energy[1])) / energy[0])
    nearest = min(max(gap) for gap in gaps.values())
    assert ledger.run("dissipation.friction_after_stick").found == pytest.approx(nearest, rel=1e-6)


def test_no_sign_saves_the_deflection_in_stick():
    found = ledger.run("peak_force.signs_of_deflection")
    assert found.found > 1 and found.corrected < 1e-12


def test_readings_quote_what_a_kept_direction_costs():
    """0.042 and 3.75 mu v2(0): Eqs 15 and 24 taken for s = -1 too; with s = +1 they are exact."""
    after_stick, after_slip = [], []
    for contacts, costs in (
        (contact.initial_stick(), after_stick),
        (contact.slip_stick_slip(), after_slip),
    ):
        for found in contacts:
            if found.last_slip_direction < 0:
                onset = found.last(EventKind.SLIP)
                left = found.impulse_left(onset.t)
                final = slip.eq_24_final_velocity(onset.v1, left, found.friction, found.m1)
                costs.append(abs(final - found.final_velocity) / abs(found.velocity_scale))
    for check in ("slip.rebound_after_stick", "slip.final_velocity_after_second_slip"):
        assert ledger.run(check).found < 1e-9
    assert max(after_stick) == pytest.approx(0.042, abs=5e-4)
    assert max(after_slip) == pytest.approx(3.75, abs=5e-3)


def test_losses_are_decoupled_in_collinear_impact_only():
    """Off centre friction changes what the normal element takes: 15 and 21 % of the energy."""
    assert ledger.run("dissipation.losses_decoupled").found < 1e-9
    rod = noncollinear.inverse_mass(1.0, 12**-0.5, 0.125**0.5, 0.125**0.5)
    energy = noncollinear.kinetic_energy(1.0, 1.0, rod)
    lost = noncollinear.rebound(1.0, 1.0, rod, friction=[0.0, 0.5], restitution=0.5).hysteresis
    assert np.round(lost / energy, 2).tolist() == [0.15, 0.21]


def test_strain_energy_is_given_back_by_the_spring_but_not_all_to_the_body():
    """85 % is quoted in the reading of strain-recovered; at e = 0 the spring keeps all it has."""
    assert ledger.run("dissipation.strain_recovered").found < 1e-12
    assert ledger.run("dissipation.strain_decreases").found < 1e-12
    assert abs(lumped.history(2.0, *contact.SPHERE, 0.0).spring[-1]) > 0.1
    shares = []
    for found in contact.with_stick():
        onset = found.last(EventKind.SLIP)
        gained = found.m1 * (found.final_velocity**2 - onset.v1**2) / 2
        held = found.stiffness / found.stiffness_ratio * onset.u1**2 / 2
        shares.append(gained / held)
    assert max(shares) == pytest.approx(0.85, abs=5e-3)


def test_sliding_of_the_particle_may_speed_up_where_that_of_the_body_slows():
    """At e = 0.5 by zeta^2/e - e m2/m1 = 0.67, as the reading of sliding-slows has it."""
    assert ledger.run("rebound.sliding_slows").found < 1e-9
    found = lumped.history(8.0, *contact.SPHERE, 0.5, samples=20001)
    sliding = found.velocity - np.gradient(found.spring, found.time * np.pi / 2)
    inside = (found.time > 1.001) & (found.time < 1.499)
    change = sliding[inside][-1] - sliding[inside][0]
    assert change == pytest.approx(0.67, abs=0.01)
