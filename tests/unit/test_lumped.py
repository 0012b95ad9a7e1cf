"""The lumped model's forms of call, losses and limits, and the places where digits were once lost.

Its laws are tried in tests/property, its digits in tests/reference.
"""

import numpy as np
import pytest

from planarimpact import ConvergenceError, Event, EventKind, Regime, lumped
from planarimpact.common import losses
from planarimpact.lumped import stick_slip
from tests.reference_solutions import high_precision

LOSSES = list(lumped.LOSSES)
GROUPS = [(3.5, 1.21, 1.0), (8.0, 0.1, 0.7), (2.5, 1.5, 0.01), (1.0, 10.0, 0.3)]
ALIKE = ("velocity", "peak_friction", "dissipation", "regime")


def drawn(count, seed=1):
    rng = np.random.default_rng(seed)
    beta, zeta2 = rng.uniform(1, 8, count), 10 ** rng.uniform(-1, 1, count)
    return rng.uniform(0, 10, count), beta, zeta2, rng.uniform(0.01, 1, count)


def same(one, other):
    for name in ALIKE:
        np.testing.assert_array_equal(getattr(one, name), getattr(other, name))


# Losses.


@pytest.mark.parametrize("loss", LOSSES)
def test_without_loss_all_are_the_same_to_the_bit(loss):
    x, beta, zeta2, e = drawn(2000)
    same(lumped.rebound(x, beta, zeta2, 1.0, loss=loss), lumped.rebound(x, beta, zeta2, 1.0))
    one, other = lumped.history(2.5, loss=loss), lumped.history(2.5)
    np.testing.assert_array_equal(one.friction_force, other.friction_force)
    assert lumped.friction_work(2.5, loss=loss) == lumped.friction_work(2.5)
    e[::3] = 1.0  # some of many
    mixed = lumped.rebound(x, beta, zeta2, e, loss=loss)
    for part in (e == 1, e < 1):
        alone = lumped.rebound(x[part], beta[part], zeta2[part], e[part], loss=loss)
        same(mixed._replace(**{name: getattr(mixed, name)[part] for name in ALIKE}), alone)


def test_unloading_stiffness_is_the_elastic_stiffness_of_unloading():
    x, beta, zeta2, e = drawn(2000)
    found = lumped.rebound(x, beta, zeta2, e, loss="unloading-stiffness")
    same(found, lumped.rebound(x, beta, e * (e * zeta2), e))
    limit, wanted = (
        lumped.slip_throughout_limit(beta, ratio, e, loss=loss)
        for ratio, loss in ((zeta2, "unloading-stiffness"), (e * e * zeta2, "hysteretic"))
    )
    np.testing.assert_allclose(limit, wanted, rtol=1e-14)
    one = lumped.history(2.0, 3.5, 1.21, 0.5, loss="unloading-stiffness")
    other = lumped.history(2.0, 3.5, 1.21 * 0.25, 0.5)
    np.testing.assert_allclose(one.velocity, other.velocity, rtol=1e-13)


# One contact.


@pytest.mark.parametrize("loss", LOSSES)
@pytest.mark.parametrize("groups", GROUPS)
@pytest.mark.parametrize("x", [0.0, 0.05, 1.0, 2.5, 12.0])
def test_a_history_is_that_of_its_rebound(groups, x, loss):
    contact = lumped.history(x, *groups, samples=4000, loss=loss)
    result = lumped.rebound(x, *groups, loss=loss)
    share = np.abs(contact.friction_force).max() / contact.normal.max()
    assert share == pytest.approx(result.peak_friction, abs=1e-5)
    assert (np.diff(contact.time) >= 0).all() and contact.time[0] == 0
    _, zeta2, e = groups
    law = losses.LUMPED[loss]
    assert contact.time[-1] == (2 if law.dashpots else 1 + e)
    if not law.dashpots:
        stiffness = law.stiffness_ratio(zeta2, e)
        np.testing.assert_allclose(contact.spring, stiffness * contact.friction_force)
    kinds, times = zip(*[event[:2] for event in contact.events], strict=True)
    assert kinds[0] == EventKind.CONTACT and kinds[-1] == EventKind.SEPARATION
    assert kinds.count(EventKind.MAXIMUM_COMPRESSION) == 1
    assert list(times) == sorted(times) and set(times) <= set(contact.time)
    assert times[kinds.index(EventKind.MAXIMUM_COMPRESSION)] == 1
    columns = np.stack([getattr(contact, name) for name in Event._fields[1:]])
    for event in contact.events:  # each has the state of a vertex at its time
        state = np.array(event[1:], float)[:, None]
        assert (columns == state).all(axis=0).any(), event
    mirrored = lumped.history(-x, *groups, samples=4000, loss=loss)
    for name in ("friction_force", "velocity", "spring"):
        np.testing.assert_array_equal(getattr(mirrored, name), -getattr(contact, name))
    np.testing.assert_array_equal(mirrored.normal, contact.normal)


def test_without_restitution_the_spring_keeps_the_rest_of_the_loss():
    contact, result = lumped.history(1.0, restitution=0.0), lumped.rebound(1.0, restitution=0.0)
    strain = 1.21 * contact.friction_force[-1] ** 2 / 2
    work = lumped.friction_work(1.0, restitution=0.0)
    assert work + strain == pytest.approx(result.dissipation, abs=1e-14)
    assert result.regime is Regime.STICK


# Digits of small results.


@pytest.mark.parametrize(
    ("field", "bound", "case"),
    [
        # N and |T| stay together from maximum compression on.
        ("velocity", 1e-15, (0.9999999998255678, 1.0, 0.344897342622378, 0.5872796115786215)),
        # Slip starts at separation, where rounding puts it behind.
        ("velocity", 1e-15, (0.9999999999333825, 1.0, 1.0, 1.0)),
        # Friction far below the amplitude that it would reach later: 7e-12.
        ("peak_friction", 1e-26, (1.0655893404136876, 1.0655789130626547, 256863749330.29388, 0.1)),
        # Hardly anything is lost, 2e-20.
        ("dissipation", 1e-34, (1e-5, 1.0, 1e10, 0.3)),
        # Slip starts near a double zero.
        ("dissipation", 1e-15, (1.7420800000000003, 41.8356, 1.74208, 1.0)),
    ],
)
def test_small_results_keep_their_digits(field, bound, case):
    exact = getattr(high_precision.rebound(*case, digits=60), field)
    assert abs(float(getattr(lumped.rebound(*case), field) - exact)) <= bound


def test_a_tiny_incidence_is_a_small_one_scaled():
    """Also one below the least of ordinary numbers: what comes to rest is never refused."""
    _, *groups = drawn(300)
    for loss in LOSSES:
        small = lumped.rebound(1e-30, *groups, loss=loss)
        for x in (1e-100, 1e-300, 5e-324):
            tiny = lumped.rebound(x, *groups, loss=loss)
            for one, other in zip(tiny[:2], small[:2], strict=True):
                np.testing.assert_allclose(one, other * (x / 1e-30), rtol=1e-12, atol=1e-322)


# Searches that take another way.


def test_a_solver_gone_wrong_does_not_run_for_ever(monkeypatch):
    """More phases than half-waves of the tangential oscillation cannot be."""
    assert lumped.rebound(2.0, 3.5, 0.1).regime == Regime.MULTIPLE
    monkeypatch.setattr(stick_slip, "most_sticks", lambda *_: 1)
    with pytest.raises(ConvergenceError, match="1 impacts stick more often"):
        lumped.rebound(2.0, 3.5, 0.1)
