"""The lumped model against independent answers: 40 digits, and small steps."""

import math
from itertools import product

import numpy as np
import pytest

from planarimpact import Regime, bodies, lumped
from tests.reference_solutions import exact_tables, high_precision

PROMISED = 1e-12
# At limits of regimes, and between: zeta^2, beta, and slip throughout at e = 1.
INCIDENCES = (0.0, 0.025, 0.8, 24 * 0.05, 1.225, 3.0, 3.5, 4.0, 5.775, 116 * 0.05, 8.0)


def worst_error(x, beta, zeta2, e):
    """Largest error of velocity, peak friction and dissipation, over max(1, |w|)."""
    exact = high_precision.rebound(x, beta, zeta2, e)
    found = lumped.rebound(x, beta, zeta2, e)
    scale = max(1.0, abs(float(exact.velocity)))
    fields = ("velocity", "peak_friction", "dissipation")
    return max(abs(float(getattr(found, f) - getattr(exact, f))) for f in fields) / scale


def thresholds(beta, zeta2, e):
    """Every threshold in 0 to 20 with its neighbours."""
    places = [0.0, zeta2, beta, (1 + e) * beta, float(lumped.slip_throughout_limit(beta, zeta2, e))]
    if zeta2 > beta:  # stick may break before maximum compression from here on
        omega = math.sqrt(beta / zeta2)
        places.append(zeta2 * omega / math.sin(omega * math.pi / 2))
    near = [
        f(v)
        for v in places
        for f in (lambda v: v, lambda v: np.nextafter(v, -1), lambda v: np.nextafter(v, 99))
    ]
    return [float(x) for x in near if 0 <= x <= 20]


ORDERS = {
    ("stick",): Regime.STICK,
    ("slip", "stick"): Regime.SLIP_STICK,
    ("stick", "slip"): Regime.STICK_SLIP,
    ("slip", "stick", "slip"): Regime.SLIP_STICK_SLIP,
    ("slip",): Regime.SLIP_THROUGHOUT,
}


def test_regimes_are_the_order_of_stick_and_slip_in_the_reference():
    for e, zeta2, x in product((0.0, 0.01, 0.15, 0.5, 0.59, 0.9, 1.0), (1.21, 3.0), INCIDENCES):
        events = high_precision.rebound(x, 3.5, zeta2, e).events
        phases = tuple(event.kind for event in events if event.kind in ("stick", "slip"))
        wanted = ORDERS.get(phases, Regime.MULTIPLE) if x else Regime.STICK
        assert lumped.rebound(x, 3.5, zeta2, e).regime == wanted, (x, zeta2, e)


@pytest.mark.parametrize(
    "seed", [0, *(pytest.param(seed, marks=pytest.mark.slow) for seed in range(1, 8))]
)
def test_random_impacts_against_40_digits(seed):
    rng = np.random.default_rng(seed)
    for _ in range(400):
        restitution = rng.choice([rng.uniform(0, 1), 10 ** rng.uniform(-12, 0), 0.0, 1.0])
        groups = rng.uniform(1, 8), 10 ** rng.uniform(-1, 1), float(restitution)
        x = float(rng.choice([rng.uniform(0, 20), rng.uniform(0, 4), 10 ** rng.uniform(-12, 0)]))
        assert worst_error(x, *groups) <= PROMISED, (x, *groups)


@pytest.mark.parametrize("beta", [1.0, 2.5, 3.5, 8.0])
@pytest.mark.parametrize("zeta2", [0.1, 1.21, 1.5, 2.5, 10.0])
@pytest.mark.parametrize(
    "e", [0.0, 1e-300, 0.5, 1.0, *(pytest.param(e, marks=pytest.mark.slow) for e in (1e-9, 1e-3))]
)
def test_thresholds_against_40_digits(beta, zeta2, e):
    for x in thresholds(beta, zeta2, e):
        assert worst_error(x, beta, zeta2, e) <= PROMISED, (x, beta, zeta2, e)


@pytest.mark.parametrize("beta", [1.5, 3.5, 8.0])
@pytest.mark.parametrize("zeta2", [0.3, 1.21])
def test_onset_of_sticking_again_against_40_digits(beta, zeta2):
    """Around e^2 beta = zeta^2, from where on slip can end in restitution."""
    e = math.sqrt(zeta2 / beta)
    for near in (e, np.nextafter(e, 0), np.nextafter(e, 1), e * (1 + 1e-9), e * (1 - 1e-9)):
        for x in (*thresholds(beta, zeta2, float(near)), 0.3, 0.9 * beta, 1.01 * beta):
            assert worst_error(x, beta, zeta2, float(near)) <= PROMISED, (x, beta, zeta2, near)


@pytest.mark.parametrize(
    "case",
    [
        (5.838395000619867, 1.0, 10.0, 1.7e-7),  # crossing of N near its crest, vanishing slope
        (0.1, 3.6771579821005655, 0.1, 1.0),  # |T| past its crest while its ratio to N rises
        (0.159, 6.082350551988165, 6.082350551988165, 1.0),  # T proportional to N to the end
        (1.0, 4.0, 1.0, 1.0),  # resonance: sticks throughout
        (2.0, 8.0, 1e-4, 1.0),  # 131 phases
        (0.3, 3.0, 0.01, 1.0),
    ],
)
def test_hard_cases_against_40_digits(case):
    assert worst_error(*case) <= PROMISED


def test_history_has_the_events_of_the_reference():
    for case in [(1.0, 3.5, 1.21, 1.0), (2.5, 3.5, 1.21, 0.5), (2.0, 8.0, 0.05, 1.0)]:
        exact = high_precision.rebound(*case).events
        found = lumped.history(*case).events
        assert [exact_tables.KINDS.get(e.kind, e.kind) for e in exact] == [
            str(e.kind) for e in found
        ]
        for one, other in zip(exact, found, strict=True):
            for field in ("time", "normal", "friction", "velocity"):
                assert abs(float(getattr(one, field)) - getattr(other, field)) < 1e-11


def test_a_wrong_solver_would_be_seen():
    """The bound above is no formality: a slightly wrong parameter breaks it."""
    exact = high_precision.rebound(2.5, 3.5, 1.21, 0.5)
    wrong = lumped.rebound(2.5, 3.5, 1.21, 0.5 + 1e-11)
    assert abs(float(wrong.velocity - exact.velocity)) > PROMISED


def test_against_small_steps_that_know_no_phases():
    """Trial stick, then cap |T| at N: the error falls as the square of the step."""
    rng = np.random.default_rng(7)
    x, beta = rng.uniform(0, 12, 400), rng.uniform(1, 8, 400)
    zeta2, e = 10 ** rng.uniform(-1, 1, 400), rng.uniform(0.2, 1, 400)
    exact = lumped.rebound(x, beta, zeta2, e).velocity
    coarse, fine = (np.abs(_stepped(x, beta, zeta2, e, n) - exact) for n in (2000, 4000))
    assert fine.max() < 1e-5
    assert np.median(coarse[fine > 1e-13] / fine[fine > 1e-13]) > 3.5


def _stepped(x, beta, zeta2, e, steps):
    """Velocity at separation by the trapezoidal rule, `steps` in each half of the contact."""
    w, friction = x.copy(), np.zeros_like(x)
    for in_restitution in (False, True):
        step = np.pi / 2 / steps * (e if in_restitution else 1.0)
        for k in range(1, steps + 1):
            eta = np.pi / 2 * (steps - k if in_restitution else k) / steps
            # Stick: s1 = s + step (w + w1)/2 and w1 = w - beta step (T + T1)/2.
            half = step / 2
            trial = friction * (zeta2 - beta * half**2) + step * w
            trial /= zeta2 + beta * half**2
            trial = np.clip(trial, -np.sin(eta), np.sin(eta))
            w = w - beta * half * (friction + trial)
            friction = trial
    return w


def test_stated_facts_of_other_sources():
    """chi of Maw's pucks (nu = 0.28) and the frequency ratio of rubber (Johnson)."""
    steel = bodies.Material(2e11, 0.28)
    chi = bodies.mass_ratio(bodies.disc(0.02, 1.0)) / (2 * bodies.stiffness_ratio(steel))
    assert chi == pytest.approx(1.2558, abs=5e-5)
    rubber = bodies.stiffness_ratio(bodies.Material(1e6, 0.5))
    assert math.sqrt(3.5 / rubber) == pytest.approx(1.53, abs=0.005)
