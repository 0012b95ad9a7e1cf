"""Fig. 5: tangential velocity at separation against incidence, e = 1."""

from collections.abc import Callable, Mapping, Sequence
from typing import TypeAlias

import numpy as np

from planarimpact import continuum, lumped, rigid
from planarimpact.arrays import Array, ArrayLike
from planarimpact.curves import Columns, Curves
from planarimpact.curves import as_printed as printed_curves
from planarimpact.curves.sampling import SIGNS, Nodes, regime_names, shifted, vertices
from planarimpact.printed import impact
from planarimpact.printed.slip import slip_throughout_limit as printed_limit
from planarimpact.results import Rebound

# Curves that only tell how far an uncertain parameter moves another one have fewer vertices.
COARSER = 4

_Model: TypeAlias = Callable[..., Rebound]


def curves(
    mass_ratio: float,
    stiffness_ratio: float,
    incidence: Sequence[float],
    restitution: float,
    samples: int,
    tolerance: float,
    rubber: dict[str, float],
    experiment: dict[str, float],
    finite_elements: dict[str, float],
    uncertainty: Mapping[str, float] | None = None,
    nodes: Nodes | None = None,
    as_printed: bool = False,
) -> Curves:
    """The lumped model, its limit, the elastic continuum; the same for rubber, an experiment.

    Parameters
    ----------
    mass_ratio, stiffness_ratio, restitution : float
        beta, zeta^2 and e of the figure.
    incidence : (float, float)
        Range of x = v1(0)/(mu v2(0)).
    samples : int
        Evenly spread vertices; thresholds come on top.
    tolerance : float
        Largest error of the elastic continuum, which has e = 1 whatever the restitution.
    rubber : dict
        `stiffness_ratio` of Johnson's rubber sphere.
    experiment : dict
        An elastic sphere shot at a plane without spin: `mass_ratio`, `stiffness_ratio`,
        `restitution`, `friction`, `speed` (m/s), `radius` (m).
    finite_elements : dict
        Of a finite-element solution: `mass_ratio`, `stiffness_ratio`, `restitution`.
    uncertainty : dict, optional
        One sigma of each parameter of the experiment that is uncertain.
    nodes : dict, optional
        More points that are vertices: of `incidence`, and of `angle` for the experiment.
    as_printed : bool
        Add what the printed equations give, see `planarimpact.curves.as_printed`.

    Returns
    -------
    dict
        `lumped`, `no tangential compliance`, `continuum`; `lumped` and `continuum` again for
        `rubber`, `finite elements` and `experiment`. Those without such a word and those of the
        finite elements have the regime and the spin after impact, R spin/(mu v2(0)) in the
        direction of incidence negative; those of the experiment the quantities that are measured
        against the angle of incidence, and curves beside them with one parameter off by one sigma,
        named by `planarimpact.curves.sampling.shifted`.

    Examples
    --------
    >>> sphere = dict(mass_ratio=3.5, stiffness_ratio=1.164, restitution=0.98, friction=0.092,
    ...               speed=3.9, radius=0.0025)
    >>> elements = dict(mass_ratio=3.5, stiffness_ratio=1.2143, restitution=1.0)
    >>> rubber = {"stiffness_ratio": 1.5}
    >>> named = curves(3.5, 1.21, (0, 8), 1.0, 9, 1e-4, rubber, sphere, elements)
    >>> float(named["lumped"]["velocity [mu v2(0)]"][-1])
    1.0
    """
    limit = lumped.slip_throughout_limit(mass_ratio, stiffness_ratio, restitution)
    printed = printed_limit(mass_ratio, restitution)
    at = nodes or {}
    extra = at.get("incidence", ())
    x = vertices(incidence, samples, stiffness_ratio, mass_ratio, limit, printed, extra)
    spring = rubber["stiffness_ratio"]
    groups = mass_ratio, stiffness_ratio
    exact = lumped.rebound(x, *groups, restitution)

    def elastic(
        incidence: ArrayLike, mass_ratio: float, stiffness_ratio: float, restitution: float = 1.0
    ) -> Rebound:
        return continuum.rebound(incidence, mass_ratio, stiffness_ratio, tolerance=tolerance)

    named = {
        "lumped": _sphere(x, exact, mass_ratio),
        "no tangential compliance": _velocity(
            x, rigid.rebound(x, mass_ratio, restitution=restitution)
        ),
        "continuum": _sphere(x, elastic(x, *groups), mass_ratio),
        "lumped, rubber": _velocity(x, lumped.rebound(x, mass_ratio, spring, restitution)),
        "continuum, rubber": _velocity(x, elastic(x, mass_ratio, spring)),
    }
    models: dict[str, _Model] = {"lumped": lumped.rebound, "continuum": elastic}
    for model, rebound in models.items():
        found = rebound(x, **finite_elements)
        named[f"{model}, finite elements"] = _sphere(x, found, finite_elements["mass_ratio"])
        curve = f"{model}, experiment"
        named[curve] = _experiment(samples, at.get("angle", ()), rebound, **experiment)
        for parameter, sigma in (uncertainty or {}).items():
            for sign in SIGNS:
                changed = experiment | {parameter: experiment[parameter] + sign * sigma}
                beside = _experiment(samples // COARSER, (), rebound, **changed)
                named[shifted(curve, parameter, sign)] = beside
    if as_printed:
        velocity, _, _ = impact.rebound(x, *groups, restitution)
        named |= printed_curves.beside("", named["lumped"], velocity)
    return named


def _velocity(x: Array, rebound: Rebound) -> Columns:
    return {"incidence [mu v2(0)]": x, "velocity [mu v2(0)]": rebound.velocity}


def _sphere(x: Array, rebound: Rebound, mass_ratio: float) -> Columns:
    return {
        **_velocity(x, rebound),
        "regime": regime_names(rebound.regime),
        "spin [mu v2(0)/R]": -(mass_ratio - 1) / mass_ratio * (x - rebound.velocity),
    }


def _experiment(
    samples: int,
    nodes: ArrayLike,
    model: _Model,
    mass_ratio: float,
    stiffness_ratio: float,
    restitution: float,
    friction: float,
    speed: float,
    radius: float,
) -> Columns:
    """What a free sphere without spin shows against its angle of incidence."""
    groups = mass_ratio, stiffness_ratio, restitution
    limits = [stiffness_ratio, mass_ratio, lumped.slip_throughout_limit(*groups)]
    # The ratio of velocities has no value at normal incidence.
    thresholds = np.degrees(np.arctan(friction * np.array(limits)))
    angle = vertices((0.01, 89.9), samples, thresholds, nodes)
    slope = np.tan(np.radians(angle))
    x = slope / friction
    rebound = model(x, *groups)
    change = x - rebound.velocity
    centre = 1 - change / (mass_ratio * x)
    unit = friction * speed * np.cos(np.radians(angle))
    return {
        **_velocity(x, rebound),
        "angle [deg]": angle,
        "centre_restitution [1]": centre,
        "spin [rad/s]": (mass_ratio - 1) / mass_ratio * change * unit / radius,
        "centre_rebound_angle [deg]": np.degrees(np.arctan(centre * slope / restitution)),
        "contact_rebound_angle [deg]": np.degrees(
            np.arctan(friction * rebound.velocity / restitution)
        ),
    }


def contact_velocities(
    angle: ArrayLike, centre_restitution: ArrayLike, mass_ratio: float, friction: float
) -> tuple[Array, Array]:
    """Measured points of a sphere without spin in the axes of the figure.

    Parameters
    ----------
    angle : array_like
        Angle of incidence in degrees.
    centre_restitution : array_like
        Tangential velocity of the centre, after over before.
    mass_ratio, friction : float
        beta and mu.

    Returns
    -------
    incidence, velocity : ndarray
        x = tan(theta)/mu and w = x (beta e_t - (beta - 1)).

    Examples
    --------
    >>> x, w = contact_velocities(45.0, 1.0, 3.5, 0.5)
    >>> round(float(x), 9), round(float(w), 9)
    (2.0, 2.0)
    """
    x = np.tan(np.radians(angle)) / friction
    return x, x * (mass_ratio * np.asarray(centre_restitution) - (mass_ratio - 1))
