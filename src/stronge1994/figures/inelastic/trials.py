"""Chi-squared of the models over the measured pairs, as judged and with one choice made otherwise.

It is not known which incidences were measured, nor whether a printed uncertainty is one standard
deviation or two. No model includes that unlike bodies spread differently under pressure. The
measured pairs have the columns of data/cornell1999/pairs.csv.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from stronge1994 import curve_names
from stronge1994.csv_tables import Columns, Curves
from stronge1994.goodness import ChiSquared, chi_squared

E, BETA_0 = "restitution [1]", "tangential_restitution [1]"
SIGMA = "tangential_restitution_uncertainty [1]"
PARAMETERS = f"{curve_names.EACH}pair's parameters"
# The pairs that decide most: the least elastic one, and the one farthest from all models.
SOFT, HARD = "polyurethane", "chrome steel"
# Pairs agree with a model if chance gives their chi-squared with at least this probability.
SIGNIFICANCE = 0.01
PAPER = "lumped.hysteretic"


class Trial(NamedTuple):
    """One way to judge the pairs.

    `spread` is that of the impacts to which beta_0 is fitted, as the names of the curves spell it.
    The pairs in `without` are left out. All uncertainties are taken as a `share` of those stated.
    """

    spread: str = ""
    without: Sequence[str] = ()
    share: float = 1.0


AS_JUDGED = Trial()


def trials(curves: Curves) -> dict[str, Trial]:
    """The pairs as the verdicts judge them, and with one choice at a time made otherwise."""
    start = f"{PAPER}, pairs, "
    spreads = [name.removeprefix(start) for name in curves if name.startswith(start)]
    pairs = curves[f"{PAPER}, pairs"]
    return {
        "as judged": AS_JUDGED,
        **{f"fit {name}": Trial(name) for name in spreads if not curve_names.is_shifted(name)},
        "the stated sigmas are two sigmas": Trial(share=0.5),
        f"without {SOFT}": Trial(without=[SOFT]),
        f"without {HARD}": Trial(without=[HARD]),
        "without both": Trial(without=[SOFT, HARD]),
        "pairs of one material alone": Trial(
            without=list(pairs["pair"][pairs["body"] != pairs["other"]])
        ),
    }


def goodness(curves: Curves, model: str, measured: Columns, trial: Trial = AS_JUDGED) -> ChiSquared:
    """Chi-squared of a model over the measured pairs, whose order is that of the curves."""
    name = f"{model}, pairs" + (f", {trial.spread}" if trial.spread else "")
    sigma = measured[SIGMA] * trial.share
    up, down = (curves[curve_names.shifted(name, PARAMETERS, sign)][BETA_0] for sign in (1, -1))
    distance = (measured[BETA_0] - curves[name][BETA_0]) / sigma
    moved = trial.share * (up - down) / 2 / sigma
    kept = ~np.isin(measured["pair"], list(trial.without))
    return chi_squared(distance[kept], np.diag(moved[kept]))
