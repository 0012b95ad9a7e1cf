"""Fig. 5: tangential velocity at separation against incidence, e = 1."""

from collections.abc import Mapping, Sequence
from typing import Any

from planarimpact import continuum, lumped, rigid
from planarimpact.common.arrays import Array
from planarimpact.common.results import Rebound, Regime
from stronge1994 import tables
from stronge1994.figures.shared.curves import measured
from stronge1994.figures.shared.curves.printed_variants import printed_variants
from stronge1994.figures.shared.curves.sampling import NO_NODES, Nodes, vertices
from stronge1994.names import CONTINUA, PAPER
from stronge1994.printed import impact
from stronge1994.printed.equations import slip_throughout_limit as printed_limit
from stronge1994.tables import Table


def curves(
    mass_ratio: float,
    stiffness_ratio: float,
    incidence: Sequence[float],
    restitution: float,
    samples: int,
    tolerance: float,
    loss_tolerance: float,
    rubber: dict[str, float],
    experiment: dict[str, float],
    finite_elements: dict[str, float],
    uncertainty: Mapping[str, float] | None = None,
    nodes: Nodes = NO_NODES,
    as_printed: bool = False,
) -> Table:
    """The lumped model, its limit and the elastic continuum; an experiment with loss.

    The elastic continuum has e = 1 whatever the restitution. The variants `rubber` and `finite
    elements` have a curve of the lumped model and of the continuum each. The variant `experiment`,
    a sphere shot at a plane without spin, has a curve of the lumped model and of each of
    `CONTINUA`, with the quantities that are measured against the angle of incidence; further curves
    have one parameter off by one sigma. `spin` is that after the impact, negative in the direction
    of incidence; that of the experiment, in rad/s, has the other sign.

    >>> sphere = dict(mass_ratio=3.5, stiffness_ratio=1.164, restitution=0.98, friction=0.092,
    ...               speed=3.9, radius=0.0025)
    >>> elements = dict(mass_ratio=3.5, stiffness_ratio=1.2143, restitution=1.0)
    >>> rubber = {"stiffness_ratio": 1.5}
    >>> table = curves(3.5, 1.21, (0, 8), 1.0, 9, 1e-4, 1e-3, rubber, sphere, elements)
    >>> float(tables.select(table, model="lumped")["velocity [mu v2(0)]"].iloc[-1])
    1.0
    """
    limit = lumped.slip_throughout_limit(mass_ratio, stiffness_ratio, restitution)
    printed = printed_limit(mass_ratio, restitution)
    extra = nodes.get("incidence", ())
    x = vertices(incidence, samples, stiffness_ratio, mass_ratio, limit, printed, extra)
    spring = rubber["stiffness_ratio"]
    groups = mass_ratio, stiffness_ratio
    exact = lumped.rebound(x, *groups, restitution)
    angles = nodes.get("angle", ())
    soft = lumped.rebound(x, mass_ratio, spring, restitution)
    own = measured.groups(finite_elements)
    sphere, soft_sphere, elements = (
        continuum.rebound(x, beta, zeta2, tolerance=tolerance)
        for beta, zeta2 in (groups, (mass_ratio, spring), own[:2])
    )
    of_sphere = _sphere(x, exact, mass_ratio)
    rough = rigid.rebound(x, mass_ratio, restitution=restitution)
    parts = [
        tables.curve(columns, model, variant, zeta2=zeta2)
        for columns, model, variant, zeta2 in (
            (of_sphere, "lumped", "", stiffness_ratio),
            (_velocity(x, rough), "rigid", "", 0.0),
            (_sphere(x, sphere, mass_ratio), "continuum", "", stiffness_ratio),
            (_velocity(x, soft), "lumped", "rubber", spring),
            (_velocity(x, soft_sphere), "continuum", "rubber", spring),
            (_sphere(x, lumped.rebound(x, *own), own[0]), "lumped", "finite elements", own[1]),
            (_sphere(x, elements, own[0]), "continuum", "finite elements", own[1]),
        )
    ]
    for model in (PAPER, *CONTINUA):
        shot = experiment, uncertainty or {}, samples, loss_tolerance, angles
        parts += measured.shots(model, "experiment", *shot)
    if as_printed:
        velocity, _, _ = impact.rebound(x, *groups, restitution)
        parts += printed_variants(of_sphere, velocity, zeta2=stiffness_ratio)
    return tables.join(parts)


def _velocity(x: Array, rebound: Rebound) -> dict[str, Any]:
    return {"incidence [mu v2(0)]": x, "velocity [mu v2(0)]": rebound.velocity}


def _sphere(x: Array, rebound: Rebound, mass_ratio: float) -> dict[str, Any]:
    return {
        **_velocity(x, rebound),
        "regime": Regime.names(rebound.regime),
        "spin [mu v2(0)/R]": -(mass_ratio - 1) / mass_ratio * (x - rebound.velocity),
    }
