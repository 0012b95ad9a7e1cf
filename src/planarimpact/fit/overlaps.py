"""How far spheres overlap in an impact, and what that costs.

While two spheres touch they pass each other, and their common normal turns. Codes also take a share
of the overlap d from the lever arm of a sphere: LAMMPS (`granular_model.cpp`) d/2 in the torque of
friction, at a flat wall nothing; MercuryDPM (`BaseParticle.cc`, `BaseWall.cc`) d/2 in the torque
and in the velocity of the contact point; Yade (`Ig2_Sphere_Sphere_ScGeom.cpp`,
`Ig2_Facet_Sphere_ScGeom.cpp`) d/2 in both, at a flat wall d. The continuum and `models.timestep`
leave this out. Normal and lever arm may cancel: for steel beads in LAMMPS, at mu = 0.1 and x up to
2.5, each alone costs 0.7 d/R, both together 0.2 d/R.
"""

from __future__ import annotations

from planarimpact import bodies
from planarimpact.common import checks
from planarimpact.common.arrays import ArrayLike

# What was measured, see overlap.csv in `data/lammps`, `data/yade` and `data/mercurydpm`, and
# computed for all codes, see `tests/unit/test_fit.py`: largest approaches over the radius of a
# sphere, and frictions. At the largest one the radius of contact is 0.22 of that of a sphere;
# Hertz' law takes it to be small.
OVERLAPS = (0.0001, 0.001, 0.004, 0.01, 0.02, 0.043, 0.1)
FRICTIONS = (0.1, 0.3, 0.5, 1.0)
# Contacts mostly stick up to the first incidence, and then slide up to the second.
INCIDENCES = (2.5, 6.0)
# Costs of two spheres up to each incidence, and of a sphere at a flat wall up to the last: by how
# much velocities jump, at any overlap, where one step of a contact changes; over the overlap of two
# spheres, the cost at vanishing friction, and what is added in proportion to friction squared.
# Above all that was computed by 0.06 of it: e = 0.3 to 1, both losses, Poisson's ratios 0 to 0.5,
# frictions up to 1, contacts that begin anywhere in a step.
COSTS = {
    "lammps": ((0.0, 2.0, 13.0), (0.0, 12.0, 170.0), (0.0, 0.0, 0.0)),
    "mercurydpm": ((0.005, 2.0, 13.0), (0.005, 12.0, 170.0), (0.0, 3.9, 0.0)),
    "yade": ((0.015, 2.0, 13.0), (0.1, 12.0, 170.0), (0.07, 8.0, 0.0)),
}


def costs(law: str, overlap: float, friction: float) -> list[float]:
    """What an overlap changes at most: of two spheres, up to each of `INCIDENCES`, and at a wall.

    It is the difference in v1(tf)/(mu v2(0)) from what `fit` foresees. The spheres come without
    spin. Velocities are along and across the normal of first touch. At a wall, too, the overlap is
    that of two spheres at this speed.

    Examples
    --------
    >>> [round(number, 3) for number in costs("lammps-hooke", 0.01, 0.3)]
    [0.032, 0.273, 0.0]
    """
    return [jump + overlap * (a + b * friction**2) for jump, a, b in COSTS[law.partition("-")[0]]]


@checks.default_errors
def overlap(
    material: bodies.Material, radius: ArrayLike, density: ArrayLike, speed: ArrayLike
) -> float:
    """How far two equal solid spheres overlap at most, over their radius.

    Arguments are those of `fit.lines`. Refused is what is not one number from 1e-30 to 1e30, or a
    speed at which they overlap by more than a tenth of their radius.

    Examples
    --------
    >>> from planarimpact import bodies
    >>> rubber = bodies.Material(young_modulus=50e6, poisson_ratio=0.45)
    >>> round(overlap(rubber, 0.005, 1100, 2.0), 3)
    0.043
    """
    young = bodies.fields("material", material, bodies.Material)["material.young_modulus"]
    given = {"radius": radius, "density": density, "speed": speed, "young_modulus": young}
    # Of numbers in this range all products are numbers, too.
    r, rho, v, _ = (
        checks.number(name, value, "numbers from 1e-30 to 1e30", 1e-30, 1e30)
        for name, value in given.items()
    )
    sphere = bodies.solid_sphere(r, density=rho)
    both = bodies.contact(sphere, material, sphere, material)
    # Energy: (2/5) F d is m2 v^2/2.
    at_one = 1.25 * float(both.mass / bodies.hertz_peak_force(*both, speed=1.0)) / r
    fastest = (OVERLAPS[-1] / at_one) ** 1.25
    if v > fastest * (1 + 1e-9):  # rounding
        raise checks.InputError(
            f"speed = {checks.brief(speed)}: allowed are speeds up to {checks.limit(fastest)} "
            f"m/s, where these spheres overlap by {OVERLAPS[-1]:g} of their radius; Hertz' law is "
            "for small contacts, and more was not measured"
        )
    return at_one * v**0.8
