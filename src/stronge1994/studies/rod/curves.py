"""Beyond the paper: a slender rod strikes with its tip, tilted, so that its motions are coupled."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from planarimpact import noncollinear
from planarimpact.common.arrays import Array, ArrayLike
from planarimpact.common.results import Regime
from planarimpact.noncollinear import InverseMass, NoncollinearHistory, NoncollinearRebound, rigid
from planarimpact.noncollinear.rigid import ImpulsiveRebound, Law
from stronge1994 import tables
from stronge1994.figures.shared.curves.sampling import NO_NODES, Nodes, vertices
from stronge1994.tables import Table

RIGID = {"": Law.ENERGETIC, "Newton": Law.KINEMATIC}  # by variant


def curves(
    stiffness_ratio: float,
    tilt: Sequence[float],
    velocity_ratio: Sequence[float],
    friction: float,
    restitution: float,
    samples: int,
    contact: dict[str, float],
    nodes: Nodes = NO_NODES,
) -> Table:
    """Rebound against the tilt, compliant and rigid, and one contact that jams.

    The velocity ratio v1(0)/v2(0) is not divided by mu. The restitution is energetic, but in the
    variant `Newton` of the rigid model, where it is the ratio of the normal velocities. Velocities
    are those of the tip, after the impact; negative normal ones leave. The kinetic energy before it
    is K0, see `noncollinear.kinetic_energy`. The variant `contact` is followed over time, with mu
    and with mu = 0, and has a column `event` as in Fig. 3.

    >>> one = {"tilt": 25.0, "velocity_ratio": 10.0}
    >>> table = curves(1.21, (-80, 80), [0.6], 1.6, 0.9, 11, one)
    >>> newton = tables.select(table, model="rigid", variant="Newton", velocity_ratio=0.6)
    >>> float(newton["kinetic_energy [K0]"].max().round(2))
    1.26
    """
    angle = vertices(tilt, samples, jam_limits(friction), nodes.get("tilt", ()))
    rod = slender_rod(angle)
    parts = []
    for ratio in velocity_ratio:
        before = noncollinear.kinetic_energy(ratio, 1.0, rod)
        rebound = noncollinear.rebound(
            ratio, 1.0, rod, friction, restitution, stiffness_ratio, loss="hysteretic"
        )
        columns = _columns(angle, rebound, rod, before)
        columns |= {
            "energy_lost [K0]": 1 - columns["kinetic_energy [K0]"],
            "friction_work [K0]": rebound.friction_work / before,
            "hysteresis [K0]": rebound.hysteresis / before,
            "energy_dissipated [K0]": (rebound.friction_work + rebound.hysteresis) / before,
            "regime": Regime.names(rebound.regime),
        }
        parts.append(tables.curve(columns, "lumped", velocity_ratio=ratio))
        for variant, law in RIGID.items():
            sudden = rigid.rebound(ratio, 1.0, rod, friction, restitution, law)
            columns = _columns(angle, sudden, rod, before)
            parts.append(tables.curve(columns, "rigid", variant, velocity_ratio=ratio))
    state = contact["velocity_ratio"], 1.0, slender_rod(contact["tilt"])
    for mu in (friction, 0.0):
        followed = noncollinear.history(
            *state, mu, restitution, stiffness_ratio, samples=samples, loss="hysteretic"
        )
        parts.append(tables.curve(_followed(followed), "lumped", "contact", mu=mu))
    return tables.join(parts)


def slender_rod(tilt: ArrayLike) -> InverseMass:
    """Inverse mass at the tip of a uniform slender rod, in units of 1/m2.

    The tilt is the angle from the normal in degrees; it is positive where the tip, in the direction
    of positive tangential velocity, is ahead of the centre.

    >>> [round(float(entry), 12) for entry in slender_rod(45.0)]
    [1.0, 0.6, 1.0]
    """
    sine, cosine = np.sin(np.radians(tilt)), np.cos(np.radians(tilt))
    # Length 1; with this mass m2 = 1, so that with kappa = 1 times are in 1/Omega.
    mass = 1 + 3 * sine**2
    return noncollinear.inverse_mass(mass, 12**-0.5, offset=sine / 2, depth=cosine / 2)


def jam_limits(friction: float) -> Array:
    """Tilts in degrees between which a slender rod jams while its tip slides: mu |c| m2 = 1.

    c m2 = 3 tan/(1 + 4 tan^2) is at most 3/4, so there are none for mu <= 4/3.

    >>> jam_limits(1.6).round(1).tolist()
    [-43.0, -15.0, 15.0, 43.0]
    >>> jam_limits(1.3).tolist()
    []
    """
    square = 9 * friction**2 - 16
    if square <= 0:
        return np.array([])
    tangent = (3 * friction + np.array([-1, 1]) * np.sqrt(square)) / 8
    limits = np.degrees(np.arctan(tangent))
    return np.concatenate([-limits[::-1], limits])


def _columns(
    angle: Array, rebound: NoncollinearRebound | ImpulsiveRebound, rod: InverseMass, before: Array
) -> dict[str, Any]:
    after = noncollinear.kinetic_energy(rebound.tangential, rebound.normal, rod)
    return {
        "tilt [deg]": angle,
        "tangential_velocity [v2(0)]": rebound.tangential,
        "normal_velocity [v2(0)]": rebound.normal,
        "kinetic_energy [K0]": after / before,
        "jams [1]": rebound.jams.astype(int),
    }


def _followed(contact: NoncollinearHistory) -> dict[str, Any]:
    """Columns of a history; the last event of an instant stands at its vertex."""
    event = np.full(contact.time.size, "", dtype="<U24")
    for mark in contact.events:
        event[np.searchsorted(contact.time, mark.time)] = str(mark.kind)
    return {
        "time [1/Omega]": contact.time,
        "normal_force [m2 Omega v2(0)]": contact.normal_force,
        "friction_force [m2 Omega v2(0)]": contact.friction_force,
        "tangential_velocity [v2(0)]": contact.tangential,
        "normal_velocity [v2(0)]": contact.normal,
        "event": event,
    }
