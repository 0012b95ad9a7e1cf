"""The non-collinear model at its thresholds: bisection towards each, then neighbours around it.

Where the order of stick and slip changes, the state at separation has a kink but no jump. So its
second difference over a step h is of the order h, and needs no reference. Random impacts do not
come that close: what rounding spoils there is some ulps wide.
"""

import warnings
from functools import partial

import numpy as np
import pytest

from planarimpact import lumped, noncollinear
from planarimpact.noncollinear import InverseMass

paper_rebound = partial(noncollinear.rebound, loss="hysteretic")

# Rounding of the velocities, some ulps a phase, and the largest change of a slope at a kink.
ROUNDING, KINK = 1e-12, 300.0
STEPS = [0.0, 1e-14, 1e-11, 1e-7]  # relative, at least one ulp


def solve(groups):
    """Rebound at v1, beta, coupling, mu, e, zeta^2, shape (6, n), for v2 = m2 = 1."""
    v1, beta, coupling, mu, e, zeta2 = groups
    mass = InverseMass(beta, coupling, np.ones_like(beta))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)  # impacts given up: NaN, which fails
        return paper_rebound(v1, 1.0, mass, mu, e, zeta2)


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


def thresholds(seed, count, solve_regimes, draw_groups, sound):
    """Impacts an ulp from a change of regime, and which of their groups leads across it."""
    rng = np.random.default_rng(seed)
    inside = draw_groups(rng, count)
    lanes, varied = np.arange(count), rng.integers(0, len(inside), count)
    across = inside.copy()
    across[varied, lanes] = draw_groups(rng, count)[varied, lanes]
    differs = sound(inside, across)
    inside, across, varied = inside[:, differs], across[:, differs], varied[differs]
    regime = solve_regimes(inside)
    differs = (solve_regimes(across) != regime).any(axis=0)
    inside, across, varied = inside[:, differs], across[:, differs], varied[differs]
    regime = regime[:, differs]
    for _ in range(53):
        middle = (inside + across) / 2
        same = (solve_regimes(middle) == regime).all(axis=0)
        inside, across = np.where(same, middle, inside), np.where(same, across, middle)
    return across, varied


def neighbours(groups, varied, step):
    """The impacts a step below, at and above in the group that leads across; e stays up to 1."""
    lanes = np.arange(varied.size)
    at = groups[varied, lanes]
    step = np.maximum(step * np.abs(at), np.spacing(np.abs(at)))
    for sign in (-1, 0, 1):
        moved = groups.copy()
        moved[varied, lanes] = at + sign * step
        yield moved


def regimes(groups):
    result = solve(groups)
    return np.stack([result.regime, result.jams])


def both_sound(*sides):
    """Of a body on both sides, and restitution on both or on neither."""
    bodies = [coupling**2 < 0.95 * beta for _, beta, coupling, *_ in sides]
    return np.all(bodies, axis=0) & ((sides[0][4] == 0) == (sides[1][4] == 0))


@pytest.mark.slow
@pytest.mark.parametrize("count", [300, pytest.param(600, marks=pytest.mark.long)])
def test_a_threshold_is_a_kink_not_a_jump(count):
    groups, varied = thresholds(2, count, regimes, draw, both_sound)
    assert varied.size > count / 6
    mass = InverseMass(groups[1], groups[2], np.ones(varied.size))
    energy = noncollinear.kinetic_energy(groups[0], 1.0, mass)
    # Largest velocities that this energy can give: of either direction, along its own mass.
    speed = np.sqrt(2 * energy * np.maximum(groups[1], 1.0))
    for step in STEPS:
        found = []
        for moved in neighbours(groups, varied, step):
            moved[4] = np.minimum(moved[4], 1.0)
            found.append(solve(moved))
        below, at, above = (np.stack([result.tangential, result.normal]) for result in found)
        second = np.abs(below - 2 * at + above).max(axis=0) / speed
        # The one true jump: the contact just fails to let go, and friction presses it in again.
        rests = np.abs([result.normal for result in found]).min(axis=0) <= 0.02
        continuous = ~(rests & (groups[3] * np.abs(groups[2]) > 1))
        assert continuous.sum() > 0.9 * varied.size
        bad = continuous & ~(second <= ROUNDING + KINK * step)
        assert not bad.any(), (step, groups[:, bad].T[:3].tolist(), second[bad][:3])


@pytest.mark.slow
@pytest.mark.parametrize("tries", [200, pytest.param(300, marks=pytest.mark.long)])
def test_without_coupling_its_thresholds_are_those_of_the_collinear_model(tries):
    def collinear(rng, count):
        beta, zeta2 = 1 + 9 * rng.random(count) ** 2, 10 ** rng.uniform(-1, 1, count)
        x = rng.uniform(0, 6, count) * np.sqrt(zeta2)
        return np.array([x, beta, rng.uniform(0.05, 1, count), zeta2])

    def rebound(groups):
        x, beta, e, zeta2 = groups
        return solve(np.array([x, beta, np.zeros_like(x), np.ones_like(x), e, zeta2]))

    groups, varied = thresholds(
        3, tries, lambda g: rebound(g).regime[None], collinear, lambda *_: slice(None)
    )
    assert varied.size > tries / 4
    for step in STEPS:
        for moved in neighbours(groups, varied, step):
            moved[2] = np.minimum(moved[2], 1.0)
            x, beta, e, zeta2 = moved
            result, exact = rebound(moved), lumped.rebound(x, beta, zeta2, e)
            np.testing.assert_allclose(result.tangential, exact.velocity, atol=1e-12)
            np.testing.assert_allclose(result.normal, -e, atol=1e-12)
            np.testing.assert_allclose(result.peak_friction, exact.peak_friction, atol=1e-12)
            np.testing.assert_allclose(result.friction_work, exact.dissipation, 1e-12, 1e-12)
