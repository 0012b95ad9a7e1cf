"""Checks of Stronge (1994), equation by equation and sentence by sentence.

Every check compares one statement of the paper, as printed (`stronge1994.printed`), with the
paper's own model and returns a number. The model is solved to rounding by `planarimpact.lumped`:
"exact" means that solution, not nature. data/stronge1994/ledger.yaml has an entry for each: what
the paper says, when it counts as true, the verdict, and the correction.
`dynamics`, `slip`, `peak_force` and `dissipation` check the equations of one section each and the
sentences about them, `rebound` sentences alone. `contact` solves, and `finding` makes a check of a
comparison at many places.

What the paper says of restitution has a second verdict, "in nature", which never changes the first
nor the reverse. The checks of `nature` take the name of a model, and two continua decide.

The docstring of a check, with its arguments, is printed in the ledger's table. A run of the ledger
runs every check.
"""

import inspect
from collections.abc import Callable
from functools import cache
from importlib import import_module

import yaml

from stronge1994.ledger.finding import Finding

__all__ = ["Finding", "called", "checks", "docstring", "run"]

# Each public function of these is a check.
MODULES = ("dynamics", "slip", "rebound", "peak_force", "dissipation", "nature")


@cache
def checks() -> dict[str, Callable[..., float | Finding]]:
    """All checks of this package, by `module.function`."""
    found: dict[str, Callable[..., float | Finding]] = {}
    for module in MODULES:
        imported = import_module(f"stronge1994.ledger.{module}")
        for name, function in inspect.getmembers(imported, inspect.isfunction):
            if function.__module__ == imported.__name__ and not name.startswith("_"):
                found[f"{module}.{name}"] = function
    return found


def called(check: str) -> tuple[Callable[..., float | Finding], inspect.BoundArguments]:
    """Function and arguments of a check that is written as a call, with names for texts.

    An unknown one is a `LookupError`; arguments that it does not take are a `TypeError`.

    >>> called("peak_force.peak_angle(0.18)")[1].arguments
    {'friction': 0.18}
    """
    name, _, arguments = check.removesuffix(")").partition("(")
    if name not in checks():
        raise LookupError(f"{check!a} is no function of stronge1994.ledger")
    function = checks()[name]
    # What `over` makes of a comparison at a place takes no place.
    signature = inspect.signature(function, follow_wrapped=False)
    return function, signature.bind(*yaml.safe_load(f"[{arguments}]"))


def docstring(check: str) -> str:
    """What a check tests, in one line: its docstring with its arguments.

    >>> docstring("peak_force.peak_angle(0.18)")
    'Angle of the largest peak of friction, $\\\\mu = 0.18$, in degrees.'
    """
    function, bound = called(check)
    words = " ".join((inspect.getdoc(function) or "").split())
    for name, argument in bound.arguments.items():
        words = words.replace(f"{{{name}}}", str(argument).strip("[]"))
    return words


def run(check: str, **model: str) -> Finding:
    """Run a check, written as a call of `module.function`; those of `nature` take a `model`.

    >>> run("rebound.stiffness_ratio(0.5)").value
    1.5
    >>> round(run("nature.limit_half", model="viscous").value, 3)
    4.645
    """
    function, bound = called(check)
    found = function(*bound.args, **model)
    return found if isinstance(found, Finding) else Finding(found)
