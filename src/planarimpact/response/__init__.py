"""Compiled responses: the rebound of one pair of bodies as a table of polynomials.

For given groups the rebound is a function of the incidence alone, smooth between a few kinks. A
response holds that function. It takes tens of nanoseconds an impact, whichever model it was made
from. If the model slides throughout from some incidence on, that formula is kept. Its error is
measured against the model, not against nature, and must be within a tolerance.
"""

import hashlib
import json
from collections.abc import Iterator, Mapping
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
# Errors below this share of the largest incidence that is fitted cannot be told from rounding.
ROUNDING = 2.0**-48
# A kink below this share of the span counts as 0.
NARROWEST = 1e-30
# Share of the tolerance for a model that has one of its own: it costs more than the fit.
MODEL_SHARE = 1 / 2
# Shares of the tolerance for the fit, at the first try and at the second.
FIT_SHARES = 1 / 4, 1 / 32
# A model with a tolerance is asked with this one first when a file is checked.
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
        What was asked for.
    error_bound : Bound
        What was measured: twice the largest difference from the model that a search found, plus
        the model's own tolerance if it has one. The search begins at 32 places of every
        piece, its ends among them, and looks closer beside the largest differences. Nothing is
        proved: a narrow kink may hide between the places, above all in a model in time steps.
        Rounding, up to 4e-15 of the largest incidence, comes on top. The bound does not hold for
        the regime, which changes within a hundredth of the tolerance from where the model's does.
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
    _maker: InitVar[object] = None
    _piecewise: piecewise.Piecewise = field(init=False)
    gains: bool = field(init=False)

    def __post_init__(self, _maker: object) -> None:
        if _maker is not _MAKER:  # it may be `dataclasses.replace`, which measures nothing
            raise checks.InputError(
                f"response of {checks.brief(self.model)}: allowed are those that `compile` or "
                "`load` makes, as they are measured against their model"
            )
        object.__setattr__(self, "parameters", MappingProxyType(dict(self.parameters)))
        table = piecewise.Piecewise(self.pieces)
        object.__setattr__(self, "_piecewise", table)
        x, (velocity, _) = table.sample(piecewise.MEASURED)
        most = x + self.error_bound.velocity + ROUNDING * self.pieces.end
        object.__setattr__(self, "gains", bool((np.abs(velocity) > most).any()))

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle and copy it by what it is made of; a read-only mapping has no pickle."""
        made_of = (self.model, dict(self.parameters), self.incidence_max, self.tolerance)
        return _made, (*made_of, self.error_bound, self.slides_from, self.pieces)

    def __repr__(self) -> str:
        groups = ", ".join(f"{name} = {value:g}" for name, value in self.parameters.items())
        return f"<Response of {self.model}: {groups}; error {max(self.error_bound):.1e}>"

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
        for part, size, slides, piece, root in self._parts(x):
            velocity[part] = self._velocity(size, slides, piece, root)
            impulse[part] = np.where(slides, 1 + e, (size - velocity[part]) / beta)
            fitted = np.clip(self._piecewise.value(1, piece, root), 0.0, 1.0)
            peak[part] = np.where(slides, 1.0, fitted)
            labels = self.pieces.label.take(piece)
            regime[part] = np.where(slides, Regime.SLIP_THROUGHOUT, labels)
            regime[part][size == 0] = Regime.STICK
        return Rebound.of(x, velocity, impulse, peak, regime.astype(np.uint8))

    @checks.default_errors
    def velocity(self, incidence: ArrayLike) -> Array:
        """Velocity at separation alone: the fastest way to it.

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
        for part, size, slides, piece, root in self._parts(x):
            found = self._velocity(size, slides, piece, root)
            np.multiply(found, np.copysign(1.0, flat[part]), out=velocity[part])
        return velocity.reshape(x.shape)[()]

    def _parts(self, x: Array) -> Iterator[tuple[slice, Array, Booleans, Integers, Array]]:
        """Parts of the impacts: slice, |x|, whether it slides, piece and its variable."""
        limit, flat = min(self.incidence_max, checks.LARGEST), x.reshape(-1)
        for start in range(0, flat.size, CHUNK):
            part = slice(start, start + CHUNK)
            size = np.abs(flat[part])
            if not (size <= limit).all():
                checks.incidence(x)
                allowed = f"finite numbers from {-limit:g} to {limit:g}"
                checks.checked("incidence", x, allowed, -limit, limit)
            slides = size >= self.slides_from
            piece, root = self._piecewise.find(np.minimum(size, self.pieces.end))
            yield part, size, slides, piece, root

    def _velocity(self, size: Array, slides: Booleans, piece: Integers, root: Array) -> Array:
        """Velocity at separation for |x|."""
        found = self._piecewise.value(0, piece, root)
        if not self.gains:  # then rounding and the fit must not create energy either
            np.clip(found, -size, size, out=found)
        if slides.any():
            e, beta = self.parameters["restitution"], self.parameters["mass_ratio"]
            np.copyto(found, sliding.velocity(size, beta, e), where=slides)
        return found

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
            If there can be no such file.
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
        text = json.dumps({"format": FORMAT, "version": VERSION, "sha256": _digest(content)})
        whole = f'{text[:-1]}, "content": {json.dumps(content)}}}\n'
        with files.written(path) as partial:
            partial.write_text(whole, encoding="utf-8")


_MAKER = object()


def _made(*made_of: Any) -> Response:
    """A response of fields that belong together: from `compile`, a checked file or a response."""
    return Response(*(*made_of, _MAKER))


@checks.default_errors
def compile(model: str, *, incidence_max: float, tolerance: float, **parameters: float) -> Response:
    """Compile the response of one pair of bodies by any model of `planarimpact.models`.

    Parameters
    ----------
    model : str
        Name of a model, `planarimpact.models.MODELS`.
    incidence_max : float
        Largest |x| = |v1(0)|/(mu v2(0)) that it must answer, from 1e-9 on. If the model slides
        throughout from a smaller incidence on, the response answers every larger one.
    tolerance : float
        Allowed error of velocity (mu v2(0)) and peak friction (mu F2max), as `error_bound` measures
        it; 1e-11 to 1, and at least 4e-15 of the largest incidence that does not slide throughout
        by formula.
    **parameters
        mass_ratio, stiffness_ratio and restitution (defaults 3.5, 1.21, 1), numbers; and the
        model's settings. A tolerance of the model is not among them: it is chosen here.

    Returns
    -------
    Response

    Raises
    ------
    InputError
        If an argument is not admissible, or the model has no such setting.
    ConvergenceError
        If the model jumps, is too rough for the tolerance (a model in time steps has a kink for
        each step), or does not reach it itself.

    Examples
    --------
    >>> response = compile("lumped", incidence_max=10, tolerance=1e-10, restitution=0.5)
    >>> max(response.error_bound) <= 1e-10
    True
    >>> response.incidence_max  # slides throughout from 3.5 on
    inf
    """
    chosen, groups, settings, tolerance, slides, end, reach = _asked(
        model, incidence_max, tolerance, parameters
    )
    silent = np.isnan(chosen.rebound(end / 2, *groups.values(), **settings).peak_friction)

    def function(x: Array) -> tuple[Array, Integers]:
        found = chosen.rebound(x, *groups.values(), **settings)
        peak = np.zeros(x.size) if silent else found.peak_friction
        return np.stack([found.velocity, peak]), found.regime

    kinks = [x for x in chosen.kinks(*groups.values(), **settings) if NARROWEST * end < x < end]
    for share in FIT_SHARES:
        # A change of regime bends the answer: it is located to a hundredth of the tolerance.
        try:
            pieces, error = piecewise.fit(
                function,
                [0.0, *kinks, end],
                tolerance * share,
                max(tolerance / 100 / max(end, 1.0), 1e-13),
            )
        except checks.ConvergenceError as why:
            raise checks.ConvergenceError(
                f"tolerance = {tolerance:g}: {model} is not compiled: {why}"
            ) from None
        bound = Bound(*(error + settings.get("tolerance", 0.0)).tolist())
        if max(bound) <= tolerance:
            break
    else:
        raise checks.ConvergenceError(
            f"tolerance = {tolerance:g}: {model} was fitted to {max(bound):.1e} only"
        )
    if silent:  # a law of impulses
        unknown = np.full_like(pieces.coefficients[1], np.nan)
        pieces = pieces._replace(coefficients=np.stack([pieces.coefficients[0], unknown]))
    return _made(chosen.name, groups | settings, reach, tolerance, bound, slides, pieces)


@checks.default_errors
def load(path: str | Path) -> Response:
    """Read a response that `Response.save` wrote.

    All that the file says is checked. It must follow from the question that was asked, and its
    pieces must agree with the model within the error bound, at the places of each where the search
    of `compile` begins. A model with a tolerance of its own gives one coarse answer for each piece.
    Then the pieces must also meet each other within the error bound.

    Parameters
    ----------
    path : str or Path

    Returns
    -------
    Response

    Raises
    ------
    InputError
        If the file is not of this format and version, is damaged, or says anything that is not so.
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
        # What overflows is no answer of any model.
        with np.errstate(over="ignore", invalid="ignore"):
            found = _restored(content)
            _refuse_strangers(found)
    except (checks.InputError, checks.ConvergenceError) as error:
        raise checks.InputError(f"{path}: {error}; compile it again") from None
    return found


def _content(path: str | Path) -> Any:
    """What a file holds, if it is of this format and nothing in it has changed."""
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
    """An object of JSON, of which Python would keep the last value of a key that comes twice."""
    found: dict[str, Any] = {}
    for key, value in pairs:
        if key in found:
            raise checks.InputError(f"{checks.brief(key)} is there twice, allowed is once")
        found[key] = value
    return found


def _digest(content: Any) -> str:
    return hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()


def _restored(content: Any) -> Response:
    """The response that a content describes, if `compile` would say the same of its question."""
    content = checks.record("content", content, CONTENT)
    model, reach = content["model"], content["incidence_max"]
    names = [*list(checks.RULES)[1:], *models.get(model).settings]
    parameters = checks.record("parameters", content["parameters"], names)
    pieces = piecewise.restored("pieces", content["pieces"], len(Bound._fields))
    largest = pieces.end if reach is None else reach
    asked = _asked(model, largest, content["tolerance"], parameters)
    follows = {
        "incidence_max": (reach, files.or_null(asked.reach)),
        "slides_from": (content["slides_from"], files.or_null(asked.slides)),
        "pieces.end": (pieces.end, asked.end),
    }
    follows |= {f"parameters.{key}": (parameters[key], v) for key, v in asked.settings.items()}
    for name, (given, expected) in follows.items():
        if given != expected:
            words = f"{name} = {checks.brief(given)}: allowed is {expected!r}"
            raise checks.InputError(f"{words}, as the rest of it has it")
    least, most = asked.settings.get("tolerance", 0.0), asked.tolerance
    allowed = f"numbers from {least:g} to the tolerance, {most:g}"
    bound = checks.record("error_bound", content["error_bound"], Bound._fields)
    bound = {
        k: checks.number(f"error_bound.{k}", v, allowed, least, most) for k, v in bound.items()
    }
    parameters = asked.groups | asked.settings
    return _made(
        asked.model.name, parameters, asked.reach, most, Bound(**bound), asked.slides, pieces
    )


def _refuse_strangers(found: Response) -> None:
    """Refuse a response that is farther from its model than its error bound."""
    own = found.parameters.get("tolerance")
    if own is None:
        words = _disagreement(found, piecewise.MEASURED, found.parameters)
    else:
        # A model with a tolerance takes long for a small one. A few coarse ones, and pieces that
        # meet each other, are enough. In doubt the model is asked with its own tolerance.
        coarse, middle = {"tolerance": max(own, COARSE)}, np.zeros(1)
        words = _jump(found) or (
            _disagreement(found, middle, dict(found.parameters) | coarse)
            and _disagreement(found, middle, found.parameters)
        )
    if words:
        raise checks.InputError(words)


def _jump(found: Response) -> str:
    """Where a response jumps from one piece to the next, in words."""
    jumps = found._piecewise.jumps()
    for (name, bound), jump in zip(found.error_bound._asdict().items(), jumps, strict=True):
        if (jump > bound).any():
            i = int(np.argmax(jump > bound))
            return (
                f"pieces.start[{i + 1}] = {found.pieces.start[i + 1]:g}: {name} jumps by "
                f"{jump[i]:.1e} there, but error_bound is {bound:.1e}"
            )
    return ""


def _disagreement(found: Response, at: Array, parameters: Mapping[str, float]) -> str:
    """Where a model answers otherwise than a response, at places `at` of every piece, in words."""
    x, values = found._piecewise.sample(at)
    answer = models.rebound(found.model, x, **parameters)
    spare = parameters.get("tolerance", 0.0) + ROUNDING * found.pieces.end
    for (name, bound), value in zip(found.error_bound._asdict().items(), values, strict=True):
        model = getattr(answer, name)
        # A law of impulses knows friction in sliding alone, which may begin at the very end.
        silent = np.isnan(value) & (np.isnan(model) | (at == 1))
        right = (np.abs(value - model) <= bound + spare) | silent
        if not right.all():
            at_x, one, other = (field[~right][0] for field in (x, value, model))
            return (
                f"pieces, incidence {at_x:g}: {name} = {one:g}, but {found.model} has {other:g} "
                f"and error_bound is {bound:.1e}"
            )
    label = found.pieces.label
    regime = answer.regime[:, np.abs(at) < 1]  # the end of a piece itself may have another one
    wrong = (regime != label[:, None]).all(axis=1)
    if wrong.any():
        i = int(wrong.argmax())
        return f"pieces.label[{i}] = {label[i]}, but {found.model} has {regime[i, 0]} there"
    return ""


class _Asked(NamedTuple):
    """What is asked of a response, checked, and what follows from it."""

    model: models.Model
    groups: dict[str, float]
    settings: dict[str, float]
    tolerance: float
    slides: float  # incidence from which the formula of slip throughout holds, or inf
    end: float  # of what is fitted
    reach: float  # largest incidence that is answered


def _asked(
    model: str, incidence_max: float, tolerance: float, parameters: Mapping[str, float]
) -> _Asked:
    chosen = models.get(model)
    largest = checks.number(
        "incidence_max", incidence_max, "numbers from 1e-9 to 1e300", 1e-9, 1e300
    )
    tolerance = checks.number("tolerance", tolerance, "numbers from 1e-11 to 1", 1e-11, 1)
    groups, settings = _parameters(chosen, parameters)
    if "tolerance" in chosen.settings:
        settings["tolerance"] = tolerance * MODEL_SHARE
    # A call without impacts costs nothing, and the model refuses arguments that it does not admit.
    chosen.rebound(np.zeros(0), *groups.values(), **settings)
    slides = np.inf
    if chosen.sliding_limit is not None:
        slides = float(chosen.sliding_limit(*groups.values(), **settings))
    end = min(largest, slides)
    if tolerance < ROUNDING * end:
        raise checks.InputError(
            f"tolerance = {tolerance:g}: allowed are numbers from {ROUNDING * end:.1e} for "
            f"incidences up to {end:g}, as rounding goes"
        )
    reach = np.inf if slides <= largest else largest
    return _Asked(chosen, groups, settings, tolerance, slides, end, reach)


def _parameters(
    model: models.Model, given: Mapping[str, float]
) -> tuple[dict[str, float], dict[str, float]]:
    """The three groups, and the settings of a model with their defaults; scalars."""
    groups = {"mass_ratio": 3.5, "stiffness_ratio": 1.21, "restitution": 1.0}
    settings = {key: value for key, value in given.items() if key not in groups}
    models.refuse_unknown(model, settings)
    groups |= {key: value for key, value in given.items() if key in groups}
    groups = {key: checks.single(key, checks.RULES[key](value)) for key, value in groups.items()}
    for key, value in settings.items():
        checks.number(key, value, "finite numbers")
        settings[key] = np.asarray(value).item()  # whole numbers stay whole
    return groups, dict(model.settings) | settings
