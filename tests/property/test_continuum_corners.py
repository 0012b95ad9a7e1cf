"""The tolerance of the elastic continuum, where it is hardest to keep.

Slip that only just happens, or does not, is decided by differences far smaller than one step of
the integration. It does so where beta, zeta^2 and the incidence are close to each other, and where
one more gross slip sets in as the incidence changes.
"""

import functools

import numpy as np
import pytest

from planarimpact import continuum, lumped
from planarimpact.continuum.micro_slip import ElasticSprings
from planarimpact.normal_impact import hertz

STEPS = 1024, 2048, 4096
SHARE = 0.1  # of a tolerance, to which the reference must agree with itself


def plain(x, beta, zeta2, steps):
    """Position Verlet in the velocity and displacement themselves, from first contact on.

    Returns the velocity, the largest friction at a step, and the number of gross slips.
    """
    step = np.pi / steps
    springs = ElasticSprings(np.zeros(x.size), steps)
    u, w, peak, slips = np.zeros(x.size), x.copy(), np.zeros(x.size), np.zeros(x.size, int)
    slid = np.ones(x.size, bool)
    for n in range(steps):
        for phase in ((n + 0.25) * step, (n + 0.75) * step):
            u = u + step / 2 * hertz.state(phase)[1] * w / zeta2
            if phase < (n + 0.5) * step:
                middle = (n + 0.5) * step
                force = springs.move(np.full(x.size, np.sin(middle)), u)
                w = w - step * 1.25 * beta * hertz.state(middle)[1] * force
        peak = np.maximum(peak, np.abs(force))
        gross = springs.stick_radius == 0
        slips += gross & ~slid
        slid = gross
    return w, peak, slips


@functools.cache
def known(impacts):
    """`reference` of impacts that are given as bytes, once for all tolerances."""
    return reference(*np.frombuffer(impacts).reshape(3, -1))


def reference(x, beta, zeta2):
    """Velocity, extrapolated, how far that moved with the last doubling, and peak friction."""
    coarse, fine, finer = (plain(x, beta, zeta2, n) for n in STEPS)
    before, better = (b[0] + (b[0] - a[0]) / 3 for a, b in ((coarse, fine), (fine, finer)))
    return better, np.abs(better - before), finer[1]


def onsets(beta, zeta2, low, high):
    """Incidences at which the number of gross slips changes, one for each pair, by bisection."""
    number = plain(low, beta, zeta2, 512)[2]
    for _ in range(12):
        middle = (low + high) / 2
        same = plain(middle, beta, zeta2, 512)[2] == number
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    return low


def corner():
    """Incidences, beta and zeta^2 all close to each other, to 1e-7 up to 1."""
    rng = np.random.default_rng(5)
    zeta2 = 10 ** rng.uniform(0.0, 1.2, 100)
    gap = zeta2 * 10 ** rng.uniform(-5.0, -0.5, 100)
    beta = np.maximum(1.0, zeta2 + rng.choice([-1, 1], 100) * gap)
    x = zeta2 + rng.choice([-1, -1, 1], 100) * gap * 10 ** rng.uniform(-3.0, 0.5, 100)
    found = [
        (7.754302603894945, 7.597869176313092, 7.755145884952939),
        (6.14405, 1.62588, 8.46260),
        (2.7993977525178293, 18.623598180509077, 0.605000672110507),
        (7.630833725514405, 7.742681694086329, 0.21935046973566377),
    ]
    return [np.concatenate(pair) for pair in zip((x, beta, zeta2), np.array(found).T, strict=True)]


def around_onsets(pairs):
    """Spread about the incidences at which one gross slip more sets in."""
    rng = np.random.default_rng(6)
    beta, zeta2 = rng.uniform(6.0, 20.0, pairs), 10 ** rng.uniform(-0.7, 0.0, pairs)
    limit = lumped.slip_throughout_limit(beta, zeta2)
    at = onsets(beta, zeta2, 0.05 * limit, 0.3 * limit)
    shift = rng.choice([-1, 1], (12, pairs)) * 10 ** rng.uniform(-6.0, -2.0, (12, pairs))
    return [a.ravel() for a in np.broadcast_arrays(at * (1 + shift), beta, zeta2)]


def assert_met(x, beta, zeta2, *tolerances):
    """Impacts that do not slide throughout meet each tolerance."""
    inside = (x > 0) & (x < lumped.slip_throughout_limit(beta, zeta2))
    x, beta, zeta2 = x[inside], beta[inside], zeta2[inside]
    velocity, moved, peak = known(np.array([x, beta, zeta2]).tobytes())
    # The largest of its points is below the peak by this at most: friction bends no more there
    # than three times as much as the normal force, sin(phase)^3.
    below = 9 / 8 * (np.pi / STEPS[-1]) ** 2
    for tolerance in tolerances:
        sure = moved <= SHARE * tolerance
        assert np.mean(sure) > 0.7
        found = continuum.rebound(x, beta, zeta2, tolerance=tolerance)
        error = np.where(sure, np.abs(found.velocity - velocity), 0.0)
        assert np.max(error) <= (1 + SHARE) * tolerance, (tolerance, np.argmax(error))
        error = np.where(sure, np.abs(found.peak_friction - peak), 0.0)
        assert np.max(error) <= (1 + SHARE) * tolerance + below, (tolerance, np.argmax(error))


@pytest.mark.slow
@pytest.mark.parametrize(
    "tolerance", [1e-3, 1e-4, 1e-5, pytest.param(1e-6, marks=pytest.mark.long)]
)
def test_the_tolerance_is_met_where_slip_only_just_happens(tolerance):
    assert_met(*corner(), tolerance)


@pytest.mark.slow
@pytest.mark.parametrize("pairs", [12, pytest.param(24, marks=pytest.mark.long)])
def test_the_tolerance_is_met_around_the_onset_of_one_more_slip(pairs):
    assert_met(*around_onsets(pairs), 1e-3, 1e-4)


def test_peak_friction_as_gross_slip_sets_in_after_maximum_compression():
    """The force meets its limit there with a root in its curvature, between two steps."""
    groups = np.array([[6.14405, 4.29879], [1.62588, 1.29697], [8.46260, 5.83369]])
    steps = 8192
    _, peak, _ = plain(*groups, steps)
    below = 9 / 8 * (np.pi / steps) ** 2
    for tolerance in (1e-4, 1e-5, 1e-6):
        found = continuum.rebound(*groups, tolerance=tolerance).peak_friction
        assert np.max(np.abs(found - peak)) <= tolerance + below
