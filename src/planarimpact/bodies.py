"""Physical bodies and materials, in SI units, to and from the groups that the models take.

Collinear configurations only: each centre of mass lies on the contact normal. Arguments are
numbers or arrays that broadcast; every refusal is an `InputError` with the field and its value.
Scales are free: any for which the result is a number, from 1e-308 to 1e308, or it is refused.

Signs. The normal velocity is positive while the body approaches, so it is positive before the
impact and negative after it. The tangential velocity is positive in the incident direction (or
any other, kept throughout). Spin is positive where it moves the contact point in that direction:
v1 = tangential + radius spin, so rolling without slip, v1 = 0, is spin = -tangential/radius, and
positive spin is backspin.

Stiffnesses are those of a circular contact of radius a: 2 a E* normally, 8 a G* tangentially
(Mindlin). They leave out the coupling of pressure with tangential displacement, which vanishes
only for equal materials or where each body is incompressible or rigid.
"""

from functools import partial
from typing import NamedTuple

import numpy as np

from planarimpact import checks
from planarimpact.checks import InputError, checked


class OutOfRange(InputError):
    """A result that is too large or too small for a number; `where` says which of an array."""

    def __init__(self, name, values, where):
        super().__init__(f"{name} = {values[where][0]:g}: it is beyond the range of numbers")
        self.where = where


class Material(NamedTuple):
    """An isotropic elastic material: Young's modulus [Pa] and Poisson's ratio (-1 < nu <= 0.5)."""

    young_modulus: float
    poisson_ratio: float


class Body(NamedTuple):
    """A rigid body: mass [kg], radius of gyration [m], distance centre to contact point [m].

    An infinite mass is one that the impact does not move, an infinite gyration one kept from
    turning.
    """

    mass: float
    gyration: float
    radius: float


class Motion(NamedTuple):
    """Velocity of the centre of mass [m/s] and spin [rad/s]; signs as in the module's heading."""

    tangential: float
    normal: float
    spin: float


# Its radius plays no part, as nothing turns it; its curvature is the default of effective_radius.
HALF_SPACE = Body(mass=np.inf, gyration=np.inf, radius=0.0)

_finite = partial(checked, allowed="finite numbers")
_not_negative = partial(checked, allowed="finite numbers from 0", low=0)
_positive = partial(checked, allowed="finite numbers above 0", low=0, open_low=True)
_poisson = partial(checked, allowed="numbers above -1, up to 0.5", low=-1, high=0.5, open_low=True)
_angle = partial(
    checked,
    allowed="degrees between -90 and 90, exclusive",
    low=np.nextafter(-90, 0),
    high=np.nextafter(90, 0),
)
# The groups scale tangential velocities by mu: at mu = 0 they no longer hold v1.
_friction = partial(
    _positive, "friction", allowed="finite numbers above 0 (without friction v1 stays as it is)"
)


def _positive_or_infinite(name, value):
    try:
        infinite = np.isposinf(value)
    except (TypeError, ValueError):  # not real numbers: `checked` says so
        infinite = np.False_
    finite = np.where(infinite, 1.0, value) if infinite.any() else value
    return np.where(infinite, np.inf, _positive(name, finite, allowed="numbers above 0, or inf"))


# Results are refused below, so that numpy need not warn.
_quietly = np.errstate(over="ignore", invalid="ignore", divide="ignore")


def _in_range(name, values, above=0.0):
    """Return values as they are, if all are finite and larger than `above` in size."""
    lost = ~(np.isfinite(values) & (np.abs(values) > above))
    if lost.any():
        raise OutOfRange(name, np.atleast_1d(values), np.atleast_1d(lost))
    return values


def _all_positive(**arguments):
    return checks.broadcast(**{name: _positive(name, v) for name, v in arguments.items()})


_CHECKS = {
    Material: (_positive, _poisson),
    Body: (_positive_or_infinite, _positive_or_infinite, _not_negative),
    Motion: (_finite, _positive, _finite),
}


def _fields(name, value, kind):
    """Checked fields of a `kind`, keyed by the names that a refusal shows."""
    if not isinstance(value, kind):
        form = f"{kind.__name__}({', '.join(kind._fields)})"
        raise InputError(f"{name} = {value!r}: allowed are {form} tuples")
    names = [f"{name}.{field}" for field in kind._fields]
    return {n: rule(n, v) for n, rule, v in zip(names, _CHECKS[kind], value, strict=True)}


@_quietly
def solid_sphere(radius, density):
    """Body of a homogeneous sphere, k^2 = 2 r^2/5, from its radius [m] and density [kg/m^3].

    >>> round(float(solid_sphere(0.0127, 7800).mass), 4)
    0.0669
    """
    r, rho = _all_positive(radius=radius, density=density)
    mass = _in_range("mass", rho * r * r * r * (4 / 3 * np.pi))
    return Body(mass, r * np.sqrt(2 / 5), r[()])


def thin_shell(radius, mass):
    """Body of a thin spherical shell (table-tennis ball), k^2 = 2 r^2/3; radius [m], mass [kg].

    >>> round(float(mass_ratio(thin_shell(0.02, 0.0027))), 12)
    2.5
    """
    r, m = _all_positive(radius=radius, mass=mass)
    return Body(m[()], r * np.sqrt(2 / 3), r[()])


def disc(radius, mass):
    """Body of a disc or cylinder that strikes with its rim, k^2 = r^2/2; radius [m], mass [kg].

    >>> round(float(mass_ratio(disc(0.05, 0.2))), 12)
    3.0
    """
    r, m = _all_positive(radius=radius, mass=mass)
    return Body(m[()], r * np.sqrt(1 / 2), r[()])


def _shares_of_mass(body, other):
    """The smaller mass, and by how much it divides for m1 and for m2."""
    mass, gyration, radius, other_mass, other_gyration, other_radius = checks.broadcast(
        **_fields("body", body, Body), **_fields("other", other, Body)
    )
    lighter = np.minimum(mass, other_mass)
    if np.isinf(lighter).any():
        raise InputError("body.mass = inf, other.mass = inf: one of the two must be finite")
    # Relative to the smaller mass nothing is lost, whatever the unit.
    share, other_share = lighter / mass, lighter / other_mass
    turning = (1 + (radius / gyration) ** 2) * share
    turning = turning + (1 + (other_radius / other_gyration) ** 2) * other_share
    return lighter, turning, share + other_share


@_quietly
def effective_masses(body, other=HALF_SPACE):
    """Tangential and normal effective mass (m1, m2) [kg] of two bodies, one of finite mass.

    1/m1 = sum (1 + (r/k)^2)/M, 1/m2 = sum 1/M (Eq. 2).

    >>> [round(float(m), 3) for m in effective_masses(Body(mass=7.0, gyration=1.0, radius=1.0))]
    [3.5, 7.0]
    """
    lighter, turning, moving = _shares_of_mass(body, other)
    return _in_range("m1", lighter / turning), lighter / moving


@_quietly
def mass_ratio(body, other=HALF_SPACE):
    """Mass ratio beta = m2/m1 of two bodies, one of finite mass.

    >>> round(float(mass_ratio(solid_sphere(0.01, 2500.0))), 12)
    3.5
    """
    _, turning, moving = _shares_of_mass(body, other)
    return _in_range("mass_ratio", turning / moving)


def _compliances(material, other):
    """1/E* and 1/G* [1/Pa]; a rigid counterbody (None) adds nothing to either."""
    fields = _fields("material", material, Material)
    if other is not None:
        fields |= _fields("other", other, Material)
    arrays = checks.broadcast(**fields)
    pairs = list(zip(arrays[::2], arrays[1::2], strict=True))
    normal = sum((1 - nu) * (1 + nu) / young for young, nu in pairs)
    tangential = sum(2 * (2 - nu) * (1 + nu) / young for young, nu in pairs)
    return _in_range("1/E*", normal), _in_range("1/G*", tangential)


@_quietly
def effective_modulus(material, other=None):
    """Effective modulus E* [Pa], 1/E* = sum (1 - nu^2)/E; `other` None is a rigid counterbody.

    >>> round(float(effective_modulus(Material(380e9, 0.23), Material(70e9, 0.25)) / 1e9))
    63
    """
    return _in_range("E*", 1 / _compliances(material, other)[0])


@_quietly
def effective_shear_modulus(material, other=None):
    """Effective shear modulus G* [Pa], 1/G* = sum (2 - nu)/G with G = E/(2 (1 + nu)).

    >>> round(float(effective_shear_modulus(Material(380e9, 0.23), Material(70e9, 0.25)) / 1e9), 1)
    13.5
    """
    return _in_range("G*", 1 / _compliances(material, other)[1])


@_quietly
def stiffness_ratio(material, other=None):
    """Stiffness ratio zeta^2 = E*/(4 G*), normal over tangential.

    (2 - nu)/(2 (1 - nu)) for a material against itself or a rigid counterbody (`other` None).

    >>> round(float(stiffness_ratio(Material(210e9, 0.3))), 4)
    1.2143
    >>> round(float(stiffness_ratio(Material(380e9, 0.23), Material(70e9, 0.25))), 3)
    1.164
    """
    normal, tangential = _compliances(material, other)
    return tangential / normal / 4


def effective_radius(radius, other=np.inf):
    """Effective radius R [m] of two convex surfaces, 1/R = sum 1/radius; a flat `other` is inf.

    >>> float(effective_radius(0.02, 0.02))
    0.01
    """
    first, second = checks.broadcast(
        radius=_positive("radius", radius), other=_positive_or_infinite("other", other)
    )
    smaller, larger = np.minimum(first, second), np.maximum(first, second)
    return smaller / (1 + smaller / larger)


@_quietly
def contact_velocity(tangential, normal, spin, radius):
    """Velocity (v1, v2) [m/s] of the contact point: v1 = tangential + radius spin, v2 = normal.

    From the centre's velocities [m/s], spin [rad/s] and radius [m]. For two bodies take relative
    velocities of the centres and add the other's radius times spin (same sense of turning) to v1.

    >>> [float(v) for v in contact_velocity(2.0, 1.0, -4.0, 0.5)]  # rolling
    [0.0, 1.0]
    """
    tangential, normal, spin, radius = checks.broadcast(
        tangential=_finite("tangential", tangential),
        normal=_finite("normal", normal),
        spin=_finite("spin", spin),
        radius=_not_negative("radius", radius),
    )
    return _in_range("v1", tangential + radius * spin, above=-1.0), normal.copy()[()]


def incidence(v1, v2, friction):
    """Incidence x = v1/(mu v2) of the contact velocities [m/s] before impact, v2 > 0 and mu > 0.

    >>> round(float(incidence(3e200, 2e200, 0.5)), 12)
    3.0
    """
    v1, v2 = _finite("v1", v1), _positive("v2", v2)
    v1, v2, mu = checks.broadcast(v1=v1, v2=v2, friction=_friction(friction))
    with np.errstate(over="ignore"):  # refused below; mu v2 could underflow where v1/v2 does not
        return checks.incidence(v1 / v2 / mu)[()]


def angle_of_incidence(incidence, friction):
    """Angle of incidence theta in degrees, tan(theta) = v1/v2 = mu x.

    >>> round(float(angle_of_incidence(2.0, 0.5)), 12)
    45.0
    """
    x = checks.incidence(incidence)
    x, mu = checks.broadcast(incidence=x, friction=_friction(friction))
    with np.errstate(over="ignore"):  # the arctangent of inf is right
        return np.degrees(np.arctan(mu * x))


def incidence_from_angle(theta_deg, friction):
    """Incidence x = tan(theta)/mu of an angle |theta| < 90 in degrees; see `angle_of_incidence`.

    >>> round(float(incidence_from_angle(45.0, 0.5)), 12)
    2.0
    """
    theta = _angle("theta_deg", theta_deg)
    theta, mu = checks.broadcast(theta_deg=theta, friction=_friction(friction))
    with np.errstate(over="ignore"):  # refused below
        return checks.incidence(np.tan(np.radians(theta)) / mu)[()]


@_quietly
def rebound_motion(body, motion, friction, rebound_velocity, restitution):
    """Motion of one body after its impact on a half-space at rest.

    The tangential impulse P1 = m1 (mu v2 w(tf) - v1) adds P1/M to the centre's velocity and
    radius P1/(M k^2) to the spin; the normal velocity becomes -e times what it was.

    Parameters
    ----------
    body : Body
        The body [kg, m, m], of finite mass.
    motion : Motion
        Before impact [m/s, m/s, rad/s], with normal > 0.
    friction, rebound_velocity, restitution : array_like
        mu > 0, w(tf) = v1(tf)/(mu v2(0)) (the `velocity` of a `Rebound`), and e in [0, 1].

    Returns
    -------
    Motion
        After impact [m/s, m/s, rad/s], of ndarrays of float64 or floats.

    Examples
    --------
    >>> ball = Body(mass=1.0, gyration=0.1, radius=0.1)
    >>> after = rebound_motion(ball, Motion(1.0, 2.0, 0.0), 0.25, 0.0, 0.5)  # leaves rolling
    >>> [round(float(v), 12) for v in after]
    [0.5, -1.0, -5.0]
    """
    beta, _, gyration, radius, tangential, normal, spin, mu, w, e = checks.broadcast(
        mass_ratio=mass_ratio(body),  # refuses an infinite mass
        **_fields("body", body, Body),
        **_fields("motion", motion, Motion),
        friction=_friction(friction),
        rebound_velocity=_finite("rebound_velocity", rebound_velocity),
        restitution=checks.restitution(restitution),
    )
    v1, v2 = contact_velocity(tangential, normal, spin, radius)
    centre_change = (w * mu * v2 - v1) / beta  # P1/M: m1/M = 1/beta
    spin_change = centre_change * (radius / gyration) / gyration
    after = Motion(tangential + centre_change, -e * v2, spin + spin_change)
    names = (f"{field} after impact" for field in Motion._fields)
    return Motion(*(_in_range(name, v, above=-1.0) for name, v in zip(names, after, strict=True)))


@_quietly
def hertz_peak_force(mass, speed, effective_modulus, effective_radius):
    """Peak normal force [N] of an elastic Hertz contact, from m2 [kg], v2(0) [m/s], E* [Pa], R [m].

    F = K d^(3/2), K = (4/3) E* R^(1/2), at the depth where the work (2/5) K d^(5/2) is m2 v2^2/2.

    >>> round(float(hertz_peak_force(0.067, 0.05, 115e9, 0.0127)), 1)
    77.2
    """
    m2, v2, modulus, radius = _all_positive(
        mass=mass,
        speed=speed,
        effective_modulus=effective_modulus,
        effective_radius=effective_radius,
    )
    # v2^1.2, since v2^2 would overflow first.
    force = (4 / 3 * modulus * np.sqrt(radius)) ** 0.4 * (1.25 * m2) ** 0.6 * v2**1.2
    return _in_range("peak force", force)


@_quietly
def normal_frequency(peak_force, mass, speed):
    """Omega [rad/s] of the linear spring of equal peak force [N], m2 Omega v2 = peak force.

    mass is m2 [kg], speed v2(0) [m/s]. At any other speed Omega stays; forces are in newtons
    after multiplying N by m2 Omega v2, and friction (as `Rebound.peak_friction`) by mu times that.

    >>> float(normal_frequency(peak_force=6.0, mass=1.5, speed=2.0))
    2.0
    """
    force, m2, v2 = _all_positive(peak_force=peak_force, mass=mass, speed=speed)
    return _in_range("frequency", force / m2 / v2)
