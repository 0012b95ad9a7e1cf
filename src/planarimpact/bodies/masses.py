"""Masses: bodies of simple shapes, and the effective masses of two that strike each other."""

import numpy as np

from planarimpact.bodies.quantities import HALF_SPACE, Body, all_positive, fields, quietly
from planarimpact.common import checks
from planarimpact.common.arrays import Array, ArrayLike
from planarimpact.common.checks import LARGEST_RATIO, InputError, in_range


@quietly
def solid_sphere(radius: ArrayLike, density: ArrayLike) -> Body:
    """Body of a homogeneous sphere that strikes with its surface: k^2 = 2 r^2/5.

    Arguments and errors: `planarimpact.bodies`.

    Examples
    --------
    >>> round(float(solid_sphere(0.0127, 7800).mass), 4)
    0.0669
    """
    r, rho = all_positive(radius=radius, density=density)
    mass = in_range("mass", rho * r * r * r * (4 / 3 * np.pi))
    return Body(mass, r * np.sqrt(2 / 5), r[()])


def thin_shell(radius: ArrayLike, mass: ArrayLike) -> Body:
    """Body of a thin spherical shell, such as a table-tennis ball: k^2 = 2 r^2/3.

    Arguments and errors: `planarimpact.bodies`.

    Examples
    --------
    >>> round(float(mass_ratio(thin_shell(0.02, 0.0027))), 12)
    2.5
    """
    r, m = all_positive(radius=radius, mass=mass)
    return Body(m[()], r * np.sqrt(2 / 3), r[()])


def disc(radius: ArrayLike, mass: ArrayLike) -> Body:
    """Body of a homogeneous disc or cylinder that strikes with its rim: k^2 = r^2/2.

    Arguments and errors: `planarimpact.bodies`.

    Examples
    --------
    >>> round(float(mass_ratio(disc(0.05, 0.2))), 12)
    3.0
    """
    r, m = all_positive(radius=radius, mass=mass)
    return Body(m[()], r * np.sqrt(1 / 2), r[()])


def _scaled_inverse_masses(body: Body, other: Body) -> tuple[Array, Array, Array]:
    """The smaller mass of the two bodies, and this mass over m1 and over m2."""
    mass, gyration, radius, other_mass, other_gyration, other_radius = checks.broadcast(
        **fields("body", body, Body), **fields("other", other, Body)
    )
    smaller_mass = np.minimum(mass, other_mass)
    if np.isinf(smaller_mass).any():
        raise InputError("body.mass = inf, other.mass = inf: one of the two must be finite")
    # Ratios to the smaller mass are at most 1, whatever the unit.
    inverse, other_inverse = smaller_mass / mass, smaller_mass / other_mass
    tangential = (1 + (radius / gyration) ** 2) * inverse
    tangential = tangential + (1 + (other_radius / other_gyration) ** 2) * other_inverse
    return smaller_mass, tangential, inverse + other_inverse


@quietly
def effective_masses(body: Body, other: Body = HALF_SPACE) -> tuple[Array, Array]:
    """Tangential and normal effective mass of two bodies, m1 and m2 [kg] (Eq. 2).

    1/m1 = sum (1 + (r/k)^2)/M and 1/m2 = sum 1/M over both bodies. Arguments and errors:
    `planarimpact.bodies`.

    Examples
    --------
    >>> [round(float(m), 3) for m in effective_masses(Body(mass=7.0, gyration=1.0, radius=1.0))]
    [3.5, 7.0]
    """
    smaller_mass, tangential, normal = _scaled_inverse_masses(body, other)
    return in_range("m1", smaller_mass / tangential), smaller_mass / normal


@quietly
def mass_ratio(body: Body, other: Body = HALF_SPACE) -> Array:
    """Mass ratio beta = m2/m1 of two bodies, at least 1 (Eq. 2).

    Arguments and errors: `planarimpact.bodies`.

    Examples
    --------
    >>> round(float(mass_ratio(solid_sphere(0.01, 2500.0))), 12)
    3.5
    """
    _, tangential, normal = _scaled_inverse_masses(body, other)
    return in_range("mass_ratio", tangential / normal, 1.0, LARGEST_RATIO)
