"""Hertz contact under tangential load: motion, closed forms, and the row of springs."""

import numpy as np
import scipy.special

from planarimpact.continuum import micro_slip
from planarimpact.normal_impact import hertz
from tests.reference_solutions import cattaneo_mindlin

PHASE = np.linspace(0.0, np.pi, 201)


def test_hertz_motion_conserves_energy_and_its_phase_is_found_again():
    velocity = hertz.velocity(PHASE)
    np.testing.assert_allclose(velocity**2, 1 - np.sin(PHASE) ** 5, atol=4e-16)
    np.testing.assert_allclose(hertz.phase_at(velocity), PHASE, atol=2e-15)


def test_hertz_pace_is_that_of_depth_and_time():
    """v dt = dd, and the time up to a phase."""
    pace = hertz.velocity(PHASE) * hertz.state(PHASE)[1]
    np.testing.assert_allclose(pace, np.sin(2 * PHASE), atol=1e-15)
    nodes, weights = np.polynomial.legendre.leggauss(40)
    for phase in (0.3, 1.5, 1.6, 3.0):
        passed = weights @ hertz.state(phase / 2 * (1 + nodes))[1] * phase / 2
        assert abs(passed / (0.4 * scipy.special.beta(0.4, 0.5)) - hertz.time(phase)) < 1e-13


def test_first_loading_and_way_back_are_the_closed_forms():
    """Cattaneo, Mindlin and Deresiewicz, exactly: pressed down, pushed, pulled back, pushed."""
    out = np.linspace(0.0, 0.9, 10)
    back = np.linspace(0.8, -0.9, 18)
    force, stick = micro_slip.friction(np.ones(28), np.concatenate([out, back]))
    np.testing.assert_allclose(force[:10], cattaneo_mindlin.friction(out), atol=1e-14)
    np.testing.assert_allclose(force[10:], cattaneo_mindlin.unloading(back, 0.9), atol=1e-14)
    np.testing.assert_allclose(stick[1:10], cattaneo_mindlin.stick_radius(force[1:10]), atol=1e-14)


def test_pushed_further_than_friction_the_whole_contact_slips():
    force, stick = micro_slip.friction([1.0, 1.0, 1.0, 1.0], [0.0, 5.0, 4.5, 3.0])
    np.testing.assert_allclose(force[1], 1.0, atol=1e-15)
    assert stick[1] == 0
    np.testing.assert_allclose(force[3], cattaneo_mindlin.unloading(-1.0, 1.0), atol=1e-15)


def test_straight_oblique_loading_does_not_slip():
    """Where approach grows faster than displacement every new spring sticks at once."""
    growth = np.linspace(0.1, 1.0, 10)
    force, stick = micro_slip.friction(np.sqrt(growth), 0.6 * growth)
    np.testing.assert_allclose(stick, np.sqrt(growth))
    np.testing.assert_allclose(force, 0.6 * growth**1.5, atol=1e-15)


def test_a_vertex_on_the_edge_of_the_cone_does_not_mislead():
    """Turning points met again exactly, where rounding decides on which side a vertex lies."""
    rng = np.random.default_rng(2)
    for _ in range(200):
        top = np.round(rng.uniform(0.1, 0.9), 2)
        path = np.round(np.concatenate([[0, top], rng.uniform(-top, top, 6), [-top]]), 2)
        force, _ = micro_slip.friction(np.ones(path.size), path)
        assert abs(force[-1] + cattaneo_mindlin.friction(top)) < 1e-13, path
