"""Figs 3 and 4: forces and tangential velocity against time."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from planarimpact import lumped
from planarimpact.common.results import History
from stronge1994 import tables
from stronge1994.tables import Table


def curves(
    mass_ratio: float,
    stiffness_ratio: float,
    incidence: float,
    restitution: Sequence[float],
    samples: int,
) -> Table:
    """One contact against time for each coefficient of restitution.

    The events come on top of the `samples`. The column `event` has the kind of an event at its
    vertex, else it is empty.

    >>> contact = curves(3.5, 1.21, 1.0, [1.0], 50)
    >>> [event for event in contact["event"] if event]
    ['contact', 'stick', 'maximum compression', 'slip', 'separation']
    """
    contacts = {
        e: lumped.history(incidence, mass_ratio, stiffness_ratio, e, samples) for e in restitution
    }
    return tables.join(tables.curve(_columns(own), "lumped", e=e) for e, own in contacts.items())


def _columns(contact: History) -> dict[str, Any]:
    """Columns of a history, with one vertex an event."""
    events = contact.events
    at_event = np.isin(contact.time, [event.time for event in events])
    parts = {
        "time [t_c]": (contact.time, [e.time for e in events]),
        "normal_force [m2 Omega v2(0)]": (contact.normal, [e.normal for e in events]),
        "friction_force [mu m2 Omega v2(0)]": (
            contact.friction_force,
            [e.friction_force for e in events],
        ),
        "velocity [mu v2(0)]": (contact.velocity, [e.velocity for e in events]),
    }
    columns = {key: np.concatenate([a[~at_event], b]) for key, (a, b) in parts.items()}
    kinds = [""] * int((~at_event).sum()) + [str(e.kind) for e in events]
    columns["event"] = np.array(kinds)
    order = np.argsort(columns["time [t_c]"], kind="stable")
    return {key: column[order] for key, column in columns.items()}
