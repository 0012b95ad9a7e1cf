"""Planar impact of rough compliant bodies, after W. J. Stronge (1994).

`lumped` is the paper's model, solved exactly; `rigid` its limit without tangential compliance.
`continuum` and `annuli` solve the elastic contact with micro-slip by two independent methods.
`laws` and `timestep` are what others use; `ladder` has every model under one call, `response`
compiles any of them, `scene` solves tables of impacts. `bodies` turns physical bodies into the
groups that they all take; `noncollinear` has bodies that strike off their centre. `printed` holds
the paper's formulas as printed, for verification, and `ledger` checks what is right and wrong in
them.
"""

from planarimpact.checks import ConvergenceError, InputError
from planarimpact.results import (
    ContinuumHistory,
    Event,
    EventKind,
    History,
    Rebound,
    Regime,
)

__all__ = [
    "ContinuumHistory",
    "ConvergenceError",
    "Event",
    "EventKind",
    "History",
    "InputError",
    "Rebound",
    "Regime",
]
