"""Beyond the paper: where the contact sticks over the impact, and the forces of both models."""

from collections.abc import Sequence

from planarimpact import continuum, lumped
from planarimpact.common.arrays import Array
from planarimpact.common.results import History
from planarimpact.continuum import ContinuumHistory
from stronge1994 import tables
from stronge1994.tables import Table


def curves(
    mass_ratio: float,
    stiffness_ratio: float,
    incidences: Sequence[float],
    forces: Sequence[float],
    samples: int,
    tolerance: float,
) -> Table:
    """Contacts of the elastic continuum, and of the lumped model where forces are compared.

    Both have e = 1. The events of the lumped model come on top of its `samples`.

    >>> curves(3.5, 1.21, [1.0], [1.0], 50, 1e-2)["curve"].unique().tolist()
    ['continuum, x = 1', 'lumped, x = 1']
    """
    parts = []
    for x in dict.fromkeys([*incidences, *forces]):
        contact = continuum.history(x, mass_ratio, stiffness_ratio, tolerance=tolerance)
        radii = {
            "contact_radius [a_max]": contact.contact_radius,
            "stick_radius [a_max]": contact.stick_radius,
        }
        parts.append(tables.curve(_columns(contact) | radii, "continuum", x=x))
    for x in forces:
        whole = lumped.history(x, mass_ratio, stiffness_ratio, 1.0, samples)
        parts.append(tables.curve(_columns(whole), "lumped", x=x))
    return tables.join(parts)


def _columns(contact: ContinuumHistory | History) -> dict[str, Array]:
    return {
        "time [t_c]": contact.time,
        "normal_force [F2max]": contact.normal,
        "friction_force [mu F2max]": contact.friction_force,
        "velocity [mu v2(0)]": contact.velocity,
    }
