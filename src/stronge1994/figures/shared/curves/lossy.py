"""Five models of an impact that loses energy, beside measurements with uncertain parameters."""

from collections.abc import Sequence

import numpy as np

from planarimpact import models
from planarimpact.ground.arrays import Array, ArrayLike
from stronge1994.csv_tables import Columns, Curves
from stronge1994.curve_names import SIGNS, shifted

MODELS = (
    "continuum.viscous",
    "continuum.plastic",
    "lumped.viscous",
    "lumped.unloading-stiffness",
    "lumped.hysteretic",
)


def velocity(model: str, tolerance: float, *groups: ArrayLike) -> Array:
    """Velocity at separation; `groups` as for `models.rebound`, `tolerance` of a continuum.

    >>> float(velocity("lumped.hysteretic", 1e-3, 8.0, 3.5, 1.21, 1.0))
    1.0
    """
    settings = {"tolerance": tolerance} if model.startswith("continuum") else {}
    return models.rebound(model, *groups, **settings).velocity


def each_off(
    curve: str, parameter: str, labels: Columns, column: str, values: Array, others: Sequence[Array]
) -> Curves:
    """A curve with its standard deviation added and taken away, as `curve_names.shifted` names it.

    The deviation is each point's own. `others` are the values with one parameter off by a sigma.

    >>> named = each_off("a", "each pair's e", {}, "y [1]", np.array([1.0]), [np.array([1.3])])
    >>> [round(float(columns["y [1]"][0]), 1) for columns in named.values()]
    [1.3, 0.7]
    """
    sigma = np.sqrt(np.sum(np.square([other - values for other in others]), axis=0))
    return {
        shifted(curve, parameter, sign): labels | {column: values + sign * sigma} for sign in SIGNS
    }
