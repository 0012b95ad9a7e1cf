"""Every model by its name, from one formula to the elastic continuum, with the same arguments.

Each model is called as `rebound(incidence, mass_ratio, stiffness_ratio, restitution, **settings)`,
the four groups by position or name and its own settings by name. It returns a `Rebound`. The
workflow measures what each model costs and how large its error is (`results/curves/trade.csv`).

Arguments and errors: a `model` is a name of `MODELS` or a `Model`. `incidence`, `mass_ratio`,
`stiffness_ratio` and `restitution` are those of `planarimpact.lumped.rebound`; `settings` are those
of the model, and have its defaults. `InputError` says what is not allowed.

A name contains what takes the energy below e = 1, such as "lumped.hysteretic", the paper's model.
"lumped" and "continuum" alone are elastic. A law of impulses takes any loss. A `Model` of your own
may stand wherever a name does; as an entry of `MODELS` it is known by its name, too.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import partial
from itertools import product
from typing import Any

import numpy as np

from planarimpact import continuum, lumped, rigid, spheres
from planarimpact.common import checks
from planarimpact.common.arrays import Array, ArrayLike
from planarimpact.common.losses import LOSSES, LUMPED, SPHERES
from planarimpact.common.results import Rebound
from planarimpact.models import laws, timestep
from planarimpact.models.choice import compare as compare
from planarimpact.models.choice import materials as materials

# How well e and mu of a pair of materials are known in practice: e to 0.02, mu to 10 %.
RESTITUTION_ERROR, FRICTION_ERROR = 0.02, 0.1
# Gauss's points of a normal distribution, in standard deviations, and their weights.
POINTS = ((-(3**0.5), 1 / 6), (0.0, 2 / 3), (3**0.5, 1 / 6))


@dataclass(frozen=True)
class Model:
    """One model. Name and rebound are enough.

    Attributes
    ----------
    name : str
        Module; and function or loss, where a module has several.
    rebound : callable
        Its solver, with the arguments of every model; `laws.of_velocity` makes one of a velocity.
    settings : dict
        Its own settings and their defaults. Its accuracy and cost depend on them.
    cost : str
        Class of cost: "formula", "table", "phases" (a few phases in closed form), "steps" or
        "steps and springs". The last two grow with the settings.
    restitution : (float, float)
        Range of restitution that it admits.
    valid : str
        What it describes, and what it neglects.
    source : str
        Publication that it is taken from.
    loss : str
        What takes the energy below e = 1: "any" for laws of impulses, to which it makes no
        difference; "" where nothing does, or nobody has said it.

    Examples
    --------
    >>> @laws.of_velocity
    ... def velocity(x, mass_ratio, stiffness_ratio, restitution, *, share=0.5):
    ...     return np.maximum(x - (1 + restitution) * mass_ratio, -share * x)
    >>> rebound(Model("mine.half", velocity, {"share": 0.5}), [2.0, 9.0]).velocity.tolist()
    [-1.0, 2.0]
    """

    name: str
    rebound: Callable[..., Rebound[Any, Any, Any]]
    settings: dict[str, float] = field(default_factory=dict)
    cost: str = "formula"
    restitution: tuple[float, float] = (0.0, 1.0)
    valid: str = ""
    source: str = ""
    loss: str = ""

    def refuse_others(self, settings: Mapping[str, object]) -> None:
        """Refuse settings that this model does not have; the message names the first one."""
        for key, value in settings.items():
            if key not in self.settings:
                names = f"the settings {', '.join(self.settings)}"
                said = checks.in_ascii(f"{key} = {checks.brief(value)}: {self.name}")
                raise checks.InputError(f"{said} has {names if self.settings else 'no settings'}")


def get(model: str | Model) -> Model:
    """The entry of a model, by its name or itself. Arguments and errors: `planarimpact.models`.

    Examples
    --------
    >>> get("lumped").cost
    'phases'
    """
    if isinstance(model, Model):
        return model
    return MODELS[checks.word("model", model, MODELS)]


def rebound(
    model: str | Model,
    incidence: ArrayLike,
    mass_ratio: ArrayLike = 3.5,
    stiffness_ratio: ArrayLike = 1.21,
    restitution: ArrayLike = 1.0,
    **settings: float,
) -> Rebound[Any, Any, Any]:
    """State at separation by the model of a name. Arguments and errors: `planarimpact.models`.

    Examples
    --------
    >>> float(rebound("rigid", 8.0).velocity)
    1.0
    """
    chosen = get(model)
    chosen.refuse_others(settings)
    result = chosen.rebound(incidence, mass_ratio, stiffness_ratio, restitution, **settings)
    if not isinstance(result, Rebound):
        said = f"rebound of {chosen.name} gives {type(result).__name__}: allowed is a Rebound"
        raise checks.InputError(f"{said}, which laws.of_velocity makes of velocities")
    return result


def input_spread(
    model: str | Model,
    incidence: ArrayLike,
    mass_ratio: float = 3.5,
    stiffness_ratio: float = 1.21,
    restitution: float = 1.0,
    **settings: float,
) -> Array:
    """Root mean square change of the velocity at separation under uncertain inputs.

    e is known to 0.02 and mu to 10 % (standard deviations): both errors are normal and independent.
    Values of e above 1 count as 1. A measurement of the same bodies cannot show an error of a model
    that is smaller than this. Nine answers are combined, at three restitutions and three
    coefficients of friction (Gaussian quadrature). If mu is r times as large, a velocity w(x)
    becomes r w(x/r). A model for e = 1 alone has the change by friction alone.

    Arguments and errors: `planarimpact.models`; but for the incidence, groups are numbers. The
    incidence and the answer, of its shape, are in mu v2(0) with mu as it is believed to be.

    Examples
    --------
    >>> float(input_spread("rigid", 1.0)), round(float(input_spread("rigid", 9.0)), 2)
    (0.0, 0.7)
    """
    x = checks.incidence(incidence)
    e = checks.number("restitution", restitution, "numbers from 0 to 1", 0, 1)
    low = get(model).restitution[0]

    def velocity(ratio: float, e: float) -> Array:
        groups = x / ratio, mass_ratio, stiffness_ratio, e
        return ratio * rebound(model, *groups, **settings).velocity

    believed = velocity(1.0, e)
    variance = np.zeros_like(believed)
    for (e_point, e_weight), (mu_point, mu_weight) in product(POINTS, POINTS):
        changed_e = float(np.clip(e + e_point * RESTITUTION_ERROR, low, 1.0))
        changed = velocity(1 + mu_point * FRICTION_ERROR, changed_e)
        variance += e_weight * mu_weight * (changed - believed) ** 2
    return np.sqrt(variance)


def _elastic(
    name: str,
    solve: Callable[..., Rebound],
    /,
    incidence: ArrayLike,
    mass_ratio: ArrayLike = 3.5,
    stiffness_ratio: ArrayLike = 1.21,
    restitution: ArrayLike = 1.0,
    **settings: float,
) -> Rebound:
    """Solve with the loss left out, for e = 1 alone; a refusal names the models with a loss."""
    groups = incidence, mass_ratio, stiffness_ratio, restitution
    checks.impact(*groups)
    lossy = [f"{name}.{loss.name}" for loss in LOSSES if loss.model == name]
    checks.require_loss(restitution, lossy, "a model with a loss")
    return solve(*groups, **settings)


_ELASTIC = (1.0, 1.0)
_STEPPED = "fixed time step, as discrete-element codes have it"
_IMPULSES = "impulses alone: no forces, no order of stick and slip"

MODELS = {
    model.name: model
    for model in (
        Model(
            "rigid",
            rigid.rebound,
            valid="no tangential compliance: the contact never turns round",
            source="Stronge 1994, Eqs 34, 35, 41",
            loss="any",
        ),
        Model(
            "laws.smith",
            laws.smith,
            valid=_IMPULSES + "; tends to a perfect bounce, w = -x, at small incidence",
            source="C. E. Smith, J. Appl. Mech. 58 (1991) 754-758",
            loss="any",
        ),
        Model(
            "laws.brach",
            laws.brach,
            {"tangential_restitution": laws.BRACH_TANGENTIAL_RESTITUTION},
            valid=_IMPULSES + "; two straight lines, the first with a constant to be fitted",
            source="O. R. Walton, in Particulate Two-Phase Flow, 1993; R. M. Brach, J. Appl. Mech. "
            "56 (1989) 133-138",
            loss="any",
        ),
        Model(
            "lumped",
            partial(_elastic, "lumped", lumped.rebound),
            cost="phases",
            restitution=_ELASTIC,
            valid="linear springs, contact sticks and slips as a whole; solved to rounding; "
            "e = 1 only",
            source="Stronge 1994",
        ),
        *(
            Model(
                f"lumped.{name}",
                partial(lumped.rebound, loss=name),
                cost="phases",
                restitution=(loss.least_restitution, 1.0),
                valid=loss.valid,
                source=loss.source,
                loss=name,
            )
            for name, loss in LUMPED.items()
        ),
        Model(
            "timestep.linear",
            partial(timestep.rebound, timestep.LINEAR),
            {"steps": timestep.STEPS},
            "steps",
            valid=f"linear spring and slider, {_STEPPED}; tends to the lumped model",
            source="P. A. Cundall, O. D. L. Strack, Geotechnique 29 (1979) 47-65",
            loss="hysteretic",
        ),
        Model(
            "timestep.mindlin",
            partial(timestep.rebound, timestep.MINDLIN),
            {"steps": timestep.STEPS},
            "steps",
            valid=f"Hertz contact, friction in increments by Mindlin's stiffness, {_STEPPED}",
            source="R. D. Mindlin, J. Appl. Mech. 16 (1949) 259-268; as in LAMMPS, mindlin/force",
            loss="hysteretic",
        ),
        Model(
            "timestep.mindlin_rescaled",
            partial(timestep.rebound, timestep.MINDLIN_RESCALED),
            {"steps": timestep.STEPS},
            "steps",
            valid="as timestep.mindlin, the force rescaled with the radius of contact on unloading",
            source="C. Thornton et al., Powder Technology 233 (2013) 30-46; LAMMPS, "
            "mindlin_rescale/force",
            loss="hysteretic",
        ),
        Model(
            "continuum",
            partial(_elastic, "continuum", continuum.rebound),
            {"tolerance": continuum.ELASTIC_TOLERANCE},
            "steps",
            _ELASTIC,
            valid="elastic spheres with micro-slip, to a tolerance; e = 1 only",
            source="N. Maw et al., Wear 38 (1976) 101-114; V. L. Popov, M. Hess, Method of "
            "Dimensionality Reduction in Contact Mechanics and Friction, Springer 2015",
        ),
        *(
            Model(
                f"continuum.{name}",
                partial(continuum.rebound, loss=name),
                {"tolerance": continuum.LOSSY_TOLERANCE},
                "steps and springs",
                (loss.least_restitution, 1.0),
                valid=loss.valid,
                source=loss.source,
                loss=name,
            )
            for name, loss in SPHERES.items()
        ),
        *(
            Model(
                f"spheres.{name}",
                partial(spheres.rebound, loss=name),
                cost="table",
                restitution=(spheres.LEAST_RESTITUTION[name], 1.0),
                valid=f"continuum.{name} from a table; zeta^2 up to {spheres.LARGEST_STIFFNESS}, "
                f"and m2/m1 over zeta^2 from {spheres.LEAST_RATIO} to {spheres.LARGEST_RATIO}",
                source="solved by this package, planarimpact.continuum",
                loss=name,
            )
            for name in SPHERES
        ),
    )
}
