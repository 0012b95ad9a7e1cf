"""Compiled responses: the rebound of one pair of bodies as a table of polynomials.

With fixed groups the rebound is a function of the incidence alone, smooth between a few kinks. A
response holds that function. It takes tens of nanoseconds an impact, whatever the model it stands
for. Where the model slides throughout by formula, the response has this formula. Its error is
measured against the model, not against nature, and must be within a tolerance.

Symbols: x incidence, beta = m2/m1 mass ratio, e restitution.
"""

import hashlib
import json
import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import InitVar, dataclass, field
from pathlib import Path
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np

from planarimpact import models
from planarimpact.ground import checks, files, sliding
from planarimpact.ground.arrays import Array, ArrayLike, Booleans, Integers
from planarimpact.ground.results import Rebound, Regime
from planarimpact.response import piecewise

FORMAT, VERSION = "planarimpact response", 1
CONTENT = (
    "model",
    "parameters",
    "incidence_max",
    "tolerance",
    "error_bound",
    "slides_from",
    "pieces",
)
# Impacts evaluated together: they stay in the cache.
CHUNK = 16384
# Rounding error of a fit, as a share of the largest incidence that is fitted.
ROUNDING = 2.0**-48
# A kink below this share of the largest incidence that is fitted counts as 0.
NARROWEST = 1e-30
# Default of the largest incidence.
INCIDENCE_MAX = 20.0
# Default tolerances by the model's class of cost. The springs of a contact with loss are slow, and
# the table of spheres jumps by up to 1e-6 between its patches.
TOLERANCES = {
    "formula": 1e-6,
    "phases": 1e-6,
    "steps": 1e-4,
    "table": 1e-3,
    "steps and springs": 3e-3,
    "steps and circles": 1e-2,
}
# Share of the tolerance that a model with a tolerance setting gets. Its answers jump by about as
# much, where neighbouring impacts take different numbers of steps: the fit must allow for that.
MODEL_SHARE = 1 / 4
OWN_TOLERANCE = re.compile("^tolerance = [^:]*: ")
# Share of the tolerance that the fit gets, at the first try and at the second.
FIT_SHARES = 1 / 4, 1 / 32
# When a file is checked, a model with a tolerance setting is solved with this one first. It is also
# the default tolerance of classes of cost that `TOLERANCES` does not have.
COARSE = 1e-3


class Bound(NamedTuple):
    """Largest errors of a response against its model, as measured when it was built."""

    velocity: float
    peak_friction: float


@dataclass(frozen=True, eq=False, repr=False)
class Response:
    """The rebound of one pair of bodies as a function of incidence; made by `compile` or `load`.

    It cannot be changed.

    Attributes
    ----------
    model : str
        Name of the model that it stands for.
    parameters : mapping
        mass_ratio, stiffness_ratio, restitution, and the model's settings.
    incidence_max : float
        Largest |incidence| that it answers; infinite where the model slides throughout beyond.
    tolerance : float
        The largest error that was allowed.
    error_bound : Bound
        Measured: twice the largest difference from the model at the points of a search, plus the
        model's own tolerance if it has one. The search begins at 32 points of every piece, its ends
        among them, and takes more points beside the largest differences. It is no proof: a narrow
        kink may lie between the points, above all in a model in time steps. Rounding adds up to
        4e-15 of the largest incidence. The bound does not hold for the regime, which changes within
        a hundredth of the tolerance from where the model's does.
    slides_from : float
        Incidence from which the formula of slip throughout holds, or infinity.
    pieces : planarimpact.response.piecewise.Pieces
        Polynomials of velocity and peak friction up to there, or up to `incidence_max`.
    gains : bool
        Whether the model itself creates energy somewhere. Where it does not, the response does not
        either: the velocity is at most |x|.
    """

    model: str
    parameters: Mapping[str, float]
    incidence_max: float
    tolerance: float
    error_bound: Bound
    slides_from: float
    pieces: piecewise.Pieces
    _token: InitVar[object] = None
    _piecewise: piecewise.Piecewise = field(init=False)
    gains: bool = field(init=False)

    def __post_init__(self, _token: object) -> None:
        if _token is not _TOKEN:  # such as `dataclasses.replace`, which measures no error
            raise checks.InputError(
                f"response of {checks.brief(self.model)}: allowed are those that `compile` or "
                "`load` makes, as they are measured against their model"
            )
        object.__setattr__(self, "parameters", MappingProxyType(dict(self.parameters)))
        table = piecewise.Piecewise(self.pieces)
        object.__setattr__(self, "_piecewise", table)
        x, (velocity, _) = table.sample(piecewise.MEASURED)
        largest = x + self.error_bound.velocity + ROUNDING * self.pieces.end
        object.__setattr__(self, "gains", bool((np.abs(velocity) > largest).any()))

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle and copy it by its fields; a read-only mapping has no pickle."""
        question = (self.model, dict(self.parameters), self.incidence_max, self.tolerance)
        return _new_response, (*question, self.error_bound, self.slides_from, self.pieces)

    def __repr__(self) -> str:
        own = {key: value for key, value in self.parameters.items() if key != "tolerance"}
        words = ", ".join(f"{name} = {value:g}" for name, value in own.items())
        reached = f"error {max(self.error_bound):.1e}, allowed {self.tolerance:g}"
        return f"<Response of {self.model}: {words}; {reached}>"

    @checks.default_errors
    def __call__(self, incidence: ArrayLike) -> Rebound:
        """State at separation, as the model's own `rebound` gives it.

        Parameters
        ----------
        incidence : array_like
            x = v1(0)/(mu v2(0)), any sign, |x| up to `incidence_max`.

        Returns
        -------
        Rebound

        Raises
        ------
        InputError
            If an incidence is no finite number, or beyond `incidence_max` or 8e307.

        Examples
        --------
        >>> response = compile("lumped", incidence_max=20, tolerance=1e-9)
        >>> result = response([0.0, 2.0, -2.0, 8.0])
        >>> result.velocity.round(6).tolist()
        [0.0, -0.577942, 0.577942, 1.0]
        >>> [Regime(code).name for code in result.regime][1:]
        ['SLIP_STICK_SLIP', 'SLIP_STICK_SLIP', 'SLIP_THROUGHOUT']
        """
        x = checks.incidence(incidence)
        velocity, impulse, peak, regime = (np.empty(x.size) for _ in range(4))
        e, beta = self.parameters["restitution"], self.parameters["mass_ratio"]
        for part, abs_x, slides, piece, variable in self._parts(x):
            velocity[part] = self._velocity(abs_x, slides, piece, variable)
            impulse[part] = np.where(slides, 1 + e, (abs_x - velocity[part]) / beta)
            fitted = np.clip(self._piecewise.value(1, piece, variable), 0.0, 1.0)
            peak[part] = np.where(slides, 1.0, fitted)
            labels = self.pieces.label.take(piece)
            regime[part] = np.where(slides, Regime.SLIP_THROUGHOUT, labels)
            regime[part][abs_x == 0] = Regime.STICK
        return Rebound.of(x, velocity, impulse, peak, regime.astype(np.uint8))

    @checks.default_errors
    def velocity(self, incidence: ArrayLike) -> Array:
        """Velocity at separation alone, in less time than a call takes.

        Parameters
        ----------
        incidence : array_like
            As for a call, with the same refusals.

        Returns
        -------
        ndarray of float64 or float
            w(tf) = v1(tf)/(mu v2(0)).

        Examples
        --------
        >>> float(compile("rigid", incidence_max=9, tolerance=1e-9).velocity(-8.0))
        -1.0
        """
        x = incidence
        # A subclass of ndarray may have a mask, so only an ndarray itself needs no check here.
        if type(x) is not np.ndarray or x.dtype != np.float64:
            x = checks.incidence(x)
        velocity, flat = np.empty(x.size), x.reshape(-1)
        for part, abs_x, slides, piece, variable in self._parts(x):
            forward = self._velocity(abs_x, slides, piece, variable)
            np.multiply(forward, np.copysign(1.0, flat[part]), out=velocity[part])
        return velocity.reshape(x.shape)[()]

    def _parts(self, x: Array) -> Iterator[tuple[slice, Array, Booleans, Integers, Array]]:
        """Parts of the impacts: slice, |x|, whether it slides throughout, piece, its variable."""
        limit, flat = min(self.incidence_max, checks.LARGEST), x.reshape(-1)
        for start in range(0, flat.size, CHUNK):
            part = slice(start, start + CHUNK)
            abs_x = np.abs(flat[part])
            if not (abs_x <= limit).all():
                checks.incidence(x)
                allowed = f"finite numbers from {-limit:g} to {limit:g}"
                checks.checked("incidence", x, allowed, -limit, limit)
            slides = abs_x >= self.slides_from
            piece, variable = self._piecewise.find(np.minimum(abs_x, self.pieces.end))
            yield part, abs_x, slides, piece, variable

    def _velocity(self, abs_x: Array, slides: Booleans, piece: Integers, variable: Array) -> Array:
        """Velocity at separation for |x|."""
        velocity = self._piecewise.value(0, piece, variable)
        if not self.gains:  # then rounding and the fit must not create energy either
            np.clip(velocity, -abs_x, abs_x, out=velocity)
        if slides.any():
            e, beta = self.parameters["restitution"], self.parameters["mass_ratio"]
            np.copyto(velocity, sliding.velocity(abs_x, beta, e), where=slides)
        return velocity

    def save(self, path: str | Path) -> None:
        """Write the response to a file, whole or not at all.

        The file is JSON: `format` and `version`; `content` with model, parameters, incidence_max,
        tolerance, error_bound, slides_from and pieces (start, kink, centre, label, end and
        coefficients by function, power and piece, of the variable sqrt(x - kink) - centre); and
        the SHA-256 of the content as `json.dumps(content, sort_keys=True)` writes it. Infinity
        is null.

        Parameters
        ----------
        path : str or Path

        Raises
        ------
        InputError
            If no such file can be written.
        """
        values = (
            self.model,
            dict(self.parameters),
            files.or_null(self.incidence_max),
            self.tolerance,
            self.error_bound._asdict(),
            files.or_null(self.slides_from),
            {key: np.asarray(value).tolist() for key, value in self.pieces._asdict().items()},
        )
        content = dict(zip(CONTENT, values, strict=True))
        header = json.dumps({"format": FORMAT, "version": VERSION, "sha256": _digest(content)})
        text = f'{header[:-1]}, "content": {json.dumps(content)}}}\n'
        with files.written(path) as partial:
            partial.write_text(text, encoding="utf-8")


_TOKEN = object()


def _new_response(*fields: Any) -> Response:
    """A response of fields that belong together: from `compile`, a checked file or a response."""
    return Response(*(*fields, _TOKEN))


@checks.default_errors
def compile(
    model: str,
    *,
    incidence_max: float = INCIDENCE_MAX,
    tolerance: float | None = None,
    progress: Callable[[int, float], None] | None = None,
    **parameters: float,
) -> Response:
    """Compile the response of one pair of bodies by any model of `planarimpact.models`.

    Parameters
    ----------
    model : str
        Name of a model, `planarimpact.models.MODELS`. Below e = 1 it says what takes the energy.
    incidence_max : float
        Largest |x| = |v1(0)|/(mu v2(0)) that it must answer, from 1e-9 on. If the model slides
        throughout from a smaller incidence on, the response answers every larger one.
    tolerance : float, optional
        Allowed error of velocity (mu v2(0)) and peak friction (mu F2max), as `error_bound` measures
        it; 1e-11 to 1, and at least 4e-15 of the largest incidence that does not slide throughout
        by formula. By default that of `TOLERANCES` for the model's
        class of cost, 1e-3 for other classes.
    progress : callable, optional
        Called after every batch of impacts that the model solves, with the number of impacts solved
        so far and the share of incidences that are fitted. The share may fall again, where a kink
        is found.
    **parameters
        mass_ratio, stiffness_ratio and restitution (defaults 3.5, 1.21, 1), numbers; and the
        model's settings. A tolerance of the model has no effect: it follows from `tolerance`.

    Returns
    -------
    Response

    Raises
    ------
    InputError
        If an argument is not admissible, or the model has no such setting.
    ConvergenceError
        If the model jumps, gives numbers that are not finite, is too rough for the tolerance (a
        model in time steps has a kink for each step), or does not reach it itself.

    Notes
    -----
    With the default tolerance a continuum with loss takes 0.7 to 9 s of processor time for a solid
    sphere with zeta^2 = 1.21 and e from 0.4 to 0.9, and up to 27 s with m2/m1 = 8 and zeta^2 = 0.5.

    Examples
    --------
    >>> response = compile("lumped.hysteretic", tolerance=1e-10, restitution=0.5)
    >>> max(response.error_bound) <= 1e-10
    True
    >>> response.incidence_max  # slides throughout from 3.5 on
    inf
    """
    if tolerance is None:
        tolerance = TOLERANCES.get(models.get(model).cost, COARSE)
    chosen, groups, settings, tolerance, slides_from, end, answered_to = _checked_question(
        model, incidence_max, tolerance, parameters
    )
    solved = 0

    def rebound(x: Array) -> Rebound:
        nonlocal solved
        try:
            result = chosen.rebound(x, *groups.values(), **settings)
        except checks.Unsolved as problem:
            reached = _reached(chosen, x[problem.impacts], groups, settings, tolerance)
            # Nobody asked for the model's own tolerance.
            words = reached or f"is not compiled: {OWN_TOLERANCE.sub('', str(problem))}"
            raise checks.ConvergenceError(f"tolerance = {tolerance:g}: {model} {words}") from None
        solved += x.size
        return result

    # A few impacts first: where the model does not reach the tolerance, they often say so soon.
    # A law of impulses has no peak friction.
    no_peak = np.isnan(rebound(end * np.arange(1, 8) / 8).peak_friction[3])

    def function(x: Array) -> tuple[Array, Integers]:
        result = rebound(x)
        peak = np.zeros(x.size) if no_peak else result.peak_friction
        values = np.stack([result.velocity, peak])
        known = np.isfinite(values).all(axis=0)
        if not known.all():
            raise checks.ConvergenceError(
                f"{model} is not compiled: at incidence {x[~known].min():g} its velocity or peak "
                "friction is no finite number"
            )
        return values, result.regime

    def watch(share: float) -> None:
        if progress:
            progress(solved, share)

    for share in FIT_SHARES:
        # A change of regime is a kink: it is located to a hundredth of the tolerance.
        try:
            pieces, error = piecewise.fit(
                function,
                [0.0, end],
                tolerance * share,
                max(tolerance / 100 / max(end, 1.0), 1e-13),
                watch,
            )
        except piecewise.NotFitted as problem:
            raise checks.ConvergenceError(
                f"tolerance = {tolerance:g}: {model} is not compiled: {problem}"
            ) from None
        bound = Bound(*(error + settings.get("tolerance", 0.0)).tolist())
        if max(bound) <= tolerance:
            break
    else:
        raise checks.ConvergenceError(
            f"tolerance = {tolerance:g}: {model} was fitted to {max(bound):.1e} only"
        )
    if no_peak:
        unknown = np.full_like(pieces.coefficients[1], np.nan)
        pieces = pieces._replace(coefficients=np.stack([pieces.coefficients[0], unknown]))
    parameters = groups | settings
    return _new_response(
        chosen.name, parameters, answered_to, tolerance, bound, slides_from, pieces
    )


def _reached(
    model: models.Model,
    x: Array,
    groups: Mapping[str, float],
    settings: Mapping[str, float],
    tolerance: float,
) -> str:
    """Message: which larger tolerance a model reaches at these incidences; "" if none."""
    while (tolerance := 10 * tolerance) <= 1:
        share = tolerance * MODEL_SHARE
        try:
            model.rebound(x, *groups.values(), **dict(settings) | {"tolerance": share})
        except checks.Unsolved:
            continue
        default = TOLERANCES.get(model.cost, COARSE)
        return (
            f"does not reach it at incidence = {x[0]:g}; there {tolerance:g} is reached, "
            f"and the default is {default:g}"
        )
    return ""


@checks.default_errors
def load(path: str | Path) -> Response:
    """Read a response that `Response.save` wrote.

    The whole content of the file is checked. What follows from the arguments of `compile` must be
    as `compile` has it, and the pieces must agree with the model within the error bound, at the
    points where the search of `compile` begins. A model with a tolerance setting is solved once for
    each piece, with a coarse tolerance; then the jumps between the pieces must also be within the
    error bound.

    Parameters
    ----------
    path : str or Path

    Returns
    -------
    Response

    Raises
    ------
    InputError
        If the file is not of this format and version, is damaged, or its content is wrong.
    OSError
        If it cannot be read.

    Examples
    --------
    >>> import tempfile, pathlib
    >>> path = pathlib.Path(tempfile.mkdtemp()) / "ball.json"
    >>> compile("rigid", incidence_max=9, tolerance=1e-9).save(path)
    >>> load(path).velocity([2.0, 8.0]).tolist()
    [0.0, 1.0]
    """
    content = _content(path)
    try:
        # A response that overflows disagrees with every model, and is refused.
        with np.errstate(over="ignore", invalid="ignore"):
            response = _restored(content)
            _refuse_disagreement(response)
    except (checks.InputError, checks.ConvergenceError) as error:
        raise checks.InputError(f"{path}: {error}; compile it again") from None
    return response


def _content(path: str | Path) -> Any:
    """The content of a file of this format, if its digest is right."""
    try:
        text = Path(path).read_text(encoding="utf-8")
        file = json.loads(text, object_pairs_hook=_without_doubles)
        kind, version = file["format"], file["version"]
    except checks.InputError as error:
        raise checks.InputError(f"{path}: damaged: {error}") from None
    except (ValueError, TypeError, KeyError, RecursionError):
        raise checks.InputError(f"{path}: no {FORMAT} file, or a damaged one") from None
    if (kind, version) != (FORMAT, VERSION) or type(version) is not int:
        raise checks.InputError(
            f"{path}: format {kind!r}, version {version!r}: allowed is {FORMAT!r}, {VERSION}; "
            "compile it again"
        )
    content = file.get("content")
    if not content or file.get("sha256") != _digest(content):
        raise checks.InputError(f"{path}: damaged: its content is not what was written")
    return content


def _without_doubles(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    """An object of JSON; a key that comes twice is refused, where Python takes the last value."""
    unique: dict[str, Any] = {}
    for key, value in pairs:
        if key in unique:
            raise checks.InputError(f"{checks.brief(key)} is there twice, allowed is once")
        unique[key] = value
    return unique


def _digest(content: Any) -> str:
    """SHA-256 of the content, whatever the order of its keys."""
    return hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()


def _restored(content: Any) -> Response:
    """The response of a file's content, if it is what `compile` makes for its arguments."""
    content = checks.record("content", content, CONTENT)
    model, incidence_max = content["model"], content["incidence_max"]
    names = [*list(checks.RULES)[1:], *models.get(model).settings]
    parameters = checks.record("parameters", content["parameters"], names)
    pieces = piecewise.restored("pieces", content["pieces"], len(Bound._fields))
    largest = pieces.end if incidence_max is None else incidence_max
    question = _checked_question(model, largest, content["tolerance"], parameters)
    fields = {
        "incidence_max": (incidence_max, files.or_null(question.answered_to)),
        "slides_from": (content["slides_from"], files.or_null(question.slides_from)),
        "pieces.end": (pieces.end, question.end),
    }
    fields |= {f"parameters.{key}": (parameters[key], v) for key, v in question.settings.items()}
    for name, (value, expected) in fields.items():
        if value != expected:
            raise checks.InputError(
                f"{name} = {checks.brief(value)}: allowed is {expected!r}, which follows from the "
                "rest of the file"
            )
    low, high = question.settings.get("tolerance", 0.0), question.tolerance
    allowed = f"numbers from {low:g} to the tolerance, {high:g}"
    bound = checks.record("error_bound", content["error_bound"], Bound._fields)
    bound = {k: checks.number(f"error_bound.{k}", v, allowed, low, high) for k, v in bound.items()}
    return _new_response(
        question.model.name,
        question.groups | question.settings,
        question.answered_to,
        question.tolerance,
        Bound(**bound),
        question.slides_from,
        pieces,
    )


def _refuse_disagreement(response: Response) -> None:
    """Refuse a response that differs from its model by more than its error bound."""
    parameters = response.parameters
    tolerance = parameters.get("tolerance")
    if tolerance is None:
        problem = _disagreement(response, piecewise.MEASURED, parameters)
    else:
        # A small tolerance takes the model long. One point of each piece with a coarse tolerance
        # is enough if the pieces do not jump. The model's own tolerance decides in doubt.
        coarse, middle = {"tolerance": max(tolerance, COARSE)}, np.zeros(1)
        problem = _jump(response) or (
            _disagreement(response, middle, dict(parameters) | coarse)
            and _disagreement(response, middle, parameters)
        )
    if problem:
        raise checks.InputError(problem)


def _jump(response: Response) -> str:
    """Message: where a response jumps between two pieces by more than its error bound, or ""."""
    jumps = response._piecewise.jumps()
    for (name, bound), jump in zip(response.error_bound._asdict().items(), jumps, strict=True):
        if (jump > bound).any():
            i = int(np.argmax(jump > bound))
            return (
                f"pieces.start[{i + 1}] = {response.pieces.start[i + 1]:g}: {name} jumps by "
                f"{jump[i]:.1e} there, but error_bound is {bound:.1e}"
            )
    return ""


def _disagreement(response: Response, places: Array, parameters: Mapping[str, float]) -> str:
    """Message: where a response differs from its model at these places of every piece, or ""."""
    x, values = response._piecewise.sample(places)
    result = models.rebound(response.model, x, **parameters)
    margin = parameters.get("tolerance", 0.0) + ROUNDING * response.pieces.end
    for (name, bound), value in zip(response.error_bound._asdict().items(), values, strict=True):
        expected = getattr(result, name)
        # A law of impulses has a peak friction only in slip throughout, perhaps at the last point.
        both_unknown = np.isnan(value) & (np.isnan(expected) | (places == 1))
        agrees = (np.abs(value - expected) <= bound + margin) | both_unknown
        if not agrees.all():
            first_x, first, first_expected = (a[~agrees][0] for a in (x, value, expected))
            return (
                f"pieces, incidence {first_x:g}: {name} = {first:g}, but {response.model} has "
                f"{first_expected:g} and error_bound is {bound:.1e}"
            )
    label = response.pieces.label
    regime = result.regime[:, np.abs(places) < 1]  # that of an end may be the neighbour's
    wrong = (regime != label[:, None]).all(axis=1)
    if wrong.any():
        i = int(wrong.argmax())
        return f"pieces.label[{i}] = {label[i]}, but {response.model} has {regime[i, 0]} there"
    return ""


class _Question(NamedTuple):
    """The arguments of `compile`, checked, and what follows from them."""

    model: models.Model
    groups: dict[str, float]
    settings: dict[str, float]
    tolerance: float
    slides_from: float  # incidence from which the formula of slip throughout holds, or inf
    end: float  # largest incidence that is fitted
    answered_to: float  # largest incidence that is answered, or inf


def _checked_question(
    model: str, incidence_max: float, tolerance: float, parameters: Mapping[str, float]
) -> _Question:
    """Check the arguments of `compile`, and add what follows from them."""
    chosen = models.get(model)
    largest = checks.number(
        "incidence_max", incidence_max, "numbers from 1e-9 to 1e300", 1e-9, 1e300
    )
    tolerance = checks.number("tolerance", tolerance, "numbers from 1e-11 to 1", 1e-11, 1)
    groups, settings = _parameters(chosen, parameters)
    if "tolerance" in chosen.settings:
        settings["tolerance"] = tolerance * MODEL_SHARE
    # Without an impact the model only checks its arguments.
    chosen.rebound(np.zeros(0), *groups.values(), **settings)
    slides_from = np.inf
    end = min(largest, slides_from)
    if tolerance < ROUNDING * end:
        raise checks.InputError(
            f"tolerance = {tolerance:g}: allowed are numbers from {ROUNDING * end:.1e} for "
            f"incidences up to {end:g}, because of rounding"
        )
    answered_to = np.inf if slides_from <= largest else largest
    return _Question(chosen, groups, settings, tolerance, slides_from, end, answered_to)


def _parameters(
    model: models.Model, parameters: Mapping[str, float]
) -> tuple[dict[str, float], dict[str, float]]:
    """The three groups, and the settings of a model with their defaults; scalars."""
    groups = {"mass_ratio": 3.5, "stiffness_ratio": 1.21, "restitution": 1.0}
    settings = {key: value for key, value in parameters.items() if key not in groups}
    models.refuse_unknown(model, settings)
    groups |= {key: value for key, value in parameters.items() if key in groups}
    groups = {key: checks.single(key, checks.RULES[key](value)) for key, value in groups.items()}
    for key, value in settings.items():
        checks.number(key, value, "finite numbers")
        settings[key] = np.asarray(value).item()  # whole numbers stay whole
    return groups, dict(model.settings) | settings
