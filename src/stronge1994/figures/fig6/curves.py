"""Fig. 6: tangential velocity at separation against incidence, for several restitutions."""

from collections.abc import Mapping, Sequence
from typing import Any

from planarimpact import lumped
from planarimpact.common.results import Regime
from stronge1994 import tables
from stronge1994.figures.shared.curves.curves_below_one import rebounds_of_continua
from stronge1994.figures.shared.curves.printed_variants import printed_variants
from stronge1994.figures.shared.curves.sampling import NO_NODES, Nodes, vertices
from stronge1994.printed import impact
from stronge1994.printed.equations import slip_throughout_limit as printed_limit
from stronge1994.tables import Table


def curves(
    mass_ratio: float,
    stiffness_ratio: float,
    incidence: Sequence[float],
    restitution: Sequence[float],
    samples: int,
    continua: Mapping[str, Any] | None = None,
    nodes: Nodes = NO_NODES,
    as_printed: bool = False,
) -> Table:
    """One curve of the paper's model for each coefficient of restitution, e.

    With them come the continua that lose energy, and what the printed equations give where it
    differs.

    >>> table = curves(3.5, 1.21, (0, 8), [0, 1], 9)
    >>> [float(own["velocity [mu v2(0)]"].iloc[-1]) for e, own in tables.each(table, "e")]
    [4.5, 1.0]
    """
    extra = nodes.get("incidence", ())
    parts = []
    for e in restitution:
        limit = lumped.slip_throughout_limit(mass_ratio, stiffness_ratio, e)
        printed = printed_limit(mass_ratio, e)
        x = vertices(incidence, samples, stiffness_ratio, mass_ratio, limit, printed, extra)
        rebound = lumped.rebound(x, mass_ratio, stiffness_ratio, e)
        columns = {
            "incidence [mu v2(0)]": x,
            "velocity [mu v2(0)]": rebound.velocity,
            "peak_friction_force [mu m2 Omega v2(0)]": rebound.peak_friction,
            "dissipation [mu^2 m2 v2(0)^2]": rebound.dissipation,
            "regime": Regime.names(rebound.regime),
        }
        parts.append(tables.curve(columns, "lumped", e=e))
        if as_printed:
            velocity, _, _ = impact.rebound(x, mass_ratio, stiffness_ratio, e)
            parts += printed_variants(columns, velocity, e=e)
    x = vertices(incidence, samples, stiffness_ratio, mass_ratio, extra)
    for model, e, found in rebounds_of_continua(continua, x, mass_ratio, stiffness_ratio):
        columns = {"incidence [mu v2(0)]": x, "velocity [mu v2(0)]": found.velocity}
        parts.append(tables.curve(columns, model, e=e))
    return tables.join(parts)
