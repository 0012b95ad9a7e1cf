"""How far spheres overlap in an impact, and what that costs.

While two spheres touch they pass each other, and their common normal turns. The continuum and
`models.timestep` leave that out. A second cause is far smaller: LAMMPS takes half of the overlap
from the lever arm of friction.
"""

from planarimpact import bodies
from planarimpact.ground import checks
from planarimpact.ground.arrays import ArrayLike

# What was measured in LAMMPS, see `data/lammps/overlap.csv`: largest approaches over the radius of
# a sphere, and frictions. At the largest approach the radius of contact is 0.22 of that of a
# sphere; Hertz' law takes it to be small.
OVERLAPS = (0.0001, 0.001, 0.004, 0.01, 0.02, 0.043, 0.1)
FRICTIONS = (0.1, 0.3, 0.5, 1.0)
# Contacts mostly stick up to the first incidence, and then slide up to the second.
INCIDENCES = (2.5, 6.0)
# Costs up to each incidence, over the overlap: at vanishing friction, and what is added in
# proportion to friction squared. Above all that was measured, e = 0.3 to 1, by 0.06 of it.
COSTS = ((1.0, 7.0), (12.0, 170.0))


def costs(overlap: float, friction: float) -> list[float]:
    """What an overlap changes at most, up to each of `INCIDENCES`.

    It is the difference in v1(tf)/(mu v2(0)) from what `fit` foresees. The spheres come without
    spin. Velocities are along and across the normal of first touch.

    Examples
    --------
    >>> [round(number, 3) for number in costs(0.01, 0.5)]
    [0.028, 0.545]
    """
    return [overlap * (a + b * friction**2) for a, b in COSTS]


@checks.default_errors
def overlap(
    material: bodies.Material, radius: ArrayLike, density: ArrayLike, speed: ArrayLike
) -> float:
    """How far two equal solid spheres overlap at most, over their radius.

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
        If an argument is not one number from 1e-30 to 1e30, or at this speed they overlap by more
        than a tenth of their radius.

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
