"""The lumped model against its equations of motion, integrated phase by phase by SciPy.

Written from the equations, without a line of the solver: the body w' = -beta T, the spring
T = s/zeta^2 of a massless particle; stick s' = w while |T| <= N; slip T = side N while the particle
moves in that direction, side (w - side zeta^2 N') > 0.
"""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from planarimpact import lumped, rigid

SPHERE, MANY, STIFF, SOFT = (3.5, 1.21), (8.0, 0.1), (3.5, 0.004), (1.5, 5.0)
IMPACTS = [
    *((x, *SPHERE, e) for e in (1.0, 0.5, 0.1) for x in (0.4, 1.21, 1.5, 3.4, 4.2)),
    *((x, *SPHERE, 1.0) for x in (5.7, 5.79, 8.0)),
    *((x, *MANY, e) for e in (1.0, 0.6) for x in (0.05, 0.5, 7.0, 11.0)),
    *((x, *STIFF, e) for e in (0.9, 0.3) for x in (0.003, 2.0)),
    *((x, *SOFT, e) for e in (1.0, 0.2) for x in (2.0, 4.9, 5.1)),
]
# A double zero, where slip turns into stick, must not count as the start of slip. An event that is
# late by epsilon moves the result by epsilon squared only.
SLACK = 1e-13


class Half:
    """Normal force and its rate over compression, or over restitution."""

    def __init__(self, e):
        self.e = e
        self.start, self.end = (0.0, np.pi / 2) if e is None else (np.pi / 2, np.pi / 2 * (1 + e))

    def angle(self, time):
        return time if self.e is None else np.pi / 2 + (time - np.pi / 2) / self.e

    def force(self, time):
        return max(np.sin(self.angle(time)), 0.0)

    def rate(self, time):
        return np.cos(self.angle(time)) / (self.e or 1.0)


def velocity_at_separation(x, beta, zeta2, e):
    """Tangential velocity at separation, and the number of phases."""
    time, state = 0.0, np.array([x, 0.0])  # velocity w, deflection s
    side, phases = (1 if x > zeta2 else 0), 1  # side 0 is stick
    for half in (Half(None), Half(e)):
        time = half.start
        while time < half.end:
            time, state, ended = one_phase(half, time, state, side, beta, zeta2)
            if ended:
                side, phases = (0 if side else int(np.sign(state[1]))), phases + 1
    return state[0], phases


def one_phase(half, start, state, side, beta, zeta2):
    """Integrate stick (side 0) or slip to its end or that of the half."""

    def motion(time, state):
        if side:
            return [-beta * side * half.force(time), zeta2 * side * half.rate(time)]
        return [-beta * state[1] / zeta2, state[0]]

    def ends(time, state):
        if side:
            return side * state[0] - zeta2 * half.rate(time)
        return half.force(time) - abs(state[1]) / zeta2 + SLACK

    ends.terminal, ends.direction = True, -1
    shortest = min(half.end - half.start, np.sqrt(zeta2 / beta))
    found = solve_ivp(
        motion,
        (start, half.end),
        state,
        method="DOP853",
        rtol=1e-12,
        atol=1e-14,
        max_step=shortest / 4,
        events=ends,
    )
    assert found.success
    return found.t[-1], found.y[:, -1], found.status == 1


def at_random(count):
    rng = np.random.default_rng(8)
    for _ in range(count):
        beta, zeta2, e = rng.uniform(1, 8), 10 ** rng.uniform(-2, 1.5), rng.uniform(0.05, 1)
        limit = float(lumped.slip_throughout_limit(beta, zeta2, e))
        yield limit * rng.uniform(0, 1.1), beta, zeta2, e


@pytest.mark.parametrize("impact", IMPACTS + list(at_random(60)), ids=str)
def test_it_finds_the_same_velocity(impact):
    integrated, _ = velocity_at_separation(*impact)
    assert abs(lumped.rebound(*impact).velocity - integrated) <= 1e-10 * max(1.0, impact[0])


def test_the_impacts_have_many_phases():
    phases = [velocity_at_separation(*impact)[1] for impact in IMPACTS[-11:]]
    assert max(phases) > 12 and min(phases) < 4


def test_a_solver_without_tangential_compliance_is_found_out(monkeypatch):
    monkeypatch.setattr(lumped, "rebound", rigid.rebound)
    for x in (0.4, 3.4, 4.2):
        with pytest.raises(AssertionError):
            test_it_finds_the_same_velocity((x, *SPHERE, 1.0))
