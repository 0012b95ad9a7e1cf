"""Impacts on which every law of the lumped model is tried.

Random impacts miss the places where an impact changes its course: its regime, its number of sticks,
the last direction of slip. So bisection finds these, in every parameter, and impacts from one unit
in the last place to 1e-4 around them are taken. With them come the thresholds that are known and
their neighbours, and equal ratios (where T stays in proportion to N).
"""

import numpy as np
import pytest

from planarimpact import lumped
from planarimpact.lumped import slip_onset, stick_slip

ULP = 2.0**-52
DISTANCES = 10.0 ** np.arange(-16, -3.5, 0.5)
# Least and largest beta, zeta^2 and e, where digits are promised in full.
BOX = {
    "hysteretic": [(1, 1e12), (1e-12, 1e12), (0, 1)],
    "viscous": [(1, 8), (0.1, 10), (0.01, 1 - ULP / 2)],
}


def drawn(rng, count, loss):
    """Groups on both sides of e omega/Omega = 1, e 1e-8 to 1, some incidences tiny."""
    powers = [1, 6] if loss == "hysteretic" else [0.9, 0.9]
    beta = 10 ** rng.uniform(0, rng.choice(powers, count))
    small = 10 ** np.where(rng.random(count) < 0.2, rng.uniform(-8, 0, count), -rng.random(count))
    near_1 = 1 - 10 ** rng.uniform(-12, -1, count)
    e = np.choose(rng.integers(0, 6, count), [1.0, 1 - ULP / 2, near_1, small, small, small])
    pace = np.choose(
        rng.integers(0, 4, count),
        [
            rng.uniform(0.2, 3, count),
            10 ** rng.uniform(-2, 1, count),
            1 + rng.choice([-1, 1], count) * 10 ** rng.uniform(-12, -1, count),
            e * rng.integers(1, 12, count) / rng.integers(1, 5, count),  # omega/Omega a ratio
        ],
    )
    _, *groups = within([beta, beta, beta * (e / pace) ** 2, e], loss)
    limit = lumped.slip_throughout_limit(*groups, loss=loss)
    x = rng.random(count) * np.where(rng.random(count) < 0.5, limit, np.minimum(limit, groups[1]))
    tiny = np.where(rng.random(count) < 0.1, rng.uniform(-140, 0, count), 0)
    return np.array([x * 10**tiny, *groups])


def within(groups, loss):
    x, *ratios = groups
    beta, zeta2, e = (np.clip(r, *ends) for r, ends in zip(ratios, BOX[loss], strict=True))
    stiffest = 1.000001e-8 * beta  # omega/Omega up to 1e4
    return np.array([x, beta, np.maximum(zeta2, stiffest), e])


def courses(groups, loss):
    """A number for each impact that changes with its course."""
    if loss == "viscous":
        return lumped.rebound(*groups, loss=loss).regime
    sticks, side, now = np.zeros(groups.shape[1], int), np.ones(groups.shape[1]), []
    stick, onset = stick_slip.Stick, slip_onset.in_restitution

    def begin(*fields):
        now[:] = [stick(*fields)]
        return now[0]

    def end(*state):
        eta, rho, wave = onset(*state)
        sticks[now[0].which] += 1
        side[now[0].which] = now[0].side * (-1) ** (wave % 2)
        return eta, rho, wave

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(stick_slip, "Stick", begin)
        patch.setattr(slip_onset, "in_restitution", end)
        regime = stick_slip.solve(stick_slip.Impacts(*groups)).regime
    return 100 * sticks + 10 * regime + (side > 0)


def switches(rng, count, loss):
    """Groups beside a change of course, and which parameter was moved to find it."""
    low = drawn(rng, count, loss)
    which, lane = rng.choice(4, count, p=[0.55, 0.15, 0.15, 0.15]), np.arange(count)
    high = low.copy()
    high[which, lane] *= np.exp(rng.normal(0, 0.5, count))
    high = within(high, loss)
    course = courses(low, loss)
    changes = course != courses(high, loss)
    low, high, which, course = low[:, changes], high[:, changes], which[changes], course[changes]
    for _ in range(60):
        middle = (low + high) / 2  # they differ in one parameter
        same = courses(middle, loss) == course
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    assert (np.abs(high - low) <= 2 * ULP * high).all()
    return low, which


def sprayed(rng, groups, which, loss):
    """Neighbours in the parameter that was moved, and in another one."""
    lane, found = np.arange(which.size), [groups]
    for distance in DISTANCES:
        for place in (which, rng.integers(0, 4, which.size)):
            for side in (-1, 1):
                near = groups.copy()
                near[place, lane] *= 1 + side * distance * rng.uniform(1, 3, which.size)
                found.append(within(near, loss))
    return np.concatenate(found, axis=1)


def thresholds(beta, zeta2, e, loss):
    """Incidences where the order of phases changes by its formula, and neighbours: (3, 5, n)."""
    limit = lumped.slip_throughout_limit(beta, zeta2, e, loss=loss)
    omega = np.minimum(np.sqrt(beta / zeta2), 1)
    breaks = zeta2 * omega / np.sin(omega * np.pi / 2)  # stick, before maximum compression
    at = np.stack([zeta2, beta, limit, (1 + e) * beta, breaks])
    return np.stack([np.nextafter(at, 0), at, np.nextafter(at, np.inf)])


def equal_ratios(loss):
    """Next to zeta^2 = beta, at all distances."""
    near = 1 + np.concatenate([[0], -np.geomspace(1e-16, 1e-3, 60), np.geomspace(1e-16, 1e-3, 60)])
    beta, near, e = np.meshgrid([1.0, 5.119047748496251], near, [0.01, np.exp(-2), 0.999, 1.0])
    least = 1e-17 if loss == "hysteretic" else 1e-3
    x = beta * near * np.reshape([least, 0.3, 1 - ULP, 1.0], (4, 1, 1, 1))
    groups = np.stack(np.broadcast_arrays(x, beta, beta * near, e)).reshape(4, -1)
    return within(groups, loss)


def ordinary(rng, loss):
    """Impacts whose answers have all digits that are promised."""
    low, which = switches(rng, {"hysteretic": 2000, "viscous": 500}[loss], loss)
    assert which.size > 40
    _, *groups = drawn(rng, 200, loss)
    at = np.stack(np.broadcast_arrays(thresholds(*groups, loss), *groups)).reshape(4, -1)
    found = np.concatenate([sprayed(rng, low, which, loss), at, equal_ratios(loss)], axis=1)
    return found if loss == "hysteretic" else found[:, ::6]  # with dashpots each takes longer


def scales(groups, loss):
    """What the outputs change by at most, over the relative change of a parameter; shape (3, n).

    Without viscosity the sums over all parameters are bounded by 5, 2 and 7 times this in the table
    of data/lumped_extremes, see its test. With it they are smaller.
    """
    x, beta, zeta2, e = groups
    work = np.minimum(x, 2 * (1 + e) * beta) * (x / (2 * beta))
    if loss == "viscous":
        kinetic = np.maximum(work, x * x / beta * np.sqrt(beta / zeta2))
        return np.stack([np.maximum(np.maximum(x, beta), 1), np.ones_like(x), kinetic])
    swings = 1 + np.sqrt(beta / zeta2)
    return np.stack([5 * np.maximum(x, beta), np.full_like(x, 2), 7 * swings * work])
