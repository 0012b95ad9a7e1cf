"""Table of data/cross2014: markers in pixels become the quantities of 13 impacts.

python -m tests.reference_solutions.cross_tables data/cross2014
"""

import functools
import sys
from typing import NamedTuple

import numpy as np

from tests.reference_solutions.table_files import read, table, write

# Standard deviation of what lies evenly between two bounds, over half their distance.
EVENLY = 3**-0.5
# A marker is read to two pixels; the author states that no component of a velocity is off by more
# than two per cent.
READ, MEASURED = 2 * EVENLY, 0.02 * EVENLY
HEADER = [
    "impact",
    "angle [deg]",
    "tangential_restitution [1]",
    "restitution [1]",
    "restitution_uncertainty [1]",
    "velocity_ratio [1]",
    "spin_change [1]",
    "tangential_before [1]",
    "tangential_before_uncertainty [1]",
]


class Panel(NamedTuple):
    """Where the axes of a panel stand, in pixels: angles of 0 and 100 deg, and two ordinates."""

    columns: tuple[float, float]
    rows: tuple[float, float]
    values: tuple[float, float]

    def read(self, column, row):
        """Angle above the surface [deg] and ordinate of a marker."""
        (left, right), (low, high), (first, last) = self
        share = (row - low) / (high - low)
        return 100 * (column - left) / (right - left), first + share * (last - first)

    @property
    def pixel(self):
        """Size of a pixel on both axes."""
        return tuple(abs(b - a) for a, b in zip(self.read(0, 0), self.read(1, 1), strict=True))


PANELS = {
    "a": Panel((61, 331), (293, 24), (0.4, 1.1)),
    "c": Panel((61.5, 332.5), (645, 374.5), (-0.5, 2.5)),
    "d": Panel((424.5, 693.5), (645, 375), (0.0, 1.0)),
}
# What each marker shows: v is the velocity of the centre, x along the surface and y across, V the
# incident speed, R the radius and s the spin; 1 is before the impact and 2 after it.
MARKERS = {
    ("a", "blue"): "velocity_ratio",  # vx2/vx1
    ("a", "black"): "restitution",  # vy2/vy1
    ("c", "blue"): "tangential_restitution",  # (R s2 - vx2)/(vx1 - R s1)
    ("c", "black"): "spin_ratio",  # R s2/vx2
    ("d", "black"): "spin_change",  # R (s2 - s1)/V
}


def tables():
    """Every table by its name."""
    return {"impacts": table(HEADER, _row, [(impact,) for impact in range(1, 1 + len(_markers()))])}


def quantities(impact):
    """What the markers of one impact show, by name; `angle` is that from the surface in deg."""
    markers = _markers()[impact]
    found = {MARKERS[key]: PANELS[key[0]].read(*place) for key, place in markers.items()}
    angles = [angle for angle, _ in found.values()]
    return {name: value for name, (_, value) in found.items()} | {"angle": np.mean(angles)}


def tangential_before(angle, velocity_ratio, spin_ratio, spin_change):
    """Tangential velocity of the contact point before the impact, over the normal one."""
    along, across = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    spin_before = spin_ratio * velocity_ratio * along - spin_change
    return (along - spin_before) / across


def _row(impact):
    found = quantities(impact)
    keys = ("angle", "velocity_ratio", "spin_ratio", "spin_change")
    sides = {key: found[key] for key in keys}
    reading = {name: READ * PANELS[panel].pixel[1] for (panel, _), name in MARKERS.items()}
    # The components of the incident velocity are measured, so the angle is.
    slope = np.sin(np.radians(2 * found["angle"])) / 2
    measured = np.degrees(slope * np.sqrt(2) * MEASURED)
    reading["angle"] = np.hypot(READ * PANELS["a"].pixel[0], measured)
    before = tangential_before(**sides)
    changes = [
        tangential_before(**sides | {key: sides[key] + reading[key]}) - before for key in keys
    ]
    restitution = np.hypot(reading["restitution"], np.sqrt(2) * MEASURED * found["restitution"])
    numbers = [
        90 - found["angle"],
        found["tangential_restitution"],
        found["restitution"],
        restitution,
        found["velocity_ratio"],
        found["spin_change"],
        before,
        np.sqrt(np.sum(np.square(changes))),
    ]
    return [f"impact {impact}", *(round(float(number), 4) for number in numbers)]


@functools.cache
def _markers():
    """Pixels of each marker, `{impact: {(panel, marker): (column, row)}}`."""
    found = {}
    for row in read("cross2014/pixels"):
        place = float(row["column"]), float(row["row"])
        found.setdefault(int(row["impact"]), {})[row["panel"], row["marker"]] = place
    return found


if __name__ == "__main__":
    write(sys.argv[1], tables())
