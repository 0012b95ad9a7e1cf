"""Checks of Stronge (1994), equation by equation and sentence by sentence.

Every check is a function without arguments. It compares one statement of the paper, as printed
(`stronge1994.printed`), with the paper's own model and returns a `Finding`. The model is solved to
rounding by `planarimpact.lumped`: "exact" means that solution, not nature. data/stronge1994/
ledger.yaml has an entry for each: what the paper says, when it counts as true, the verdict, and
the correction. `dynamics`, `slip`, `peak_force` and `dissipation` check the equations of one
section each and the sentences about them, `rebound` sentences alone.

What the paper says of restitution has a second verdict, "in nature", which never changes the first.
`nature` measures it on the models of `nature_models`, and `in_nature` judges.

The docstring of a check is printed in the ledger's table. A run of the ledger runs every check.
"""

from importlib import import_module
from importlib.util import find_spec

from stronge1994.ledger.finding import Finding, Judgement, judge

__all__ = ["Finding", "Judgement", "judge", "run"]


def run(check: str) -> Finding:
    """Run one check, named `module.function`.

    >>> run("rebound.rubber_stiffness_ratio").value
    1.5
    """
    module, _, function = check.partition(".")
    path = f"stronge1994.ledger.{module}"
    check_function = getattr(import_module(path), function, None) if find_spec(path) else None
    if check_function is None:
        raise LookupError(f"there is no check {check}")
    return check_function()
