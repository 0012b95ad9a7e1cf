"""Beyond the paper: where the contact sticks over the impact, and the forces of both models."""

from collections.abc import Sequence

from stronge1994.csv_tables import Columns, Curves

from planarimpact import continuum, lumped
from planarimpact.common.results import History
from planarimpact.continuum import ContinuumHistory


def curves(
    mass_ratio: float,
    stiffness_ratio: float,
    incidences: Sequence[float],
    forces: Sequence[float],
    samples: int,
    tolerance: float,
) -> Curves:
    """Contacts of the elastic continuum, and of the lumped model where forces are compared.

    Both have e = 1. The events of the lumped model come on top of its `samples`.

    >>> list(curves(3.5, 1.21, [1.0], [1.0], 50, 1e-2))
    ['continuum, x = 1', 'lumped, x = 1']
    """
    named = {}
    for x in dict.fromkeys([*incidences, *forces]):
        contact = continuum.history(x, mass_ratio, stiffness_ratio, tolerance=tolerance)
        named[f"continuum, x = {x:g}"] = {
            **_columns(contact),
            "contact_radius [a_max]": contact.contact_radius,
            "stick_radius [a_max]": contact.stick_radius,
        }
    for x in forces:
        whole = lumped.history(x, mass_ratio, stiffness_ratio, 1.0, samples)
        named[f"lumped, x = {x:g}"] = _columns(whole)
    return named


def _columns(contact: ContinuumHistory | History) -> Columns:
    return {
        "time [t_c]": contact.time,
        "normal_force [F2max]": contact.normal,
        "friction_force [mu F2max]": contact.friction,
        "velocity [mu v2(0)]": contact.velocity,
    }
