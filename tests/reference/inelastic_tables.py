"""Tables of data/inelastic_models: five models of loss, each by a second code.

python tests/reference/inelastic_tables.py data/inelastic_models
"""

import csv
import functools
import sys
from pathlib import Path

import numpy as np
import yaml
from high_precision import rebound as exact_rebound
from inelastic_contact import MOTIONS, rebound
from scipy.optimize import minimize_scalar
from table_files import Table, write

ROOT = Path(__file__).parents[2]
BETA = 3.5
MODELS = ["continuum.viscous", "continuum.plastic", "lumped.viscous", "lumped.plastic", "lumped"]
E = [0.5, 0.6, 0.7, 0.8, 0.9, 1.0]
NU = [0.2, 0.5]
CONTACT_E, CONTACT_NU = 0.6, 0.3
INCIDENCES = [0.5 * i for i in range(1, 17)]
# Impacts of a fit, and how many of them are solved; the others lie on chords.
IMPACTS, SOLVED = 3000, 121
STEPS, SPRINGS = 1600, 400


def tables():
    """Every table by its name."""
    return {
        "rebound": Table(
            ["curve", "incidence [mu v2(0)]", "velocity [mu v2(0)]"],
            [functools.partial(_at_incidence, model, x) for model in MODELS for x in INCIDENCES],
        ),
        "tangential_restitution": Table(
            ["curve", "restitution [1]", "tangential_restitution [1]"],
            [
                functools.partial(_at_restitution, model, nu, e)
                for model in MODELS
                for nu in NU
                for e in E
            ],
        ),
        "pairs": Table(
            ["curve", "pair", "restitution [1]", "tangential_restitution [1]"],
            [functools.partial(_of_pair, model, pair) for model in MODELS for pair in _pairs()],
        ),
    }


def velocities(model, x, zeta2, e):
    """Velocities at separation."""
    if model == "lumped.plastic":
        zeta2 = e * e * zeta2
    # Without loss a Kelvin-Voigt element is a spring, and its relaxation has no steps.
    if model in ("lumped", "lumped.plastic") or (model == "lumped.viscous" and e == 1):
        return np.array([float(exact_rebound(float(v), BETA, zeta2, e, 15).velocity) for v in x])
    assert model in MOTIONS
    return rebound(model, x, BETA, zeta2, e, STEPS, SPRINGS)


def like(nu):
    """zeta^2 of two bodies of one material."""
    return (2 - nu) / (2 * (1 - nu))


def slope(model, zeta2, e):
    """beta_0 of the lines that fit best, over incidences spread evenly from 0 to (1 + e) beta."""
    reach = (1 + e) * BETA
    x = reach * (np.arange(IMPACTS) + 0.5) / IMPACTS
    solved = np.linspace(0, reach, SOLVED)
    w = np.interp(x, solved, velocities(model, solved, zeta2, e))

    def squares(beta_0):
        return np.sum((w - np.maximum(-beta_0 * x, x - reach)) ** 2)

    # There may be several minima: the lowest of a scan is refined.
    scan = np.linspace(-1, 1, 401)
    near = scan[np.argmin([squares(b) for b in scan])]
    bounds = (near - 0.005, near + 0.005)
    return float(minimize_scalar(squares, bounds=bounds, options={"xatol": 1e-9}).x)


def _at_incidence(model, x):
    w = velocities(model, [x], like(CONTACT_NU), CONTACT_E)[0]
    return [f"{model}, e = {CONTACT_E:g}", x, round(float(w), 5)]


def _at_restitution(model, nu, e):
    return [f"{model}, nu = {nu:g}", e, round(slope(model, like(nu), e), 5)]


def _of_pair(model, pair):
    e = float(_pairs()[pair]["restitution [1]"])
    return [f"{model}, pairs", pair, e, round(slope(model, _ratio(pair), e), 5)]


@functools.cache
def _pairs():
    with open(ROOT / "data/cornell1999/pairs.csv", newline="", encoding="utf-8") as file:
        return {row["pair"]: row for row in csv.DictReader(file)}


@functools.cache
def _parameters():
    text = (ROOT / "data/cornell1999/source.yaml").read_text(encoding="utf-8")
    return yaml.safe_load(text)["parameters"]


def _ratio(pair):
    """zeta^2 = E*/(4 G*) of two materials."""
    normal = tangential = 0.0
    for body in (_pairs()[pair]["body"], _pairs()[pair]["other"]):
        name = body.lower().replace(" ", "_").replace("-", "_")
        young, nu = (
            _parameters()[f"{name}_{key}"]["value"] for key in ("young_modulus", "poisson_ratio")
        )
        normal += (1 - nu**2) / young
        tangential += (2 - nu) * 2 * (1 + nu) / young
    return tangential / normal / 4


if __name__ == "__main__":
    write(sys.argv[1], tables())
