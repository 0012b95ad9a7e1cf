"""Laws of discrete-element codes before and after a fit, beside the continuum."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from planarimpact import fit
from stronge1994.csv_tables import Curves
from stronge1994.figures.shared.curves import beside

MASS_RATIO = 3.5
LAWS = ("lammps-hertz-mindlin", "lammps-hooke")


def curves(pairs: Mapping[str, Mapping[str, Any]], incidence_max: float) -> Curves:
    """For each pair `<pair>, continuum`, and of both laws `<pair>, <law>, before` and `after`.

    >>> steel = {"poisson_ratio": 0.3, "restitution": 0.8, "loss": "plastic"}
    >>> list(curves({"steel": steel}, 6))[:2]
    ['steel, continuum', 'steel, lammps-hertz-mindlin, before']
    """
    named: Curves = {}
    for pair, found in fitted(pairs, incidence_max).items():
        x = next(iter(found.values())).incidence
        drawn = {"continuum": next(iter(found.values())).continuum}
        for law, one in found.items():
            drawn |= {f"{law}, before": one.before, f"{law}, after": one.after}
        for name, velocity in drawn.items():
            named[f"{pair}, {name}"] = {
                "incidence [mu v2(0)]": np.array(x),
                "velocity [mu v2(0)]": velocity,
            }
    return named


def fitted(
    pairs: Mapping[str, Mapping[str, Any]], incidence_max: float
) -> dict[str, dict[str, fit.Fit]]:
    """Fits of both laws by pair.

    >>> polymer = {"poisson_ratio": 0.5, "restitution": 0.6, "loss": "viscous"}
    >>> found = fitted({"polymer": polymer}, 6)
    >>> [round(one.error.rms, 2) for one in found["polymer"].values()]
    [0.01, 0.01]
    """
    return {
        pair: {
            law: fit.fit(
                law,
                MASS_RATIO,
                beside.stiffness_ratio(about["poisson_ratio"]),
                about["restitution"],
                loss=about["loss"],
                incidence_max=incidence_max,
            )
            for law in LAWS
        }
        for pair, about in pairs.items()
    }
