"""Next to every change of an impact's course: its regime, number of phases, last direction of slip.

Random impacts miss these places. Here bisection finds them, in every parameter, and impacts from
one unit in the last place to 1e-4 around them are tried: against each other, where the answer must
not jump, and the most suspicious ones against 40 digits.
"""

import numpy as np
import pytest
from mpmath import mp

from planarimpact import Regime, lumped
from planarimpact.ground import sliding
from planarimpact.lumped import slip_onset, stick_slip
from tests.reference_solutions import extreme_tables

OUTPUTS = ("velocity", "peak_friction", "dissipation")
RESTITUTION = 3  # its place among the parameters
ULP = 2.0**-52
STEP = 1e-13  # of a parameter to its neighbour: far less than any loss that matters
DISTANCES = 10.0 ** np.arange(-16, -3.5, 0.5)
ALLOWED = 100  # what `lumped.rebound` promises: so many times the effect of rounding its arguments


def drawn(rng, count):
    """Groups on both sides of e omega/Omega = 1, e 1e-8 to 1, some incidences tiny."""
    beta = 10 ** rng.uniform(0, rng.choice([1, 6], count))
    e = rng.choice([1.0, 1 - ULP / 2, 0, 0, 0, 0], count)
    small = 10 ** np.where(rng.random(count) < 0.2, rng.uniform(-8, 0, count), -rng.random(count))
    e = np.where(e > 0, e, small)
    pace = np.choose(
        rng.integers(0, 4, count),
        [
            rng.uniform(0.2, 3, count),
            10 ** rng.uniform(-2, 1, count),
            1 + rng.choice([-1, 1], count) * 10 ** rng.uniform(-12, -1, count),
            e * rng.integers(1, 12, count) / rng.integers(1, 5, count),  # omega/Omega a ratio
        ],
    )
    zeta2 = beta * (e / pace) ** 2
    limit = sliding.limit(beta, zeta2, e)
    x = rng.random(count) * np.where(rng.random(count) < 0.5, limit, np.minimum(limit, zeta2))
    tiny = np.where(rng.random(count) < 0.1, rng.uniform(-140, 0, count), 0)
    return np.array([x * 10**tiny, beta, zeta2, e])


def courses(groups):
    """A number for each impact that changes with its regime, sticks or last direction of slip."""
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


def switches(rng, count):
    """Groups beside a change of course, and which parameter was moved to find it."""
    low = drawn(rng, count)
    which, lane = rng.choice(4, count, p=[0.55, 0.15, 0.15, 0.15]), np.arange(count)
    high = low.copy()
    high[which, lane] *= np.exp(rng.normal(0, 0.5, count))
    high = within(high)
    course = courses(low)
    changes = course != courses(high)
    low, high, which, course = low[:, changes], high[:, changes], which[changes], course[changes]
    for _ in range(60):
        middle = (low + high) / 2  # they differ in one parameter
        same = courses(middle) == course
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    assert (np.abs(high - low) <= 2 * ULP * high).all()
    return low, which


def sprayed(rng, groups, which):
    """Neighbours in the parameter that was moved, and in another one."""
    lane, found = np.arange(which.size), [groups]
    for distance in DISTANCES:
        for place in (which, rng.integers(0, 4, which.size)):
            for side in (-1, 1):
                near = groups.copy()
                near[place, lane] *= 1 + side * distance * rng.uniform(1, 3, which.size)
                found.append(within(near))
    return np.concatenate(found, axis=1)


def within(groups):
    x, beta, zeta2, e = groups
    return np.array([x, np.maximum(beta, 1), zeta2, np.minimum(e, 1)])


def outputs(groups):
    return np.stack(lumped.rebound(*groups)[:3])


def scales(groups):
    """What the outputs change by at most, over the relative change of a parameter.

    The sums over all parameters are bounded by 5, 2 and 7 times this in the table of
    data/lumped_extremes, see its test.
    """
    x, beta, zeta2, e = groups
    work = np.minimum(x, 2 * (1 + e) * beta) * (x / (2 * beta))
    return np.stack([np.maximum(x, beta), np.ones_like(x), (1 + np.sqrt(beta / zeta2)) * work])


@pytest.fixture(scope="module")
def impacts():
    rng = np.random.default_rng(1994)
    low, which = switches(rng, 3000)
    groups = sprayed(rng, low, which)
    rate = groups[3] * np.sqrt(groups[1] / groups[2])
    assert min((rate < 1).sum(), (rate > 1).sum()) > 20_000
    return groups


@pytest.fixture(scope="module")
def jumps(impacts):
    """Change of the outputs to the neighbours, at most, in units of `scales`; shape (3, n)."""
    here, most = outputs(impacts), np.zeros((3, impacts.shape[1]))
    for place in range(4):
        for side in (-1, 1):
            near = impacts.copy()
            near[place] *= 1 + side * STEP
            most = np.maximum(most, np.abs(outputs(within(near)) - here))
    return most / scales(impacts)


def test_no_answer_differs_from_its_neighbours(jumps):
    """A lost or invented phase does not strike two neighbours alike."""
    condition = np.array([[5], [2], [7]])
    assert (jumps <= condition * (STEP + ALLOWED * ULP)).all()


@pytest.mark.slow
def test_suspicious_answers_against_40_digits(impacts, jumps):
    x, beta, zeta2, e = impacts
    quick = (e * np.sqrt(beta / zeta2) < 12) & (e > 1e-6)  # for the reference
    ranks = [np.argsort(-np.where(quick, jump, 0))[:20] for jump in jumps]
    spread = np.flatnonzero(quick)[::1500]
    for lane in np.unique(np.concatenate([*ranks, spread])):
        point = tuple(map(float, impacts[:, lane]))
        _, *exact = map(mp.mpf, extreme_tables.row(point)[3:10])
        found = lumped.rebound(*point)
        for name, value, condition in zip(OUTPUTS, exact[:3], exact[3:], strict=True):
            error = abs(getattr(found, name) - value)
            assert error <= ALLOWED * ULP * (abs(value) + condition), (name, point)


def test_one_and_many_and_history_agree(impacts):
    batch = lumped.rebound(*impacts)
    for lane in range(0, impacts.shape[1], 400):
        x, beta, *_ = point = tuple(map(float, impacts[:, lane]))
        alone = lumped.rebound(*point)
        assert tuple(alone[:4]) == tuple(field[lane] for field in batch[:4]), point
        contact = lumped.history(*point, samples=2)
        assert abs(contact.velocity[-1] - alone.velocity) <= ALLOWED * ULP * max(x, beta), point
        assert (np.abs(contact.friction) <= contact.normal + ALLOWED * ULP).all(), point
        phases = sum(event.kind in ("stick", "slip") for event in contact.events)
        assert (phases > 3) == (alone.regime == Regime.MULTIPLE), point
