"""Impacts of equal solid spheres in Yade: `measure.py` makes Yade run this file.

It reads impacts from the first file that is named, and writes what Yade answers into the second.
"""

import json
import sys

import numpy as np
import yade
from yade import O, Vector3, utils


def collide(
    lines: str,
    radius: float,
    friction: float,
    speed: float,
    incidence: list[float],
    wall: bool,
    begins: float,
) -> list[float]:
    """Spheres that meet equal ones, or a flat wall, without spin; all in one simulation, SI units.

    `lines` are given to Yade as they are. A part of the first step, `begins`, is over when contact
    begins. Returns v1(tf)/(mu v2(0)) of each impact, for the normal of first touch.
    """
    O.reset()
    names = dict(vars(yade))
    exec(lines, names)
    spheres = []
    for sign in (1,) if wall else (1, -1):
        for k, x in enumerate(incidence):
            velocity = Vector3(friction * x, 0, -1) * speed * (sign if wall else sign / 2)
            place = Vector3(8 * k * radius, 0, sign * radius) - velocity * O.dt * begins
            spheres.append(utils.sphere(place, radius, material=names["of_spheres"]))
            spheres[-1].state.vel = velocity
    O.bodies.append(spheres)
    if wall:
        O.bodies.append(utils.wall(0, axis=2, sense=1, material=names["of_walls"]))
    for _ in range(100):
        O.run(100, True)
        if not any(contact.isReal for contact in O.interactions):
            break
    else:
        raise RuntimeError("two bodies are still in contact")
    shape = (-1, len(incidence), 3)
    motion = np.array([sphere.state.vel for sphere in spheres]).reshape(shape)
    spin = np.array([sphere.state.angVel for sphere in spheres]).reshape(shape)
    after = motion[0] - (0 if wall else motion[1])
    return ((after[:, 0] - radius * spin[:, :, 1].sum(axis=0)) / (friction * speed)).tolist()


with open(sys.argv[1], encoding="utf-8") as file:
    impacts = json.load(file)
with open(sys.argv[2], "w", encoding="utf-8") as file:
    json.dump([collide(**impact) for impact in impacts], file)
