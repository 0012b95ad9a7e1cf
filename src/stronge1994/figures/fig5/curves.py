"""Fig. 5: tangential velocity at separation against incidence, e = 1."""

from collections.abc import Mapping, Sequence

from planarimpact import continuum, lumped, rigid
from planarimpact.common.arrays import Array
from planarimpact.common.results import Rebound, Regime
from stronge1994.csv_tables import Columns, Curves
from stronge1994.curve_names import CONTINUA
from stronge1994.figures.shared.curves import as_printed as printed_curves
from stronge1994.figures.shared.curves import measured
from stronge1994.figures.shared.curves.sampling import NO_NODES, Nodes, vertices
from stronge1994.printed import impact
from stronge1994.printed.slip import slip_throughout_limit as printed_limit


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
) -> Curves:
    """The lumped model, its limit and the elastic continuum; an experiment with loss.

    The elastic continuum has e = 1 whatever the restitution. `rubber` and `finite elements` have a
    curve `lumped, ...` and `continuum, ...` each. The experiment, a sphere shot at a plane without
    spin, has a curve of the lumped model and of each of `CONTINUA`, with the quantities that
    are measured against the angle of incidence; beside them stand curves with one parameter off by
    one sigma, named by `curve_names.shifted`. `spin` is that after the impact, negative in the
    direction of incidence; that of the experiment, in rad/s, has the other sign.

    >>> sphere = dict(mass_ratio=3.5, stiffness_ratio=1.164, restitution=0.98, friction=0.092,
    ...               speed=3.9, radius=0.0025)
    >>> elements = dict(mass_ratio=3.5, stiffness_ratio=1.2143, restitution=1.0)
    >>> rubber = {"stiffness_ratio": 1.5}
    >>> named = curves(3.5, 1.21, (0, 8), 1.0, 9, 1e-4, 1e-3, rubber, sphere, elements)
    >>> float(named["lumped"]["velocity [mu v2(0)]"][-1])
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
    rough = rigid.rebound(x, mass_ratio, restitution=restitution)
    soft = lumped.rebound(x, mass_ratio, spring, restitution)
    own = measured.groups(finite_elements)
    elastic = {
        name: continuum.rebound(x, beta, zeta2, tolerance=tolerance)
        for name, (beta, zeta2) in (
            ("sphere", groups),
            ("rubber", (mass_ratio, spring)),
            ("finite elements", own[:2]),
        )
    }
    named = {
        "lumped": _sphere(x, exact, mass_ratio),
        "no tangential compliance": _velocity(x, rough),
        "continuum": _sphere(x, elastic["sphere"], mass_ratio),
        "lumped, rubber": _velocity(x, soft),
        "continuum, rubber": _velocity(x, elastic["rubber"]),
        "lumped, finite elements": _sphere(x, lumped.rebound(x, *own), own[0]),
        "continuum, finite elements": _sphere(x, elastic["finite elements"], own[0]),
    }
    for model in ("lumped.hysteretic", *CONTINUA):
        sphere = experiment, uncertainty or {}, samples, loss_tolerance, angles
        named |= measured.shots(model, f"{model}, experiment", *sphere)
    if as_printed:
        velocity, _, _ = impact.rebound(x, *groups, restitution)
        named |= printed_curves.beside("", named["lumped"], velocity)
    return named


def _velocity(x: Array, rebound: Rebound) -> Columns:
    return {"incidence [mu v2(0)]": x, "velocity [mu v2(0)]": rebound.velocity}


def _sphere(x: Array, rebound: Rebound, mass_ratio: float) -> Columns:
    return {
        **_velocity(x, rebound),
        "regime": Regime.names(rebound.regime),
        "spin [mu v2(0)/R]": -(mass_ratio - 1) / mass_ratio * (x - rebound.velocity),
    }
