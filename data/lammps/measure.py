"""Rebounds in LAMMPS with the lines that `planarimpact.fit` writes, and with usual values.

    python data/lammps/measure.py

LAMMPS comes from workflow/envs/peers.txt. Every law has no scale of its own, so the spheres are the
same for all pairs but for Poisson's ratio and restitution; they are slow, so that the normal of a
contact hardly turns.
"""

from pathlib import Path
from typing import Any

import yaml

from planarimpact import bodies, fit
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
                velocity = peers.lammps_pairs(text, x, **SPHERE).velocity
                measured += [
                    [f"{pair}, {law}, {name}", f"{at:.10g}", f"{w:.6f}"]
                    for at, w in zip(x, velocity, strict=True)
                ]
    return measured


def settings() -> dict[str, Any]:
    """Settings of the figure, by their values."""
    return _values(yaml.safe_load(FIGURE.read_text(encoding="utf-8"))["settings"])


def _values(node: dict[str, Any]) -> Any:
    return node["value"] if "value" in node else {key: _values(own) for key, own in node.items()}


if __name__ == "__main__":
    header = ["curve", "incidence [mu v2(0)]", "velocity [mu v2(0)]"]
    csv_tables.write_rows(HERE / "rebound.csv", header, rows(**settings()))
