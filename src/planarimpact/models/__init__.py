"""Every model by its name, from one formula to the elastic continuum, with the same arguments.

Each model is called as `rebound(incidence, mass_ratio, stiffness_ratio, restitution, **settings)`,
the four groups by position or name and its own settings by name. It returns a `Rebound`. The
workflow measures what each model costs and how large its error is (`results/trade.csv`).

A name says what takes the energy below e = 1, such as "lumped.hysteretic", the paper's model.
"lumped" and "continuum" alone are elastic. A law of impulses takes any loss. `register` adds a
model of your own.
"""

import re
from collections.abc import Callable, Mapping
from functools import partial, wraps
from itertools import product
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from planarimpact import continuum, lumped, rigid, spheres
from planarimpact.continuum import annuli
from planarimpact.ground import checks, sliding
from planarimpact.ground.arrays import Array, ArrayLike
from planarimpact.ground.results import Rebound
from planarimpact.models import laws, timestep

# How well e and mu of a pair of materials are known in practice: e to 0.02, mu to 10 %.
RESTITUTION_ERROR, FRICTION_ERROR = 0.02, 0.1
# Classes of cost. A table has an end, see `admits`.
COSTS = ("formula", "table", "phases", "steps", "steps and springs", "steps and circles")
# Gauss's points of a normal distribution, in standard deviations, and their weights.
POINTS = ((-(3**0.5), 1 / 6), (0.0, 2 / 3), (3**0.5, 1 / 6))


def _no_kinks(*groups: float, **settings: float) -> tuple[float, ...]:
    """Kinks of a model of which none is known."""
    return ()


class Model(NamedTuple):
    """One model. Name and rebound are enough.

    Attributes
    ----------
    name : str
        Module, and function where a module holds several.
    rebound : callable
        Its solver.
    settings : dict
        Its own settings and their defaults. Its accuracy and cost depend on them.
    cost : str
        Class of cost: "formula", "table", "phases" (a few phases in closed form), "steps", "steps
        and springs", or "steps and circles". The last three grow with the settings.
    restitution : (float, float)
        Range of restitution that it admits.
    valid : str
        What it describes, and what it neglects.
    source : str
        Publication that it is taken from.
    sliding_limit : callable or None
        Incidence from which it slides throughout, w = x - (1 + e) beta, as a function of mass
        ratio, stiffness ratio, restitution (numbers) and settings. None if it never has that
        velocity exactly.
    kinks : callable
        Incidences, by the same arguments, where its velocity is known to have a kink; there may be
        more.
    loss : str
        What takes the energy below e = 1: "any" for laws of impulses, to which it makes no
        difference; "" where nothing does, or nobody has said it.
    """

    name: str
    rebound: Callable[..., Rebound]
    settings: dict[str, float] = {}
    cost: str = "formula"
    restitution: tuple[float, float] = (0.0, 1.0)
    valid: str = ""
    source: str = ""
    sliding_limit: Callable[..., float] | None = None
    kinks: Callable[..., tuple[float, ...]] = _no_kinks
    loss: str = ""


def get(name: str) -> Model:
    """The model of a name.

    Parameters
    ----------
    name : str
        One of `MODELS`.

    Returns
    -------
    Model

    Raises
    ------
    InputError
        If there is none of that name.

    Examples
    --------
    >>> get("lumped").cost
    'phases'
    >>> get("magic")
    Traceback (most recent call last):
    ...
    planarimpact.InputError: model = 'magic': allowed are rigid, laws.smith, laws.brach, lumped, \
lumped.hysteretic, lumped.unloading-stiffness, lumped.viscous, timestep.linear, timestep.mindlin, \
timestep.mindlin_rescaled, continuum, continuum.viscous, continuum.plastic, spheres.viscous, \
spheres.plastic, annuli
    """
    if not isinstance(name, str) or name not in MODELS:
        raise checks.InputError(f"model = {checks.brief(name)}: allowed are {', '.join(MODELS)}")
    return MODELS[name]


def rebound(
    model: str,
    incidence: ArrayLike,
    mass_ratio: ArrayLike = 3.5,
    stiffness_ratio: ArrayLike = 1.21,
    restitution: ArrayLike = 1.0,
    **settings: float,
) -> Rebound:
    """State at separation by the model of a name.

    Parameters
    ----------
    model : str
        One of `MODELS`.
    incidence, mass_ratio, stiffness_ratio, restitution : array_like
        As in `planarimpact.lumped.rebound`.
    **settings
        Those of the model. Settings that are left out have their defaults.

    Returns
    -------
    Rebound

    Raises
    ------
    InputError
        If there is no such model or setting, or as the model does.

    Examples
    --------
    >>> float(rebound("rigid", 8.0).velocity)
    1.0
    >>> rebound("lumped", 2.0, restitution=0.8)
    Traceback (most recent call last):
    ...
    planarimpact.InputError: restitution = 0.8: allowed are numbers equal to 1, unless the model's \
name says what takes the energy: lumped.hysteretic (the paper's), lumped.unloading-stiffness, \
lumped.viscous
    >>> rebound("lumped", 8.0, steps=4)
    Traceback (most recent call last):
    ...
    planarimpact.InputError: steps = 4: lumped has no settings
    """
    chosen = get(model)
    refuse_unknown(chosen, settings)
    return chosen.rebound(incidence, mass_ratio, stiffness_ratio, restitution, **settings)


def input_spread(
    model: str,
    incidence: ArrayLike,
    mass_ratio: float = 3.5,
    stiffness_ratio: float = 1.21,
    restitution: float = 1.0,
    *,
    restitution_error: float = RESTITUTION_ERROR,
    friction_error: float = FRICTION_ERROR,
    **settings: float,
) -> Array:
    """Root mean square change of the velocity at separation under uncertain inputs.

    A measurement of the same bodies cannot show an error of a model that is smaller than this.

    Parameters
    ----------
    model : str
        One of `MODELS`.
    incidence : array_like
        x = v1(0)/(mu v2(0)), with mu as it is believed to be.
    mass_ratio, stiffness_ratio, restitution : float
        As in `planarimpact.lumped.rebound`.
    restitution_error : float
        Standard deviation of e, from 0. Values above 1 count as 1.
    friction_error : float
        Standard deviation of mu over mu, 0 to 0.5.
    **settings
        Of the model.

    Returns
    -------
    ndarray of float64 or float
        In mu v2(0), with mu as it is believed to be; the shape of `incidence`. If mu is r times as
        large, a velocity w(x) becomes r w(x/r). Both errors are normal and independent. A model
        for e = 1 alone has that of friction alone.

    Raises
    ------
    InputError
        As `rebound`, or if an error is out of its range.

    Notes
    -----
    Nine answers are combined, at three restitutions and three coefficients of friction (Gaussian
    quadrature).

    Examples
    --------
    >>> float(input_spread("rigid", 1.0)), round(float(input_spread("rigid", 9.0)), 2)
    (0.0, 0.7)
    """
    allowed = "numbers from 0 to 1"
    e_error = checks.number("restitution_error", restitution_error, allowed, 0, 1)
    mu_error = checks.number("friction_error", friction_error, "numbers from 0 to 0.5", 0, 0.5)
    x = checks.incidence(incidence)
    e = float(checks.restitution(restitution))
    low = get(model).restitution[0]

    def velocity(ratio: float, e: float) -> Array:
        groups = x / ratio, mass_ratio, stiffness_ratio, e
        return ratio * rebound(model, *groups, **settings).velocity

    believed = velocity(1.0, e)
    variance = np.zeros_like(believed)
    for (e_point, e_weight), (mu_point, mu_weight) in product(POINTS, POINTS):
        changed_e = float(np.clip(e + e_point * e_error, low, 1.0))
        changed = velocity(1 + mu_point * mu_error, changed_e)
        variance += e_weight * mu_weight * (changed - believed) ** 2
    return np.sqrt(variance)


def admits(model: Model, mass_ratio: float, stiffness_ratio: float, restitution: float) -> bool:
    """Whether a model has an answer for these groups.

    Parameters
    ----------
    model : Model
    mass_ratio, stiffness_ratio, restitution : float
        As in `planarimpact.lumped.rebound`.

    Returns
    -------
    bool

    Examples
    --------
    >>> names = "lumped", "lumped.hysteretic", "spheres.plastic"
    >>> [admits(get(name), 3.5, 5.0, 0.5) for name in names]
    [False, True, False]
    """
    low, high = model.restitution
    covered = model.cost != "table" or spheres.covers(mass_ratio, stiffness_ratio, restitution)
    return low <= restitution <= high and bool(covered)


def register(model: Model, *, replace: bool = False) -> None:
    """Add a model of your own: from then on `MODELS` and all that takes a name know it.

    It lasts as long as the program runs. That `rebound` keeps the convention is tried with a few
    impacts of a solid sphere (mass ratio 3.5, stiffness ratio 1.21), at both ends of its range of
    restitution.

    Parameters
    ----------
    model : Model
        Its `name` has letters, digits, dots, hyphens and underscores. Its `rebound` takes the four
        groups by position or name and the settings by name, and gives a `Rebound`;
        `laws.of_velocity` makes one of a velocity alone.
    replace : bool
        Whether it may replace one of your own that has the same name.

    Raises
    ------
    InputError
        If the name is taken or is no name, the restitution is no range within 0 to 1, the cost is
        none of `COSTS` or "table", or `rebound` fails, gives no `Rebound`, another shape than that
        of the incidences, a velocity that is no number, not odd in the incidence or farther from it
        than friction can bring it, or other velocities without its settings than with the defaults
        that `settings` states.

    Examples
    --------
    >>> import numpy as np
    >>> @laws.of_velocity
    ... def velocity(x, mass_ratio, stiffness_ratio, restitution, *, share=0.5):
    ...     return np.maximum(x - (1 + restitution) * mass_ratio, -share * x)
    >>> register(Model("example.half", velocity, settings={"share": 0.5}))
    >>> rebound("example.half", [2.0, 9.0]).velocity.tolist()
    [-1.0, 2.0]
    >>> register(Model("rigid", velocity))
    Traceback (most recent call last):
    ...
    planarimpact.InputError: name = 'rigid': allowed are names that no model has
    >>> del MODELS["example.half"]
    """
    if not isinstance(model, Model):
        raise checks.InputError(f"model = {checks.brief(model)}: allowed are models.Model(...)")
    name = model.name
    if not isinstance(name, str) or not re.fullmatch(r"[A-Za-z][\w.-]*", name, re.ASCII):
        allowed = "letters, digits, dots, hyphens and underscores, a letter first"
        raise checks.InputError(f"name = {checks.brief(name)}: allowed are {allowed}")
    taken = name in _OF_THE_PACKAGE
    if taken or (name in MODELS and not replace):
        own = "" if taken else "; replace=True replaces one of your own"
        raise checks.InputError(f"name = {name!r}: allowed are names that no model has{own}")
    allowed = "two numbers from 0 to 1, the smaller first"
    ends = checks.checked("restitution", model.restitution, allowed, 0, 1)
    if ends.shape != (2,) or ends[0] > ends[1]:
        raise checks.InputError(f"restitution = {model.restitution}: allowed are {allowed}")
    costs = [cost for cost in COSTS if cost != "table"]
    if model.cost not in costs:
        known = ", ".join(costs)
        raise checks.InputError(f"cost = {checks.brief(model.cost)}: allowed are {known}")
    for e in ends.tolist():
        _refuse_other_convention(model, e)
    MODELS[name] = model


def _refuse_other_convention(model: Model, restitution: float) -> None:
    """Refuse a model whose `rebound` is not as that of every other, at one restitution."""
    x = np.array([[-9.0, -2.0, -0.5, 0.0], [9.0, 2.0, 0.5, 4.0]])
    where = f"rebound of {model.name} at restitution {restitution:g}"
    groups: dict[str, Any] = dict(zip(checks.RULES, (x, 3.5, 1.21, restitution), strict=True))

    def answer(shape: tuple[int, ...], *by_position: ArrayLike, **by_name: Any) -> Rebound:
        try:
            result = model.rebound(*by_position, **by_name)
        except Exception as error:
            problem = f"{type(error).__name__}: {error}"
            raise checks.InputError(f"{where}: it fails: {problem}") from error
        if not isinstance(result, Rebound):
            raise checks.InputError(
                f"{where}: it gives {type(result).__name__}: allowed is a Rebound, which "
                "laws.of_velocity makes of velocities"
            )
        for field in ("velocity", "peak_friction", "dissipation", "regime"):
            found = np.shape(getattr(result, field))
            if found != shape:
                raise checks.InputError(
                    f"{where}: {field}, shape {found}: allowed is that of the incidences, {shape}"
                )
        return result

    velocity = np.asarray(answer(x.shape, *groups.values()).velocity)
    answer((), 2.0, *list(groups.values())[1:])
    if not np.isfinite(velocity).all():
        first = x[~np.isfinite(velocity)][0]
        raise checks.InputError(
            f"{where}: velocity at incidence {first:g}: allowed are finite numbers"
        )
    if not np.array_equal(velocity[0, :3], -velocity[1, :3]):
        raise checks.InputError(
            f"{where}: velocity at incidence -2 is {velocity[0, 1]:g}, at 2 {velocity[1, 1]:g}: "
            "allowed are opposite ones"
        )
    largest = sliding.change(3.5, restitution)
    too_much = np.abs(x - velocity)[1] > 1.01 * largest  # models in time steps have small errors
    if too_much.any():
        raise checks.InputError(
            f"{where}: velocity at incidence {x[1][too_much][0]:g}: allowed are changes up to "
            f"(1 + e) m2/m1 = {largest:g}, the most that friction can give"
        )
    if not np.array_equal(velocity, answer(x.shape, **groups, **model.settings).velocity):
        raise checks.InputError(
            f"settings = {model.settings}: allowed are the defaults of rebound, which gives other "
            "velocities without them"
        )


def refuse_unknown(model: Model, settings: Mapping[str, object]) -> None:
    """Refuse settings that a model does not have.

    Parameters
    ----------
    model : Model
    settings : mapping
        By name.

    Raises
    ------
    InputError
        If there is such a setting. The message names the first one, and those of the model.

    Examples
    --------
    >>> refuse_unknown(get("annuli"), {"circles": 8})
    """
    for key, value in settings.items():
        if key not in model.settings:
            known = f"the settings {', '.join(model.settings)}" if model.settings else "no settings"
            raise checks.InputError(f"{key} = {checks.brief(value)}: {model.name} has {known}")


def loss_of(model: str, restitution: float) -> str:
    """What takes the energy of an impact by the model of a name.

    Parameters
    ----------
    model : str
        One of `MODELS`.
    restitution : float
        e, 0 to 1.

    Returns
    -------
    str
        "none" for e = 1, else as `Model.loss`.

    Examples
    --------
    >>> [loss_of(name, 0.8) for name in ("continuum.plastic", "timestep.linear", "rigid")]
    ['plastic', 'hysteretic', 'any']
    >>> loss_of("lumped", 1.0)
    'none'
    """
    return "none" if restitution == 1 else get(model).loss


def losses(model: str) -> dict[str, str]:
    """Names of the models that are a model with a loss, by that loss.

    Parameters
    ----------
    model : str
        Name of a model without loss, such as "lumped".

    Returns
    -------
    dict of str

    Examples
    --------
    >>> losses("continuum")
    {'viscous': 'continuum.viscous', 'plastic': 'continuum.plastic'}
    >>> losses("rigid")
    {}
    """
    return {other.loss: name for name, other in MODELS.items() if name == f"{model}.{other.loss}"}


def _elastic(name: str, solve: Callable[..., Rebound]) -> Callable[..., Rebound]:
    """A solver with the loss left out, for e = 1 alone; a refusal names the models with a loss."""

    @wraps(solve)
    def rebound(
        incidence: ArrayLike,
        mass_ratio: ArrayLike = 3.5,
        stiffness_ratio: ArrayLike = 1.21,
        restitution: ArrayLike = 1.0,
        **settings: float,
    ) -> Rebound:
        groups = incidence, mass_ratio, stiffness_ratio, restitution
        checks.impact(*groups)
        checks.lossless(restitution, losses(name).values(), "the model's name")
        return solve(*groups, **settings)

    return rebound


# What the table below has as `sliding_limit` and `kinks`: functions of mass ratio, stiffness ratio,
# restitution and the model's settings, most of which have no effect on them.
_Limit: TypeAlias = Callable[..., float]
_Kinks: TypeAlias = Callable[..., tuple[float, ...]]


def _stiff_limit(
    beta: float, zeta2: float, e: float, *, tangential_restitution: float = 0.0
) -> float:
    """Sliding limit without compliance, where just below it w = -tangential_restitution x."""
    return sliding.change(beta, e) / (1 + tangential_restitution)


def _compliant_limit(loss: str) -> _Limit:
    """Sliding limit of a contact with tangential compliance, elastic or with this loss."""
    return lambda beta, zeta2, e, **settings: float(
        lumped.slip_throughout_limit(beta, zeta2, e, loss=loss)
    )


def _yielding_limit(beta: float, zeta2: float, e: float, **settings: float) -> float:
    """Sliding limit of the plastic continuum."""
    return float(continuum.slip_throughout_limit(beta, zeta2, e, loss="plastic"))


def _tabled_yielding_limit(beta: float, zeta2: float, e: float) -> float:
    """Sliding limit of the plastic continuum, from the table of spheres where it covers this."""
    if not spheres.covers(beta, zeta2, e):
        return _yielding_limit(beta, zeta2, e)
    return float(spheres.plastic_limit(*np.array([[beta], [zeta2], [e]]))[0])


def _limit_alone(limit: _Limit) -> _Kinks:
    """The limit of sliding throughout is the only kink."""
    return lambda *groups, **settings: (limit(*groups, **settings),)


def _compliant_kinks(limit: _Limit) -> _Kinks:
    """Where the contact no longer starts in stick, where slip lasts through compression, limit."""
    return lambda beta, zeta2, e, **settings: (zeta2, beta, limit(beta, zeta2, e, **settings))


_BRACH_SETTINGS = {"tangential_restitution": laws.BRACH_TANGENTIAL_RESTITUTION}
_BRACH_LIMIT = partial(_stiff_limit, **_BRACH_SETTINGS)
_HYSTERETIC_LIMIT, _UNLOADING_LIMIT, _VISCOUS_LIMIT = map(_compliant_limit, lumped.LOSSES)
_ANY, _ELASTIC = (0.0, 1.0), (1.0, 1.0)
_LOSSY = (continuum.LEAST_RESTITUTION, 1.0)
_STEPPED = "fixed time step, as discrete-element codes have it"
_IMPULSES = "impulses alone: no forces, no order of stick and slip"

MODELS = {
    model.name: model
    for model in (
        Model(
            "rigid",
            rigid.rebound,
            {},
            "formula",
            _ANY,
            "no tangential compliance: the contact never turns round",
            "Stronge 1994, Eqs 34, 35, 41",
            _stiff_limit,
            lambda beta, zeta2, e: (beta, _stiff_limit(beta, zeta2, e)),
            "any",
        ),
        Model(
            "laws.smith",
            laws.smith,
            {},
            "formula",
            _ANY,
            _IMPULSES + "; tends to a perfect bounce, w = -x, at small incidence",
            "C. E. Smith, J. Appl. Mech. 58 (1991) 754-758",
            _stiff_limit,
            _limit_alone(_stiff_limit),
            "any",
        ),
        Model(
            "laws.brach",
            laws.brach,
            _BRACH_SETTINGS,
            "formula",
            _ANY,
            _IMPULSES + "; two straight lines, the first with a constant to be fitted",
            "O. R. Walton, in Particulate Two-Phase Flow, 1993; R. M. Brach, J. Appl. Mech. 56 "
            "(1989) 133-138",
            _BRACH_LIMIT,
            _limit_alone(_BRACH_LIMIT),
            "any",
        ),
        Model(
            "lumped",
            _elastic("lumped", lumped.rebound),
            {},
            "phases",
            _ELASTIC,
            "linear springs, contact sticks and slips as a whole; solved to rounding; e = 1 only",
            "Stronge 1994",
            _HYSTERETIC_LIMIT,
            _compliant_kinks(_HYSTERETIC_LIMIT),
        ),
        Model(
            "lumped.hysteretic",
            partial(lumped.rebound, loss="hysteretic"),
            {},
            "phases",
            _ANY,
            "the paper's model: as lumped, the normal spring alone loses energy; to rounding",
            "Stronge 1994",
            _HYSTERETIC_LIMIT,
            _compliant_kinks(_HYSTERETIC_LIMIT),
            "hysteretic",
        ),
        Model(
            "lumped.unloading-stiffness",
            partial(lumped.rebound, loss="unloading-stiffness"),
            {},
            "phases",
            _ANY,
            "as lumped, with e^2 zeta^2 for zeta^2: both stiffnesses elastic; solved to rounding",
            "Stronge 1994, with the elastic stiffness of unloading in the ratio",
            _UNLOADING_LIMIT,
            lambda beta, zeta2, e: (e * e * zeta2, beta, _UNLOADING_LIMIT(beta, zeta2, e)),
            "unloading-stiffness",
        ),
        Model(
            "lumped.viscous",
            partial(lumped.rebound, loss="viscous"),
            {},
            "phases",
            (lumped.viscous.LEAST_RESTITUTION, 1.0),
            "two Kelvin-Voigt elements of one relaxation time; solved to 1e-12",
            "T. Schwager, T. Poeschel, Granular Matter 9 (2007) 465-469, for the normal element",
            _VISCOUS_LIMIT,
            _compliant_kinks(_VISCOUS_LIMIT),
            "viscous",
        ),
        Model(
            "timestep.linear",
            timestep.linear,
            {"steps": timestep.STEPS},
            "steps",
            _ANY,
            f"linear spring and slider, {_STEPPED}; tends to the lumped model",
            "P. A. Cundall, O. D. L. Strack, Geotechnique 29 (1979) 47-65",
            None,
            _compliant_kinks(_HYSTERETIC_LIMIT),
            "hysteretic",
        ),
        Model(
            "timestep.mindlin",
            timestep.mindlin,
            {"steps": timestep.STEPS},
            "steps",
            _ANY,
            f"Hertz contact, friction in increments by Mindlin's stiffness, {_STEPPED}",
            "R. D. Mindlin, J. Appl. Mech. 16 (1949) 259-268; as in LAMMPS, mindlin/force",
            None,
            _compliant_kinks(_HYSTERETIC_LIMIT),
            "hysteretic",
        ),
        Model(
            "timestep.mindlin_rescaled",
            timestep.mindlin_rescaled,
            {"steps": timestep.STEPS},
            "steps",
            _ANY,
            "as timestep.mindlin, the force rescaled with the radius of contact on unloading",
            "C. Thornton et al., Powder Technology 233 (2013) 30-46; LAMMPS, mindlin_rescale/force",
            None,
            _compliant_kinks(_HYSTERETIC_LIMIT),
            "hysteretic",
        ),
        Model(
            "continuum",
            partial(
                _elastic("continuum", continuum.rebound), tolerance=continuum.ELASTIC_TOLERANCE
            ),
            {"tolerance": continuum.ELASTIC_TOLERANCE},
            "steps",
            _ELASTIC,
            "elastic spheres with micro-slip, to a tolerance; e = 1 only",
            "N. Maw et al., Wear 38 (1976) 101-114; V. L. Popov, M. Hess, Method of Dimensionality "
            "Reduction in Contact Mechanics and Friction, Springer 2015",
            _HYSTERETIC_LIMIT,
            _compliant_kinks(_HYSTERETIC_LIMIT),
        ),
        Model(
            "continuum.viscous",
            partial(continuum.rebound, loss="viscous", tolerance=continuum.LOSSY_TOLERANCE),
            {"tolerance": continuum.LOSSY_TOLERANCE},
            "steps and springs",
            _LOSSY,
            "Kelvin-Voigt spheres with micro-slip, to a tolerance; one relaxation time",
            "V. L. Popov, E. Willert, M. Hess, Facta Univ. Mech. Eng. 16 (2018) 141-156; G. "
            "Kuwabara, K. Kono, Jpn. J. Appl. Phys. 26 (1987) 1230-1233",
            _VISCOUS_LIMIT,
            _compliant_kinks(_VISCOUS_LIMIT),
            "viscous",
        ),
        Model(
            "continuum.plastic",
            partial(continuum.rebound, loss="plastic", tolerance=continuum.LOSSY_TOLERANCE),
            {"tolerance": continuum.LOSSY_TOLERANCE},
            "steps and springs",
            _LOSSY,
            "elastic-plastic spheres with micro-slip, to a tolerance; contained yielding",
            "C. Thornton, J. Appl. Mech. 64 (1997) 383-386",
            _yielding_limit,
            _compliant_kinks(_yielding_limit),
            "plastic",
        ),
        *(
            Model(
                f"spheres.{loss}",
                partial(spheres.rebound, loss=loss),
                {},
                "table",
                (spheres.LEAST_RESTITUTION, 1.0),
                f"continuum.{loss} from a table; zeta^2 up to {spheres.LARGEST_STIFFNESS}, and "
                f"m2/m1 over zeta^2 from {spheres.LEAST_RATIO} to {spheres.LARGEST_RATIO}",
                "solved by this package, planarimpact.spheres.making",
                limit,
                _compliant_kinks(limit),
                loss,
            )
            for loss, limit in zip(
                continuum.LOSSES, (_VISCOUS_LIMIT, _tabled_yielding_limit), strict=True
            )
        ),
        Model(
            "annuli",
            annuli.rebound,
            {"circles": 32, "steps": 512},
            "steps and circles",
            _ELASTIC,
            "elastic spheres with micro-slip by the scheme of 1976: a check of the continuum",
            "N. Maw et al., Wear 38 (1976) 101-114",
            None,
            _compliant_kinks(_HYSTERETIC_LIMIT),
        ),
    )
}
_OF_THE_PACKAGE = frozenset(MODELS)


def reference(restitution: float, loss: str | None = None) -> str:
    """Name of the model that others are measured against.

    It is a continuum: elastic, or for e < 1 the one with this loss. If the loss is not known, the
    error is up to the distance between the two lossy ones.

    Parameters
    ----------
    restitution : float
        e, 0 to 1.
    loss : str, optional
        "viscous" or "plastic"; needed where e < 1.

    Returns
    -------
    str
        "continuum" for e = 1, else "continuum.viscous" or "continuum.plastic".

    Raises
    ------
    InputError
        If an argument is none of these.

    Examples
    --------
    >>> reference(1.0), reference(0.9, "viscous"), reference(0.9, "plastic")
    ('continuum', 'continuum.viscous', 'continuum.plastic')
    """
    if loss is None:
        checks.lossless(restitution, continuum.LOSSES)
        return "continuum"
    checks.loss(loss, continuum.LOSSES)
    return "continuum" if checks.restitution(restitution) == 1 else f"continuum.{loss}"
