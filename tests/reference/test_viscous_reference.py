"""Two viscous elements against independent answers: 40 digits, small steps, and the energy."""

import csv
import math
from pathlib import Path

import numpy as np
import pytest
from mpmath import mp

from planarimpact import Regime, lumped
from tests.reference_solutions import table_files, viscous_precision, viscous_tables

TABLE = Path(__file__).parents[2] / "data/lumped_viscous/impacts.csv"
PROMISED = 1e-12
OUTPUTS = ("velocity", "peak_friction", "dissipation")


def scales(x, beta, e):
    """What `lumped.rebound` promises the errors beside."""
    work = np.minimum(x / (2 * beta), 1 + e) * x
    return np.maximum(np.maximum(x, beta), 1), np.ones_like(x), np.maximum(work, 1e-300)


def table():
    with open(TABLE, newline="", encoding="utf-8") as file:
        header, *rows = csv.reader(file)
    assert header == viscous_tables.HEADER
    return np.array(rows, dtype=object)


def test_every_impact_of_the_table():
    rows = table()
    x, beta, zeta2, e = rows[:, :4].astype(float).T
    found = lumped.rebound(x, beta, zeta2, e, loss="viscous")
    for column, name, scale in zip(range(4, 7), OUTPUTS, scales(x, beta, e), strict=True):
        exact = rows[:, column].astype(float)
        error = np.abs(getattr(found, name) - exact) / scale
        assert error.max() <= PROMISED, (name, error.max(), rows[error.argmax(), :4])


def test_the_table_covers_the_box_and_its_thresholds():
    rows = table()
    x, beta, zeta2, e = rows[:, :4].astype(float).T
    assert x.min() < 1e-11 and x.max() > 19 and beta.min() == 1 and beta.max() == 8
    assert zeta2.min() < 0.11 and zeta2.max() > 9 and e.min() < 0.02 and e.max() == 1 - 2**-53
    assert (zeta2 == beta).any() and (e == viscous_tables.CRITICAL).sum() > 20
    beside = set()
    for point in zip(x, beta, zeta2, e, strict=True):
        for which, place in enumerate(viscous_tables.thresholds(*point[1:])):
            for side in (np.nextafter(place, 0), place, np.nextafter(place, np.inf)):
                if point[0] == side:
                    beside.add((which, float(np.sign(point[0] - place))))
    assert beside == {(which, side) for which in range(4) for side in (-1.0, 0.0, 1.0)}
    assert rows[:, -1].astype(float).max() >= 9


def test_rows_are_what_the_reference_computes():
    for row in table()[::60].tolist():
        point = tuple(map(float, row[:4]))
        again = table_files.Table([], [lambda point=point: viscous_tables.row(point)])
        assert again.cells(0) == row


def test_a_wrong_solver_would_be_seen():
    """The bound is no formality: a slightly wrong parameter breaks it."""
    exact = viscous_precision.rebound(2.5, 3.5, 1.21, 0.5)
    wrong = lumped.rebound(2.5, 3.5, 1.21, 0.5 + 1e-11, loss="viscous")
    assert abs(float(wrong.velocity - exact.velocity)) > PROMISED


def worst_error(point):
    exact = viscous_precision.rebound(*point)
    found = lumped.rebound(*point, loss="viscous")
    bounds = scales(*np.array([point[0], point[1], point[3]]))
    pairs = zip(OUTPUTS, bounds, strict=True)
    return max(abs(float(getattr(found, n) - getattr(exact, n))) / float(s) for n, s in pairs)


@pytest.mark.parametrize("seed", [0, *(pytest.param(s, marks=pytest.mark.long) for s in (1, 2, 3))])
def test_random_impacts_against_40_digits(seed):
    rng = np.random.default_rng(seed)
    for _ in range(60):
        e = rng.choice(
            [rng.uniform(0.01, 1), 10 ** rng.uniform(-2, 0), 1 - 10 ** rng.uniform(-12, 0)]
        )
        groups = rng.uniform(1, 8), 10 ** rng.uniform(-1, 1), float(max(e, 0.01))
        x = float(rng.choice([rng.uniform(0, 20), rng.uniform(0, 4), 10 ** rng.uniform(-12, 0)]))
        assert worst_error((x, *groups)) <= PROMISED, (x, *groups)


@pytest.mark.parametrize("seed", [0, *(pytest.param(s, marks=pytest.mark.long) for s in (1, 2, 3))])
def test_a_last_slip_of_no_length(seed):
    """With little loss and a soft tangential element slip begins just before separation."""
    rng = np.random.default_rng(seed)
    found = (1.1802952482075958e-05, 1.530372937008003, 8.689591378611864, 0.999999996890692)
    points = [found]
    for _ in range(20):
        beta, x = rng.uniform(1, 8), 10 ** rng.uniform(-6, -3)
        e = 1 - x * 10 ** rng.uniform(-5, -2)
        points.append((x, beta, beta * 10 ** rng.uniform(0, 1.5), e))
    for point in points:
        assert worst_error(point) <= PROMISED, point


@pytest.mark.parametrize(
    "point",
    [
        (1.0, 3.5, 1.21, 1e-3),  # the ends of the range
        (2.0, 1e6, 1e3, 0.5),
        (0.5, 1.0, 1e6, 0.9),
        (1e-30, 3.5, 1.21, 0.7),
        (2.0, 3.5, 3.5e-4, 0.9),
    ],
)
def test_outside_the_box(point):
    assert worst_error(point) <= PROMISED


@pytest.mark.parametrize("x", [0.3, 1.0, 3.0, 6.0])
@pytest.mark.parametrize("groups", [(3.5, 1.21, 0.5), (8.0, 0.2, 0.9), (2.0, 5.0, 0.05)])
def test_all_energy_is_accounted_for(x, groups):
    """Friction, both dashpots, the strain left in both springs, and what still moves."""
    beta, zeta2, e = groups
    answer = viscous_precision.rebound(x, beta, zeta2, e)
    found = lumped.rebound(x, *groups, loss="viscous")
    contact = lumped.history(x, *groups, loss="viscous")
    strain = contact.spring[-1] ** 2 / (2 * zeta2)
    assert abs(strain - float(answer.tangential_strain)) < 1e-13
    parts = found.dissipation + float(answer.tangential_viscous) + strain
    assert abs(x * x / (2 * beta) - found.velocity**2 / (2 * beta) - parts) < PROMISED
    with mp.workdps(40):
        normal = (1 - mp.mpf(e) ** 2) / 2 - answer.normal_viscous - answer.normal_strain
        assert abs(normal) < 1e-30


def test_against_small_steps_that_know_no_phases():
    """Trial stick, then cap |T| at N: the error falls as the square of the step."""
    rng = np.random.default_rng(7)
    x, beta = rng.uniform(0, 12, 300), rng.uniform(1, 8, 300)
    zeta2, e = 10 ** rng.uniform(-1, 1, 300), rng.uniform(0.05, 1, 300)
    exact = lumped.rebound(x, beta, zeta2, e, loss="viscous").velocity
    coarse, fine = (np.abs(_stepped(x, beta, zeta2, e, n) - exact) for n in (2000, 4000))
    assert fine.max() < 2e-5
    assert np.median(coarse[fine > 1e-13] / fine[fine > 1e-13]) > 3.5


def _stepped(x, beta, zeta2, e, steps):
    """Velocity at separation by the trapezoidal rule, with xi from the formula by bisection."""
    low, high = np.zeros_like(e), np.full_like(e, 20.0)
    for _ in range(60):
        xi = (low + high) / 2
        too_bouncy = _duration(xi)[1] > e
        low, high = np.where(too_bouncy, xi, low), np.where(too_bouncy, high, xi)
    tau, (end, _) = 2 * xi, _duration(xi)
    root = np.sqrt((1 - xi * xi).astype(complex))
    w, s, step = x.copy(), np.zeros_like(x), end / steps
    rate = w.copy()  # s'
    for k in range(1, steps + 1):
        time = k * step
        u = (np.exp(-xi * time) * np.sin(root * time) / root).real
        v = (np.exp(-xi * time) * (np.cos(root * time) - xi * np.sin(root * time) / root)).real
        force = np.maximum(u + tau * v, 0.0)
        if k == 1:
            friction = np.clip(tau * x / zeta2, -tau, tau)
            rate = zeta2 * friction / tau
        # Stick: s' = w at the end; s and w by the trapezoidal rule.
        half = step / 2
        known, body = s + half * rate, w - beta * half * friction
        trial = (known + (half + tau) * body) / (zeta2 + beta * half * (half + tau))
        friction = np.clip(trial, -force, force)
        w = body - beta * half * friction
        rate = (zeta2 * friction - known) / (half + tau)
        s = known + half * rate
    return w


def _duration(xi):
    root = np.sqrt((1 - xi * xi).astype(complex))
    root = np.where(root == 0, 1e-9, root)
    # The angle of N = 0 from 0 to pi; its logarithm is right for imaginary roots too.
    time = (np.pi / 2 - np.arcsin(np.clip(xi, 0, 1))) * 2 / np.where(xi < 1, root.real, 1)
    over = 2 * np.arccosh(np.maximum(xi, 1)) / np.where(xi > 1, root.imag, 1)
    time = np.where(xi < 1, time, over)
    return time, np.exp(-xi * time)


@pytest.mark.parametrize("count", [1200, pytest.param(6000, marks=pytest.mark.long)])
def test_next_to_every_change_of_course(count):
    """Bisection finds neighbours of different regime; sprayed around, no answer jumps."""
    rng = np.random.default_rng(1994)
    beta, zeta2 = rng.uniform(1, 8, count), 10 ** rng.uniform(-1, 1, count)
    e = np.where(
        rng.random(count) < 0.4, 1 - 10 ** rng.uniform(-8, -1, count), rng.uniform(0.01, 1, count)
    )
    limit = lumped.slip_throughout_limit(beta, zeta2, e, loss="viscous")
    low = np.array([limit * rng.random(count), beta, zeta2, e])
    which, lane = rng.integers(0, 4, count), np.arange(count)
    high = low.copy()
    high[which, lane] *= np.exp(rng.normal(0, 0.5, count))
    high = within(high)
    first = regimes(low)
    changes = first != regimes(high)
    low, high, which, first = low[:, changes], high[:, changes], which[changes], first[changes]
    for _ in range(60):
        middle = (low + high) / 2
        same = regimes(middle) == first
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    assert which.size > count / 8
    multiple = (first == Regime.MULTIPLE) | (regimes(high) == Regime.MULTIPLE)
    assert multiple.sum() > count / 120
    lane = np.arange(which.size)
    for distance in 10.0 ** np.arange(-16, -3.5, 0.5):
        for side in (-1, 1):
            near = low.copy()
            near[which, lane] *= 1 + side * distance * rng.uniform(1, 3, which.size)
            near = within(near)
            there = low.copy()
            there[which, lane] = near[which, lane] * (1 + 1e-13)
            moved = np.abs(outputs(within(there)) - outputs(near))
            # Ten times the effect of a step of 1e-13, and rounding.
            assert (moved / scale_of(near)).max() < 3e-12 + 1e-13
    spread = np.flatnonzero(multiple)[:: max(1, multiple.sum() // 6)]
    for k in (*spread, *range(0, which.size, which.size // 6)):
        assert worst_error(tuple(map(float, low[:, k]))) <= PROMISED
        assert worst_error(tuple(map(float, high[:, k]))) <= PROMISED


def within(groups):
    x, beta, zeta2, e = groups
    return np.array([x, np.clip(beta, 1, 8), zeta2, np.clip(e, 0.01, math.nextafter(1, 0))])


def outputs(groups):
    return np.stack(lumped.rebound(*groups, loss="viscous")[:3])


def regimes(groups):
    return lumped.rebound(*groups, loss="viscous").regime


def scale_of(groups):
    x, beta, zeta2, e = groups
    velocity, one, work = scales(x, beta, e)
    return np.stack([velocity, one, np.maximum(work, (x * x / beta) * np.sqrt(beta / zeta2))])
