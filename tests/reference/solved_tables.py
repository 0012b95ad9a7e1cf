"""Write data/scenes_solved and data/study_solved: what scenes and the study must come to.

    python tests/reference/solved_tables.py data

A second. Rebound and regime are those of `high_precision`. The rest is mechanics from first
principles, in vectors of 40 digits: the velocity of a contact point, what an impulse there does to
velocity and spin, the kinetic energy that is lost, and the depth at which the work of Hertz's force
has used up the energy of approach. Nothing is taken from the package.
"""

import csv
import sys
from itertools import product
from pathlib import Path

import high_precision
import numpy as np
import yaml
from mpmath import mp

ROOT = Path(__file__).parents[2]
SCENES = ("shot_peening", "billiard_cushion", "superball")
DIGITS = 40
REGIMES = ("STICK", "SLIP_STICK", "STICK_SLIP", "SLIP_STICK_SLIP", "SLIP_THROUGHOUT", "MULTIPLE")
SPACE = tuple(f"{kind}_{axis}" for kind in ("velocity", "spin") for axis in "xyz")
PLANE = ("velocity_tangential", "velocity_normal", "spin")
UNITS = {"velocity": "m/s", "spin": "rad/s"}
# Some at a limit of a regime or beside it: zeta^2, beta, and slip throughout at e = 1.
INCIDENCES = (0.0, 0.025, 0.8, 1.2, 1.225, 3.0, 3.5, 4.0, 5.775, 5.8, 8.0)
RESTITUTIONS = (0.0, 0.005, 0.15, 0.5, 0.59, 0.9, 1.0)


# Scenes ------------------------------------------------------------------------------------


def scene_table(name, step=1):
    """Every `step`-th impact of a scene: header, and rows of text, numbers to 20 digits."""
    with open(ROOT / f"data/scenes/{name}.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))[::step]
    with mp.workdps(DIGITS + 10):
        answers = [_impact({key.split(" [")[0]: text for key, text in row.items()}) for row in rows]
    # A word cannot be measured: as a label the regime must be the same.
    header = ["regime", "row [1]", *(name for name in answers[0] if name != "regime")]
    for index, answer in enumerate(answers):
        answer["row [1]"] = str(1 + step * index)
    return header, [[_text(answer[name]) for name in header] for answer in answers]


def _impact(row):
    """One impact on a half-space at rest: `{column of the result: number or regime}`."""
    # The float64 that the text is, exactly.
    row = {name: mp.mpf(float(text)) for name, text in row.items() if name != "id"}
    velocity, spin, normal = _state(row)
    radius, e, friction = row["radius"], row["restitution"], row["friction"]
    mass, inertia = _mass(row)
    arm = _times(-radius, normal)  # from the centre to the contact

    def at_contact(velocity, spin):
        return _plus(velocity, _cross(spin, arm))

    def changes(impulse):
        """Of velocity and spin, by an impulse at the contact."""
        return _times(1 / mass, impulse), _times(1 / inertia, _cross(arm, impulse))

    def energy(velocity, spin):
        return (mass * _dot(velocity, velocity) + inertia * _dot(spin, spin)) / 2

    contact = at_contact(velocity, spin)
    approach = -_dot(contact, normal)
    sideways = _plus(contact, _times(approach, normal))
    speed = mp.sqrt(_dot(sideways, sideways))
    tangent = _times(1 / speed, sideways)
    # 1/m2 and 1/m1: velocity of the contact point along a unit impulse.
    give, give_tangential = (
        _dot(at_contact(*changes(along)), along) for along in (normal, tangent)
    )
    normal_stiffness, ratio = _stiffness(row)
    incidence = speed / (friction * approach)
    answer = high_precision.rebound(incidence, give_tangential / give, ratio, e, DIGITS)
    impulse = _plus(
        _times((1 + e) * approach / give, normal),
        _times((answer.velocity * friction * approach - speed) / give_tangential, tangent),
    )
    after = [*map(_plus, (velocity, spin), changes(impulse))]
    # Force K d^(3/2) at the depth where its work (2/5) K d^(5/2) is the energy of approach.
    hertz = mp.mpf(4) / 3 * normal_stiffness * mp.sqrt(radius)
    depth = (approach**2 / give / 2 * 5 / (2 * hertz)) ** (mp.mpf(2) / 5)
    peak = hertz * depth ** (mp.mpf(3) / 2)
    return _columns(*after, "normal_x" in row) | {
        "regime": regime(answer),
        "incidence": incidence,
        "peak_normal_force [N]": peak,
        "peak_friction_force [N]": friction * answer.peak_friction * peak,
        "energy_lost [J]": energy(velocity, spin) - energy(*after),
    }


def _state(row):
    """Velocity, spin and normal in space; a plane state has x along the surface and z off it."""
    if "normal_x" in row:
        numbers = [row[name] for name in SPACE]
        return numbers[:3], numbers[3:], [row[f"normal_{axis}"] for axis in "xyz"]
    along, down, spin = (row[name] for name in PLANE)
    # The contact is below the centre: turning about -y moves it along x.
    zero = mp.zero
    return [along, zero, -down], [zero, -spin, zero], [zero, zero, mp.one]


def _columns(velocity, spin, space):
    """A state after the impact under its headers."""
    values = (*velocity, *spin) if space else (velocity[0], -velocity[2], -spin[1])
    names = SPACE if space else PLANE
    return {
        f"{name}_after [{UNITS[name.split('_')[0]]}]": value
        for name, value in zip(names, values, strict=True)
    }


def _mass(row):
    """Mass and moment of inertia about an axis through the centre."""
    if "density" in row:
        mass = row["density"] * 4 / 3 * mp.pi * row["radius"] ** 3
        return mass, mass * row["radius"] ** 2 * 2 / 5
    return row["mass"], row["mass"] * row["gyration"] ** 2


def _stiffness(row):
    """E*, and the stiffness ratio: 2 a E* over 8 a G* for a contact of radius a (Mindlin)."""
    normal = tangential = mp.zero  # compliances 1/E* and 1/G*
    for body in ("", "other_"):
        if f"{body}young_modulus" in row:  # without, it is rigid
            young, poisson = row[f"{body}young_modulus"], row[f"{body}poisson_ratio"]
            shear = young / (2 * (1 + poisson))
            normal += (1 - poisson**2) / young
            tangential += (2 - poisson) / shear
    return 1 / normal, tangential / normal / 4


def _plus(a, b):
    return [x + y for x, y in zip(a, b, strict=True)]


def _times(factor, a):
    return [factor * x for x in a]


def _dot(a, b):
    return mp.fsum(x * y for x, y in zip(a, b, strict=True))


def _cross(a, b):
    return [a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3)]


# Study -------------------------------------------------------------------------------------


def study_table(step=1):
    """Every `step`-th point chosen from the study's grid: header, and rows of text."""
    header = ["restitution", "stiffness_ratio", "incidence [mu v2(0)]", "velocity [mu v2(0)]"]
    header += ["peak_friction [mu F2max]", "dissipation [mu^2 m2 v2(0)^2]", "regime [code]"]
    rows = []
    for x, beta, zeta2, e in study_points()[::step]:
        answer = high_precision.rebound(x, beta, zeta2, e, DIGITS)
        numbers = answer.velocity, answer.peak_friction, answer.dissipation
        code = REGIMES.index(regime(answer))
        rows.append([repr(e), repr(zeta2), repr(x), *map(_text, numbers), str(code)])
    return header, rows


def study_points():
    """Points of the grid, in its order: chosen ones, and the first and last of every chunk."""
    config = yaml.safe_load((ROOT / "workflow/config.yaml").read_text(encoding="utf-8"))
    study = config["study"]
    grid = {name: [config[name]] for name in ("mass_ratio", "stiffness_ratio")} | study["grid"]
    names = ("incidence", "mass_ratio", "stiffness_ratio", "restitution")
    axes = [_axis(grid[name]) for name in names]
    shape = [len(axis) for axis in axes]
    chosen = INCIDENCES, axes[1], axes[2], RESTITUTIONS
    nearest = [
        sorted({int(np.argmin(np.abs(np.array(axis) - value))) for value in values})
        for axis, values in zip(axes, chosen, strict=True)
    ]
    # Points are numbered with the last axis fastest, and divided among the chunks.
    points = {int(np.ravel_multi_index(place, shape)) for place in product(*nearest)}
    count = int(np.prod(shape))
    ends = [count * i // study["chunks"] for i in range(study["chunks"] + 1)]
    points |= {*ends[:-1], *(end - 1 for end in ends[1:])}
    places = np.transpose(np.unravel_index(sorted(points), shape))
    return [tuple(axis[i] for axis, i in zip(axes, place, strict=True)) for place in places]


def _axis(given):
    if isinstance(given, dict):
        return np.linspace(given["from"], given["to"], given["points"]).tolist()
    return [float(value) for value in given]


# Both --------------------------------------------------------------------------------------


def regime(answer):
    """Name of the order of stick and slip in an answer of `high_precision`."""
    phases = tuple(event.kind for event in answer.events if event.kind in ("stick", "slip"))
    orders = {
        ("stick",): "STICK",
        ("slip", "stick"): "SLIP_STICK",
        ("stick", "slip"): "STICK_SLIP",
        ("slip", "stick", "slip"): "SLIP_STICK_SLIP",
        ("slip",): "SLIP_THROUGHOUT",
    }
    return "STICK" if answer.events[0].velocity == 0 else orders.get(phases, "MULTIPLE")


def _text(value):
    return value if isinstance(value, str) else mp.nstr(value, 20)


def main(data):
    tables = {f"scenes_solved/{name}.csv": scene_table(name) for name in SCENES}
    tables["study_solved/grid.csv"] = study_table()
    for path, (header, rows) in tables.items():
        with open(Path(data) / path, "w", newline="", encoding="utf-8") as file:
            csv.writer(file, lineterminator="\n").writerows([header, *rows])


if __name__ == "__main__":
    main(sys.argv[1])
