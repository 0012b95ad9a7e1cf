"""The method that solves each impact: a formula, the table of spheres, or the continuum, solved.

Slip throughout and head-on impacts have a formula that is exact. `spheres` has a table of the
continuum, nearly as fast as a formula; it takes the impacts that it covers, where its error is
below the tolerance. For all others the continuum is solved, elastic for e = 1, else with the loss
of the impact. That takes up to some milliseconds an impact.
"""

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from planarimpact import continuum, models, spheres
from planarimpact.collision.mechanics import Impacts, slides_throughout
from planarimpact.common import checks, sliding
from planarimpact.common.arrays import Array, Booleans, Integers
from planarimpact.common.cautions import Caution
from planarimpact.common.checks import ConvergenceError, InputError
from planarimpact.common.losses import CODE_OF, CODES, NAMES, NONCOLLINEAR, PLASTIC, SPHERES, Loss
from planarimpact.common.results import Rebound, Regime

# Default tolerance, mu v2(0): a little above the bounds of the whole table of spheres. An impact
# that is solved has no larger error in v1(0) either, so that friction of any size has an effect.
TOLERANCE = 5e-3
# Models of the continuum, by the beginning of their names.
CONTINUA = "continuum", "spheres"
# Error by rounding, for a unit of the mass ratio.
ROUNDING = 1e-12


class Method(NamedTuple):
    """A model, the way to its answer ("formula", "table" or "solved"), and why impacts get it.

    The loss is that of the continuum; there is none by a formula, or where it is elastic.
    """

    model: str
    way: str
    why: str
    loss: Loss | None = None

    @property
    def name(self) -> str:
        """Model and way, in words."""
        return self.model if self.way == "formula" else f"{self.model}, {self.way}"


FORMULAS = (
    Method("slip throughout", "formula", "they slide from first to last, by Coulomb's law"),
    Method("head-on", "formula", "they have no tangential motion"),
)
CONTINUUM_WAYS = (
    ("table", "the table of spheres covers them, and its error is below the tolerance"),
    ("solved", "the table of spheres covers them, but its error is above the tolerance"),
    ("solved", "the table of spheres does not cover them"),
)
METHODS = (
    *FORMULAS,
    *(
        Method(f"continuum.{loss.name}" if loss else "continuum", *way, loss)
        for way in CONTINUUM_WAYS
        for loss in (None, *SPHERES.values())  # by code, from -1 on
    ),
)
SLIDING, HEAD_ON = map(METHODS.index, FORMULAS)
# From this place on is the model that a caller has asked for; off the centre one for each loss.
ASKED = len(METHODS)
IS_CONTINUUM = np.array(
    [method not in FORMULAS for method in METHODS] + [False] * len(NONCOLLINEAR)
)
IS_SOLVED = np.array([method.way == "solved" for method in METHODS])


def of_each(impacts: Impacts, tolerance: float) -> tuple[Integers, Array]:
    """The place of each impact's method in `METHODS`, and the largest error of its answer [m/s].

    The method of an impact is the first of `METHODS` that fits; no other function decides it. The
    error is one of velocity; over mu v2(0) that of peak friction, in mu times the peak normal
    force, is not larger.
    """
    head_on = impacts.v1 == 0
    slides = slides_throughout(impacts) & ~head_on
    place, error = np.where(slides, SLIDING, HEAD_ON), np.zeros(slides.size)
    rows = np.flatnonzero(~slides & ~head_on)
    groups = impacts.groups_of(rows)
    loss_code = impacts.loss_code[rows]
    x = impacts.incidence_of(rows)
    of_table = table_error(spheres.error_bound(*groups, loss_code == CODES[PLASTIC]), groups[0], x)
    tabled, covered = of_table <= tolerance, np.isfinite(of_table)
    for way, which in enumerate((tabled, covered & ~tabled, ~covered)):
        elastic = len(FORMULAS) + way * (1 + len(SPHERES))
        place[rows[which]] = elastic + 1 + loss_code[which]
    error[rows] = np.where(tabled, of_table, _tolerance(x, tolerance))
    return place, error * impacts.unit


def _tolerance(x: Array, tolerance: float) -> Array:
    """Largest error of impacts that are solved, mu v2(0)."""
    return np.minimum(tolerance, TOLERANCE * x)


def table_error(bound: Any, mass_ratio: Any, x: Any) -> Any:
    """Largest error of the table of spheres, arrays or floats, mu v2(0), from its bound."""
    return (bound + ROUNDING * mass_ratio) * np.minimum(x, 1.0)


class Answers(NamedTuple):
    """Answers to impacts, arrays of shape (n,), and messages for impacts without an answer.

    Refused ones are not allowed, and unsolved ones did not reach their tolerance.
    """

    place: Integers  # of the method, in `METHODS`
    change: Array  # of the velocity of the contact point [m/s]; slip throughout knows it best
    velocity: Array  # of the contact point at separation [m/s]
    peak_friction: Array  # mu times the peak normal force; NaN where it is not asked for
    regime: Integers
    error: Array  # of the velocity, at most [m/s]; NaN where a model has no bound
    unsolved: dict[int, str]  # `{index: message}`
    refused: dict[int, str]


def answers(
    impacts: Impacts, tolerance: float, peaks: bool = False, solve: bool | Booleans = True
) -> Answers:
    """Each impact answered by its method, with its peak friction or, in less time, without.

    Where `solve` is False, impacts that need the continuum solved are refused.
    """
    place, error = of_each(impacts, tolerance)
    result = _by_formulas(impacts, place, error)
    needs = np.flatnonzero(IS_SOLVED[place] & ~np.asarray(solve)).tolist()
    said = "solve = False: {}, so that it must be solved; choose a model, or solve = True"
    result.refused.update({i: said.format(METHODS[place[i]].why) for i in needs})
    for number in np.unique(np.delete(place, needs)).tolist():
        if IS_CONTINUUM[number]:
            _add_continuum(result, impacts, number, tolerance, peaks)
    return result


def answers_of(model: models.Model, impacts: Impacts, tolerance: float) -> Answers:
    """Each impact answered by one model; without friction, or head-on, formulas are exact.

    The tolerance is that of a continuum. The loss of the impacts is that of the model, see
    `lost_by`. One that the model refuses stops all: it is the first of them.
    """
    x = impacts.incidence_of(np.arange(impacts.v1.size))
    place = np.where(x > checks.LARGEST, SLIDING, np.where(x > 0, ASKED, HEAD_ON))
    result = _by_formulas(impacts, place, np.where(place == ASKED, np.nan, 0.0))
    rows = np.flatnonzero(place == ASKED)
    x, groups, settings = x[rows], impacts.groups_of(rows), dict[str, Any]()
    plastic = impacts.loss_code[rows] == CODES[PLASTIC]
    if has_micro_slip(model):
        error = table_error(spheres.error_bound(*groups, plastic), groups[0], x)
        if is_solved(model):
            error = settings["tolerance"] = _tolerance(x, tolerance)
        result.error[rows] = error * impacts.unit[rows]

    def rebound(part: slice | int) -> Rebound:
        own = {name: values[part] for name, values in settings.items()}
        return models.rebound(model, x[part], *(group[part] for group in groups), **own)

    (least, most), e = model.restitution, groups[2]
    beyond = np.flatnonzero((e < least) | (e > most))
    if beyond.size and least < 1:  # before any work; those for e = 1 say what has a loss
        allowed = f"allowed are numbers from {least:g} to {most:g}"
        first, said = beyond[0], f"{model.name}: restitution = {e[beyond[0]]}: {allowed}"
        result.refused[int(rows[first])] = said
        return result
    found = tried(rebound, rows, result, f"{model.name}: ")
    if not found:
        return result
    slides = found.regime == Regime.SLIP_THROUGHOUT
    fall, velocity = sliding.change(*groups[::2]), found.velocity * impacts.unit[rows]
    result.change[rows] = np.where(slides, -fall * impacts.unit[rows], velocity - impacts.v1[rows])
    result.velocity[rows] = impacts.v1[rows] + result.change[rows]
    result.peak_friction[rows], result.regime[rows] = found.peak_friction, found.regime
    return result


def has_micro_slip(model: models.Model) -> bool:
    """Whether a model is the continuum, solved or from its table."""
    return models.MODELS.get(model.name) is model and model.name.startswith(CONTINUA)


def is_solved(model: models.Model) -> bool:
    """Whether a model is the continuum, solved to a tolerance."""
    return has_micro_slip(model) and model.name.startswith("continuum")


def spared(model: models.Model) -> Caution:
    """Cautions that do not concern a model: it has micro-slip, or no law of the loss."""
    micro_slip = Caution.NO_MICRO_SLIP if has_micro_slip(model) else Caution.NONE
    return micro_slip | (Caution.NONE if model.loss in CODE_OF else Caution.RESTITUTION)


def lost_by(model: models.Model, loss_code: Integers) -> tuple[Integers, dict[int, str]]:
    """Codes of the losses of impacts by a model, and `{index: message}` where a pair contradicts.

    A pair's own loss counts where the model has none, or any. The losses of spheres are those of
    materials, so that one of them does not stand for another; an element of the paper may.
    """
    if model.loss not in CODE_OF:
        return loss_code, {}
    code = CODE_OF[model.loss]
    wrong = np.flatnonzero((loss_code >= 0) & (loss_code != code) & (model.loss in SPHERES))
    said = "loss = '{}': the loss of {} is {}; choose a model with the loss of the pair"
    messages = {i: said.format(NAMES[loss_code[i]], model.name, model.loss) for i in wrong.tolist()}
    return np.where(loss_code >= 0, code, loss_code), messages


def tried(
    rebound: Callable[[slice | int], Any], rows: Integers, result: Answers, who: str = ""
) -> Any:
    """What a model answers to all rows; or None, and what it says of the first that it refuses.

    That goes into the result. The first is found by halves, and answered alone, as the model does
    not know its index.
    """
    try:
        return rebound(slice(None))
    except continuum.Unsolved as error:
        result.unsolved[int(rows[error.impacts[0]])] = f"{who}{error}"
        return None
    except (InputError, ConvergenceError) as error:
        refused = error
    low, high = 0, rows.size
    while high - low > 1:
        middle = (low + high) // 2
        try:
            rebound(slice(low, middle))
            low = middle
        except (InputError, ConvergenceError):
            high = middle
    try:
        rebound(low)
    except (InputError, ConvergenceError) as error:
        refused = error
    problems = result.refused if isinstance(refused, InputError) else result.unsolved
    problems[int(rows[low])] = f"{who}{refused}"
    return None


def _by_formulas(impacts: Impacts, place: Integers, error: Array) -> Answers:
    """Answers with those of formulas in them."""
    slides = place == SLIDING
    fall = sliding.change(impacts.mass_ratio, impacts.restitution) * impacts.unit
    change = np.where(slides, -fall, 0.0)
    regime = np.where(slides, Regime.SLIP_THROUGHOUT, Regime.STICK).astype(np.uint8)
    velocity = impacts.v1 + change
    return Answers(place, change, velocity, slides.astype(float), regime, error, {}, {})


def _add_continuum(
    result: Answers, impacts: Impacts, number: int, tolerance: float, peaks: bool
) -> None:
    """Write the answers of one method into the result."""
    method, rows = METHODS[number], np.flatnonzero(result.place == number)
    rows = np.setdiff1d(rows, [*result.refused]) if result.refused else rows
    x, groups = impacts.incidence_of(rows), impacts.groups_of(rows)
    if method.way == "solved":
        rebound, with_answer, messages = solved(method.loss, x, groups, _tolerance(x, tolerance))
        result.unsolved.update({int(rows[i]): message for i, message in messages.items()})
        rows = rows[with_answer]
    else:
        name = method.loss.name if method.loss else None
        rebound = spheres.rebound(x, *groups, loss=name, forces=peaks)
    result.velocity[rows] = rebound.velocity * impacts.unit[rows]
    result.change[rows] = result.velocity[rows] - impacts.v1[rows]
    result.peak_friction[rows] = rebound.peak_friction
    result.regime[rows] = rebound.regime


def solved(
    loss: Loss | None, incidence: Array, groups: tuple[Array, ...], tolerance: Array
) -> tuple[Rebound, Integers, dict[int, str]]:
    """The continuum, solved to the tolerance of each impact, in mu v2(0).

    Answers, the indices of the impacts that have one, and `{index: message}` of the others.
    """
    rows, messages = np.arange(incidence.size), dict[int, str]()
    while True:
        try:
            arguments = incidence[rows], *(group[rows] for group in groups)
            name = loss.name if loss else None
            rebound = continuum.rebound(*arguments, loss=name, tolerance=tolerance[rows])
            return rebound, rows, messages
        except ConvergenceError as error:
            # An error that names no impacts concerns all of them.
            unsolved = error.impacts if isinstance(error, continuum.Unsolved) else slice(None)
            messages |= dict.fromkeys(rows[unsolved].tolist(), str(error))
            rows = np.delete(rows, unsolved)
