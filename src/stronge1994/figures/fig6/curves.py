"""Fig. 6: tangential velocity at separation against incidence, for several restitutions."""

from collections.abc import Mapping, Sequence
from typing import Any

from planarimpact import lumped
from planarimpact.common.results import Regime
from stronge1994.csv_tables import Curves
from stronge1994.curve_names import name
from stronge1994.figures.shared.curves import as_printed as printed_curves
from stronge1994.figures.shared.curves.beside import rebounds_of_continua
from stronge1994.figures.shared.curves.sampling import NO_NODES, Nodes, vertices
from stronge1994.printed import impact
from stronge1994.printed.slip import slip_throughout_limit as printed_limit


def curves(
    mass_ratio: float,
    stiffness_ratio: float,
    incidence: Sequence[float],
    restitution: Sequence[float],
    samples: int,
    continua: Mapping[str, Any] | None = None,
    nodes: Nodes = NO_NODES,
    as_printed: bool = False,
) -> Curves:
    """One curve `e = ...` of the paper's model for each coefficient of restitution.

    Beside them stand the continua that lose energy, `continuum.viscous, e = ...`, and what the
    printed equations give where it differs.

    >>> named = curves(3.5, 1.21, (0, 8), [0, 1], 9)
    >>> [float(curve["velocity [mu v2(0)]"][-1]) for curve in named.values()]
    [4.5, 1.0]
    """
    extra = nodes.get("incidence", ())
    named = {}
    for e in restitution:
        limit = lumped.slip_throughout_limit(mass_ratio, stiffness_ratio, e)
        printed = printed_limit(mass_ratio, e)
        x = vertices(incidence, samples, stiffness_ratio, mass_ratio, limit, printed, extra)
        rebound = lumped.rebound(x, mass_ratio, stiffness_ratio, e)
        named[name("e", e)] = {
            "incidence [mu v2(0)]": x,
            "velocity [mu v2(0)]": rebound.velocity,
            "peak_friction_force [mu m2 Omega v2(0)]": rebound.peak_friction,
            "dissipation [mu^2 m2 v2(0)^2]": rebound.dissipation,
            "regime": Regime.names(rebound.regime),
        }
        if as_printed:
            velocity, _, _ = impact.rebound(x, mass_ratio, stiffness_ratio, e)
            named |= printed_curves.beside(name("e", e), named[name("e", e)], velocity)
    x = vertices(incidence, samples, stiffness_ratio, mass_ratio, extra)
    for title, of_continuum in rebounds_of_continua(continua, x, mass_ratio, stiffness_ratio):
        named[title] = {"incidence [mu v2(0)]": x, "velocity [mu v2(0)]": of_continuum.velocity}
    return named
