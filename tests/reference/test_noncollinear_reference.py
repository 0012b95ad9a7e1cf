"""The non-collinear model against SciPy's integration of the equations of motion."""

import numpy as np
import pytest
from noncollinear_integration import Contact

from planarimpact import noncollinear
from planarimpact.noncollinear import phases

AGREEMENT = 1e-9


def errors(v1, v2, body, friction, restitution, stiffness_ratio, stiffness):
    """Velocities, work and duration of both, relative, and what the integration met."""
    mass, gyration, x1, x2 = body
    mass = noncollinear.inverse_mass(mass, gyration, offset=x1, depth=-x2)
    settings = friction, restitution, stiffness_ratio, stiffness
    found = noncollinear.rebound(v1, v2, mass, *settings)
    contact = Contact(v1, -v2, body, *settings).run()
    energy = noncollinear.kinetic_energy(v1, v2, mass)
    _, _, tangential, normal = contact.state
    return (
        abs(found.tangential - tangential) / max(abs(v1), v2),
        abs(-found.normal - normal) / v2,
        abs(found.friction_work - contact.friction_work) / energy,
        abs(found.duration / contact.time - 1),
    ), found


def random_impact(rng):
    gyration, friction, v2 = rng.uniform(0.1, 1), rng.uniform(0.05, 2.5), rng.uniform(0.1, 5)
    body = (
        rng.uniform(0.5, 3),
        gyration,
        gyration * rng.uniform(-3, 3),
        -gyration * rng.uniform(0, 3),
    )
    v1 = v2 * friction * rng.uniform(-6, 6)
    ratio, stiffness = 10 ** rng.uniform(-0.7, 0.7), 10 ** rng.uniform(2, 6)
    return v1, v2, body, friction, rng.uniform(0.1, 1), ratio, stiffness


@pytest.mark.parametrize("seed", range(4))
def test_random_bodies(seed):
    rng = np.random.default_rng(seed)
    jams = 0
    for _ in range(30):
        impact = random_impact(rng)
        worst, found = errors(*impact)
        assert max(worst) <= AGREEMENT, impact
        jams += found.jams
    assert jams  # the sample has them


SPIKY = (1.032, 0.9537), (-2.2135, -1.59155)  # mass, gyration; contact point


@pytest.mark.parametrize(
    "impact",
    [
        # Friction holds the contact closed: reloading beyond the earlier peak, four times stick.
        (-12.425, 3.3405, (*SPIKY[0], *SPIKY[1]), 2.3832, 0.0283, 2.2134, 300.7),
        (2.0, 1.0, (1.0, 12**-0.5, 0.2, -0.4), 1.6, 0.5, 1.21, 50.0),  # jams from the start
        (1.0, 1.0, (1.0, 1.0, 0.0, -1.58), 0.4, 0.7, 0.02, 3.0),  # many phases
        (0.0, 1.0, (1.0, 12**-0.5, 0.3, -0.4), 0.5, 0.9, 1.21, 1.0),  # nothing but coupling
        (1.0, 1.0, (1.0, 0.3, 0.3, -0.001), 0.5, 0.9, 1.21, 1.0),  # beta < 1
        # Slip reloads the contact up to its earlier peak: it jams there, approaching or not yet.
        (1.67785, 1.0, (1.3441, 1.0, 0.5866, 3.0209), 0.9357, 0.5, 0.72699, 1.0),
        (0.74123, 1.0, (7.1565, 1.0, 2.4812, -2.4567), 1.37314, 1.0, 1.90488, 1.0),
        (0.77318, 1.0, (6.285, 1.0, 2.2989, 2.8091), 6.6156, 1.0, 0.12157, 1.0),
    ],
)
def test_hard_impacts(impact):
    worst, _ = errors(*impact)
    assert max(worst) <= AGREEMENT


def test_a_wrong_solver_would_be_seen(monkeypatch):
    """The bound is no formality: a slightly wrong restitution, or work, breaks it."""
    impact = (2.0, 1.0, (1.0, 12**-0.5, 0.2, -0.4), 1.6, 0.5, 1.21, 50.0)
    changed = (*impact[:4], 0.5 + 1e-7, *impact[5:])
    exact, wrong = (errors(*case)[1] for case in (impact, changed))
    assert abs(exact.tangential - wrong.tangential) > AGREEMENT
    work = phases.Slip.work
    monkeypatch.setattr(phases.Slip, "work", lambda *a: work(*a) * (1 + 1e-6))
    assert max(errors(*impact)[0]) > AGREEMENT
