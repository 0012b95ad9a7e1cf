"""Rebounds in Yade with the lines that `planarimpact.fit` writes, and with usual values.

    python data/yade/measure.py

Yade is the program `yade` of Debian. Pairs and spheres are those of data/lammps.
"""

import functools
import itertools
import json
import runpy
import subprocess
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np
import pandas as pd

from planarimpact import bodies, fit
from planarimpact.fit import overlaps
from planarimpact.models import timestep

HERE = Path(__file__).resolve().parent
LAMMPS: dict[str, Any] = runpy.run_path(str(HERE.parent / "lammps/measure.py"))
SPHERE, EVERY = LAMMPS["SPHERE"], LAMMPS["EVERY"]
fitted = functools.cache(LAMMPS["fitted"])
# The part of a step that is over when contact begins. At 0, spheres that just touch may or may not
# be in contact.
BEGINS = (0.001, 0.25, 0.5, 0.75)


def material(pair: str) -> bodies.Material:
    """The material of both spheres of a pair."""
    return bodies.Material(LAMMPS["YOUNG_MODULUS"], LAMMPS["PAIRS"][pair][0])


Ask: TypeAlias = Callable[[list[dict[str, Any]]], list[list[float]]]


def usual(found: fit.Fit) -> fit.Fit:
    """The same with usual values: 2/7 of the stiffness and of the damping."""
    e = found.restitution
    damping = timestep.normal_damping(hertzian=False, input_restitution=e)
    return found._replace(stiffness=2 / 7, damping=2 / 7 * damping, input_restitution=e)


def in_yade(impacts: list[dict[str, Any]]) -> list[list[float]]:
    """What Yade answers to impacts, the arguments of `collide` in impacts.py."""
    with tempfile.TemporaryDirectory() as folder:
        asked, answered = Path(folder) / "asked", Path(folder) / "answered"
        asked.write_text(json.dumps(impacts), encoding="utf-8")
        command = ["yade", "-n", "-x", "-j1", str(HERE / "impacts.py"), str(asked), str(answered)]
        subprocess.run(command, check=True, capture_output=True)
        answers: list[list[float]] = json.loads(answered.read_text(encoding="utf-8"))
        return answers


def impact(
    found: fit.Fit, pair: str, x: list[float], *, wall: bool, begins: float, **given: float
) -> dict[str, Any]:
    """Arguments of `collide` for a fit, in spheres of data/lammps that differ as given."""
    sphere = SPHERE | given
    lines = fit.lines(found, material(pair), **sphere)
    del sphere["density"]
    return {"lines": lines, "incidence": x, "wall": wall, "begins": begins} | sphere


def rows(law: str = "yade", ask: Ask = in_yade) -> list[list[str]]:
    """Pair, contact, variant, begin, incidence and velocity of every impact."""
    labels, impacts = [], []
    for pair, wall, begins in itertools.product(LAMMPS["PAIRS"], (False, True), BEGINS):
        found = fitted(law, pair)
        x = [*found.incidence[::EVERY].tolist(), 2 * float(found.incidence[-1])]
        variants = {"before": usual(found), "after": found}
        for name, one in variants.items():
            if not (wall and name == "before"):
                labels.append([pair, "wall" if wall else "spheres", name, f"{begins:g}"])
                impacts.append(impact(one, pair, x, wall=wall, begins=begins))
    return [
        [*label, f"{x:.10g}", f"{w:.6f}"]
        for label, asked, answer in zip(labels, impacts, ask(impacts), strict=True)
        for x, w in zip(asked["incidence"], answer, strict=True)
    ]


def overlap_rows(law: str = "yade", ask: Ask = in_yade) -> list[list[str]]:
    """Pair, contact, friction, overlap, and how far the code is from the fit with its lines."""
    labels, impacts, foreseen = [], [], []
    cases = LAMMPS["PAIRS"], (False, True), overlaps.FRICTIONS, overlaps.OVERLAPS
    for pair, wall, friction, size in itertools.product(*cases):
        slow = fit.overlap(material(pair), *(SPHERE[key] for key in ("radius", "density", "speed")))
        found = fitted(law, pair)
        speed = SPHERE["speed"] * (size / slow) ** 1.25
        given = {"friction": friction, "speed": speed, "wall": wall, "begins": BEGINS[0]}
        impacts.append(impact(found, pair, found.incidence.tolist(), **given))
        labels.append([pair, "wall" if wall else "spheres", f"{friction:g}", f"{size:.4f}"])
        foreseen.append(found)
    measured = []
    for label, found, answer in zip(labels, foreseen, ask(impacts), strict=True):
        off = np.abs(np.array(answer) - found.after)
        costs = [off[found.incidence <= end].max() for end in overlaps.INCIDENCES]
        measured.append([*label, *(f"{cost:.4f}" for cost in costs)])
    return measured


def write(folder: Path, law: str, ask: Ask) -> None:
    """Both tables of a code."""
    header = ["pair", "contact", "variant", "begins [1]", "incidence [mu v2(0)]"]
    impacts = pd.DataFrame(rows(law, ask), columns=[*header, "velocity [mu v2(0)]"])
    impacts.to_csv(folder / "rebound.csv", index=False, lineterminator="\n")
    header = ["pair", "contact", "mu", "overlap [radius]"]
    ends = ["cost_sticking [mu v2(0)]", "cost_sliding [mu v2(0)]"]
    costs = pd.DataFrame(overlap_rows(law, ask), columns=[*header, *ends])
    costs.to_csv(folder / "overlap.csv", index=False, lineterminator="\n")


if __name__ == "__main__":
    write(HERE, "yade", in_yade)
