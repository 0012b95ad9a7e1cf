"""The non-collinear model against SciPy's integration of the equations of motion."""

from functools import partial

import numpy as np
import pytest

from planarimpact import noncollinear
from tests.reference_solutions.noncollinear_integration import Contact

paper_rebound = partial(noncollinear.rebound, loss="hysteretic")

AGREEMENT = 1e-9


def errors(v1, v2, body, friction, restitution, stiffness_ratio, stiffness):
    """Velocities, work and duration of both, relative, and what the integration met."""
    mass, gyration, x1, x2 = body
    mass = noncollinear.inverse_mass(mass, gyration, offset=x1, depth=-x2)
    settings = friction, restitution, stiffness_ratio, stiffness
    found = paper_rebound(v1, v2, mass, *settings)
    contact = Contact(v1, -v2, body, *settings).run()
    energy = noncollinear.kinetic_energy(v1, v2, mass)
    _, _, tangential, normal = contact.state
    assert found.peak_friction == pytest.approx(contact.peak_friction, rel=1e-4)
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


@pytest.mark.parametrize("seed", [0, *(pytest.param(n, marks=pytest.mark.long) for n in (1, 2, 3))])
def test_random_bodies(seed):
    rng = np.random.default_rng(seed)
    jams = 0
    for _ in range(30):
        impact = random_impact(rng)
        worst, found = errors(*impact)
        assert max(worst) <= AGREEMENT, impact
        jams += found.jams
    assert jams  # the sample has them


# Mass, gyration and contact point of bodies with m2 = 1.
HELD = 27.478123341887763, 1.0, 5.1456897829045, -3.0240573965824393
BURST = 10.439702294961105, 1.0, 3.0724098513969627, 4.006143059717655
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


def swing(friction, normal, mass, e):
    """Change of velocity in one swing of N under the largest forces.

    When a contact lets go, or begins to creep, is a matter of less.
    """
    return 2 * np.pi * e * (mass.tangential * friction + abs(mass.coupling) * normal)


@pytest.mark.parametrize(
    ("v1", "body", "friction", "stiffness_ratio"),
    [
        # beta = 0.3692, C = 0.5663: compressed again, then held closed in stick and in creep.
        (6.2256, HELD, 1.8575, 1.3185),
        # The first swing slips, is held all the same, and friction passes a crest.
        (-8.52178, BURST, 0.88069, 2.34643),
    ],
)
def test_no_restitution_is_the_limit_of_integrations_with_little(
    v1, body, friction, stiffness_ratio
):
    mass = noncollinear.inverse_mass(body[0], body[1], offset=body[2], depth=-body[3])
    limit = paper_rebound(v1, 1.0, mass, friction, 0.0, stiffness_ratio)
    assert limit.jams and limit.normal == 0
    changes = []
    for e in (0.08, 0.02):
        contact = Contact(v1, -1.0, body, friction, e, stiffness_ratio, 1.0).run()
        _, _, tangential, normal = contact.state
        bound = swing(limit.peak_friction, limit.peak_normal, mass, e)
        changes.append(abs(limit.tangential - tangential))
        assert changes[-1] <= bound and abs(normal) <= bound
        assert abs(contact.peak_friction - limit.peak_friction) <= bound
        assert abs(contact.time - limit.duration) <= bound
    # It comes closer at least as fast as e falls.
    assert changes[1] <= changes[0] / 4


@pytest.mark.parametrize("e", [0.02, pytest.param(0.005, marks=pytest.mark.long)])
def test_no_restitution_is_the_limit_for_any_body(e):
    rng = np.random.default_rng(0)
    size = 300
    beta, mu = 10 ** rng.uniform(-1, 1, size), 10 ** rng.uniform(-0.5, 1, size)
    zeta2 = 10 ** rng.uniform(-1, 1, size)
    share = rng.uniform(-0.97, 0.97, size)
    mass = noncollinear.InverseMass(beta, share * np.sqrt(beta), np.ones(size))
    v1 = rng.uniform(-6, 6, size) * mu * zeta2
    limit = paper_rebound(v1, 1.0, mass, mu, 0.0, zeta2)
    assert limit.jams.sum() > 50 and (~limit.jams).sum() > 50
    # Where a contact just fails to let go the answer jumps, at a place that moves with e: none of
    # these impacts lies between.
    little = paper_rebound(v1, 1.0, mass, mu, e, zeta2)
    bound = swing(limit.peak_friction, limit.peak_normal, mass, e)
    for name in ("tangential", "peak_friction"):
        assert (np.abs(getattr(little, name) - getattr(limit, name)) <= bound).all(), name


@pytest.mark.parametrize(
    "impact", [(-27.1, 0.1175, -0.32445, 8.75, 1.0), (18.6, 0.754, 0.6514, 2.74, 7.31)]
)
def test_friction_that_just_suffices_compresses_a_contact_again(impact):
    """Held closed without restitution, then compressed beyond the earlier peak by less than 1 %."""
    v1, mass_ratio, coupling, friction, stiffness_ratio = impact
    mass = noncollinear.InverseMass(mass_ratio, coupling, 1.0)
    limit, little = (
        paper_rebound(v1, 1.0, mass, friction, e, stiffness_ratio) for e in (0.0, 0.003)
    )
    assert abs(little.tangential - limit.tangential) < 1e-4
    assert abs(little.peak_normal - limit.peak_normal) < 1e-4
