"""Restitution from the material: e as a function of speed, for bodies that lose normal energy.

Two laws of normal impact, those of `planarimpact.normal_impact`. A viscous body has a relaxation
time, and e falls slowly with speed. A plastic body has a yield pressure: it is elastic up to the
yield speed, and then e falls with speed. Each function describes a contact of two spheres by its
effective mass, modulus and radius, as `contact` returns them.

Symbols in addition to those of `planarimpact.bodies`: v_y yield speed, and a_y the radius of
contact where yield begins.
"""

import numpy as np

from planarimpact.bodies.materials import hertz_peak_force
from planarimpact.bodies.quantities import all_positive, quietly
from planarimpact.common import checks
from planarimpact.common.arrays import Array, ArrayLike, Number
from planarimpact.common.checks import (
    LEAST_RATIO,
    OutOfRange,
    checked,
    in_range,
    not_negative,
    positive,
)
from planarimpact.common.losses import PLASTIC, SPHERES, VISCOUS
from planarimpact.normal_impact import LEAST_RESTITUTION, kelvin_voigt, yielding

LAWS = {VISCOUS: kelvin_voigt, PLASTIC: yielding}
# Relative rounding error of a relaxation time that `relaxation_time` returns.
ROUNDING = 1e-12


@checks.default_errors
def viscous_restitution(
    speed: ArrayLike,
    relaxation_time: ArrayLike,
    mass: ArrayLike,
    effective_modulus: ArrayLike,
    effective_radius: ArrayLike,
) -> Array:
    """Coefficient of restitution of viscous spheres with a relaxation time.

    It is solved to 1e-10, and 1 without relaxation. Where it would be below 0.022 the relaxation
    time is refused. Stress = modulus (strain + tau strain rate), alike in shear and compression;
    tau is the A of Brilliantov et al. Arguments and errors: `planarimpact.bodies`.

    Notes
    -----
    While the approach d grows the force is (4/3) E* R^(1/2) (d^(3/2) + (3/2) tau d^(1/2) d').
    While it falls the force is (4/3) E* R^(1/2) (d + tau d')^(3/2), until that is 0. The first
    formula would count springs at the edge that pull. In a contact without adhesion they have let
    go, so that its radius shrinks faster. e depends on tau v2/L alone, with the length
    L = (m2 v2^2/(E* R^(1/2)))^(2/5), and e = 1 - 1.94 tau v2/L for a small loss. So 1 - e grows
    like the fifth root of the speed.

    References
    ----------
    G. Kuwabara, K. Kono, Jpn. J. Appl. Phys. 26 (1987) 1230-1233.

    Examples
    --------
    >>> ball = {"mass": 0.005, "effective_modulus": 4e9, "effective_radius": 0.01}
    >>> [round(float(viscous_restitution(v, 5e-6, **ball)), 3) for v in (0.1, 1.0, 10.0)]
    [0.874, 0.812, 0.727]
    """
    v2, tau, m2, modulus, radius = checks.broadcast(
        speed=positive("speed", speed),
        relaxation_time=not_negative("relaxation_time", relaxation_time),
        mass=positive("mass", mass),
        effective_modulus=positive("effective_modulus", effective_modulus),
        effective_radius=positive("effective_radius", effective_radius),
    )
    unit = time_unit(v2, m2, modulus, radius)
    longest = kelvin_voigt.relaxation_time(np.array(LEAST_RESTITUTION)) * unit
    too_long = np.flatnonzero(tau > longest * (1 + ROUNDING))
    if too_long.size:
        said = (
            "relaxation_time = {:g}: allowed are numbers up to {} here, where restitution is "
            f"{LEAST_RESTITUTION}"
        )
        given, most = np.ravel(tau), np.ravel(longest)
        raise OutOfRange(
            {i: said.format(given[i], checks.limit(most[i])) for i in too_long.tolist()}
        )
    return np.maximum(kelvin_voigt.restitution(tau / unit), LEAST_RESTITUTION)[()]


@checks.default_errors
def relaxation_time(
    restitution: ArrayLike,
    speed: ArrayLike,
    mass: ArrayLike,
    effective_modulus: ArrayLike,
    effective_radius: ArrayLike,
) -> Array:
    """Relaxation time [s] from restitution at one speed, the inverse of `viscous_restitution`.

    It is 0 where e = 1. Arguments and errors: `planarimpact.bodies`.

    Examples
    --------
    >>> ball = {"mass": 0.005, "effective_modulus": 4e9, "effective_radius": 0.01}
    >>> tau = relaxation_time(0.8, 1.0, **ball)
    >>> round(float(viscous_restitution(1.0, tau, **ball)), 9)
    0.8
    """
    e, v2, m2, modulus, radius = _checked_impact(
        restitution, speed, mass, effective_modulus, effective_radius
    )
    tau = kelvin_voigt.relaxation_time(e) * time_unit(v2, m2, modulus, radius)
    return in_range("relaxation time", np.where(e < 1, tau, 0.0), 0.0)[()]


@quietly
def yield_speed(
    yield_pressure: ArrayLike,
    mass: ArrayLike,
    effective_modulus: ArrayLike,
    effective_radius: ArrayLike,
) -> Array:
    """Normal speed of impact v_y [m/s] from which elastic-plastic spheres yield.

    The yield pressure is the largest pressure that the contact carries. It lies between 1.6 times
    the yield stress, where yield begins below the surface, and about 3 times, where the whole
    contact yields (Johnson, Contact Mechanics, 1985). Arguments and errors: `planarimpact.bodies`.

    Notes
    -----
    At the radius of contact a_y = pi p_y R/(2 E*) the pressure of Hertz in the centre is p_y. The
    approach is d_y = a_y^2/R there, and m2 v_y^2/2 = (8/15) E* R^(1/2) d_y^(5/2).

    References
    ----------
    C. Thornton, J. Appl. Mech. 64 (1997) 383-386.

    Examples
    --------
    >>> round(float(yield_speed(2e9, 0.0327, 115e9, 0.01)), 3)  # steel
    0.239
    """
    pressure, m2, modulus, radius = all_positive(
        yield_pressure=yield_pressure,
        mass=mass,
        effective_modulus=effective_modulus,
        effective_radius=effective_radius,
    )
    return in_range("yield speed", unchecked_yield_speed(pressure, m2, modulus, radius))[()]


@quietly
def plastic_restitution(
    speed: ArrayLike,
    yield_pressure: ArrayLike,
    mass: ArrayLike,
    effective_modulus: ArrayLike,
    effective_radius: ArrayLike,
) -> Array:
    """Coefficient of restitution of elastic-plastic spheres with a yield pressure.

    It is 1 up to the yield speed. Far above it e falls like v2^(-1/4). Arguments and errors:
    `planarimpact.bodies`.

    References
    ----------
    C. Thornton, J. Appl. Mech. 64 (1997) 383-386, Eq. 44.

    Examples
    --------
    >>> steel = {"mass": 0.0327, "effective_modulus": 115e9, "effective_radius": 0.01}
    >>> [round(float(plastic_restitution(v, 2e9, **steel)), 3) for v in (0.1, 1.0, 10.0)]
    [1.0, 0.804, 0.465]
    """
    v2, pressure, m2, modulus, radius = all_positive(
        speed=speed,
        yield_pressure=yield_pressure,
        mass=mass,
        effective_modulus=effective_modulus,
        effective_radius=effective_radius,
    )
    # A yield speed that overflows to inf is above any speed: the contact stays elastic.
    yield_share = np.minimum(unchecked_yield_speed(pressure, m2, modulus, radius) / v2, 1.0)
    e = np.where(yield_share == 1, 1.0, np.minimum(yielding.restitution(yield_share), 1.0))
    return in_range("restitution", e, LEAST_RATIO, 1.0)[()]


@quietly
def yield_pressure(
    restitution: ArrayLike,
    speed: ArrayLike,
    mass: ArrayLike,
    effective_modulus: ArrayLike,
    effective_radius: ArrayLike,
) -> Array:
    """Yield pressure [Pa] from restitution at one speed, the inverse of `plastic_restitution`.

    Where e = 1 it is the least one, at which yield begins with this speed. Arguments and errors:
    `planarimpact.bodies`.

    Examples
    --------
    >>> steel = {"mass": 0.0327, "effective_modulus": 115e9, "effective_radius": 0.01}
    >>> pressure = yield_pressure(0.8, 1.0, **steel)
    >>> round(float(plastic_restitution(1.0, pressure, **steel)), 9)
    0.8
    """
    e, v2, m2, modulus, radius = _checked_impact(
        restitution, speed, mass, effective_modulus, effective_radius
    )
    v_y = v2 * np.where(e < 1, yielding.yield_velocity(e), 1.0)
    # The inverse of `unchecked_yield_speed`: (a_y/R)^(5/2), then p_y.
    power = np.sqrt(15 / 16) * v_y * np.sqrt(m2 / modulus / radius) / radius
    return in_range("yield pressure", 2 / np.pi * modulus * power**0.4)[()]


@checks.default_errors
def peak_force(
    mass: ArrayLike,
    speed: ArrayLike,
    effective_modulus: ArrayLike,
    effective_radius: ArrayLike,
    restitution: ArrayLike,
    loss: str,
) -> Array:
    """Peak normal force [N] of spheres that lose normal energy.

    `loss` is "viscous" or "plastic", as in `viscous_restitution` and `plastic_restitution`. The
    force is that of Hertz where e = 1. Below, a plastic contact has a smaller one. A viscous one
    has a smaller one down to e = 0.19, and a larger one for more loss. Other arguments and errors:
    `planarimpact.bodies`.

    Examples
    --------
    >>> steel = {"mass": 0.0327, "effective_modulus": 115e9, "effective_radius": 0.01, "speed": 1}
    >>> losses = ["viscous", "plastic"]
    >>> round(float(hertz_peak_force(**steel)))
    1742
    >>> [round(float(peak_force(**steel, restitution=0.5, loss=loss))) for loss in losses]
    [1347, 960]
    """
    law = LAWS[SPHERES[checks.loss(loss, SPHERES)]]
    e, v2, m2, modulus, radius = _checked_impact(
        restitution, speed, mass, effective_modulus, effective_radius
    )
    factor = np.where(e < 1, law.largest_force(e), 1.0)
    return in_range("peak force", factor * hertz_peak_force(m2, v2, modulus, radius))[()]


def _checked_impact(
    restitution: ArrayLike,
    speed: ArrayLike,
    mass: ArrayLike,
    effective_modulus: ArrayLike,
    effective_radius: ArrayLike,
) -> tuple[Array, ...]:
    """Restitution in the range of the laws, speed, mass, modulus and radius; checked, broadcast."""
    allowed = f"numbers from {LEAST_RESTITUTION} to 1"
    return checks.broadcast(
        restitution=checked("restitution", restitution, allowed, LEAST_RESTITUTION, 1),
        speed=positive("speed", speed),
        mass=positive("mass", mass),
        effective_modulus=positive("effective_modulus", effective_modulus),
        effective_radius=positive("effective_radius", effective_radius),
    )


def time_unit(v2: Number, m2: Number, modulus: Number, radius: Number) -> Number:
    """L/v2 [s] of arrays or floats that are checked."""
    return m2**0.4 / modulus**0.4 / radius**0.2 / v2**0.2


def unchecked_yield_speed(pressure: Number, m2: Number, modulus: Number, radius: Number) -> Number:
    """v_y [m/s] of arrays or floats that are checked; it may overflow."""
    relative_radius = np.pi / 2 * (pressure / modulus)  # a_y/R
    return np.sqrt(16 / 15 * modulus / m2 * radius) * radius * relative_radius**2.5
