"""Masses: bodies of simple shapes, and the effective masses of two that strike each other."""

import numpy as np

from planarimpact.bodies.quantities import HALF_SPACE, Body, all_positive, fields, in_range, quietly
from planarimpact.ground import checks
from planarimpact.ground.arrays import Array, ArrayLike
from planarimpact.ground.checks import InputError


@quietly
def solid_sphere(radius: ArrayLike, density: ArrayLike) -> Body:
    """Body of a homogeneous sphere that strikes with its surface: k^2 = 2 r^2/5.

    Parameters
    ----------
    radius : array_like
        r [m], above 0.
    density : array_like
        [kg/m^3], above 0.

    Returns
    -------
    Body

    Raises
    ------
    InputError
        If an argument is not a number in its range, shapes do not broadcast, or a result is
        beyond the range of numbers.

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

    Parameters
    ----------
    radius : array_like
        r [m], above 0.
    mass : array_like
        [kg], above 0.

    Returns
    -------
    Body

    Raises
    ------
    InputError
        If an argument is not a number in its range, shapes do not broadcast, or a result is
        beyond the range of numbers.

    Examples
    --------
    >>> round(float(mass_ratio(thin_shell(0.02, 0.0027))), 12)
    2.5
    """
    r, m = all_positive(radius=radius, mass=mass)
    return Body(m[()], r * np.sqrt(2 / 3), r[()])


def disc(radius: ArrayLike, mass: ArrayLike) -> Body:
    """Body of a homogeneous disc or cylinder that strikes with its rim: k^2 = r^2/2.

    Parameters
    ----------
    radius : array_like
        r [m], above 0.
    mass : array_like
        [kg], above 0.

    Returns
    -------
    Body

    Raises
    ------
    InputError
        If an argument is not a number in its range, shapes do not broadcast, or a result is
        beyond the range of numbers.

    Examples
    --------
    >>> round(float(mass_ratio(disc(0.05, 0.2))), 12)
    3.0
    """
    r, m = all_positive(radius=radius, mass=mass)
    return Body(m[()], r * np.sqrt(1 / 2), r[()])


def _shares_of_mass(body: Body, other: Body) -> tuple[Array, Array, Array]:
    """The smaller mass, and by how much it divides for m1 and for m2."""
    mass, gyration, radius, other_mass, other_gyration, other_radius = checks.broadcast(
        **fields("body", body, Body), **fields("other", other, Body)
    )
    lighter = np.minimum(mass, other_mass)
    if np.isinf(lighter).any():
        raise InputError("body.mass = inf, other.mass = inf: one of the two must be finite")
    # Relative to the smaller mass nothing is lost, whatever the unit.
    share, other_share = lighter / mass, lighter / other_mass
    turning = (1 + (radius / gyration) ** 2) * share
    turning = turning + (1 + (other_radius / other_gyration) ** 2) * other_share
    return lighter, turning, share + other_share


@quietly
def effective_masses(body: Body, other: Body = HALF_SPACE) -> tuple[Array, Array]:
    """Tangential and normal effective mass of two bodies (Eq. 2).

    Parameters
    ----------
    body : Body
        The body that strikes.
    other : Body
        What it strikes; a half-space at rest if left out. One of the two has a finite mass.

    Returns
    -------
    m1, m2 : ndarray of float64 or float
        [kg]: 1/m1 = sum (1 + (r/k)^2)/M and 1/m2 = sum 1/M over both bodies.

    Raises
    ------
    InputError
        If an argument is not a number in its range, shapes do not broadcast, or a result is
        beyond the range of numbers.

    Examples
    --------
    >>> [round(float(m), 3) for m in effective_masses(Body(mass=7.0, gyration=1.0, radius=1.0))]
    [3.5, 7.0]
    """
    lighter, turning, moving = _shares_of_mass(body, other)
    return in_range("m1", lighter / turning), lighter / moving


@quietly
def mass_ratio(body: Body, other: Body = HALF_SPACE) -> Array:
    """Mass ratio beta = m2/m1 of two bodies (Eq. 2).

    Parameters
    ----------
    body : Body
        The body that strikes.
    other : Body
        What it strikes; a half-space at rest if left out. One of the two has a finite mass.

    Returns
    -------
    ndarray of float64 or float
        At least 1.

    Raises
    ------
    InputError
        If an argument is not a number in its range, shapes do not broadcast, or a result is
        beyond the range of numbers.

    Examples
    --------
    >>> round(float(mass_ratio(solid_sphere(0.01, 2500.0))), 12)
    3.5
    """
    _, turning, moving = _shares_of_mass(body, other)
    return in_range("mass_ratio", turning / moving)
