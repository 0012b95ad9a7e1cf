"""The figure `rod`: numbers of its curves, and closed forms they must meet."""

import numpy as np
import pytest

from stronge1994.figures.rod import curves as rod

SETTINGS = {
    "stiffness_ratio": 1.21,
    "tilt": (-85, 85),
    "velocity_ratio": [0.6, 2.5],
    "friction": 1.6,
    "restitution": 0.9,
    "samples": 681,
    "contact": {"tilt": 25.0, "velocity_ratio": 10.0},
}
TILT, ENERGY, JAMS = "tilt [deg]", "kinetic_energy [K0]", "jams [1]"


@pytest.fixture(scope="module")
def curves():
    return rod.curves(**SETTINGS)


def test_only_newtons_coefficient_creates_energy(curves):
    created = {name for name, c in curves.items() if ENERGY in c and c[ENERGY].max() > 1}
    assert created == {"rigid, Newton, v1/v2 = 0.6"}
    newton = curves[created.pop()]
    assert newton[ENERGY].max() == pytest.approx(1.27, abs=0.005)
    assert newton[TILT][newton[ENERGY].argmax()] == -45


def test_compliance_brings_the_tip_back_where_the_rigid_impulse_leaves_it_at_rest(curves):
    rigid, compliant = (
        curves[f"{kind}v1/v2 = 2.5"]["tangential_velocity [v2(0)]"] for kind in ("rigid, ", "")
    )
    worst = np.abs(compliant - rigid).argmax()
    assert compliant[worst] == pytest.approx(-2.3, abs=0.05)
    assert rigid[worst] == pytest.approx(0, abs=1e-14)


@pytest.mark.parametrize("ratio", ["0.6", "2.5"])
def test_a_rigid_rod_jams_between_the_limits_of_the_closed_form(curves, ratio):
    curve = curves[f"rigid, v1/v2 = {ratio}"]
    low, high = rod.jam_limits(1.6)[2:]
    assert (round(low), round(high)) == (15, 43)
    inside = (curve[TILT] > low + 1e-9) & (curve[TILT] < high - 1e-9)
    outside = (curve[TILT] < low - 1e-9) | (curve[TILT] > high + 1e-9)
    assert curve[JAMS][inside].all() and not curve[JAMS][outside].any()


def test_a_compliant_rod_jams_at_negative_tilt_and_in_slip_after_stick(curves):
    first_sticks, first_slips = (curves[f"v1/v2 = {ratio}"] for ratio in ("0.6", "2.5"))
    for curve in (first_sticks, first_slips):
        assert curve[JAMS][curve[TILT] < 0].any() and curve[JAMS][curve[TILT] > 0].any()
    assert set(first_sticks["regime"]) == {"STICK_SLIP"}
    jams = first_sticks[TILT][(first_sticks[JAMS] == 1) & (first_sticks[TILT] > 0)]
    assert jams[[0, -1]] == pytest.approx([19.7, 43], abs=0.3)


def test_nothing_jams_up_to_four_thirds():
    curves = rod.curves(**(SETTINGS | {"friction": 4 / 3}))
    assert not any(curve[JAMS].any() for curve in curves.values() if JAMS in curve)


def test_forces_grow_like_a_hyperbolic_sine_until_the_tip_sticks(curves):
    contact, mass = curves["contact"], rod.slender_rod(25.0)
    rate = np.sqrt(1.6 * mass.coupling - 1)
    time, force = contact["time [1/Omega]"], contact["normal_force [m2 Omega v2(0)]"]
    stick = time[contact["event"] == "stick"][0]
    slips = time <= stick
    exact = np.sinh(rate * time[slips]) / rate
    np.testing.assert_allclose(force[slips], exact, rtol=1e-13, atol=1e-15)
    np.testing.assert_allclose(
        contact["friction_force [m2 Omega v2(0)]"][slips], 1.6 * exact, rtol=1e-13, atol=1e-15
    )
    assert stick == pytest.approx(2.148, abs=0.001)


def test_events_stand_at_their_vertices(curves):
    event = curves["contact"]["event"]
    kinds = [str(kind) for kind in event if kind]
    assert kinds == ["slip", "stick", "maximum compression", "slip", "separation"]
    assert event[0] == "slip" and event[-1] == "separation"
