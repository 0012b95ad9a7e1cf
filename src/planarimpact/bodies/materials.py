"""Stiffness of a contact: effective moduli of two bodies, and the forces that follow by Hertz.

Stiffnesses are those of a circular contact of radius a: 2 a E* normally, 8 a G* tangentially
(Mindlin). They leave out the coupling of pressure with tangential displacement, which vanishes
where (1 - 2 nu)/G is the same for both bodies: for equal materials, where each body is
incompressible or rigid, and for a few other pairs.
"""

import numpy as np

from planarimpact.bodies.quantities import (
    Material,
    all_positive,
    fields,
    positive_or_infinite,
)
from planarimpact.common import checks
from planarimpact.common.arrays import Array, ArrayLike, Numbers
from planarimpact.common.checks import in_range, positive


def _elastic_constants(material: Material, other: Material | None) -> list[tuple[Array, Array]]:
    """Young's modulus and Poisson's ratio of each body that is not rigid (None), checked."""
    constants = fields("material", material, Material)
    if other is not None:
        constants |= fields("other", other, Material)
    arrays = checks.broadcast(**constants)
    return list(zip(arrays[::2], arrays[1::2], strict=True))


def _compliances(pairs: list[tuple[Array, Array]]) -> tuple[Array, Array]:
    """1/E* and 1/G* [1/Pa]; a rigid counterbody adds nothing to either."""
    normal = np.sum([(1 - nu) * (1 + nu) / young for young, nu in pairs], axis=0)
    tangential = np.sum([2 * (2 - nu) * (1 + nu) / young for young, nu in pairs], axis=0)
    return normal, tangential


@checks.default_errors
def effective_modulus(material: Material, other: Material | None = None) -> Array:
    """Effective modulus E* [Pa] of two elastic bodies: 1/E* = sum (1 - nu^2)/E over both.

    Arguments and errors: `planarimpact.bodies`.

    Examples
    --------
    >>> round(float(effective_modulus(Material(380e9, 0.23), Material(70e9, 0.25)) / 1e9))
    63
    """
    return in_range("E*", 1 / _compliances(_elastic_constants(material, other))[0])


@checks.default_errors
def stiffness_ratio(material: Material, other: Material | None = None) -> Array:
    """Stiffness ratio of two elastic bodies in contact, normal over tangential.

    zeta^2 = E*/(4 G*) with 1/G* = sum (2 - nu)/G over both bodies, G = E/(2 (1 + nu)). It is
    (2 - nu)/(2 (1 - nu)) for a material against itself or a rigid counterbody. Arguments and
    errors: `planarimpact.bodies`.

    Examples
    --------
    >>> round(float(stiffness_ratio(Material(210e9, 0.3))), 4)
    1.2143
    >>> round(float(stiffness_ratio(Material(380e9, 0.23), Material(70e9, 0.25))), 3)
    1.164
    """
    normal, tangential = _compliances(_elastic_constants(material, other))
    return tangential / normal / 4


# Dundurs' constant over friction up to which the velocity of an elastic impact moves by less than
# 0.1 mu v2(0), by the finite elements of data/finite_elements (mu 0.1 to 0.4, nu 0.3 to 0.45).
COUPLING = 0.8


@checks.default_errors
def dundurs(material: Material, other: Material | None = None) -> Array:
    """Dundurs' second constant: how far pressure alone pushes two surfaces past each other.

    Where it is not 0, two surfaces under pressure spread differently. Friction resists that, so
    less friction is left to change the motion of the bodies. All models of this package leave it
    out. The error depends on its size over the coefficient of friction. By finite elements at e = 1
    the velocity moves by 0.01 mu v2(0) where that is 0.23, by 0.03 at 0.42, by less than 0.1 below
    0.8 (`COUPLING`), and by 0.36 at 2.9.

    It is (E*/2) times (1 - 2 nu)/(2 G) of `material` less that of `other`: from -1/2 to 1/2 for
    Poisson's ratios from 0, positive where `material` spreads more. Arguments and errors:
    `planarimpact.bodies`.

    References
    ----------
    K. L. Johnson, Contact Mechanics, Cambridge 1985, Eq. 5.3a.

    Examples
    --------
    >>> steel = Material(210e9, 0.3)
    >>> round(float(dundurs(steel)), 3), float(dundurs(steel, steel))
    (0.286, 0.0)
    >>> round(float(dundurs(Material(380e9, 0.23), Material(70e9, 0.25))), 2)  # alumina on glass
    -0.23
    """
    pairs = _elastic_constants(material, other)
    normal, _ = _compliances(pairs)
    spread, *other_spread = ((1 - 2 * nu) * (1 + nu) / young for young, nu in pairs)
    return (spread - sum(other_spread)) / normal / 2


@checks.default_errors
def effective_radius(radius: ArrayLike, other: ArrayLike = np.inf) -> Array:
    """Effective radius R [m] of two convex surfaces in contact: 1/R = sum 1/radius over both.

    `other` is the other's radius, infinite where it is flat. Arguments and errors:
    `planarimpact.bodies`.

    Examples
    --------
    >>> float(effective_radius(0.02, 0.02))
    0.01
    """
    first, second = checks.broadcast(
        radius=positive("radius", radius), other=positive_or_infinite("other", other)
    )
    return radius_of_two(first, second)


def radius_of_two(*radii: Numbers) -> Array:
    """Effective radius of two surfaces, unchecked; a radius of 0 is flat, as is an infinite one."""
    first, second = (np.where(radius > 0, radius, np.inf) for radius in map(np.asarray, radii))
    smaller, larger = np.minimum(first, second), np.maximum(first, second)
    with np.errstate(invalid="ignore"):  # two flat surfaces: NaN
        return smaller / (1 + smaller / larger)


@checks.default_errors
def hertz_peak_force(
    mass: ArrayLike, speed: ArrayLike, effective_modulus: ArrayLike, effective_radius: ArrayLike
) -> Array:
    """Peak normal force [N] of an elastic Hertz contact.

    It is K d^(3/2) with K = (4/3) E* R^(1/2), at the depth d where the work (2/5) K d^(5/2) is
    m2 v2^2/2. Arguments and errors: `planarimpact.bodies`.

    Examples
    --------
    >>> round(float(hertz_peak_force(0.067, 0.05, 115e9, 0.0127)), 1)
    77.2
    """
    m2, v2, modulus, radius = all_positive(
        mass=mass,
        speed=speed,
        effective_modulus=effective_modulus,
        effective_radius=effective_radius,
    )
    force = (4 / 3 * modulus * np.sqrt(radius)) ** 0.4 * (1.25 * m2) ** 0.6 * v2**1.2
    return in_range("peak force", force)


@checks.default_errors
def normal_frequency(peak_force: ArrayLike, mass: ArrayLike, speed: ArrayLike) -> Array:
    """Frequency Omega [rad/s] of the linear normal spring with this peak force [N] at this speed.

    m2 Omega v2 = `peak_force`; Omega is the same at any other speed. To get newtons, multiply a
    normal force of `History` by m2 Omega v2, and a friction (as `Rebound.peak_friction`) by
    mu m2 Omega v2. Other arguments and errors: `planarimpact.bodies`.

    Examples
    --------
    >>> float(normal_frequency(peak_force=6.0, mass=1.5, speed=2.0))
    2.0
    """
    force, m2, v2 = all_positive(peak_force=peak_force, mass=mass, speed=speed)
    return in_range("frequency", force / m2 / v2)
