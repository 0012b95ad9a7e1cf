"""Chi-squared of the models over the measured pairs, as judged and with one choice made otherwise.

It is not known which incidences were measured, nor whether a printed uncertainty is one standard
deviation or two. No model includes that unlike bodies spread differently under pressure. The
measured pairs have the columns of data/cornell1999/pairs.csv.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from stronge1994 import tables
from stronge1994.goodness import ChiSquared, chi_squared
from stronge1994.tables import Table

E, BETA_0 = "restitution [1]", "tangential_restitution [1]"
SIGMA = "tangential_restitution_uncertainty [1]"
# The spread of the impacts that the verdicts judge, as the curves have it.
WHOLE = "to (1 + e) m2/m1"
# The pairs that decide most: the least elastic one, and the one farthest from all models.
SOFT, HARD = "polyurethane", "chrome steel"
# Pairs differ from a model if chance gives their chi-squared with at most this probability.
SIGNIFICANCE = 0.001


class Trial(NamedTuple):
    """One way to judge the pairs.

    `spread` is that of the impacts to which beta_0 is fitted. The pairs in `without` are left out.
    All uncertainties are taken as a `share` of those stated.
    """

    spread: str = WHOLE
    without: Sequence[str] = ()
    share: float = 1.0


AS_JUDGED = Trial()


def trials(curves: Table) -> dict[str, Trial]:
    """The pairs as the verdicts judge them, and with one choice at a time made otherwise."""
    spreads = [spread for spread, _ in tables.each(curves, "spread", variant="pairs")]
    pairs = tables.select(curves, variant="pairs")
    unlike = pairs["pair"][pairs["body"] != pairs["other"]]
    return {
        "as judged": AS_JUDGED,
        **{f"fit {spread}": Trial(spread) for spread in spreads if spread != WHOLE},
        "the stated sigmas are two sigmas": Trial(share=0.5),
        f"without {SOFT}": Trial(without=[SOFT]),
        f"without {HARD}": Trial(without=[HARD]),
        "without both": Trial(without=[SOFT, HARD]),
        "pairs of one material alone": Trial(without=unlike.unique().tolist()),
    }


def goodness(curves: Table, model: str, measured: Table, trial: Trial = AS_JUDGED) -> ChiSquared:
    """Chi-squared of a model over the measured pairs, whose order is that of the curves."""
    own = tables.select(curves, model=model, variant="pairs", spread=trial.spread)
    kept = ~measured["pair"].isin(trial.without)
    sigma = measured[SIGMA][kept] * trial.share
    distance = (measured[BETA_0] - own[BETA_0])[kept] / sigma
    moved = trial.share * own[tables.sigma_name(BETA_0)][kept] / sigma
    return chi_squared(distance, np.diag(moved))
