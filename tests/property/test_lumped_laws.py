"""Laws of the lumped model, tried on the impacts of `lumped_impacts`, with and without viscosity.

Warnings are errors here.
"""

import numpy as np
import pytest
from mpmath import mp

from planarimpact import Regime, lumped, rigid
from tests.property import lumped_impacts
from tests.reference_solutions import extreme_tables, viscous_tables

OUTPUTS = ("velocity", "peak_friction", "dissipation")
STEP = 1e-13  # of a parameter to its neighbour: far less than any loss of digits that matters
# What `lumped.rebound` promises: a hundred times the effect of rounding its arguments.
ALLOWED = 100 * lumped_impacts.ULP
SEEDS = [0, *(pytest.param(seed, marks=pytest.mark.long) for seed in range(1, 20))]


@pytest.fixture(scope="module", params=SEEDS)
def seed(request):
    return request.param


@pytest.fixture(scope="module", params=["hysteretic", "viscous"])
def loss(request):
    return request.param


@pytest.fixture(scope="module")
def impacts(seed, loss):
    return lumped_impacts.ordinary(np.random.default_rng(1994 + seed), loss)


@pytest.fixture(scope="module")
def found(impacts, loss):
    return lumped.rebound(*impacts, loss=loss)


@pytest.fixture(scope="module")
def jumps(impacts, loss):
    """Change of the outputs to the neighbours, at most, in units of `scales`; shape (3, n)."""

    def outputs(groups):
        return np.stack(lumped.rebound(*groups, loss=loss)[:3])

    here, most = outputs(impacts), np.zeros((3, impacts.shape[1]))
    for place in range(4):
        for side in (-1, 1):
            near = impacts.copy()
            near[place] *= 1 + side * STEP
            near = lumped_impacts.within(near, loss)
            most = np.maximum(most, np.abs(outputs(near) - here))
    return most / np.maximum(lumped_impacts.scales(impacts, loss), 1e-300)  # of x = 0


def rounding(groups, loss):
    """What rounding may take from a velocity: some of this size are added and taken away."""
    share = ALLOWED if loss == "hysteretic" else viscous_tables.PROMISED
    return share * np.maximum(groups[0], groups[1])


def test_friction_creates_no_energy_and_keeps_its_limit(impacts, found):
    assert (np.abs(found.velocity) <= impacts[0]).all()
    assert (found.dissipation >= 0).all() and np.isfinite(found.dissipation).all()
    assert ((found.peak_friction >= 0) & (found.peak_friction <= 1)).all()


def test_friction_takes_what_the_body_loses(impacts, found, loss):
    """All of it; with viscosity the tangential dashpot and the spring have a share."""
    x, beta, *_ = impacts
    taken_besides = (x - found.velocity) / beta * (x + found.velocity) / 2 - found.dissipation
    bound = 2 * rounding(impacts, loss) * (x / beta)
    assert (taken_besides >= -bound).all()
    if loss == "hysteretic":
        assert (taken_besides <= bound).all()


def test_slip_throughout_is_a_line_from_its_limit_on(impacts, found, loss):
    x, beta, zeta2, e = impacts
    slides = x >= lumped.slip_throughout_limit(beta, zeta2, e, loss=loss)
    np.testing.assert_array_equal(found.regime == Regime.SLIP_THROUGHOUT, slides)
    line = np.maximum(x - (1 + e) * beta, -x)  # rounding creates no energy
    np.testing.assert_array_equal(found.velocity[slides], line[slides])
    assert (found.peak_friction[slides] == 1).all()


def test_two_impacts_approach_each_other(impacts, loss):
    """The tangential energy of a difference never grows: w is 1-Lipschitz in the incidence."""
    x, *groups = impacts
    here = lumped.rebound(x, *groups, loss=loss).velocity
    for y in (np.nextafter(x, np.inf), x * (1 + 1e-9), x * 1.001, x / 2):
        gap = np.abs(lumped.rebound(y, *groups, loss=loss).velocity - here)
        assert (gap <= np.abs(y - x) + rounding(impacts, loss)).all()


def test_only_ratios_of_the_groups_matter(impacts, loss):
    """x, beta and zeta^2 in another unit, a power of 2."""
    x, beta, zeta2, e = impacts
    one = lumped.rebound(*impacts, loss=loss)
    other = lumped.rebound(4 * x, 4 * beta, 4 * zeta2, e, loss=loss)
    np.testing.assert_array_equal(other.velocity, 4 * one.velocity)
    np.testing.assert_array_equal(other.peak_friction, one.peak_friction)
    np.testing.assert_allclose(other.dissipation, 4 * one.dissipation, rtol=0, atol=1e-322)


def test_equal_ratios_start_no_slip_by_rounding():
    """There T and N are in proportion, all along: the limit is -e x."""
    x, beta, zeta2, e = groups = lumped_impacts.equal_ratios("viscous")
    velocity, away = lumped.rebound(*groups, loss="viscous").velocity, np.abs(zeta2 / beta - 1)
    assert (np.abs(velocity + e * x) <= 20 * (away + 1e-15) * beta).all()


def test_no_answer_differs_from_its_neighbours(jumps, loss):
    """A lost or invented phase does not strike two neighbours alike."""
    slack = STEP if loss == "hysteretic" else 30 * STEP
    assert (jumps <= slack + ALLOWED).all()


def test_suspicious_answers_against_40_digits(impacts, jumps, loss):
    x, beta, zeta2, e = impacts
    quick = (e * np.sqrt(beta / zeta2) < 12) & (e > 1e-6)  # for the reference
    ranks = [np.argsort(-np.where(quick, jump, 0))[:3] for jump in jumps]
    spread = np.flatnonzero(quick)[:: quick.sum() // 6]
    for lane in np.unique(np.concatenate([*ranks, spread])):
        point = tuple(map(float, impacts[:, lane]))
        found = lumped.rebound(*point, loss=loss)
        if loss == "viscous":
            exact = viscous_tables.row(point)[4:7]
            bounds = viscous_tables.PROMISED * viscous_tables.scales(*point)
        else:
            _, *exact = map(mp.mpf, extreme_tables.row(point)[3:10])
            exact, conditions = exact[:3], exact[3:]
            bounds = [ALLOWED * (abs(v) + c) for v, c in zip(exact, conditions, strict=True)]
        for name, value, bound in zip(OUTPUTS, exact, bounds, strict=True):
            assert abs(getattr(found, name) - value) <= bound, (name, point)


def test_loss_and_compliance_vanish_without_a_jump(impacts, loss):
    x, beta, zeta2, e = impacts
    answer = lumped.rebound(*impacts, loss=loss).velocity
    if loss == "viscous":
        elastic = lumped.rebound(x, beta, zeta2, 1.0)
        for lost in (1e-4, 1e-8, 1e-16):
            nearly = lumped.rebound(x, beta, zeta2, 1 - lost, loss=loss)
            for name in OUTPUTS:
                gap = np.abs(getattr(nearly, name) - getattr(elastic, name))
                assert (gap <= 200 * lost + 1e-12 * np.maximum(x, 1)).all()
        return
    # Restitution adds the impulse e at most, and compliance stores sqrt(beta zeta^2) at most.
    plastic = lumped.rebound(x, beta, zeta2, 0.0).velocity
    assert (np.abs(answer - plastic) <= e * beta * (1 + 1e-12) + rounding(impacts, loss)).all()
    stiff = rigid.rebound(*impacts).velocity
    assert (np.abs(answer - stiff) <= np.sqrt(beta * zeta2) + rounding(impacts, loss)).all()


def test_one_impact_has_the_bits_of_many(impacts, found, loss):
    """One is solved in floats, many in arrays: at each threshold and beside it, in every regime."""
    if loss == "viscous":  # dashpots have one way
        return
    places, regimes = range(0, impacts.shape[1], 3), set()
    for place, point in zip(places, impacts[:, ::3].T.tolist(), strict=True):
        alone = lumped.rebound(*point, loss=loss)
        assert tuple(alone[:4]) == tuple(field[place] for field in found[:4]), point
        regimes.add(alone.regime)
    assert regimes > {Regime.STICK_SLIP, Regime.SLIP_STICK_SLIP, Regime.SLIP_THROUGHOUT}


def test_one_and_many_and_history_agree(impacts, found, loss):
    """Along a contact friction keeps its limit, and the tangential energy never grows."""
    x, beta, zeta2, e = impacts
    # With more steps a history loses digits, as it says, and takes seconds.
    few = np.flatnonzero((e * np.sqrt(beta) <= 300 * np.sqrt(zeta2)) & (beta <= 1e6 * zeta2))
    for lane in few[:: few.size // 120]:
        x, beta, zeta2, e = point = tuple(map(float, impacts[:, lane]))
        alone = lumped.rebound(*point, loss=loss)
        assert tuple(alone[:4]) == tuple(field[lane] for field in found[:4]), point
        contact = lumped.history(*point, samples=40, loss=loss)
        assert abs(contact.velocity[-1] - alone.velocity) <= rounding(point, loss), point
        slack = rounding((1.0, contact.normal.max()), loss)
        assert (np.abs(contact.friction_force) <= contact.normal + slack).all(), point
        phases = sum(event.kind in ("stick", "slip") for event in contact.events)
        # Where the last phase shrinks to nothing, rounding decides whether there is one.
        near = lumped.rebound(x * (1 + STEP * np.arange(-1, 2)), beta, zeta2, e, loss=loss).regime
        assert (phases > 3) in (near == Regime.MULTIPLE), point
        energy = contact.velocity**2 / (2 * beta) + contact.spring**2 / (2 * zeta2)
        slack = rounding(point, loss) * max(x, beta) / beta
        assert (np.diff(energy) <= slack).all(), point
        if e > 0:
            work = lumped.friction_work(*point, loss=loss)
            slack = rounding(point, loss)  # of x, so of x^2/beta:
            assert abs(work - alone.dissipation) <= slack * (2 * x + slack) / beta, point
