"""Non-collinear impact by numerical integration: the equations of motion and nothing else.

Written independently of the package, in the paper's axes: x1 along the surface, x2 out of it,
v2 < 0 before the impact. It knows no closed form: SciPy integrates the state (u1, u2, v1, v2) from
event to event,

    dv1/dt = F1/m1 + c F2,  dv2/dt = c F1 + F2/m2,  du2/dt = v2,
    stick: F1 = (kappa/zeta^2) u1, du1/dt = -v1;   slip: F1 = -mu g F2,

F2 = -kappa u2 up to the largest compression so far, below it on a line of stiffness kappa/e^2.
"""

import math

import numpy as np
from scipy.integrate import solve_ivp

TOLERANCE = {"rtol": 1e-12, "atol": 1e-14, "method": "DOP853"}


class Contact:
    """One contact, integrated from first touch to separation."""

    def __init__(self, v1, v2, body, friction, restitution, stiffness_ratio, stiffness):
        """`body` is (M, k, x1, x2) of Eqs 1 and 2; restitution above 0."""
        mass, gyration, x1, x2 = body
        self.a = (1 + (x2 / gyration) ** 2) / mass
        self.b = (1 + (x1 / gyration) ** 2) / mass
        self.c = -x1 * x2 / (mass * gyration**2)
        self.mu, self.e, self.zeta2, self.kappa = friction, restitution, stiffness_ratio, stiffness
        self.loading, self.deepest = True, 0.0
        self.state = [0.0, 0.0, v1, v2]
        self.time, self.friction_work = 0.0, 0.0
        self.peak_friction = 0.0
        # The spring can follow the body only as fast as friction grows.
        self.g = 0 if abs(v1) <= friction * stiffness_ratio * abs(v2) else math.copysign(1, v1)
        # Of each phase: when it begins, what SciPy found, slip direction, loading, deepest; and
        # the name of the event that ends it.
        self.phases = []

    def normal(self, u2):
        """F2."""
        if self.loading:
            return -self.kappa * u2
        rest = (1 - self.e**2) * self.deepest
        return -self.kappa / self.e**2 * (u2 - rest)

    def tangential(self, u1, u2):
        """F1."""
        return -self.mu * self.g * self.normal(u2) if self.g else self.kappa / self.zeta2 * u1

    def slip_velocity(self, y):
        """dv1 of the contact particle: v1 + du1/dt with u1 = (zeta^2/kappa) F1."""
        stiffness = self.kappa if self.loading else self.kappa / self.e**2
        return y[2] + self.zeta2 / self.kappa * self.mu * self.g * stiffness * y[3]

    def rate(self, t, y):
        """Right-hand side; the last entry is the work of friction."""
        f2 = self.normal(y[1])
        f1 = self.tangential(y[0], y[1])
        work = -f1 * self.slip_velocity(y) if self.g else 0.0
        slide = self.slip_velocity(y) - y[2] if self.g else -y[2]
        return [slide, y[3], self.a * f1 + self.c * f2, self.c * f1 + self.b * f2, work]

    def run(self):
        """Integrate to separation; returns self."""
        for _ in range(500):
            if self._phase():
                return self
        raise RuntimeError("no end")

    def _phase(self):
        """One phase; True at separation."""
        names, events = zip(*self._events().items(), strict=True)
        for event in events:
            event.terminal, event.direction = True, -1
        period = 2 * math.pi / math.sqrt(self.kappa * self.b)
        fastest = period * min(1.0, math.sqrt(self.zeta2 * self.b / self.a))
        fastest *= 1.0 if self.loading else self.e
        found = solve_ivp(
            self.rate, (0, 50 * period), [*self.state, 0.0], events=events,
            max_step=fastest / 100, first_step=fastest * 1e-4, dense_output=True, **TOLERANCE,
        )  # fmt: skip
        u1, u2, *_ = found.sol(np.linspace(0, found.t[-1], 2001))
        self.peak_friction = max(self.peak_friction, np.abs(self.tangential(u1, u2)).max())
        name = next(n for n, times in zip(names, found.t_events, strict=True) if len(times))
        self.phases.append((self.time, found, self.g, self.loading, self.deepest, name))
        self.time += found.t[-1]
        self.friction_work += found.y[4, -1]
        self.state = list(found.y[:4, -1])
        return self._switch(name)

    def _switch(self, name):
        if name == "separation":
            return True
        if name == "turn":
            self.loading, self.deepest = False, self.state[1]
        elif name == "reload":
            self.loading = True
        elif name == "stop":
            self.g = 0
        else:
            self.g = 1 if name == "forward" else -1  # friction opposes slip
        if self.g:
            self.state[0] = self.zeta2 / self.kappa * self.tangential(0.0, self.state[1])
        return False

    def _events(self):
        """Functions that fall through zero at what ends this phase."""
        chosen = {}
        if self.loading:
            chosen["turn"] = lambda t, y: -y[3]
        else:
            chosen["separation"] = lambda t, y: self.normal(y[1])
            chosen["reload"] = lambda t, y: y[1] - self.deepest
        if self.g:
            chosen["stop"] = lambda t, y: self.g * self.slip_velocity(y)
        else:
            chosen["forward"] = lambda t, y: self.mu * self.normal(y[1]) + self.tangential(*y[:2])
            chosen["backward"] = lambda t, y: self.mu * self.normal(y[1]) - self.tangential(*y[:2])
        return chosen
