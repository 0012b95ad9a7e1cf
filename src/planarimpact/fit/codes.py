"""Codes that step through contacts: their laws, the values they usually have, and their input.

Read in their sources: LAMMPS 22Jul2025, `src/GRANULAR/gran_sub_mod_*.cpp`; MercuryDPM,
`LinearViscoelasticInteraction.cc`, `SlidingFrictionInteraction.cc`, of 2020; Yade,
`pkg/dem/ViscoelasticPM.cpp`, of 2021; for their motion see `overlaps`. What the codes answer is in
`data/lammps`, `data/yade` and `data/mercurydpm`.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from planarimpact import bodies
from planarimpact.common import checks
from planarimpact.common.arrays import Array, ArrayLike
from planarimpact.common.cautions import Caution
from planarimpact.common.records import record
from planarimpact.fit import overlaps
from planarimpact.models import timestep
from planarimpact.models.timestep import Law
from planarimpact.normal_impact import hertz

# What `lines` prints: "#" begins a comment, most names are those of `_numbers`, and words in
# capitals are filled in by `CODES`.
ABOUT = """\
# {found.law}, fitted to the {continuum} continuum of planarimpact; SI units
# two equal solid spheres: e = {found.restitution:g}, zeta^2 = {found.stiffness_ratio:.4g}, \
m2/m1 = {found.mass_ratio:g}, mu = {friction:g}
# range of the fit: x = v1(0)/(mu v2(0)) from 0 to {end:.3g}; {steps} steps in an elastic contact \
at {speed:g} m/s
# error of v1(tf)/(mu v2(0)), root mean square and largest, where overlaps are small:
#   before {found.error_before.rms:.3f}, {found.error_before.largest:.3f} at x = \
{found.error_before.at:.2f} ({code.origin})
#   after  {found.error.rms:.3f}, {found.error.largest:.3f} at x = {found.error.at:.2f}; beyond \
the range, at x = {twice:.3g}, {found.beyond:.3f}
# overlap of the spheres at this speed, over their radius: at most {overlap:.2g}
#   at mu = {measured:g} and without spin before, it adds to the largest error,
#   as computed from the source of the code; LAMMPS (two spheres), Yade and MercuryDPM agree:
#     of two spheres at most {costs[0]:.2g} for x up to {up_to[0]:g}, where contacts mostly stick
#     of two spheres at most {costs[1]:.2g} for x up to {up_to[1]:g}, where they slide; beyond, more
#     of a sphere at a flat wall {wall} for x up to {up_to[1]:g}
{jumps}{larger}#   a spin against the motion can more than double it
# The fit is valid for this restitution and this material.
{caution}"""
JUMPS = """\
#     of these {0:g}, {1:g} and {2:g} also for the smallest overlap: velocities jump where a step of
#     the contact changes
"""
LARGER = "#   at a larger mu it is more; how much is not known\n"
LAMMPS = """\
# limit_damping keeps contacts from pulling: with it {found.input_restitution:.4g} gives e = \
{found.restitution:g}.
# Behind {found.style}: tangential stiffness UNIT, tangential damping as a multiple of the normal \
one, friction.
# The rest is yours: units si, atom_style sphere, fix nve/sphere.
# For a wall of this material give the words behind * * to fix wall/gran granular.
# Other radii have the same pair_coeff, but the time step is for spheres of this radius: print it \
for the smallest.
timestep {step:g}
pair_style granular
pair_coeff * * SPRING {multiple:g} {friction:g} damping coeff_restitution limit_damping
"""
AT_WALLS = """\
# Springs and dashpots of this code know no mass: spheres of other masses have another e.
# A wall of this material would have e = {wall_e:.3f}, instead of {found.restitution:g}, with the \
dashpots of two spheres.
# So it has values of its own: dashpots of its contacts are sqrt(2) times as strong.
"""
MERCURYDPM = """\
auto species = speciesHandler.copyAndAddObject(LinearViscoelasticSlidingFrictionSpecies());
species->setDensity({density:g});
species->setStiffness({kn:g});
species->setDissipation({cn:g});
species->setSlidingStiffness({kt:g});
species->setSlidingDissipation({ct:g});
species->setSlidingFrictionCoefficient({friction:g});
WALLS
# Give `wall` to the objects that are walls, by setSpecies(wall).
auto wall = speciesHandler.copyAndAddObject(species);
auto atWall = speciesHandler.getMixedObject(species, wall);
atWall->setDissipation({wall_cn:g});
atWall->setSlidingDissipation({wall_ct:g});
setTimeStep({step:g});
"""
YADE = """\
# O.interactions[i, j].phys.kn of a contact must be {kn:g}.
# Give spheres material=of_spheres and walls material=of_walls: else Yade takes the last one.
from math import atan
of_spheres = O.materials.append(ViscElMat(density={density:g}, frictionAngle=atan({friction:g}), \
kn={yade_kn:g}, ks={yade_kt:g}, cn={yade_cn:g}, cs={yade_ct:g}))
WALLS
# Dashpots of two bodies act in series: for this, its own are {strong:.3f} times those of \
the sphere.
of_walls = O.materials.append(ViscElMat(density={density:g}, frictionAngle=atan({friction:g}), \
kn={yade_kn:g}, ks={yade_kt:g}, cn={yade_wall_cn:g}, cs={yade_wall_ct:g}))
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()]),
    InteractionLoop(
        [Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()],
        [Ip2_ViscElMat_ViscElMat_ViscElPhys()],
        [Law2_ScGeom_ViscElPhys_Basic()],
    ),
    NewtonIntegrator(damping=0),
]
O.dt = {step:g}
"""


@record
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
    words: str  # of its input


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
        words=LAMMPS.replace("UNIT", "over contact radius [Pa]").replace(
            "SPRING",
            "hertz/material {young:g} {found.input_restitution:g} {nu:g} tangential {found.style} "
            "{gt:g}",
        ),
    ),
    "lammps-hooke": Code(
        {"linear_history": Law(limited=True)},
        usual_stiffness=2 / 7,
        usual_damping=0.5,
        limited=False,
        by_normal=True,
        origin="2/7 of the stiffness and 1/2 of the damping, as its style gran/hooke/history has",
        words=LAMMPS.replace("UNIT", "[N/m]").replace(
            "SPRING", "hooke {kn:g} {found.input_restitution:g} tangential {found.style} {kt:g}"
        ),
    ),
    "mercurydpm": Code(
        {"": Law()},
        usual_stiffness=2 / 7,
        usual_damping=2 / 7,
        limited=False,
        by_normal=False,
        origin="2/7 of stiffness and dissipation, as in its examples",
        words=MERCURYDPM.replace("WALLS\n", AT_WALLS),
    ),
    "yade": Code(
        {"": Law(limited=True, spring_slides=True)},
        usual_stiffness=2 / 7,
        usual_damping=2 / 7,
        limited=True,
        by_normal=False,
        origin="2/7 of kn and cn, which tc and et = en give",
        words=YADE.replace("WALLS\n", AT_WALLS),
    ),
}


@record
class Error(NamedTuple):
    """Difference of velocity from the continuum, in mu v2(0), where the overlap vanishes."""

    rms: float
    largest: float
    at: float  # incidence of the largest


@record
class Fit(NamedTuple):
    """A law of a code compared with the continuum, as `planarimpact.fit.fit` returns it.

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
    input_restitution : float
        Restitution that the code gets as input, so that its contact has that of the fit.
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
        Error that remains at twice the largest incidence, where nothing was fitted.
    """

    law: str
    style: str
    stiffness: float
    damping: float
    input_restitution: float
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


# At a wall the mass of a contact is that of one sphere, twice that of two; a dashpot has a
# coefficient times the root of it.
WALL = 2**0.5


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
    radius, density, friction : array_like
        One number each, [m], [kg/m^3] and Coulomb's mu.
    speed : array_like
        Normal speed of approach [m/s], up to that at which the spheres overlap by a tenth of their
        radius. The length of a step and linear springs follow from the duration of an elastic
        contact at this speed.

    Returns
    -------
    str
        Comments on what was fitted to what, which error it has, and what the overlap adds to
        that, and then the lines, in SI units.

    Raises
    ------
    InputError
        As `overlap`; also if the fit is of other bodies.

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
    numbers = _numbers(found, material, radius, density, friction, speed)
    code = CODES[found.law]
    text = (ABOUT + code.words).format(found=found, code=code, **numbers)
    return re.sub("^#", "//", text, flags=re.M) if found.law == "mercurydpm" else text


def _numbers(found: Fit, material: bodies.Material, *given: ArrayLike) -> dict[str, Any]:
    """Numbers and words of what `lines` prints: of the comments, and of a contact in SI units."""
    radius, density, friction, speed = given
    size = overlaps.overlap(material, radius, density, speed)
    mu = checks.number("friction", friction, "finite numbers above 0", 0, open_low=True)
    r, rho, v2, young, nu = (float(np.asarray(n)) for n in (radius, density, speed, *material))
    sphere = bodies.solid_sphere(r, density=rho)
    for name, value, own in (
        ("mass_ratio", found.mass_ratio, bodies.mass_ratio(sphere, sphere)),
        ("stiffness_ratio", found.stiffness_ratio, bodies.stiffness_ratio(material, material)),
    ):
        if abs(value - checks.number(name, own, "numbers")) > 1e-6 * value:
            raise checks.InputError(
                f"found.{name} = {value:g}: allowed is that of two such spheres, {float(own):g}"
            )
    both = bodies.contact(sphere, material, sphere, material)
    mass, force = float(both.mass), float(bodies.hertz_peak_force(*both, speed=v2))
    lasts = 2 * hertz.COMPRESSION * hertz.PEAK_FORCE * mass * v2 / force
    # Stiffness and damping of linear springs, normal and tangential.
    kn = mass * (math.pi / lasts) ** 2
    damping = timestep.normal_damping(hertzian=False, input_restitution=found.input_restitution)
    root = (kn * mass) ** 0.5
    linear = {"kn": kn, "kt": kn * found.stiffness}
    linear |= {"cn": root * damping, "ct": root * found.damping}
    # Yade puts the springs, and the dashpots, of two bodies in series.
    strong = 1 / (2 / WALL - 1)
    factors = {"": 1.0, "wall_": WALL, "yade_": 2.0, "yade_wall_": 2 * strong}
    law = CODES[found.law].styles[found.style]
    own_damping = timestep.normal_damping(law.hertzian, found.input_restitution)
    # A wall with the dashpots of spheres is as a contact with another input restitution.
    weaker = damping / WALL
    at_wall = math.exp(-math.pi * weaker / math.sqrt(4 - weaker**2))
    end, known = float(found.incidence[-1]), overlaps.FRICTIONS[-1]
    costs = overlaps.costs(found.law, size, min(mu, known))
    jumps = overlaps.costs(found.law, 0.0, 0.0)
    caution = Caution.of(found.loss, mu, found.restitution).text
    return {
        "continuum": found.loss if found.restitution < 1 else "elastic",
        "steps": timestep.DASHPOT_STEPS,
        "step": lasts / timestep.DASHPOT_STEPS,
        "end": end,
        "twice": 2 * end,
        "overlap": size,
        "up_to": overlaps.INCIDENCES,
        "costs": costs,
        "wall": f"at most {costs[2]:.2g}" if costs[2] else "nothing",
        "jumps": JUMPS.format(*jumps) if any(jumps) else "",
        "measured": min(mu, known),
        "larger": LARGER if mu > known else "",
        "caution": f"# caution: {caution}\n" if caution else "",
        "friction": mu,
        "density": rho,
        "speed": v2,
        "young": young,
        "nu": nu,
        "gt": found.stiffness * young / (1 - nu**2),  # 2 E* times the share
        "multiple": found.damping / own_damping if own_damping else 0.0,
        "strong": strong,
        "wall_e": timestep.restitution_after(law, at_wall, round(WALL * timestep.DASHPOT_STEPS)),
        **{at + name: factor * linear[name] for at, factor in factors.items() for name in linear},
    }
