"""Planar impact of rough compliant bodies, after W. J. Stronge (1994).

`lumped` is the paper's model, solved exactly; `rigid` its limit without tangential compliance.
`continuum` and `annuli` solve the elastic contact with micro-slip by two independent methods.
`laws` and `timestep` are what others use; `ladder` has every model under one call, `response`
compiles any of them, `scene` solves tables of impacts. `bodies` turns physical bodies into the
groups that they all take; `noncollinear` has bodies that strike off their centre. `printed` holds
the paper's formulas as printed, for verification, and `ledger` checks what is right and wrong in
them.

`import planarimpact` is enough: `planarimpact.lumped` and the others are imported at their first
use.
"""

import importlib
from types import ModuleType
from typing import TYPE_CHECKING

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
__version__ = "0.1.0"

# Modules that are there as `planarimpact.lumped`, imported at their first use: some need SciPy or
# pandas, which take their time.
_MODULES = (
    "annuli",
    "bodies",
    "cattaneo_mindlin",
    "continuum",
    "hertz",
    "ladder",
    "landmarks",
    "laws",
    "ledger",
    "lumped",
    "micro_slip",
    "noncollinear",
    "printed",
    "response",
    "rigid",
    "scene",
    "study",
    "timestep",
)

if TYPE_CHECKING:
    # The same for type checkers and editors. Relative, since the workflow takes absolute imports
    # for those that are carried out.
    from . import annuli as annuli
    from . import bodies as bodies
    from . import cattaneo_mindlin as cattaneo_mindlin
    from . import continuum as continuum
    from . import hertz as hertz
    from . import ladder as ladder
    from . import landmarks as landmarks
    from . import laws as laws
    from . import ledger as ledger
    from . import lumped as lumped
    from . import micro_slip as micro_slip
    from . import noncollinear as noncollinear
    from . import printed as printed
    from . import response as response
    from . import rigid as rigid
    from . import scene as scene
    from . import study as study
    from . import timestep as timestep
else:

    def __getattr__(name: str) -> ModuleType:
        if name in _MODULES:
            return importlib.import_module(f"planarimpact.{name}")
        raise AttributeError(f"module 'planarimpact' has no attribute {name!r}")

    def __dir__() -> list[str]:
        return sorted({*globals(), *_MODULES})
