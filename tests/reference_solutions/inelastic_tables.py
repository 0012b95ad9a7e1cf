"""Tables of data/inelastic_models: five models of loss, each by a second code.

python -m tests.reference_solutions.inelastic_tables data/inelastic_models [table ...]
"""

import functools
import sys
from itertools import product

import numpy as np
import yaml
from mpmath import mp
from scipy.optimize import minimize_scalar

from tests.reference_solutions import high_precision, inelastic_contact, viscous_precision
from tests.reference_solutions.exact_tables import (
    ANGLE,
    CURVE,
    FIG9_COLUMNS,
    INCIDENCE,
    RUBBER,
    SHOT,
    SHOT_HEADER,
    VELOCITY,
    ZETA2,
    shot_columns,
)
from tests.reference_solutions.table_files import DATA, digits, read, table, write

BETA = 3.5
MODELS = [
    "continuum.viscous",
    "continuum.plastic",
    "lumped.viscous",
    "lumped.unloading-stiffness",
    "lumped.hysteretic",
]
E = [0.5, 0.6, 0.7, 0.8, 0.9, 1.0]
NU = [0.2, 0.5]
CONTACT_E, CONTACT_NU = 0.6, 0.3
INCIDENCES = [0.5 * i for i in range(1, 17)]
# The impacts that beta_0 of a pair is fitted to: up to where, and whether evenly over the angle.
SPREADS = ["to (1 + e) m2/m1", "to 45 deg", "to 60 deg"]
SPREADS += ["to 0.5 (1 + e) m2/m1", "to 1.5 (1 + e) m2/m1"]
SPREADS += [f"{reach}, by angle" for reach in SPREADS]
# Impacts of a fit, and how many of them are solved; the others lie on chords.
IMPACTS, SOLVED = 3000, 121
STEPS, SPRINGS = 1600, 400
# Of the grid, and of the continua in Figs 5, 6 and 9: solved with half
# of each too, and extrapolated, as errors are in proportion to the step.
FINE_STEPS, FINE_SPRINGS = 6400, 1600
CONTINUA = MODELS[:2]
ANGLES = [0.5, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 10.0, 12.0, 15.0, 18.0, 20.0, 22.0, 25.0]
ANGLES += [27.0, 28.0, 30.0, 35.0, 50.0, 70.0]
FIGURES_E = 0.5
# Of what data/model_errors measures errors against.
GRID_E = 0.8
GRID_OUTPUTS = ["peak_friction [mu F2max]", "dissipation [mu^2 m2 v2(0)^2]"]
GRID = [round(0.1 * k, 1) for k in range(81)]
# The rubber sphere, beside the elastic continuum: at one e, and impacts below an incidence.
ELASTIC = "continuum"
RUBBER_E, RUBBER_LIMITS = 0.9, (2.5, 8.5)
RUBBER_ALONE = ["velocity alone", "spin alone"]
RUBBER_RMS = ["rms_distance [1]", "rms_from_velocity [1]", "rms_from_spin [1]"]
RUBBER_INCIDENCES = [0.1, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0]
FIG6_INCIDENCES = [0.25 * i for i in range(1, 18)] + [4.5, 4.6, 4.7, 5.0, 6.0, 7.0, 8.0]
FIG9_ANGLES = {
    0.1: [float(k) for k in (2, 4, 6, 7, 9, 11, 13, 15, 17, 19, 22, 24, 27, 30, 50, 75)],
    0.5: [float(k) for k in (5, 15, 25, 31, 35, 40, 45, 50, 55, 60, 64, 66, 70, 75, 85)],
}


def tables():
    """Every table by its name."""
    angles = [(mu, angle) for mu, angles in FIG9_ANGLES.items() for angle in angles]
    rebound = ["model", "e", INCIDENCE, VELOCITY]
    turned = ["restitution [1]", "tangential_restitution [1]"]
    return {
        "rebound": table(rebound, _at_incidence, product(MODELS, INCIDENCES)),
        "rebound_grid": table([*rebound, *GRID_OUTPUTS], _on_grid, product(CONTINUA, GRID)),
        "tangential_restitution": table(
            ["model", "nu", *turned], _at_restitution, product(MODELS, NU, E)
        ),
        "pairs": table(
            [*CURVE, "spread", "pair", *turned], _of_pair, product(MODELS, _pairs(), SPREADS)
        ),
        "rubber_sphere": table([*CURVE, "e", INCIDENCE, turned[1]], _of_rubber, _rubber_rows()),
        "rubber_rms": table(
            [*CURVE, "incidence_limit [mu v2(0)]", *RUBBER_RMS],
            _rubber_rms,
            product([*MODELS, ELASTIC], RUBBER_LIMITS),
        ),
        "fig5_experiment": table([*CURVE, ANGLE, *SHOT_HEADER], _shot, product(CONTINUA, ANGLES)),
        "fig6_rebound": table(rebound, _fig6, product(CONTINUA, FIG6_INCIDENCES)),
        "fig9_dissipation": table(
            ["model", *FIG9_COLUMNS],
            _fig9,
            [(model, *place) for model in CONTINUA for place in angles],
        ),
    }


def velocities(model, x, zeta2, e):
    """Velocities at separation."""
    if model == "lumped.unloading-stiffness":
        zeta2 = e * e * zeta2
    if model not in CONTINUA:
        # Without loss a Kelvin-Voigt element is a spring.
        dashpots = model == "lumped.viscous" and e < 1
        exact = viscous_precision if dashpots else high_precision
        return np.array([float(exact.rebound(float(v), BETA, zeta2, e, 15).velocity) for v in x])
    return inelastic_contact.rebound(model, x, BETA, zeta2, e, STEPS, SPRINGS)


def like(nu):
    """zeta^2 of two bodies of one material."""
    return (2 - nu) / (2 * (1 - nu))


def slope(model, zeta2, e, spread=""):
    """beta_0 of the lines that fit best, over impacts spread evenly from 0 to (1 + e) beta.

    A `spread` is an other one: up to another incidence or angle, or evenly over the angle.
    """
    end = (1 + e) * BETA
    x = _spread(end, spread)
    solved, w = _solved(model, zeta2, e)
    w = np.where(x < end, np.interp(x, solved, w), x - end)

    def squares(beta_0):
        return np.sum((w - np.maximum(-beta_0 * x, x - end)) ** 2)

    # There may be several minima: the lowest of a scan is refined.
    scan = np.linspace(-1, 1, 401)
    near = scan[np.argmin([squares(b) for b in scan])]
    bounds = (near - 0.005, near + 0.005)
    return float(minimize_scalar(squares, bounds=bounds, options={"xatol": 1e-9}).x)


@functools.cache
def _solved(model, zeta2, e):
    solved = np.linspace(0, (1 + e) * BETA, SOLVED)
    return solved, velocities(model, solved, zeta2, e)


def _spread(end, words):
    """Incidences of the impacts of a fit by words such as "0.3: to 45 deg, by angle", mu first."""
    share = (np.arange(IMPACTS) + 0.5) / IMPACTS
    if not words:
        return end * share
    friction, words = float(words.split(": ")[0]), words.split(": ")[1]
    number = float(words.split()[1].strip("(")) if "to (1" not in words else 1.0
    # Beyond 1.5 end no impact has a part in the slope.
    reach = number * end
    if " deg" in words:
        reach = min(np.tan(np.radians(number)) / friction, 1.5 * end)
    if "by angle" not in words:
        return reach * share
    return np.tan(np.arctan(friction * reach) * share) / friction


def extrapolated(model, zeta2, e, x):
    """One impact of a continuum: alone, so that a test can compute a few rows of a table."""
    found = inelastic_contact.extrapolated(
        model, [float(x)], BETA, zeta2, e, FINE_STEPS, FINE_SPRINGS
    )
    return inelastic_contact.Impact(*(column[0] for column in found))


def _on_grid(model, x):
    found = extrapolated(model, ZETA2, GRID_E, x)
    numbers = found.velocity, found.peak_friction, found.work
    return [model, GRID_E, x, *(digits(number, 6) for number in numbers)]


def _shot(model, angle):
    x = mp.tan(mp.radians(angle)) / mp.mpf(SHOT["friction"])
    w = extrapolated(model, SHOT["stiffness_ratio"], SHOT["restitution"], x).velocity
    first, *columns = shot_columns(angle, x, mp.mpf(float(w)))
    return [model, "experiment", angle, first, *(digits(c, 6) for c in columns)]


def _fig6(model, x):
    w = extrapolated(model, ZETA2, FIGURES_E, x).velocity
    return [model, FIGURES_E, x, digits(w, 6)]


def _fig9(model, mu, angle):
    theta = np.radians(angle)
    work = extrapolated(model, ZETA2, FIGURES_E, np.tan(theta) / mu).work
    lost = 2 * (mu * np.cos(theta)) ** 2 * work
    return [model, mu, FIGURES_E, angle, digits(lost, 6)]


def _at_incidence(model, x):
    w = velocities(model, [x], like(CONTACT_NU), CONTACT_E)[0]
    return [model, CONTACT_E, x, round(float(w), 5)]


def _at_restitution(model, nu, e):
    return [model, nu, e, round(slope(model, like(nu), e), 5)]


def _of_pair(model, pair, spread):
    row = _pairs()[pair]
    e = float(row["restitution [1]"])
    found = slope(model, _ratio(pair), e, f"{row['friction [1]']}: {spread}")
    return [model, "pairs", spread, pair, e, round(found, 5)]


def _rubber_rows():
    """Model, variant and e, then incidence and restitution of every row on the rubber sphere.

    In place of the restitution, what a half of the measurement says; of this there is no model.
    """
    rows = [
        ("measured", half, None, x, said[1 + place])
        for place, half in enumerate(RUBBER_ALONE)
        for x, _, said in _rubber_impacts()
    ]
    for model in [*MODELS, ELASTIC]:
        rows += [(model, "impacts", None, x, e) for x, e, _ in _rubber_impacts()]
        if model != ELASTIC:
            rows += [(model, "stated", None, x, e) for x, e in _rubber_stated()]
        e = 1.0 if model == ELASTIC else RUBBER_E
        rows += [(model, None, e, x, e) for x in RUBBER_INCIDENCES]
    return rows


def _of_rubber(model, variant, own_e, x, e):
    share = e if model == "measured" else turned_round(model, x, e)
    return [model, variant, own_e, x, digits(share, 5)]


def _rubber_rms(model, limit):
    near = [(turned_round(model, x, e), said) for x, e, said in _rubber_impacts() if x <= limit]
    off = np.array([e_t - np.array(said) for e_t, said in near])
    return [model, "rms", limit, *(digits(rms, 5) for rms in np.sqrt(np.mean(off**2, axis=0)))]


@functools.cache
def turned_round(model, x, e):
    """-w/x of the rubber sphere: what of the tangential velocity is turned round."""
    if model == ELASTIC:
        model, e = "continuum.viscous", 1.0
    if model in CONTINUA:
        found = inelastic_contact.extrapolated(model, [x], BETA, RUBBER, e, STEPS, SPRINGS)
        return -float(found.velocity[0]) / x
    return -float(velocities(model, [x], RUBBER, e)[0]) / x


@functools.cache
def _rubber_impacts():
    """Incidence and restitution of the measured impacts, and -w/x.

    This is there as it was measured, and again from the change of the centre's velocity and from
    that of the spin: friction gives the contact point 7/2 of the one and 7/5 of the other.
    """
    friction = _parameters("cross2014")["friction"]["value"]
    found = []
    for row in read("cross2014/impacts"):
        number = {key.partition(" [")[0]: cell for key, cell in row.items()}
        before, e, e_t, ratio, spin = (
            float(number[key])
            for key in (
                "tangential_before",
                "restitution",
                "tangential_restitution",
                "velocity_ratio",
                "spin_change",
            )
        )
        angle = float(number["angle"]) * np.pi / 180
        # In units of the incident speed.
        contact = before * np.cos(angle)
        after = [contact - change for change in (3.5 * (1 - ratio) * np.sin(angle), 1.4 * spin)]
        found.append((before / friction, e, (e_t, *(-float(w) / contact for w in after))))
    return found


def _rubber_stated():
    """Incidence and restitution of the stated impacts."""
    known = {key: parameter["value"] for key, parameter in _parameters("cross2014").items()}
    return [
        (
            float(np.tan(np.radians(known[f"angle_{year}"])) / known[f"friction_{year}"]),
            known[f"restitution_{year}"],
        )
        for year in (2010, 2002)
    ]


@functools.cache
def _pairs():
    return {row["pair"]: row for row in read("cornell1999/pairs")}


@functools.cache
def _parameters(source):
    text = (DATA / source / "source.yaml").read_text(encoding="utf-8")
    return yaml.safe_load(text)["parameters"]


def _ratio(pair):
    """zeta^2 = E*/(4 G*) of two materials."""
    normal = tangential = 0.0
    for body in (_pairs()[pair]["body"], _pairs()[pair]["other"]):
        name = body.lower().replace(" ", "_").replace("-", "_")
        young, nu = (
            _parameters("cornell1999")[f"{name}_{key}"]["value"]
            for key in ("young_modulus", "poisson_ratio")
        )
        normal += (1 - nu**2) / young
        tangential += (2 - nu) * 2 * (1 + nu) / young
    return tangential / normal / 4


if __name__ == "__main__":
    folder, *names = sys.argv[1:]
    write(folder, {name: table for name, table in tables().items() if name in names or not names})
