"""Laws of discrete-element codes before and after a fit, and the continuum."""

from collections.abc import Mapping
from typing import Any

from planarimpact import fit
from stronge1994 import tables
from stronge1994.figures.shared.curves import curves_below_one
from stronge1994.tables import Table

MASS_RATIO = 3.5
LAWS = ("lammps-hertz-mindlin", "lammps-hooke")


def curves(pairs: Mapping[str, Mapping[str, Any]], incidence_max: float) -> Table:
    """For each pair the continuum, and of both laws the variants `before` and `after` the fit.

    >>> steel = {"poisson_ratio": 0.3, "restitution": 0.8, "loss": "plastic"}
    >>> curves({"steel": steel}, 6)["curve"].unique().tolist()[:2]
    ['continuum, steel', 'lammps-hertz-mindlin, before, steel']
    """
    parts = []
    for pair, found in fitted(pairs, incidence_max).items():
        first = next(iter(found.values()))
        drawn = {("continuum", ""): first.continuum}
        for law, one in found.items():
            drawn |= {(law, "before"): one.before, (law, "after"): one.after}
        for (model, variant), velocity in drawn.items():
            columns = {"incidence [mu v2(0)]": first.incidence, "velocity [mu v2(0)]": velocity}
            parts.append(tables.curve(columns, model, variant, pair=pair))
    return tables.join(parts)


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
                curves_below_one.stiffness_ratio(about["poisson_ratio"]),
                about["restitution"],
                loss=about["loss"],
                incidence_max=incidence_max,
            )
            for law in LAWS
        }
        for pair, about in pairs.items()
    }
