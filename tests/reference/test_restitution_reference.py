"""Restitution from the material against the equations of motion in SI units, by SciPy."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import minimize_scalar

from planarimpact import bodies

STEEL = {"mass": 0.0327, "effective_modulus": 115e9, "effective_radius": 0.01}
RUBBER = {"mass": 0.3, "effective_modulus": 3e6, "effective_radius": 0.02}
BALLS = {"steel": STEEL, "rubber": RUBBER}
# The solver's steps are held to this share of depth and speed. Then its answers have nine digits.
PRECISION = 1e-12


def motion(mass, force, start, end, span, scale):
    """Solution of mass d'' = -force(d, d') from a state (d, d') until `end` falls to 0.

    The scale is that of depth and speed.
    """

    def stop(_, y):
        return end(*y)

    stop.terminal, stop.direction = True, -1
    found = solve_ivp(
        lambda _, y: [y[1], -force(*y) / mass],
        (0, span),
        start,
        events=stop,
        method="DOP853",
        rtol=PRECISION,
        atol=PRECISION * np.array(scale),
        dense_output=True,
    )
    assert found.status == 1  # it stopped where it should
    return found


def largest(force, found):
    """Largest force along a solution."""
    times = np.linspace(0, found.t[-1], 2001)
    top = int(np.argmax([force(*found.sol(t)) for t in times]))
    around = times[max(top - 1, 0)], times[min(top + 1, 2000)]
    fine = {"xatol": 1e-9 * found.t[-1]}
    best = minimize_scalar(
        lambda t: -force(*found.sol(t)), bounds=around, method="bounded", options=fine
    )
    return -best.fun


def viscous(tau, speed, mass, effective_modulus, effective_radius):
    """Restitution and largest force, Kuwabara & Kono in loading and no pull in unloading."""
    stiffness = 4 / 3 * effective_modulus * np.sqrt(effective_radius)

    def loading(d, v):
        return stiffness * (max(d, 0) ** 1.5 + 1.5 * tau * max(d, 0) ** 0.5 * v)

    def unloading(d, v):
        return stiffness * max(d + tau * v, 0) ** 1.5

    length = (mass * speed**2 / stiffness) ** 0.4
    span = 100 * (length / speed + tau)
    # The force has no slope at d = 0: the first instants are those of the viscous part alone.
    d = 1e-8 * length
    start = [d, speed - stiffness * tau * d**1.5 / mass / speed]
    compression = motion(mass, loading, start, lambda d, v: v, span, (length, speed))
    back = motion(
        mass,
        unloading,
        [compression.y[0, -1], 0.0],
        lambda d, v: d + tau * v,
        span,
        (length, speed),
    )
    return -back.y[1, -1] / speed, largest(loading, compression)


def plastic(pressure, speed, mass, effective_modulus, effective_radius):
    """Restitution and largest force by Thornton's three branches."""
    stiffness = 4 / 3 * effective_modulus * np.sqrt(effective_radius)
    radius_at_yield = np.pi * pressure * effective_radius / (2 * effective_modulus)
    yields = radius_at_yield**2 / effective_radius

    def loading(d, _):
        if d < yields:
            return stiffness * max(d, 0) ** 1.5
        return stiffness * yields**1.5 + np.pi * pressure * effective_radius * (d - yields)

    length = (mass * speed**2 / stiffness) ** 0.4
    span = 100 * (length / speed + np.sqrt(mass / (pressure * effective_radius)))
    compression = motion(mass, loading, [0.0, speed], lambda d, v: v, span, (length, speed))
    deepest = compression.y[0, -1]
    force = loading(deepest, 0.0)
    if deepest <= yields:
        return 1.0, force
    radius = effective_radius * stiffness * deepest**1.5 / force
    left = deepest - (force / (4 / 3 * effective_modulus * np.sqrt(radius))) ** (2 / 3)

    def unloading(d, _):
        return 4 / 3 * effective_modulus * np.sqrt(radius) * max(d - left, 0) ** 1.5

    back = motion(mass, unloading, [deepest, 0.0], lambda d, v: d - left, span, (length, speed))
    return -back.y[1, -1] / speed, force


# The motion, the property of the material and its law, and how near the largest force is.
LAWS = {
    "viscous": (viscous, bodies.relaxation_time, bodies.viscous_restitution, 1e-6),
    "plastic": (plastic, bodies.yield_pressure, bodies.plastic_restitution, 1e-8),
}


@pytest.mark.parametrize("loss", LAWS)
@pytest.mark.parametrize("ball", BALLS)
@pytest.mark.parametrize(("speed", "e"), [(1e-3, 0.99), (30.0, 0.8), (0.7, 0.3), (1e-3, 0.05)])
def test_restitution_and_force_are_those_of_the_motion(loss, ball, speed, e):
    moved, property_of, restitution, near = LAWS[loss]
    body = BALLS[ball]
    material = property_of(e, speed, **body)
    wanted, force = moved(float(material), speed, **body)
    assert wanted == pytest.approx(e, abs=1e-8)
    assert restitution(speed, material, **body) == pytest.approx(wanted, abs=1e-8)
    found = bodies.peak_force(speed=speed, restitution=e, loss=loss, **body)
    assert found == pytest.approx(force, rel=near)


@pytest.mark.parametrize("ball", BALLS)
@pytest.mark.parametrize("share", [0.3, 0.999])
def test_below_the_yield_speed_the_motion_is_elastic(ball, share):
    body = BALLS[ball]
    pressure = 0.01 * body["effective_modulus"]
    speed = share * bodies.yield_speed(pressure, **body)
    e, force = plastic(pressure, speed, **body)
    assert e == 1 == bodies.plastic_restitution(speed, pressure, **body)
    assert bodies.hertz_peak_force(speed=speed, **body) == pytest.approx(force, rel=1e-8)
    assert plastic(pressure, speed / share * 1.01, **body)[0] < 1
