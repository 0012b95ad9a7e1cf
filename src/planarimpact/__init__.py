"""Planar impact of rough compliant bodies, after W. J. Stronge (1994).

- `lumped`: the paper's model, solved to rounding, and two variants that lose energy in other ways;
  below e = 1 the evidence on the paper's is divided. `rigid`: its limit without tangential
  compliance.
- `continuum`: spheres with micro-slip, elastic or with a loss of energy, to a tolerance.
- `spheres`: the continuum from a table, for impacts that are each their own pair.
- `models`: every model by its name. `models.laws` makes one of a velocity of your own.
- `export`: writes collisions of spheres as C or JavaScript.
- `fit`: laws of discrete-element codes, fitted to the continuum.
- `collide`: velocities and spins of two bodies in space after their impact, by the pair of their
  materials, a `Pair`. `scene`: solves tables of impacts.
- `bodies`: from physical bodies to the groups that all models take. `noncollinear`: bodies that
  strike off their centre.
- `normal_impact.hertz`, `normal_impact.kelvin_voigt`, `normal_impact.yielding`: head-on impact of
  spheres, elastic, viscous and plastic.

Symbols and their names. Every model takes the first four. Index 1 is tangential, 2 normal.

| symbol | meaning | name |
|---|---|---|
| x | v1(0)/(mu v2(0)), incidence | `incidence` |
| beta | m2/m1, effective normal over tangential mass | `mass_ratio` |
| zeta^2 | normal over tangential stiffness | `stiffness_ratio` |
| e | energetic coefficient of restitution; `loss` is what takes the energy | `restitution` |
| w | v1/(mu v2(0)), velocity of the contact point, in a rebound at its end | `velocity` |
| F1, F2 | friction, normal force | `friction_force`, `normal` in a history |
| t_c | time of compression, the unit of time in a history | `time` |
| mu, nu | coefficient of friction and Poisson's ratio of bodies | `friction`, `poisson_ratio` |
| tau | relaxation time of viscous bodies (Kelvin-Voigt) [s] | `relaxation_time` |
| p_y | yield pressure of plastic bodies [Pa] | `yield_pressure` |

An example runs after `import numpy as np` and `from planarimpact.lumped import *`, where `lumped`
stands for the module on whose page it is.
"""

import importlib
from typing import TYPE_CHECKING

from planarimpact.common.checks import ConvergenceError, InputError
from planarimpact.common.results import Event, EventKind, History, Rebound, Regime

if TYPE_CHECKING:  # the rest loads when it is used
    from planarimpact import (
        bodies,
        collision,
        continuum,
        export,
        fit,
        lumped,
        models,
        noncollinear,
        normal_impact,
        rigid,
        scene,
        spheres,
    )
    from planarimpact.collision import Collision, Pair, collide
    from planarimpact.continuum import ContinuumHistory

__version__ = "0.4.0"

# Modules first, in the order of the text above.
__all__ = [
    "lumped",
    "rigid",
    "continuum",
    "spheres",
    "models",
    "export",
    "collision",
    "fit",
    "scene",
    "bodies",
    "noncollinear",
    "normal_impact",
    "Collision",
    "Pair",
    "collide",
    "ContinuumHistory",
    "ConvergenceError",
    "Event",
    "EventKind",
    "History",
    "InputError",
    "Rebound",
    "Regime",
]
# Where the names are that do not load with this file, and that are no modules.
_HOMES = dict.fromkeys(("Collision", "Pair", "collide"), "collision")
_HOMES |= {"ContinuumHistory": "continuum"}

if not TYPE_CHECKING:  # else every name would pass as one of this package

    def __getattr__(name: str) -> object:
        """Load a name of `__all__` at its first use."""
        if name not in __all__:
            raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
        found = importlib.import_module(f"{__name__}.{_HOMES.get(name, name)}")
        globals()[name] = getattr(found, name) if name in _HOMES else found
        return globals()[name]


def __dir__() -> list[str]:
    return [*{*globals(), *__all__}]
