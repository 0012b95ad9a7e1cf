"""Codes that step through contacts: their laws, the values they usually have, and their input.

Read in their sources: LAMMPS 22Jul2025, `src/GRANULAR/gran_sub_mod_*.cpp`; MercuryDPM,
`LinearViscoelasticInteraction.cc`, `SlidingFrictionInteraction.cc`, of 2020; Yade,
`pkg/dem/ViscoelasticPM.cpp`, of 2021. What LAMMPS answers is in `data/lammps`; the other two were
not run.
"""

import math
from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from planarimpact import bodies
from planarimpact.fit import overlaps
from planarimpact.ground import checks
from planarimpact.ground.arrays import Array, ArrayLike
from planarimpact.models import timestep
from planarimpact.models.timestep import Law
from planarimpact.normal_impact import hertz


class Code(NamedTuple):
    """A law of a code: by its tangential styles, and as it is used without a fit.

    `usual_stiffness` is the tangential over the normal stiffness, None where the code takes it from
    Poisson's ratio; `usual_damping` is the coefficient of the tangential dashpot over the normal
    one. `limited` is whether a user usually has that limit. Where `by_normal` is true the code
    takes the tangential damping as a multiple of the normal one, so that there is none at e = 1.
    """

    styles: Mapping[str, Law]
    usual_stiffness: float | None
    usual_damping: float
    limited: bool
    by_normal: bool
    origin: str  # of the usual values


CODES = {
    "lammps-hertz-mindlin": Code(
        {
            "mindlin/force": Law(hertzian=True, limited=True),
            "mindlin_rescale/force": Law(hertzian=True, limited=True, rescales=True),
        },
        usual_stiffness=None,
        usual_damping=1.0,
        limited=False,
        by_normal=True,
        origin="NULL 1.0, as in examples of its manual",
    ),
    "lammps-hooke": Code(
        {"linear_history": Law(limited=True)},
        usual_stiffness=2 / 7,
        usual_damping=0.5,
        limited=False,
        by_normal=True,
        origin="2/7 of the stiffness and 1/2 of the damping, as its style gran/hooke/history has",
    ),
    "mercurydpm": Code(
        {"": Law()},
        usual_stiffness=2 / 7,
        usual_damping=2 / 7,
        limited=False,
        by_normal=False,
        origin="2/7 of stiffness and dissipation, as in its examples",
    ),
    "yade": Code(
        {"": Law(limited=True, spring_slides=True)},
        usual_stiffness=2 / 7,
        usual_damping=2 / 7,
        limited=True,
        by_normal=False,
        origin="2/7 of kn and cn, which tc and et = en give",
    ),
}


class Error(NamedTuple):
    """Difference of velocity from the continuum, in mu v2(0), where the overlap vanishes."""

    rms: float
    largest: float
    at: float  # incidence of the largest


class Fit(NamedTuple):
    """A law of a code beside the continuum, as `planarimpact.fit.fit` returns it.

    Attributes
    ----------
    law : str
        The code and its law, a key of `CODES`.
    style : str
        Name of the tangential law in the code; empty where it has only one.
    stiffness : float
        Tangential over normal stiffness; of Hertz' contact at every approach.
    damping : float
        Coefficient of the tangential dashpot, over (m2 F/d)^(1/2) with the elastic force F at the
        approach d: over (m2 kn)^(1/2) where the contact is linear.
    told : float
        Restitution that the code is told, with which the contact has that of the fit.
    mass_ratio, stiffness_ratio, restitution : float
        The groups of the fit; the stiffness ratio is that of the continuum.
    loss : str or None
        The loss of the continuum.
    incidence, continuum, before, after : ndarray of float64, shape (n,)
        Incidence v1(0)/(mu v2(0)); velocity v1(tf)/(mu v2(0)) of the continuum, of the law as it is
        usually used, and of the fitted law. Contact begins with a step.
    error_before, error : Error
        Error of the law as it is usually used, and error that remains. Contact begins within a
        step, where that is worst.
    beyond : float
        Error that remains at twice the largest incidence, where nothing was fitted; it has a sign.
    """

    law: str
    style: str
    stiffness: float
    damping: float
    told: float
    mass_ratio: float
    stiffness_ratio: float
    restitution: float
    loss: str | None
    incidence: Array
    continuum: Array
    before: Array
    after: Array
    error_before: Error
    error: Error
    beyond: float


class _Contact(NamedTuple):
    """Two equal solid spheres, in SI units."""

    young_modulus: float
    poisson_ratio: float
    density: float
    friction: float
    speed: float
    overlap: float  # in radii
    step: float  # of time
    normal: float  # stiffness and damping of linear springs, normal and tangential
    tangential: float
    normal_damping: float
    tangential_damping: float


def lines(
    found: Fit,
    material: bodies.Material,
    radius: ArrayLike,
    density: ArrayLike,
    friction: ArrayLike,
    speed: ArrayLike,
) -> str:
    """Lines of the input of a code, for two equal spheres and for one that meets a wall like it.

    Parameters
    ----------
    found : Fit
        Of solid spheres: with a mass ratio of 3.5, and the stiffness ratio of this material.
    material : bodies.Material
        Of both spheres.
    radius : array_like
        One number [m]; as density and speed from 1e-30 to 1e30.
    density : array_like
        One number [kg/m^3].
    friction : array_like
        One number, above 0.
    speed : array_like
        Normal speed of approach [m/s], up to that at which the spheres overlap by a tenth of their
        radius. The length of a step and linear springs follow from the duration of an elastic
        contact at this speed.

    Returns
    -------
    str
        Comments that say what was fitted to what, which error it has, and what the overlap adds to
        that, and then the lines, in SI units.

    Raises
    ------
    InputError
        If an argument is not one number in its range, or the fit is of other bodies.

    Examples
    --------
    >>> from planarimpact import bodies, fit
    >>> glass = bodies.Material(young_modulus=70e9, poisson_ratio=0.25)
    >>> groups = 3.5, float(bodies.stiffness_ratio(glass)), 0.9
    >>> found = fit.fit("lammps-hooke", *groups, loss="viscous")
    >>> lines(found, glass, 0.001, 2500, 0.2, 1.0).splitlines()[-2]
    'pair_style granular'
    """
    if not isinstance(found, Fit):
        raise checks.InputError(f"found = {checks.brief(found)}: allowed is what fit.fit returns")
    contact = _contact(found, material, radius, density, friction, speed)
    write = {"mercurydpm": _mercurydpm, "yade": _yade}.get(found.law, _lammps)
    comment = "//" if found.law == "mercurydpm" else "#"
    about = [f"{comment} {words}\n" for words in _about(found, contact)]
    return "".join(about) + write(found, contact)


def _contact(found: Fit, material: bodies.Material, *given: ArrayLike) -> _Contact:
    radius, density, friction, speed = given
    size = overlaps.overlap(material, radius, density, speed)
    mu = checks.number("friction", friction, "finite numbers above 0", 0, open_low=True)
    r, rho, v2 = (float(np.asarray(value)) for value in (radius, density, speed))
    sphere = bodies.solid_sphere(r, rho)
    for name, value, own in (
        ("mass_ratio", found.mass_ratio, bodies.mass_ratio(sphere, sphere)),
        ("stiffness_ratio", found.stiffness_ratio, bodies.stiffness_ratio(material, material)),
    ):
        if abs(value - checks.number(name, own, "numbers")) > 1e-6 * value:
            raise checks.InputError(
                f"found.{name} = {value:g}: allowed is that of two such spheres, {float(own):g}"
            )
    m2, modulus, effective = bodies.contact(sphere, material, sphere, material)
    mass, force = float(m2), float(bodies.hertz_peak_force(m2, v2, modulus, effective))
    lasts = 2 * hertz.COMPRESSION * hertz.PEAK_FORCE * mass * v2 / force
    stiffness = mass * (math.pi / lasts) ** 2
    damping = (stiffness * mass) ** 0.5
    return _Contact(
        float(material.young_modulus),
        float(material.poisson_ratio),
        rho,
        mu,
        v2,
        size,
        lasts / timestep.DASHPOT_STEPS,
        stiffness,
        stiffness * found.stiffness,
        damping * timestep.normal_damping(hertzian=False, told=found.told),
        damping * found.damping,
    )


def _about(found: Fit, contact: _Contact) -> list[str]:
    """What was fitted to what, and which error it has."""
    error, before, end = found.error, found.error_before, float(found.incidence[-1])
    measured = min(contact.friction, overlaps.FRICTIONS[-1])
    sticking, sliding = overlaps.costs(contact.overlap, measured)
    alike = "" if found.law.startswith("lammps") else f" ({found.law}: expected alike, not run)"
    continuum = f"{found.loss} continuum" if found.restitution < 1 else "elastic continuum"
    low, high = overlaps.INCIDENCES
    return [
        f"{found.law}, fitted to the {continuum} of planarimpact; SI units",
        f"two equal solid spheres: e = {found.restitution:g}, zeta^2 = "
        f"{found.stiffness_ratio:.4g}, m2/m1 = {found.mass_ratio:g}, mu = {contact.friction:g}",
        f"range of the fit: x = v1(0)/(mu v2(0)) from 0 to {end:.3g}; "
        f"{timestep.DASHPOT_STEPS} steps in an elastic contact at {contact.speed:g} m/s",
        "error of v1(tf)/(mu v2(0)), root mean square and largest, where overlaps are small:",
        f"  before {before.rms:.3f}, {before.largest:.3f} at x = {before.at:.2f} "
        f"({CODES[found.law].origin})",
        f"  after  {error.rms:.3f}, {error.largest:.3f} at x = {error.at:.2f}; "
        f"beyond the range, at x = {2 * end:.3g}, {abs(found.beyond):.3f}",
        f"overlap of the spheres at this speed, over their radius: at most {contact.overlap:.2g}",
        "  while two spheres touch they pass each other: their normal turns, which no fit includes",
        f"  at mu = {measured:g} and without spin before, this adds to the largest error, as "
        f"measured in LAMMPS{alike}:",
        f"    at most {sticking:.2g} for x up to {low:g}, where contacts mostly stick",
        f"    at most {sliding:.2g} for x up to {high:g}, where they slide; beyond, more",
        *["  at a larger mu it is more, and was not measured"] * (contact.friction > measured),
        "  a spin against the motion can more than double it",
        "  at a flat wall no normal turns: there the overlap adds nothing",
        "The fit holds for this restitution and this material.",
    ]


def _lammps(found: Fit, contact: _Contact) -> str:
    code = CODES[found.law]
    normal = timestep.normal_damping(code.styles[found.style].hertzian, found.told)
    multiple = found.damping / normal if normal else 0.0
    if found.law == "lammps-hooke":
        spring, stiffness = f"hooke {_short(contact.normal)} {found.told:.6g}", contact.tangential
    else:
        young, nu = contact.young_modulus, contact.poisson_ratio
        spring = f"hertz/material {_short(young)} {found.told:.6g} {nu:g}"
        stiffness = found.stiffness * young / (1 - nu**2)  # 2 E* times the share
    words = (
        f"{spring} tangential {found.style} {_short(stiffness)} {_short(multiple)} "
        f"{contact.friction:g} damping coeff_restitution limit_damping"
    )
    return (
        f"# limit_damping keeps contacts from pulling: with it {found.told:.4g} gives e = "
        f"{found.restitution:g}.\n"
        f"# Behind {found.style}: tangential stiffness "
        f"{'[N/m]' if found.law == 'lammps-hooke' else 'over contact radius [Pa]'}, tangential "
        "damping as a multiple of the normal one, friction.\n"
        "# The rest is yours: units si, atom_style sphere, fix nve/sphere.\n"
        "# For a wall of this material give the words behind * * to fix wall/gran granular.\n"
        "# Other radii have the same pair_coeff, but the time step is for spheres of this radius: "
        "print it for the smallest.\n"
        f"timestep {_short(contact.step)}\n"
        "pair_style granular\n"
        f"pair_coeff * * {words}\n"
    )


# At a wall the mass of a contact is that of one sphere, twice that of two; a dashpot has a
# coefficient times the root of it.
WALL = 2**0.5


def _walls(found: Fit, own: str) -> list[str]:
    """What dashpots that know no mass do at a wall, and that it needs its own."""
    damping = timestep.normal_damping(hertzian=False, told=found.told) / WALL
    told = math.exp(-math.pi * damping / math.sqrt(4 - damping**2))
    steps = round(WALL * timestep.DASHPOT_STEPS)
    e = timestep.restitution(CODES[found.law].styles[found.style], told, steps)
    return [
        "Springs and dashpots of this code know no mass: spheres of other masses have another e.",
        f"A wall of this material would have e = {e:.3f}, instead of {found.restitution:g}, "
        "with the dashpots of two spheres.",
        f"So it has {own}: dashpots of its contacts are sqrt(2) times as strong.",
    ]


def _mercurydpm(found: Fit, contact: _Contact) -> str:
    return (
        "auto species = speciesHandler.copyAndAddObject("
        "LinearViscoelasticSlidingFrictionSpecies());\n"
        f"species->setDensity({_short(contact.density)});\n"
        f"species->setStiffness({_short(contact.normal)});\n"
        f"species->setDissipation({_short(contact.normal_damping)});\n"
        f"species->setSlidingStiffness({_short(contact.tangential)});\n"
        f"species->setSlidingDissipation({_short(contact.tangential_damping)});\n"
        f"species->setSlidingFrictionCoefficient({contact.friction:g});\n"
        + "".join(f"// {words}\n" for words in _walls(found, "a species of its own, `wall`"))
        + "// Give `wall` to the objects that are walls, by setSpecies(wall).\n"
        "auto wall = speciesHandler.copyAndAddObject(species);\n"
        "auto atWall = speciesHandler.getMixedObject(species, wall);\n"
        f"atWall->setDissipation({_short(WALL * contact.normal_damping)});\n"
        f"atWall->setSlidingDissipation({_short(WALL * contact.tangential_damping)});\n"
        f"setTimeStep({_short(contact.step)});\n"
    )


def _yade(found: Fit, contact: _Contact) -> str:
    # Yade puts the springs, and the dashpots, of two bodies in series.
    kn, ks, cn, cs = (2 * value for value in contact[-4:])
    common = (
        f"O.materials.append(ViscElMat(density={_short(contact.density)}, "
        f"frictionAngle=atan({contact.friction:g}), kn={_short(kn)}, ks={_short(ks)}, "
    )
    strong = 1 / (2 / WALL - 1)  # in series with that of a sphere
    return (
        f"# O.interactions[i, j].phys.kn of a contact must be {_short(contact.normal)}.\n"
        "# Give spheres material=of_spheres and walls material=of_walls: else Yade takes the last "
        "one.\n"
        "from math import atan\n"
        f"of_spheres = {common}cn={_short(cn)}, cs={_short(cs)}))\n"
        + "".join(f"# {words}\n" for words in _walls(found, "a material of its own"))
        + f"# Dashpots of two bodies act in series: for this, its own are {strong:.3f} times those "
        "of the sphere.\n"
        + f"of_walls = {common}cn={_short(strong * cn)}, cs={_short(strong * cs)}))\n"
        "O.engines = [\n"
        "    ForceResetter(),\n"
        "    InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()]),\n"
        "    InteractionLoop(\n"
        "        [Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()],\n"
        "        [Ip2_ViscElMat_ViscElMat_ViscElPhys()],\n"
        "        [Law2_ScGeom_ViscElPhys_Basic()],\n"
        "    ),\n"
        "    NewtonIntegrator(damping=0),\n"
        "]\n"
        f"O.dt = {_short(contact.step)}\n"
    )


def _short(value: float) -> str:
    """A number with six digits."""
    return f"{value + 0.0:.6g}"  # no -0
