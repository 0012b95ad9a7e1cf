"""Rebounds in LAMMPS with the lines that `planarimpact.fit` writes, and with usual values.

    python data/lammps/measure.py

LAMMPS comes from workflow/envs/peers.txt. The laws have no scale of their own but that they turn
with the normal of a contact. This grows with the overlap, in `overlap.csv`, and with friction. The
spheres of `rebound.csv` are so slow that they hardly overlap.
"""

import itertools
from pathlib import Path
from typing import Any

import numpy as np
import yaml

from planarimpact import bodies, fit
from planarimpact.fit import overlaps
from stronge1994 import csv_tables
from stronge1994.figures.fitted_laws import curves
from stronge1994.figures.trade import peers

HERE = Path(__file__).resolve().parent
FIGURE = HERE.parents[1] / "src/stronge1994/figures/fitted_laws/figure.yaml"
SPHERE = {"radius": 0.002, "density": 2500.0, "friction": 0.2, "speed": 1e-3}
YOUNG_MODULUS = 70e9
# Every so many incidences of the fit.
EVERY = 5
# Without a fit, as `planarimpact.fit.CODES` says.
USUAL = {
    "lammps-hertz-mindlin": "{normal} {e} {nu} tangential {style} NULL 1.0 {mu}",
    "lammps-hooke": "{normal} {e} tangential {style} {share} 0.5 {mu}",
}


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


def rows(pairs: dict[str, Any], incidence_max: float) -> list[list[object]]:
    """Curve, incidence and velocity of every impact."""
    measured = []
    for pair, laws in curves.fitted(pairs, incidence_max).items():
        nu, e = (float(pairs[pair][key]) for key in ("poisson_ratio", "restitution"))
        material = bodies.Material(YOUNG_MODULUS, nu)
        for law, found in laws.items():
            lines = fit.lines(found, material, **SPHERE)
            x = found.incidence[::EVERY]
            for name, text in (("before", before(lines, nu, e)), ("after", lines)):
                velocity = peers.lammps_pairs(text, x, **SPHERE)
                measured += [
                    [f"{pair}, {law}, {name}", f"{at:.10g}", f"{w:.6f}"]
                    for at, w in zip(x, velocity, strict=True)
                ]
    return measured


def overlap_rows(pairs: dict[str, Any], incidence_max: float) -> list[list[object]]:
    """Curve, overlap, and how far LAMMPS is from what the fit foresees, with its lines."""
    measured = []
    for pair, laws in curves.fitted(pairs, incidence_max).items():
        material = bodies.Material(YOUNG_MODULUS, float(pairs[pair]["poisson_ratio"]))
        slow = fit.overlap(material, *(SPHERE[key] for key in ("radius", "density", "speed")))
        for law, found in laws.items():
            for friction, size in itertools.product(overlaps.FRICTIONS, overlaps.OVERLAPS):
                speed = SPHERE["speed"] * (size / slow) ** 1.25
                sphere = SPHERE | {"friction": friction, "speed": speed}
                lines = fit.lines(found, material, **sphere)
                off = np.abs(peers.lammps_pairs(lines, found.incidence, **sphere) - found.after)
                cost = [off[found.incidence <= end].max() for end in overlaps.INCIDENCES]
                curve = f"{pair}, {law}, mu = {friction:g}"
                measured.append([curve, *(f"{number:.4f}" for number in (size, *cost))])
    return measured


def settings() -> dict[str, Any]:
    """Settings of the figure, by their values."""
    return _values(yaml.safe_load(FIGURE.read_text(encoding="utf-8"))["settings"])


def _values(node: dict[str, Any]) -> Any:
    return node["value"] if "value" in node else {key: _values(own) for key, own in node.items()}


if __name__ == "__main__":
    header = ["curve", "incidence [mu v2(0)]", "velocity [mu v2(0)]"]
    csv_tables.write_rows(HERE / "rebound.csv", header, rows(**settings()))
    header = ["curve", "overlap [radius]", "cost_sticking [mu v2(0)]", "cost_sliding [mu v2(0)]"]
    csv_tables.write_rows(HERE / "overlap.csv", header, overlap_rows(**settings()))
