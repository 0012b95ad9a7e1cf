"""Write data/scenes_solved: what the example scenes must come to.

    python -m tests.reference_solutions.solved_tables data

A minute. Rebound, peak friction and largest normal force are those of `inelastic_contact`, the
continuum of the loss. The rest is mechanics from first principles, in vectors of 50 digits: the
velocity of a contact point, what an impulse there does to velocity and spin, the kinetic energy
that is lost. Nothing is taken from the package.
"""

import sys
from pathlib import Path
from typing import NamedTuple

import numpy as np
from mpmath import mp

from tests.reference_solutions import inelastic_contact, table_files

SCENES = ("shot_peening", "billiard_cushion", "superball")
WORKING_DIGITS, DIGITS = 50, 14
# Of the second code; solved with half of each too, and extrapolated.
STEPS, SPRINGS = 6400, 1600
SPACE = tuple(f"{kind}_{axis}" for kind in ("velocity", "spin") for axis in "xyz")
PLANE = ("velocity_tangential", "velocity_normal", "spin")
UNITS = {"velocity": "m/s", "spin": "rad/s"}


# Scenes ------------------------------------------------------------------------------------


def scene_table(name, step=1):
    """Every `step`-th impact of a scene: header, and rows of text."""
    rows = table_files.read(f"scenes/{name}")[::step]
    with mp.workdps(WORKING_DIGITS):
        impacts = [_Impact({key.split(" [")[0]: text for key, text in row.items()}) for row in rows]
        groups = [impact.groups for impact in impacts]
        others = [other for other, *_ in _rebounds([g.with_other_loss() for g in groups])]
        rebounds = zip(impacts, others, _rebounds(groups), strict=True)
        answers = [impact.after(other, *found) for impact, other, found in rebounds]
    # A word cannot be measured: as a label the regime must be the same.
    header = ["regime", "row [1]", *(name for name in answers[0] if name != "regime")]
    for index, answer in enumerate(answers):
        answer["row [1]"] = str(1 + step * index)
    return header, [[_text(answer[name]) for name in header] for answer in answers]


class Groups(NamedTuple):
    """What an impact without units depends on."""

    incidence: mp.mpf
    mass_ratio: mp.mpf
    stiffness_ratio: mp.mpf
    restitution: mp.mpf
    loss: str

    def slides(self):
        """Whether slip never ends."""
        _, beta, zeta2, e, _ = self
        return self.incidence >= max(zeta2, beta + e * (beta - zeta2))

    def with_other_loss(self):
        """The same impact of bodies that lose the energy in the other way."""
        return self._replace(loss={"viscous": "plastic", "plastic": "viscous"}[self.loss])

    def regime(self, gross_slips):
        """The order of stick and slip: gross slips are counted, the last one may be too short."""
        if self.slides():
            return "SLIP_THROUGHOUT"
        if self.incidence == 0:
            return "STICK"
        at_first = self.incidence > self.stiffness_ratio
        if gross_slips > 1 + at_first:
            return "MULTIPLE"
        return "SLIP_STICK_SLIP" if at_first else "STICK_SLIP"


def _rebounds(impacts):
    """Velocity after each impact in mu v2(0), peak friction in mu F2max, and regime.

    Those that slide throughout have the impulse of Coulomb's friction; the second code solves the
    others, of one pair together.
    """
    found = [(g.incidence - (1 + g.restitution) * g.mass_ratio, mp.one, 1) for g in impacts]
    pairs = {}
    for place, groups in enumerate(impacts):
        if not groups.slides():
            pair = f"continuum.{groups.loss}", *map(float, groups[1:4])
            pairs.setdefault(pair, []).append(place)
    for (model, *pair), places in pairs.items():
        x = [float(impacts[place].incidence) for place in places]
        solved = inelastic_contact.extrapolated(model, x, *pair, STEPS, SPRINGS)
        columns = solved.velocity, solved.peak_friction, solved.gross_slips
        for place, *numbers in zip(places, *columns, strict=True):
            found[place] = tuple(mp.mpf(float(number)) for number in numbers)
    return [(w, peak, g.regime(slips)) for g, (w, peak, slips) in zip(impacts, found, strict=True)]


class _Impact:
    """One impact on a half-space at rest."""

    def __init__(self, row):
        words = {name: row.pop(name) for name in ("id", "loss") if name in row}
        # The float64 that the text is, exactly.
        row = {name: mp.mpf(float(text)) for name, text in row.items()}
        self.row, (self.velocity, self.spin, self.normal) = row, _state(row)
        self.mass, self.inertia = _mass(row)
        self.arm = self.normal * -row["radius"]  # from the centre to the contact
        contact = self.at_contact(self.velocity, self.spin)
        self.approach = -(contact @ self.normal)
        sideways = contact + self.normal * self.approach
        self.speed = mp.sqrt(sideways @ sideways)
        self.tangent = sideways / self.speed
        # 1/m2 and 1/m1: velocity of the contact point along a unit impulse.
        self.give, self.give_tangential = (
            self.at_contact(*self.changes(along)) @ along for along in (self.normal, self.tangent)
        )
        self.modulus, ratio = _stiffness(row)
        self.groups = Groups(
            self.speed / (row["friction"] * self.approach),
            self.give_tangential / self.give,
            ratio,
            row["restitution"],
            words["loss"],
        )

    def at_contact(self, velocity, spin):
        """Velocity of the contact point."""
        return velocity + np.cross(spin, self.arm)

    def changes(self, impulse):
        """Of velocity and spin, by an impulse at the contact."""
        return impulse / self.mass, np.cross(self.arm, impulse) / self.inertia

    def energy(self, velocity, spin):
        """Kinetic energy."""
        return (self.mass * (velocity @ velocity) + self.inertia * (spin @ spin)) / 2

    def after(self, other, w, peak_friction, regime):
        """`{column of the result: number or regime}`, from the rebound without units.

        `other` is the velocity with the other loss.
        """
        e, friction = self.row["restitution"], self.row["friction"]
        unit = friction * self.approach
        impulse = self.normal * ((1 + e) * self.approach / self.give)
        impulse += self.tangent * ((w * unit - self.speed) / self.give_tangential)
        before = self.velocity, self.spin
        after = [old + change for old, change in zip(before, self.changes(impulse), strict=True)]
        peak = self._peak_normal()
        return _columns(*after, "normal_x" in self.row) | {
            "contact_velocity_after [m/s]": w * unit,
            "model_form [m/s]": abs(other - w) * unit,
            "regime": regime,
            "incidence": self.groups.incidence,
            "peak_normal_force [N]": peak,
            "peak_friction_force [N]": friction * peak_friction * peak,
            "energy_lost [J]": self.energy(*before) - self.energy(*after),
        }

    def _peak_normal(self):
        """Largest normal force by the law of the loss: a number of its own for each e.

        Lengths scale with (m2 v2^2/(E* sqrt(R)))^(2/5), forces with E* sqrt(R) times that to 3/2.
        """
        motion, _ = inelastic_contact.motion_with(
            f"continuum.{self.groups.loss}", float(self.row["restitution"])
        )
        stiffness = self.modulus * mp.sqrt(self.row["radius"])
        depth = (self.approach**2 / self.give / stiffness) ** (mp.mpf(2) / 5)
        return motion.peak * stiffness * depth ** (mp.mpf(3) / 2)


def _state(row):
    """Velocity, spin and normal in space; a plane state has x along the surface and z off it."""
    if "normal_x" in row:
        numbers = [row[name] for name in (*SPACE, *(f"normal_{axis}" for axis in "xyz"))]
        return np.array(numbers).reshape(3, 3)
    along, down, spin = (row[name] for name in PLANE)
    # The contact is below the centre: turning about -y moves it along x.
    zero = mp.zero
    return np.array([[along, zero, -down], [zero, -spin, zero], [zero, zero, mp.one]])


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


def _text(value):
    return value if isinstance(value, str) else mp.nstr(value, DIGITS)


def tables():
    """Every scene by its name."""
    solved = {name: scene_table(name) for name in SCENES}
    return {
        name: table_files.table(header, lambda *cells: cells, rows)
        for name, (header, rows) in solved.items()
    }


if __name__ == "__main__":
    table_files.write(Path(sys.argv[1]) / "scenes_solved", tables())
