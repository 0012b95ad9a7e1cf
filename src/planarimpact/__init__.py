"""Planar impact of rough compliant bodies, after W. J. Stronge (1994).

`lumped` is the paper's model, solved exactly; `rigid` its limit without tangential compliance;
`bodies` turns physical bodies into the groups that they take.
"""

from planarimpact.checks import InputError
from planarimpact.results import Event, EventKind, History, Rebound, Regime

__all__ = ["Event", "EventKind", "History", "InputError", "Rebound", "Regime"]
