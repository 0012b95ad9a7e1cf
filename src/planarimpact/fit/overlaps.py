"""How far spheres overlap in an impact, and what that costs.

While two spheres touch they pass each other, and their common normal turns. The continuum keeps it,
as every planar theory does, and so do `laws`. A second cause is far smaller: LAMMPS takes half of
the overlap from the lever arm of friction.
"""

from typing import NamedTuple

from planarimpact import bodies
from planarimpact.ground import checks
from planarimpact.ground.arrays import ArrayLike

# What was measured in LAMMPS, see `data/lammps/overlap.csv`: largest approaches over the radius of
# a sphere, and frictions. At the largest approach the radius of contact is 0.22 of that of a
# sphere; Hertz' law takes it to be small.
OVERLAPS = (0.0001, 0.001, 0.004, 0.01, 0.02, 0.043, 0.1)
FRICTIONS = (0.1, 0.3, 0.5, 1.0)
INCIDENCE = 6.0  # the largest


class Cost(NamedTuple):
    """What an overlap changes at most, of all that was measured.

    `rms` and `largest` are of the difference in v1(tf)/(mu v2(0)) from what `fit` foresees, over
    x = 0 to `INCIDENCE`; `restitution` is what e loses. The spheres come without spin. Velocities
    are along and across the normal of first touch.
    """

    rms: float
    largest: float
    restitution: float


# Over the overlap: at vanishing friction, and what is added in proportion to friction squared.
# Rounded up, so that it holds with other materials, too.
COST = Cost(5.1, 11.0, 0.3), Cost(60.0, 160.0, 41.0)


def cost(overlap: float, friction: float) -> Cost:
    """What an overlap costs at most.

    Examples
    --------
    >>> [round(number, 2) for number in cost(0.043, 0.5)]
    [0.86, 2.19, 0.45]
    """
    return Cost(*(overlap * (a + b * friction**2) for a, b in zip(*COST, strict=True)))


@checks.default_errors
def overlap(
    material: bodies.Material, radius: ArrayLike, density: ArrayLike, speed: ArrayLike
) -> float:
    """Largest approach of two equal solid spheres over their radius, in an elastic impact.

    Parameters
    ----------
    material, radius, density, speed
        As in `fit.lines`.

    Returns
    -------
    float

    Raises
    ------
    InputError
        If an argument is not one number above 0, or at this speed they overlap by more than a tenth
        of their radius.

    Examples
    --------
    >>> rubber = bodies.Material(young_modulus=50e6, poisson_ratio=0.45)
    >>> round(overlap(rubber, 0.005, 1100, 2.0), 3)
    0.043
    """
    r, rho, v = (
        checks.single(name, checks.positive(name, value))
        for name, value in (("radius", radius), ("density", density), ("speed", speed))
    )
    sphere = bodies.solid_sphere(r, rho)
    mass, modulus, effective = bodies.contact(sphere, material, sphere, material)
    # Energy: (2/5) F d is m2 v^2/2.
    at_one = 1.25 * float(mass / bodies.hertz_peak_force(mass, 1.0, modulus, effective)) / r
    fastest = (OVERLAPS[-1] / at_one) ** 1.25
    if v > fastest * (1 + 1e-9):  # rounding
        raise checks.InputError(
            f"speed = {checks.brief(speed)}: allowed are speeds up to {fastest * (1 - 5e-4):.4g} "
            f"m/s, where these spheres overlap by {OVERLAPS[-1]:g} of their radius; Hertz' law is "
            "for small contacts, and more was not measured"
        )
    return at_one * v**0.8
