"""Every argument of every public function has a rule, and is refused by it in one line.

The line names the argument and says what is allowed. A name has one rule in the whole package, but
for `OTHERWISE`; a new function is tested as soon as its room's door shows it. What arguments may
not be together is in tests/refusals.
"""

import inspect
from functools import partial
from types import FunctionType

import numpy as np
import pandas as pd
import pytest

from planarimpact import (
    InputError,
    Pair,
    bodies,
    collision,
    continuum,
    export,
    fit,
    lumped,
    models,
    noncollinear,
    rigid,
    spheres,
)
from planarimpact.bodies import Body, Material, Motion
from planarimpact.continuum import micro_slip
from planarimpact.models import laws, timestep
from planarimpact.noncollinear import rigid as rigid_noncollinear
from planarimpact.normal_impact import hertz


class Inches(np.ndarray):
    """An array with a unit, as astropy and unyt have it."""

    unit = "inch"


class Inch:
    """A number with a unit, as pint has it, which NumPy takes for a number."""

    units = "inch"

    def __float__(self):
        return 0.5


class Millimetres(float):
    """A number with a unit that is a float, too."""

    unit = "mm"


HALF = np.ma.array([0.5, 0.5], mask=[False, True])
UNITS = [Inch(), [0.5, Inch()], np.full(3, 0.5).view(Inches), [np.full(3, 0.5).view(Inches)]]
UNITS += [pd.Series([Inch(), Inch()]), Millimetres(0.5), [0.5, Millimetres(0.5)]]
NO_NUMBERS = [*UNITS, "1", True, [True, 0.5], 1j, HALF, [HALF, HALF], pd.NA, None, 10**400]
NO_NUMBERS += [[[0.5], [0.5, 0.5]], pd.array([1, None], dtype="Int64"), {}, b"1"]
NOT_EVEN_MISSING = [bad for bad in NO_NUMBERS if not isinstance(bad, pd.arrays.IntegerArray)]
FINITE = [*NO_NUMBERS, np.nan, np.inf, -np.inf, [0.5, np.nan], 1e101]
POSITIVE = [*FINITE, 0.0, -1.0, [0.5, -0.5], 1e-101]
# What each rule refuses. None is left out where an argument need not be given.
RULES = {
    "real": NOT_EVEN_MISSING,
    "finite": FINITE,
    "positive": POSITIVE,
    "positive or infinite": [bad for bad in POSITIVE if bad is not np.inf],
    "from 0": [*FINITE, -1.0],
    "from 0 or missing": [*NOT_EVEN_MISSING, np.inf, -1.0],
    "positive or missing": [*NOT_EVEN_MISSING, np.inf, -1.0, 0.0],
    "from 1": [*FINITE, 0.9, 0.0],
    "unit_interval": [*FINITE, -0.1, 1.1, 1e-13],
    "unit_interval or missing": [*NOT_EVEN_MISSING, -0.1, 1.1, 1e-13],
    "share": [*FINITE, -0.1, 1.1],
    "of a law": [*FINITE, 0.02, 1.1],
    "poisson_ratio": [*FINITE, -1.0, 0.51],
    "angle": [*FINITE, 90.0, -90.0],
    "two angles": [*FINITE, 45.0, [0.0, 91.0], [-1.0, 45.0], [0.0, 1.0, 2.0]],
    "tolerance": [*FINITE, 0.0, -0.1],
    "count": [*UNITS, 2.5, "9", True, 0, -1, np.nan, None, 10**8],
    "vector": [*FINITE, [1.0, 0.0], [0.0, np.nan, 1.0], ["0", "0", "1"], [0.0, Inch(), 1.0]],
    "loss": ["magic", "viscou\u0455", 5, pd.NA, Inch()],
    "word": ["magic", 5, None, Inch()],
    "path": [5, None, Inch()],
    "record": [3.5, None, (1.0, 2.0, 3.0), Inch()],
}
BALL, STEEL = bodies.solid_sphere(0.01, density=7800.0), Material(207e9, 0.3)
ROD = noncollinear.inverse_mass(1.0, 12**-0.5, offset=0.2, depth=0.4)
# The rule of each argument, and a value that it allows.
ARGUMENTS = {
    "incidence": ("finite", 1.0),
    "mass_ratio": ("from 1", 3.5),
    "stiffness_ratio": ("positive", 1.21),
    "restitution": ("unit_interval", 1.0),
    "loss": ("loss", "viscous"),
    "tolerance": ("tolerance", 0.01),
    "samples": ("count", 9),
    "steps": ("count", 64),
    "tangential_restitution": ("share", 0.5),
    "model": ("word", "rigid"),
    "law": ("word", "yade"),
    "pair": ("record", Pair(STEEL, friction=0.2, restitution=1.0)),
    "body": ("record", BALL),
    "material": ("record", STEEL),
    "other_material": ("record", STEEL),
    "motion": ("record", Motion(0.0, 1.0, 0.0)),
    "inverse_mass": ("record", ROD),
    "first": ("record", ROD),
    "second": ("record", ROD),
    "radius": ("positive", 0.01),
    "mass": ("positive", 0.03),
    "density": ("positive", 7800.0),
    "gyration": ("positive", 1.0),
    "young_modulus": ("positive", 207e9),
    "poisson_ratio": ("poisson_ratio", 0.3),
    "friction": ("positive", 0.2),
    "speed": ("positive", 1.0),
    "effective_modulus": ("positive", 115e9),
    "effective_radius": ("positive", 0.01),
    "relaxation_time": ("from 0", 1e-7),
    "yield_pressure": ("positive", 2e9),
    "peak_force": ("positive", 6.0),
    "rebound_velocity": ("finite", 0.0),
    "theta_deg": ("angle", 30.0),
    "v1": ("finite", 1.0),
    "v2": ("positive", 1.0),
    "tangential": ("finite", 1.0),
    "normal": ("positive", 1.0),
    "spin": ("finite", 0.0),
    "offset": ("finite", 0.2),
    "depth": ("finite", 0.4),
    "stiffness": ("positive", 1.0),
    "phase": ("real", 0.5),
    "displacement": ("finite", [0.5, 0.5]),
    "path": ("path", "sphere.h"),
    "language": ("word", "c"),
    "incidence_max": ("positive", 4.0),
}
VECTORS = {"normal": ("vector", [0, 0, 1]), "other": ("record", BALL)}
VECTORS |= dict.fromkeys(("spin", "other_velocity", "other_spin"), ("vector", [0.0, 0.0, 0.0]))
VECTORS |= {"velocity": ("vector", [1.0, 0.0, -1.0])}
VECTORS |= dict.fromkeys(("offset", "other_offset"), ("vector", None))
MOTION = {"normal": ("finite", 1.0)}
OTHER_BODY, OTHER_MATERIAL = {"other": ("record", BALL)}, {"other": ("record", STEEL)}
OF_LAW = {"restitution": ("of a law", 0.8)}
HERTZ = {"velocity": ("real", 0.5)}
OTHERWISE = {
    Body: {
        "mass": ("positive or infinite", 1.0),
        "gyration": ("positive or infinite", 1.0),
        "radius": ("from 0", 0.0),
    },
    Motion: MOTION,
    Pair: {
        "friction": ("from 0", 0.2),
        "restitution": ("unit_interval or missing", 0.8),
        "relaxation_time": ("from 0 or missing", None),
        "yield_pressure": ("positive or missing", None),
        "stiffness_ratio": ("positive", 1.2),
        "effective_modulus": ("positive", None),
    },
    bodies.contact: OTHER_BODY,
    bodies.contact_velocity: MOTION | {"radius": ("from 0", 0.01)},
    bodies.dundurs: OTHER_MATERIAL,
    bodies.effective_masses: OTHER_BODY,
    bodies.effective_modulus: OTHER_MATERIAL,
    bodies.effective_radius: {"other": ("positive or infinite", 0.1)},
    bodies.mass_ratio: OTHER_BODY,
    bodies.peak_force: OF_LAW,
    bodies.relaxation_time: OF_LAW,
    bodies.stiffness_ratio: OTHER_MATERIAL,
    bodies.yield_pressure: OF_LAW,
    collision.collide: VECTORS,
    fit.lines: {"found": ("record", fit.fit("yade", 3.5, bodies.stiffness_ratio(STEEL)))},
    hertz.phase_at: HERTZ,
    micro_slip.friction: {"radius": ("positive", [0.5, 1.0])},
    models.compare: {"on": ("record", STEEL), "angle": ("two angles", (80, 90))},
    noncollinear.history: {"friction": ("from 0", 0.5), "loss": ("loss", "hysteretic")},
    noncollinear.rebound: {"friction": ("from 0", 0.5), "loss": ("loss", "hysteretic")},
    noncollinear.kinetic_energy: MOTION,
    spheres.covers: dict.fromkeys(("mass_ratio", "stiffness_ratio", "restitution"), ("real", 1.0)),
    spheres.rebound: {"restitution": ("unit_interval", 0.5)},
    rigid_noncollinear.rebound: {"friction": ("from 0", 0.5), "law": ("word", "energetic")},
}
# Settings and switches, and arguments of any number.
LEFT_OUT = {"settings", "materials", "forces", "solve"}
# Of arrays that are checked.
UNCHECKED = {spheres.error_bound}
DOORS = bodies, collision, continuum, fit, lumped, models, laws, noncollinear, rigid_noncollinear
DOORS = *DOORS, rigid, spheres, export, hertz, micro_slip
RECORDS = Body, Material, Motion, Pair


def public():
    """Every function of every door."""
    for door in DOORS:
        names = getattr(door, "__all__", None) or vars(door)
        for name in names:
            found = getattr(door, name)
            own = isinstance(found, FunctionType) and found.__module__.startswith(door.__name__)
            if own and found not in UNCHECKED and not name.startswith("_"):
                yield found
    yield from RECORDS
    yield partial(timestep.rebound, timestep.LINEAR)


def cases():
    """Each function with each of its arguments."""
    for function in public():
        known = ARGUMENTS | OTHERWISE.get(function, {})
        names = [name for name in inspect.signature(function).parameters if name not in LEFT_OUT]
        given = {name: known.get(name, ("?", None))[1] for name in names}
        for name in names:
            words = f"{getattr(function, '__module__', '')}.{getattr(function, '__name__', 'step')}"
            yield pytest.param(
                function, given, name, known.get(name, ("?",))[0], id=f"{words} {name}"
            )


@pytest.mark.parametrize(("function", "given", "name", "rule"), list(cases()))
def test_an_argument_is_refused_by_its_rule(function, given, name, rule):
    default = inspect.signature(function).parameters[name].default
    passed = []
    for bad in RULES[rule]:
        if bad is None and default is None:
            continue
        try:
            function(**given | {name: bad})
        except InputError as error:
            said = str(error)
            told = any(words in said for words in ("allowed", "give ", "choose ", "not a regular"))
            if not (name in said and told and "\n" not in said and said.isascii()):
                passed.append((bad, said))
        else:
            passed.append((bad, "not refused"))
    assert not passed
