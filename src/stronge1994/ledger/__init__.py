"""Checks of Stronge (1994), equation by equation and sentence by sentence.

Every check compares one statement of the paper, as printed (`stronge1994.printed`), with the
paper's own model and returns a `Finding`. The model is solved to rounding by
`planarimpact.lumped`: "exact" means that solution, not nature. data/stronge1994/ledger.yaml has an
entry for each: what the paper says, when it counts as true, the verdict, and the correction.
`dynamics`, `slip`, `peak_force` and `dissipation` check the equations of one section each and the
sentences about them, `rebound` sentences alone. `contact` solves, and `finding` makes a check of a
comparison at many places.

What the paper says of restitution has a second verdict, "in nature", which never changes the first
nor the reverse. The checks of `nature` take the name of a model, and two continua decide.

The docstring of a check is printed in the ledger's table. A run of the ledger runs every check.
"""

import inspect
from functools import cache
from importlib import import_module

from stronge1994.ledger.finding import Finding

__all__ = ["Finding", "checks", "run"]

# Each public function of these is a check.
MODULES = ("dynamics", "slip", "rebound", "peak_force", "dissipation", "nature")


@cache
def checks() -> dict[str, str]:
    """All checks of this room: `{module.function: its docstring in one line}`."""
    docstrings = {}
    for module in MODULES:
        room = import_module(f"stronge1994.ledger.{module}")
        for name, function in inspect.getmembers(room, inspect.isfunction):
            if function.__module__ == room.__name__ and not name.startswith("_"):
                docstrings[f"{module}.{name}"] = " ".join((inspect.getdoc(function) or "").split())
    return docstrings


def run(check: str, *model: str) -> Finding:
    """Run one check, named `module.function`; one of `nature` takes the name of a model.

    >>> run("rebound.rubber_stiffness_ratio").value
    1.5
    >>> round(run("nature.limit_half", "paper").value, 3)
    3.5
    """
    if check not in checks():
        raise LookupError(f"there is no check {check}")
    module, _, function = check.partition(".")
    return getattr(import_module(f"stronge1994.ledger.{module}"), function)(*model)
