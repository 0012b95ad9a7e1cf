"""The non-collinear model: laws that hold for all impacts, random ones and those at thresholds.

Where the order of stick and slip changes, the state at separation has a kink but no jump. So its
second difference over a step h is of the order h, and needs no reference. Random impacts do not
come that close: what rounding spoils there is some ulps wide. Bisection does.
"""

import warnings
from functools import partial
from itertools import product

import numpy as np
import pytest

from planarimpact import lumped, noncollinear
from planarimpact.noncollinear import InverseMass

paper_rebound = partial(noncollinear.rebound, loss="hysteretic")
paper_history = partial(noncollinear.history, loss="hysteretic")

# Rounding of the velocities, some ulps a phase, and the largest change of a slope at a kink.
ROUNDING, KINK = 1e-12, 300.0
STEPS = [0.0, 1e-14, 1e-11, 1e-7]  # relative, at least one ulp


def arguments(groups):
    """Those of `rebound` for v1, beta, coupling, mu, e, zeta^2, and v2 = m2 = 1."""
    v1, beta, coupling, mu, e, zeta2 = groups
    return v1, 1.0, InverseMass(beta, coupling, np.ones_like(beta)), mu, e, zeta2


def solve(groups):
    """Rebound of groups of shape (6, n)."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)  # impacts given up: NaN, which fails
        return paper_rebound(*arguments(groups))


def draw(rng, count):
    """Impacts whose contact does not rattle long: e from 0.3, some elastic, some without."""
    beta = 10 ** rng.uniform(-0.7, 0.9, count)
    mu, zeta2 = 10 ** rng.uniform(-1, 0.7, count), 10 ** rng.uniform(-1, 1, count)
    e = np.clip(rng.uniform(0.3, 1.1, count), 0.3, 1.0)
    e[: count // 10] = 0.0
    share = rng.uniform(-0.97, 0.97, count)
    return np.array(
        [rng.uniform(-5, 5, count) * mu * zeta2, beta, share * np.sqrt(beta), mu, e, zeta2]
    )


def regimes(groups):
    result = solve(groups)
    return np.stack([result.regime, result.jams])


@pytest.fixture(scope="module")
def at_thresholds():
    """Impacts an ulp from a change of regime, and which of their groups leads across it."""
    rng, count = np.random.default_rng(2), 150
    inside = draw(rng, count)
    lanes, varied = np.arange(count), rng.integers(0, len(inside), count)
    across = inside.copy()
    across[varied, lanes] = draw(rng, count)[varied, lanes]
    # Of a body on both sides, and restitution on both or on neither.
    bodies = [coupling**2 < 0.95 * beta for _, beta, coupling, *_ in (inside, across)]
    sound = np.all(bodies, axis=0) & ((inside[4] == 0) == (across[4] == 0))
    inside, across, varied = inside[:, sound], across[:, sound], varied[sound]
    regime = regimes(inside)
    differs = (regimes(across) != regime).any(axis=0)
    inside, across, varied = inside[:, differs], across[:, differs], varied[differs]
    regime = regime[:, differs]
    lanes = np.arange(varied.size)
    assert varied.size > count / 6
    for _ in range(18):  # into eighths: that many impacts take hardly longer than one
        points = np.array([inside + (across - inside) * share / 8 for share in range(8)] + [across])
        moved = np.concatenate(points[1:8], axis=1)
        same = (regimes(moved) == np.tile(regime, 7)).all(axis=0).reshape(7, -1)
        first = np.argmin(np.concatenate([same, [np.zeros(varied.size, bool)]]), axis=0)
        inside, across = points[first, :, lanes].T, points[first + 1, :, lanes].T
    return across, varied


def neighbours(groups, varied, step):
    """The impacts a step below, at and above in the group that leads across; e stays up to 1."""
    lanes = np.arange(varied.size)
    at = groups[varied, lanes]
    step = np.maximum(step * np.abs(at), np.spacing(np.abs(at)))
    for sign in (-1, 0, 1):
        moved = groups.copy()
        moved[varied, lanes] = at + sign * step
        moved[4] = np.minimum(moved[4], 1.0)
        yield moved


@pytest.fixture(scope="module")
def impacts(at_thresholds):
    """Random ones, those beside thresholds, and round numbers, which are exactly at some."""
    rows = product([0, 1, -1.5], [0.25, 1, 4], [0, 0.5, -0.5], [0, 0.5, 2], [0, 0.5, 1], [0.5, 1])
    v1, beta, share, mu, e, zeta2 = np.array([*rows]).T
    coupling = share * np.sqrt(beta)
    v1 = v1 * zeta2 * np.where(mu > 0, mu, 1)
    rounded = np.array([v1, beta, coupling, mu, e, zeta2])
    beside = neighbours(*at_thresholds, 1e-11)
    return np.concatenate([rounded, draw(np.random.default_rng(7), 300), *beside], axis=1)


@pytest.fixture(scope="module")
def solved(impacts):
    return solve(impacts)


def test_a_threshold_is_a_kink_not_a_jump(at_thresholds):
    groups, varied = at_thresholds
    mass = InverseMass(groups[1], groups[2], np.ones(varied.size))
    energy = noncollinear.kinetic_energy(groups[0], 1.0, mass)
    # Largest velocities that this energy can give: of either direction, along its own mass.
    speed = np.sqrt(2 * energy * np.maximum(groups[1], 1.0))
    for step in STEPS:
        found = [solve(moved) for moved in neighbours(groups, varied, step)]
        below, at, above = (np.stack([result.tangential, result.normal]) for result in found)
        second = np.abs(below - 2 * at + above).max(axis=0) / speed
        # The one true jump: the contact just fails to let go, and friction presses it in again.
        rests = np.abs([result.normal for result in found]).min(axis=0) <= 0.02
        continuous = ~(rests & (groups[3] * np.abs(groups[2]) > 1))
        assert continuous.sum() > 0.9 * varied.size
        bad = continuous & ~(second <= ROUNDING + KINK * step)
        assert not bad.any(), (step, groups[:, bad].T[:3].tolist(), second[bad][:3])


def hard_impacts():
    """Masses near singular ones, and friction so large that it slips last at N = 1/mu."""
    rng = np.random.default_rng(9)
    singular = draw(rng, 100)
    share = np.sqrt(1 - 10 ** rng.uniform(-7, 0, 100))
    singular[2] = np.sign(singular[2]) * share * np.sqrt(singular[1])
    rough = [
        np.stack(np.broadcast_arrays(v1, 1.75, coupling, 10.0 ** np.arange(1, 13), 0.6, zeta2))
        for v1, coupling, zeta2 in ((2.0, 0.65, 1.21), (-1.5, -0.74, 20.0))
    ]
    return np.concatenate([singular, *rough], axis=1)


def test_energy_and_momentum_balance_and_friction_keeps_coulombs_law(impacts):
    groups = np.concatenate([impacts, hard_impacts()], axis=1)
    result = solve(groups)
    solved = np.isfinite(result.tangential)
    assert solved.mean() > 0.95 and solved[: impacts.shape[1]].all()
    groups, result = groups[:, solved], result._make(np.array(result)[:, solved])
    v1, v2, mass, friction, *_ = arguments(groups)
    impulse, normal_impulse = result.tangential_impulse, result.normal_impulse
    taken = (impulse * (v1 + result.tangential) + normal_impulse * (v2 + result.normal)) / 2
    lost = result.friction_work + result.hysteresis
    assert (np.abs(taken - lost) <= 1e-12 * noncollinear.kinetic_energy(v1, v2, mass)).all()
    assert (result.friction_work >= 0).all() and (result.normal <= 0).all()
    assert (result.peak_friction <= friction * result.peak_normal * (1 + 1e-13)).all()
    assert (np.abs(impulse) <= friction * normal_impulse * (1 + 1e-13)).all()
    change = np.array([v1 - result.tangential, v2 - result.normal])
    terms = np.array([[mass.tangential, -mass.coupling], [-mass.coupling, mass.normal]])
    terms = terms * [impulse, normal_impulse]
    rounding = 1e-13 * (np.hypot(v1, v2) + np.abs(terms).sum(axis=1))
    assert (np.abs(change - terms.sum(axis=1)) <= rounding).all()


def test_the_mirror_image_is_solved_alike(impacts, solved):
    v1, v2, mass, *rest = arguments(impacts)
    one = solved
    other = paper_rebound(-v1, v2, mass._replace(coupling=-mass.coupling), *rest)
    turned = other._replace(
        tangential=-other.tangential, tangential_impulse=-other.tangential_impulse
    )
    scale = (1 + np.abs(v1) + mass.tangential) / (1 - mass.coupling**2 / mass.tangential)
    off = np.abs(np.array(turned[:9]) - one[:9])
    assert (off <= 1e-12 * np.abs(one[:9]) + 1e-13 * scale).all()
    np.testing.assert_array_equal(np.array(other[9:]), one[9:])


@pytest.mark.parametrize("powers", [(44, -38, 15), (-48, 30, 50)])
def test_speed_mass_and_stiffness_only_scale(impacts, solved, powers):
    """Powers of 4, which no rounding touches, up to 1e30; halves of them for the energies."""
    speed, mass, stiffness = (4.0**power for power in powers)
    v1, v2, inverse, *rest = arguments(impacts)
    scaled = InverseMass(*(entry / mass for entry in inverse))
    result = paper_rebound(v1 * speed, v2 * speed, scaled, *rest, stiffness)
    force, energy = speed * (mass * stiffness) ** 0.5, mass * speed * speed
    units = [speed] * 2 + [mass * speed] * 2 + [force] * 2 + [energy] * 2
    units += [(mass / stiffness) ** 0.5]
    for found, one, unit in zip(result, solved, units, strict=False):
        np.testing.assert_array_equal(found, one * unit)


def test_history_keeps_coulombs_law_and_ends_at_the_rebound(impacts):
    for groups in impacts[:, ::31].T.tolist():
        v1, v2, mass, friction, *rest = arguments(groups)
        mass = InverseMass(groups[1], groups[2], 1.0)
        contact = paper_history(v1, v2, mass, friction, *rest, samples=50)
        result = paper_rebound(v1, v2, mass, friction, *rest)
        scale = contact.normal_force.max()
        rounding = 1e-12 * max(scale, np.abs(contact.friction_force).max())
        assert (np.abs(contact.friction_force) <= friction * contact.normal_force + rounding).all()
        assert (contact.normal_force >= 0).all() and (np.diff(contact.time) >= 0).all()
        reach = max(1.0, np.abs(contact.tangential).max())
        assert abs(contact.tangential[-1] - result.tangential) <= 1e-11 * reach
        assert abs(contact.normal[-1] - result.normal) <= 1e-11 * reach
        assert abs(contact.time[-1] - result.duration) <= 1e-12 * result.duration
        assert abs(scale - result.peak_normal) <= 1e-12 * scale
        states = np.stack([*contact[:4], contact.spring], axis=1)
        for event in contact.events:
            assert np.abs(states - event[1:]).max(axis=1).min() <= 1e-12 * np.abs(states).max()


def test_without_coupling_it_is_the_collinear_model_at_its_thresholds_too(impacts):
    rng = np.random.default_rng(3)
    _, beta, _, mu, e, zeta2 = draw(rng, 300)
    beta, mu, e = np.maximum(beta, 1), np.maximum(mu, 0.1), np.maximum(e, 0.05)
    limit = lumped.slip_throughout_limit(beta, zeta2, e)
    at = np.choose(rng.integers(0, 3, 300), [zeta2, limit, rng.random(300) * limit])
    for step in STEPS:
        for x in (at * (1 - step), np.nextafter(at, 0), at, np.nextafter(at, 99), at * (1 + step)):
            result = solve(np.array([mu * x, beta, np.zeros(300), mu, e, zeta2]))
            exact = lumped.rebound(x, beta, zeta2, e, loss="hysteretic")
            for found, wanted in (
                (result.tangential / mu, exact.velocity),
                (result.normal, -e),
                (result.peak_friction / mu, exact.peak_friction),
            ):
                np.testing.assert_allclose(found, wanted, atol=1e-12)
            lost = result.friction_work / mu**2
            np.testing.assert_allclose(lost, exact.dissipation, 1e-12, 1e-12)
