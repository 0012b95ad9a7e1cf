"""Physical bodies and materials, in SI units, to and from the groups that the models take.

Collinear configurations only: each centre of mass lies on the contact normal. Other consistent
units give the same numbers.

Arguments of all functions have these names. Each is a number or an array; they broadcast, and a
result is a number or an array of the broadcast shape. Index 1 is tangential, 2 normal.

| argument | meaning | unit | allowed |
|---|---|---|---|
| `body`, `other` | a `Body` and what it strikes, a half-space at rest by default | | one can move |
| `material`, `other`, `other_material` | the `Material` of each; None is rigid | | |
| `radius` | r, from the centre to the contact point; or of curvature | m | above 0 |
| `mass` of a shape | M | kg | above 0 |
| `density` | of a homogeneous sphere | kg/m^3 | above 0 |
| `motion`: `tangential`, `normal` | velocity of the centre of mass | m/s | finite |
| `motion`: `spin` | angular velocity | rad/s | finite |
| `v1`, `v2` | velocity of the contact point before impact | m/s | v2 above 0 |
| `friction` | coefficient mu | | above 0 |
| `mass` with a speed or modulus | normal effective mass m2 | kg | above 0 |
| `effective_radius` | R | m | above 0 |
| `effective_modulus` | E* | Pa | above 0 |
| `speed` | normal speed of approach, v2(0) | m/s | above 0 |
| `restitution` | energetic coefficient e | | 0.022 to 1; in `rebound_motion` 0 to 1 |
| `relaxation_time` | tau of viscous bodies | s | from 0 |
| `yield_pressure` | p_y of plastic bodies | Pa | above 0 |

Laws of contact take mass, effective radius, effective modulus and speed in this order, and then
what else they need. The first three are those of a `Contact`: `yield_pressure(*contact(...), speed,
restitution)`.

Other symbols: m1 tangential effective mass; beta = m2/m1; k radius of gyration; x incidence, w
velocity of the contact point at separation over mu v2; E, G, nu Young's modulus, shear modulus and
Poisson's ratio; G* effective shear modulus; zeta^2 normal over tangential stiffness; v_y yield
speed, and a_y the radius of contact where yield begins.

Errors. Every function raises `InputError` with the field and its value if an argument is not a
number that is allowed, if shapes do not broadcast, or if an argument or a result is beyond 1e-100
to 1e100 in size (a mass ratio 1e12); what may be 0 may be smaller.

Signs. The normal velocity is positive while the body approaches, so it is positive before the
impact and negative after it. The tangential velocity is positive in one direction along the
surface, the same one for all quantities; usually it is the incident direction. Spin is positive
where it moves the contact point in that direction: v1 = tangential + radius spin, so rolling
without slip, v1 = 0, is spin = -tangential/radius, and positive spin is backspin.

Stiffness. Stiffnesses are those of a circular contact of radius a: 2 a E* normally, 8 a G*
tangentially (Mindlin). They leave out the coupling of pressure with tangential displacement, which
vanishes where (1 - 2 nu)/G is the same for both bodies: for equal materials, where each body is
incompressible or rigid, and for a few other pairs.

Restitution from the material: e as a function of speed, for bodies that lose normal energy, by two
laws of normal impact, those of `planarimpact.normal_impact`. A viscous body has a relaxation time,
and e falls slowly with speed. A plastic body has a yield pressure: it is elastic up to the yield
speed, and then e falls with speed.
"""

from __future__ import annotations

import inspect
import math
from collections.abc import Callable, Iterable
from functools import partial, wraps
from typing import Any, NamedTuple, ParamSpec, TypeAlias, TypeVar, cast

import numpy as np

from planarimpact.common import checks
from planarimpact.common.arrays import Array, ArrayLike, Number, Numbers
from planarimpact.common.checks import (
    LARGEST,
    LARGEST_RATIO,
    LEAST,
    LEAST_RATIO,
    InputError,
    OutOfRange,
    checked,
    finite,
    in_range,
    not_negative,
    positive,
)
from planarimpact.common.losses import PLASTIC, SPHERES, VISCOUS, SpheresLoss
from planarimpact.common.records import record
from planarimpact.normal_impact import LEAST_RESTITUTION, kelvin_voigt, yielding

__all__ = [
    "COUPLING",
    "HALF_SPACE",
    "LEAST_RESTITUTION",
    "Body",
    "Contact",
    "Material",
    "Motion",
    "OutOfRange",
    "contact",
    "contact_velocity",
    "disc",
    "dundurs",
    "effective_masses",
    "effective_modulus",
    "effective_radius",
    "hertz_peak_force",
    "incidence",
    "incidence_from_angle",
    "mass_ratio",
    "normal_frequency",
    "peak_force",
    "plastic_restitution",
    "rebound_motion",
    "relaxation_time",
    "solid_sphere",
    "stiffness_ratio",
    "thin_shell",
    "viscous_restitution",
    "yield_pressure",
    "yield_speed",
]

# Dundurs' constant over friction up to which the velocity of an elastic impact moves by less than
# 0.1 mu v2(0), by the finite elements of data/finite_elements (mu 0.1 to 0.4, nu 0.3 to 0.45).
COUPLING = 0.8
# Relative rounding error of a relaxation time that `relaxation_time` returns.
_ROUNDING = 1e-12
_LAWS = {VISCOUS: kelvin_voigt, PLASTIC: yielding}

# NumPy does not warn, whatever the caller has set: `in_range` refuses bad results.
quietly = np.errstate(over="ignore", invalid="ignore", divide="ignore", under="ignore")

# A rule takes the name and the value of an argument, refuses what is not allowed, and returns an
# array. Of a tuple it returns its fields by their names, and {} of what a formula takes as it is.
_RuleOfNumbers: TypeAlias = Callable[[str, Any], Array]
_Rule: TypeAlias = Callable[[str, Any], Array | dict[str, Array]]
_FIELDS: dict[type, dict[str, _RuleOfNumbers]] = {}  # rules of the fields of a tuple
_Tuple = TypeVar("_Tuple", bound=tuple[Any, ...])
_Arguments = ParamSpec("_Arguments")
_Result = TypeVar("_Result")

_positive_or_infinite = partial(
    checked, allowed="numbers above 0, or inf", low=0, open_low=True, infinite=True
)
_poisson = partial(checked, allowed="numbers above -1, up to 0.5", low=-1, high=0.5, open_low=True)


def _check_fields(**rules: _RuleOfNumbers) -> Callable[[type[_Tuple]], type[_Tuple]]:
    """Decorator of a named tuple: every new tuple's fields are checked by these rules."""

    def decorate(tuple_type: type[_Tuple]) -> type[_Tuple]:
        unchecked: Callable[..., _Tuple] = tuple_type.__new__

        @wraps(unchecked)
        def new(cls: type[_Tuple], *values: Any, **named_values: Any) -> _Tuple:
            instance = unchecked(cls, *values, **named_values)
            # The fields stay what the caller passed: numbers, or arrays that broadcast later.
            for (name, rule), value in zip(rules.items(), instance, strict=True):
                rule(name, value)
            return instance

        def make(cls: type[_Tuple], values: Iterable[Any]) -> _Tuple:  # `_replace` calls it too
            return cls(*values)

        _FIELDS[tuple_type] = rules
        # A named tuple may not define these itself. Any, as mypy refuses to replace methods.
        untyped: Any = tuple_type
        untyped.__new__, untyped._make = staticmethod(new), classmethod(make)
        return tuple_type

    return decorate


@_check_fields(young_modulus=positive, poisson_ratio=_poisson)
@record
class Material(NamedTuple):
    """An isotropic elastic material: Young's modulus [Pa] and Poisson's ratio (-1 < nu <= 0.5)."""

    young_modulus: Numbers
    poisson_ratio: Numbers


@_check_fields(mass=_positive_or_infinite, gyration=_positive_or_infinite, radius=not_negative)
@record
class Body(NamedTuple):
    """A rigid body: mass [kg], radius of gyration [m], distance centre to contact point [m].

    A body of infinite mass does not move, and one of infinite gyration does not turn.
    """

    mass: Numbers
    gyration: Numbers
    radius: Numbers


@_check_fields(tangential=finite, normal=finite, spin=finite)
@record
class Motion(NamedTuple):
    """Velocity of the centre of mass [m/s] and spin [rad/s]; signs as in `planarimpact.bodies`."""

    tangential: Numbers
    normal: Numbers
    spin: Numbers


@record
class Contact(NamedTuple):
    """What the laws of contact ask of two bodies, in the order of their arguments.

    Normal effective mass [kg], effective radius [m] and effective modulus [Pa].
    """

    mass: Array
    effective_radius: Array
    effective_modulus: Array


# A body that cannot turn, so its radius has no effect.
HALF_SPACE = Body(mass=np.inf, gyration=np.inf, radius=0.0)


def fields(
    name: str, value: Body | Material | Motion, kind: type[Body | Material | Motion]
) -> dict[str, Array]:
    """Checked fields of a `kind`, keyed by the names that a refusal shows."""
    if not isinstance(value, kind):
        signature = f"{kind.__name__}({', '.join(kind._fields)})"
        raise InputError(f"{name} = {checks.brief(value)}: allowed are {signature} tuples")
    named = zip(_FIELDS[kind].items(), value, strict=True)
    return {f"{name}.{field}": rule(f"{name}.{field}", v) for (field, rule), v in named}


def _or_none(rule: _Rule, name: str, value: Any) -> Array | dict[str, Array]:
    return {} if value is None else rule(name, value)


_material_or_rigid = partial(_or_none, partial(fields, kind=Material))


def _approaching(name: str, value: Motion) -> dict[str, Array]:
    normal = f"{name}.normal"
    return {**fields(name, value, Motion), normal: positive(normal, value.normal)}


def _any_restitution(_: str, value: ArrayLike) -> Array:
    return checks.restitution(value)


def _loss(_: str, value: str) -> dict[str, Array]:
    checks.loss(value, SPHERES)
    return {}


# The rules of all arguments, by name, but for those that a formula has of its own.
_RULES: dict[str, _Rule] = {
    "body": partial(fields, kind=Body),
    "other": partial(fields, kind=Body),
    "material": partial(fields, kind=Material),
    "motion": _approaching,
    "radius": positive,
    "density": positive,
    "tangential": finite,
    "normal": finite,
    "spin": finite,
    "v1": finite,
    "v2": positive,
    "theta_deg": partial(
        checked,
        allowed="degrees between -90 and 90, exclusive",
        low=-math.nextafter(90, 0),
        high=math.nextafter(90, 0),
    ),
    # The groups scale tangential velocities by mu: at mu = 0 they no longer hold v1.
    "friction": partial(
        positive, allowed="finite numbers above 0 (without friction v1 stays as it is)"
    ),
    "rebound_velocity": finite,
    "mass": positive,
    "effective_radius": positive,
    "effective_modulus": positive,
    "speed": positive,
    "restitution": partial(
        checked, allowed=f"numbers from {LEAST_RESTITUTION} to 1", low=LEAST_RESTITUTION, high=1
    ),
    "relaxation_time": not_negative,
    "yield_pressure": positive,
    "peak_force": positive,
    "loss": _loss,
}


def _formula(
    result: str = "", least: float = LEAST, most: float = LARGEST, /, **own_rules: _Rule
) -> Callable[[Callable[_Arguments, _Result]], Callable[_Arguments, _Result]]:
    """Decorator of a formula: what callers pass is checked and becomes arrays of one shape.

    A tuple becomes one of arrays. The rule of an argument is that of `own_rules`, else of `_RULES`.
    The formula runs without warnings of NumPy. If the `result` has a name here, its size must lie
    between `least` and `most`. Scalars give scalars. One of the keyword-only arguments is given.
    """

    def decorate(formula: Callable[_Arguments, _Result]) -> Callable[_Arguments, _Result]:
        parameters = inspect.signature(formula).parameters.values()
        rules = {one.name: own_rules.get(one.name) or _RULES[one.name] for one in parameters}
        defaults = {one.name: one.default for one in parameters if one.default is not one.empty}
        known = {name: rules[name](name, value) for name, value in defaults.items()}
        ways = [one.name for one in parameters if one.kind is one.KEYWORD_ONLY]
        of_arrays: Callable[..., Any] = formula

        @wraps(formula)
        @quietly
        def call(*values: _Arguments.args, **named: _Arguments.kwargs) -> _Result:
            unnamed = len(values) > len(rules) - len(ways)
            if ways and (unnamed or sum(named.get(way) is not None for way in ways) != 1):
                texts = (f"{formula.__name__}({next(iter(rules))}, {way}=...)" for way in ways)
                raise InputError(f"give one number by its name: {' or '.join(texts)}")
            given = {**dict(zip(rules, values, strict=False)), **named}
            arguments: dict[str, Any] = {**defaults, **given}
            if len(given) < len(values) + len(named) or arguments.keys() != rules.keys():
                return formula(*values, **named)  # Python says what is wrong with such a call
            found = {
                name: rule(name, given[name]) if name in given else known[name]
                for name, rule in rules.items()
            }
            answer = of_arrays(**_of_one_shape(found, arguments))
            if result:
                in_range(result, answer, least, most)
            return _numbers(answer)

        return call

    return decorate


def _of_one_shape(
    found: dict[str, Array | dict[str, Array]], arguments: dict[str, Any]
) -> dict[str, Any]:
    """Arguments of a formula: what the rules found is broadcast, and fields are tuples again."""
    named: dict[str, Array] = {}
    for name, part in found.items():
        named |= part if isinstance(part, dict) else {name: part}
    differ = len({array.shape for array in named.values()}) > 1
    arrays = iter(checks.broadcast(**named) if differ else named.values())
    alike = dict(arguments)  # where the rules found nothing, they stay as they are
    for name, part in found.items():
        if not isinstance(part, dict):
            alike[name] = next(arrays)
        elif part:
            alike[name] = tuple.__new__(type(arguments[name]), [next(arrays) for _ in part])
    return alike


def _numbers(answer: Any) -> Any:
    """An answer, or a tuple of them: scalars of NumPy in place of arrays without a dimension."""
    if isinstance(answer, tuple):
        return tuple.__new__(type(answer), [part[()] for part in answer])
    return answer[()]


def _arrays(*arguments: ArrayLike | None) -> tuple[Array, ...]:
    """Arguments of a formula: the decorator has made arrays of them, which type checkers miss."""
    return cast(tuple[Array, ...], arguments)


@_formula(density=partial(_or_none, positive), mass=partial(_or_none, positive))
def solid_sphere(
    radius: ArrayLike, *, density: ArrayLike | None = None, mass: ArrayLike | None = None
) -> Body:
    """Body of a homogeneous sphere that strikes with its surface: k^2 = 2 r^2/5.

    Give the density or the mass, by name. Arguments and errors: `planarimpact.bodies`.

    Examples
    --------
    >>> round(float(solid_sphere(0.0127, density=7800).mass), 4)
    0.0669
    >>> round(float(solid_sphere(0.028575, mass=0.17).gyration), 4)
    0.0181
    """
    if density is not None:
        r, rho = _arrays(radius, density)
        mass = in_range("mass", rho * r * r * r * (4 / 3 * np.pi))
    r, m = _arrays(radius, mass)
    return Body(m, r * np.sqrt(2 / 5), r)


@_formula()
def thin_shell(radius: ArrayLike, *, mass: ArrayLike) -> Body:
    """Body of a thin spherical shell, such as a table-tennis ball: k^2 = 2 r^2/3.

    Arguments and errors: `planarimpact.bodies`.

    Examples
    --------
    >>> round(float(mass_ratio(thin_shell(0.02, mass=0.0027))), 12)
    2.5
    """
    r, m = _arrays(radius, mass)
    return Body(m, r * np.sqrt(2 / 3), r)


@_formula()
def disc(radius: ArrayLike, *, mass: ArrayLike) -> Body:
    """Body of a homogeneous disc or cylinder that strikes with its rim: k^2 = r^2/2.

    Arguments and errors: `planarimpact.bodies`.

    Examples
    --------
    >>> round(float(mass_ratio(disc(0.05, mass=0.2))), 12)
    3.0
    """
    r, m = _arrays(radius, mass)
    return Body(m, r * np.sqrt(1 / 2), r)


@_formula()
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


@_formula("mass_ratio", 1.0, LARGEST_RATIO)
def mass_ratio(body: Body, other: Body = HALF_SPACE) -> Array:
    """Mass ratio beta = m2/m1 of two bodies, at least 1 (Eq. 2).

    Arguments and errors: `planarimpact.bodies`.

    Examples
    --------
    >>> round(float(mass_ratio(solid_sphere(0.01, density=2500))), 12)
    3.5
    """
    _, tangential, normal = _scaled_inverse_masses(body, other)
    return tangential / normal


def _scaled_inverse_masses(body: Body, other: Body) -> tuple[Array, Array, Array]:
    """The smaller mass of the two bodies, and this mass over m1 and over m2."""
    mass, gyration, radius = _arrays(*body)
    other_mass, other_gyration, other_radius = _arrays(*other)
    smaller_mass = np.minimum(mass, other_mass)
    if np.isinf(smaller_mass).any():
        raise InputError("body.mass = inf, other.mass = inf: one of the two must be finite")
    # Ratios to the smaller mass are at most 1, whatever the unit.
    inverse, other_inverse = smaller_mass / mass, smaller_mass / other_mass
    tangential = (1 + (radius / gyration) ** 2) * inverse
    tangential = tangential + (1 + (other_radius / other_gyration) ** 2) * other_inverse
    return smaller_mass, tangential, inverse + other_inverse


@_formula("E*", other=_material_or_rigid)
def effective_modulus(material: Material, other: Material | None = None) -> Array:
    """Effective modulus E* [Pa] of two elastic bodies: 1/E* = sum (1 - nu^2)/E over both.

    Arguments and errors: `planarimpact.bodies`.

    Examples
    --------
    >>> round(float(effective_modulus(Material(380e9, 0.23), Material(70e9, 0.25)) / 1e9))
    63
    """
    return 1 / _compliances(material, other)[0]


@_formula(other=_material_or_rigid)
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
    normal, tangential = _compliances(material, other)
    return tangential / normal / 4


@_formula(other=_material_or_rigid)
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
    normal, _ = _compliances(material, other)
    spread, *other_spread = (
        (1 - 2 * nu) * (1 + nu) / young for young, nu in _elastic(material, other)
    )
    return (spread - sum(other_spread)) / normal / 2


def _elastic(*materials: Material | None) -> list[tuple[Array, ...]]:
    """Young's modulus and Poisson's ratio of each body that is not rigid."""
    return [_arrays(*material) for material in materials if material is not None]


def _compliances(material: Material, other: Material | None) -> tuple[Array, Array]:
    """1/E* and 1/G* [1/Pa]; a rigid counterbody adds nothing to either."""
    pairs = _elastic(material, other)
    normal = np.sum([(1 - nu) * (1 + nu) / young for young, nu in pairs], axis=0)
    tangential = np.sum([2 * (2 - nu) * (1 + nu) / young for young, nu in pairs], axis=0)
    return normal, tangential


@_formula(other=_positive_or_infinite)
def effective_radius(radius: ArrayLike, other: ArrayLike = np.inf) -> Array:
    """Effective radius R [m] of two convex surfaces in contact: 1/R = sum 1/radius over both.

    `other` is the other's radius, infinite where it is flat. Arguments and errors:
    `planarimpact.bodies`.

    Examples
    --------
    >>> float(effective_radius(0.02, 0.02))
    0.01
    """
    return radius_of_two(*_arrays(radius, other))


def radius_of_two(*radii: Numbers) -> Array:
    """Effective radius of two surfaces, unchecked; a radius of 0 is flat, as is an infinite one."""
    first, second = (np.where(radius > 0, radius, np.inf) for radius in map(np.asarray, radii))
    smaller, larger = np.minimum(first, second), np.maximum(first, second)
    with np.errstate(invalid="ignore"):  # two flat surfaces: NaN
        return smaller / (1 + smaller / larger)


def contact(
    body: Body, material: Material, other: Body = HALF_SPACE, other_material: Material | None = None
) -> Contact:
    """Effective mass, radius and modulus of two bodies that strike each other.

    A radius of 0 is flat. Another body that can move needs a material. Arguments and errors:
    `planarimpact.bodies`.

    Examples
    --------
    The yield pressure of two steel beads whose restitution is 0.8 at 1 m/s:

    >>> steel, bead = Material(207e9, 0.3), solid_sphere(0.001, density=7800)
    >>> pressure = yield_pressure(*contact(bead, steel, bead, steel), 1.0, 0.8)
    >>> round(float(pressure / 1e9), 2)
    2.59
    """
    _, mass = effective_masses(body, other)
    _material_or_rigid("other_material", other_material)
    if other_material is None and np.isfinite(other.mass).any():
        raise checks.InputError("other_material: missing, as the other body has a finite mass")
    radius = radius_of_two(body.radius, other.radius)
    if np.isnan(radius).any():
        raise checks.InputError("body.radius = 0, other.radius = 0: one of the two must be above 0")
    return Contact(mass, radius, effective_modulus(material, other_material))


@_formula("peak force")
def hertz_peak_force(
    mass: ArrayLike, effective_radius: ArrayLike, effective_modulus: ArrayLike, speed: ArrayLike
) -> Array:
    """Peak normal force [N] of an elastic Hertz contact.

    It is K d^(3/2) with K = (4/3) E* R^(1/2), at the depth d where the work (2/5) K d^(5/2) is
    m2 v2^2/2. Arguments and errors: `planarimpact.bodies`.

    Examples
    --------
    >>> round(float(hertz_peak_force(0.067, 0.0127, 115e9, 0.05)), 1)
    77.2
    """
    m2, radius, modulus, v2 = _arrays(mass, effective_radius, effective_modulus, speed)
    return (4 / 3 * modulus * np.sqrt(radius)) ** 0.4 * (1.25 * m2) ** 0.6 * v2**1.2


@_formula("frequency")
def normal_frequency(mass: ArrayLike, speed: ArrayLike, peak_force: ArrayLike) -> Array:
    """Frequency Omega [rad/s] of the linear normal spring with this peak force [N] at this speed.

    m2 Omega v2 = `peak_force`; Omega is the same at any other speed. To get newtons, multiply a
    normal force of `History` by m2 Omega v2, and a friction (as `Rebound.peak_friction`) by
    mu m2 Omega v2. Other arguments and errors: `planarimpact.bodies`.

    Examples
    --------
    >>> float(normal_frequency(mass=1.5, speed=2.0, peak_force=6.0))
    2.0
    """
    m2, v2, force = _arrays(mass, speed, peak_force)
    return force / m2 / v2


@_formula()
def viscous_restitution(
    mass: ArrayLike,
    effective_radius: ArrayLike,
    effective_modulus: ArrayLike,
    speed: ArrayLike,
    relaxation_time: ArrayLike,
) -> Array:
    """Coefficient of restitution of viscous spheres with a relaxation time.

    It is solved to 1e-10, and 1 without relaxation. Where it would be below 0.022 the relaxation
    time is refused. Stress = modulus (strain + tau strain rate), alike in shear and compression.
    Arguments and errors: `planarimpact.bodies`.

    Notes
    -----
    While the approach d grows the force is (4/3) E* R^(1/2) (d^(3/2) + (3/2) tau d^(1/2) d').
    While it falls the force is (4/3) E* R^(1/2) (d + tau d')^(3/2), until that is 0. The first
    formula would count springs at the edge that pull. In a contact without adhesion they have let
    go, so that its radius shrinks faster. e depends on tau v2/L alone, with the length
    L = (m2 v2^2/(E* R^(1/2)))^(2/5), and e = 1 - 1.94 tau v2/L for a small loss. So 1 - e grows
    like the fifth root of the speed.

    Brilliantov et al. use the first formula for the whole contact. For this material their constant
    A is tau. But their contact pulls at its end, so the same number gives a lower e.

    References
    ----------
    G. Kuwabara, K. Kono, Jpn. J. Appl. Phys. 26 (1987) 1230-1233.
    N. V. Brilliantov, F. Spahn, J.-M. Hertzsch, T. Poeschel, Phys. Rev. E 53 (1996) 5382-5392.

    Examples
    --------
    >>> ball = {"mass": 0.005, "effective_radius": 0.01, "effective_modulus": 4e9}
    >>> [
    ...     round(float(viscous_restitution(speed=v, relaxation_time=5e-6, **ball)), 3)
    ...     for v in (0.1, 1.0, 10.0)
    ... ]
    [0.874, 0.812, 0.727]
    """
    m2, radius, modulus, v2, tau = _arrays(
        mass, effective_radius, effective_modulus, speed, relaxation_time
    )
    unit = time_unit(m2, radius, modulus, v2)
    longest = kelvin_voigt.relaxation_time(np.array(LEAST_RESTITUTION)) * unit
    too_long = np.flatnonzero(tau > longest * (1 + _ROUNDING))
    if too_long.size:
        said = (
            "relaxation_time = {:g}: allowed are numbers up to {} here, where restitution is "
            f"{LEAST_RESTITUTION}"
        )
        given, most = np.ravel(tau), np.ravel(longest)
        raise OutOfRange(
            {i: said.format(given[i], checks.limit(most[i])) for i in too_long.tolist()}
        )
    return np.maximum(kelvin_voigt.restitution(tau / unit), LEAST_RESTITUTION)


@_formula("relaxation time", 0.0)
def relaxation_time(
    mass: ArrayLike,
    effective_radius: ArrayLike,
    effective_modulus: ArrayLike,
    speed: ArrayLike,
    restitution: ArrayLike,
) -> Array:
    """Relaxation time [s] from restitution at one speed, the inverse of `viscous_restitution`.

    It is 0 where e = 1. Arguments and errors: `planarimpact.bodies`.

    Examples
    --------
    >>> ball = {"mass": 0.005, "effective_radius": 0.01, "effective_modulus": 4e9}
    >>> tau = relaxation_time(speed=1.0, restitution=0.8, **ball)
    >>> round(float(viscous_restitution(speed=1.0, relaxation_time=tau, **ball)), 9)
    0.8
    """
    m2, radius, modulus, v2, e = _arrays(
        mass, effective_radius, effective_modulus, speed, restitution
    )
    tau = kelvin_voigt.relaxation_time(e) * time_unit(m2, radius, modulus, v2)
    return np.where(e < 1, tau, 0.0)


@_formula("yield speed")
def yield_speed(
    mass: ArrayLike,
    effective_radius: ArrayLike,
    effective_modulus: ArrayLike,
    yield_pressure: ArrayLike,
) -> Array:
    """Normal speed of impact v_y [m/s] from which elastic-plastic spheres yield.

    The yield pressure is the largest pressure that the contact carries. It lies between 1.6 times
    the yield stress, where yield begins below the surface, and about 3 times, where the whole
    contact yields (Johnson, Contact Mechanics, 1985). The law is Thornton's, see
    `plastic_restitution`. Arguments and errors: `planarimpact.bodies`.

    Notes
    -----
    At the radius of contact a_y = pi p_y R/(2 E*) the pressure of Hertz in the centre is p_y. The
    approach is d_y = a_y^2/R there, and m2 v_y^2/2 = (8/15) E* R^(1/2) d_y^(5/2).

    Examples
    --------
    >>> round(float(yield_speed(0.0327, 0.01, 115e9, 2e9)), 3)  # steel
    0.239
    """
    return unchecked_yield_speed(
        *_arrays(mass, effective_radius, effective_modulus, yield_pressure)
    )


@_formula("restitution", LEAST_RATIO, 1.0)
def plastic_restitution(
    mass: ArrayLike,
    effective_radius: ArrayLike,
    effective_modulus: ArrayLike,
    speed: ArrayLike,
    yield_pressure: ArrayLike,
) -> Array:
    """Coefficient of restitution of elastic-plastic spheres with a yield pressure.

    It is 1 up to the yield speed. Far above it e falls like v2^(-1/4). Arguments and errors:
    `planarimpact.bodies`.

    References
    ----------
    C. Thornton, J. Appl. Mech. 64 (1997) 383-386, Eq. 44.

    Examples
    --------
    >>> steel = {"mass": 0.0327, "effective_radius": 0.01, "effective_modulus": 115e9}
    >>> [
    ...     round(float(plastic_restitution(speed=v, yield_pressure=2e9, **steel)), 3)
    ...     for v in (0.1, 1.0, 10.0)
    ... ]
    [1.0, 0.804, 0.465]
    """
    m2, radius, modulus, v2, pressure = _arrays(
        mass, effective_radius, effective_modulus, speed, yield_pressure
    )
    # A yield speed that overflows to inf is above any speed: the contact stays elastic.
    yield_share = np.minimum(unchecked_yield_speed(m2, radius, modulus, pressure) / v2, 1.0)
    return np.where(yield_share == 1, 1.0, np.minimum(yielding.restitution(yield_share), 1.0))


@_formula("yield pressure")
def yield_pressure(
    mass: ArrayLike,
    effective_radius: ArrayLike,
    effective_modulus: ArrayLike,
    speed: ArrayLike,
    restitution: ArrayLike,
) -> Array:
    """Yield pressure [Pa] from restitution at one speed, the inverse of `plastic_restitution`.

    Where e = 1 it is the least one, at which yield begins with this speed. Arguments and errors:
    `planarimpact.bodies`.

    Examples
    --------
    >>> steel = {"mass": 0.0327, "effective_radius": 0.01, "effective_modulus": 115e9}
    >>> pressure = yield_pressure(speed=1.0, restitution=0.8, **steel)
    >>> round(float(plastic_restitution(speed=1.0, yield_pressure=pressure, **steel)), 9)
    0.8
    """
    m2, radius, modulus, v2, e = _arrays(
        mass, effective_radius, effective_modulus, speed, restitution
    )
    v_y = v2 * np.where(e < 1, yielding.yield_velocity(e), 1.0)
    # The inverse of `unchecked_yield_speed`: (a_y/R)^(5/2), then p_y.
    power = np.sqrt(15 / 16) * v_y * np.sqrt(m2 / modulus / radius) / radius
    return 2 / np.pi * modulus * power**0.4


@_formula("peak force")
def peak_force(
    mass: ArrayLike,
    effective_radius: ArrayLike,
    effective_modulus: ArrayLike,
    speed: ArrayLike,
    restitution: ArrayLike,
    loss: SpheresLoss,
) -> Array:
    """Peak normal force [N] of spheres that lose normal energy.

    `loss` is "viscous" or "plastic", as in `viscous_restitution` and `plastic_restitution`. The
    force is that of Hertz where e = 1. Below, a plastic contact has a smaller one. A viscous one
    has a smaller one down to e = 0.19, and a larger one for more loss. Other arguments and errors:
    `planarimpact.bodies`.

    Examples
    --------
    >>> steel = {"mass": 0.0327, "effective_radius": 0.01, "effective_modulus": 115e9, "speed": 1}
    >>> losses = ["viscous", "plastic"]
    >>> round(float(hertz_peak_force(**steel)))
    1742
    >>> [round(float(peak_force(**steel, restitution=0.5, loss=loss))) for loss in losses]
    [1347, 960]
    """
    law = _LAWS[SPHERES[loss]]
    m2, radius, modulus, v2, e = _arrays(
        mass, effective_radius, effective_modulus, speed, restitution
    )
    factor = np.where(e < 1, law.largest_force(e), 1.0)
    return factor * hertz_peak_force(m2, radius, modulus, v2)


def time_unit(m2: Number, radius: Number, modulus: Number, v2: Number) -> Number:
    """L/v2 [s] of arrays or floats that are checked."""
    return m2**0.4 / modulus**0.4 / radius**0.2 / v2**0.2


def unchecked_yield_speed(m2: Number, radius: Number, modulus: Number, pressure: Number) -> Number:
    """v_y [m/s] of arrays or floats that are checked; it may overflow."""
    relative_radius = np.pi / 2 * (pressure / modulus)  # a_y/R
    return np.sqrt(16 / 15 * modulus / m2 * radius) * radius * relative_radius**2.5


@_formula(radius=not_negative)
def contact_velocity(
    tangential: ArrayLike, normal: ArrayLike, spin: ArrayLike, radius: ArrayLike
) -> tuple[Array, Array]:
    """Velocity of the contact point of a body: v1 = tangential + radius spin, v2 = normal [m/s].

    For two bodies take relative velocities of the centres, and add the other's radius times its
    spin, in the same sense of turning, to v1. The radius may be 0. Arguments and errors:
    `planarimpact.bodies`.

    Examples
    --------
    >>> [float(v) for v in contact_velocity(2.0, 1.0, -4.0, 0.5)]  # rolling
    [0.0, 1.0]
    """
    along, v2, turning, r = _arrays(tangential, normal, spin, radius)
    return in_range("v1", along + r * turning, 0.0), v2.copy()


@_formula("incidence", 0.0)
def incidence(v1: ArrayLike, v2: ArrayLike, friction: ArrayLike) -> Array:
    """Incidence of an impact from the velocity of the contact point: x = v1/(mu v2).

    Arguments and errors: `planarimpact.bodies`.

    Examples
    --------
    >>> round(float(incidence(3.0, 2.0, 0.5)), 12)
    3.0
    """
    v1, v2, mu = _arrays(v1, v2, friction)
    return v1 / v2 / mu


@_formula("incidence", 0.0)
def incidence_from_angle(theta_deg: ArrayLike, friction: ArrayLike) -> Array:
    """Incidence of an impact at an angle: x = tan(theta)/mu.

    `theta_deg` is the angle from the normal in degrees, between -90 and 90. Other arguments and
    errors: `planarimpact.bodies`.

    Examples
    --------
    >>> round(float(incidence_from_angle(45.0, 0.5)), 12)
    2.0
    """
    theta, mu = _arrays(theta_deg, friction)
    return np.tan(np.radians(theta)) / mu


@_formula(restitution=_any_restitution)
def rebound_motion(
    body: Body,
    motion: Motion,
    friction: ArrayLike,
    rebound_velocity: ArrayLike,
    restitution: ArrayLike,
) -> Motion:
    """Motion of one body after its impact on a half-space at rest.

    The tangential impulse P1 = m1 (mu v2 w(tf) - v1) adds P1/M to the centre's velocity and
    radius P1/(M k^2) to the spin; the normal velocity becomes -e times what it was.
    `rebound_velocity` is w(tf) = v1(tf)/(mu v2(0)), the `velocity` of a `Rebound`. The normal
    velocity of `motion` is above 0. Other arguments and errors: `planarimpact.bodies`.

    Examples
    --------
    >>> ball = Body(mass=1.0, gyration=0.1, radius=0.1)
    >>> after = rebound_motion(ball, Motion(1.0, 2.0, 0.0), 0.25, 0.0, 0.5)  # leaves rolling
    >>> [round(float(v), 12) for v in after]
    [0.5, -1.0, -5.0]
    """
    _, gyration, radius = _arrays(*body)
    tangential, v2, spin = _arrays(*motion)
    mu, w, e = _arrays(friction, rebound_velocity, restitution)
    beta = mass_ratio(body)  # refuses an infinite mass
    v1, _ = contact_velocity(tangential, v2, spin, radius)
    centre_change = (w * mu * v2 - v1) / beta  # P1/M: m1/M = 1/beta
    spin_change = centre_change * (radius / gyration) / gyration
    after = tangential + centre_change, -e * v2, spin + spin_change
    names = (f"{field} after impact" for field in Motion._fields)
    return Motion(*(in_range(name, v, 0.0) for name, v in zip(names, after, strict=True)))
