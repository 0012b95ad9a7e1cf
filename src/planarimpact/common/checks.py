"""The exceptions that the package raises, and the checks of arguments before any computation."""

import math
import re
import reprlib
from collections.abc import Collection, Iterable, Iterator, Sequence
from decimal import ROUND_DOWN, Context
from functools import partial
from typing import Any

import numpy as np

from planarimpact.common.arrays import Array, ArrayLike, Booleans, Integers

# The rule of sizes. States (velocities, masses, lengths, moduli, forces, times) and the incidence
# are at most LARGEST; what must be above 0 is at least LEAST. What may be 0 may be tiny too, as in
# a simulation that comes to rest. Ratios of masses and of stiffnesses, and a restitution other than
# 0, lie between LEAST_RATIO and LARGEST_RATIO. Products of three such numbers are below 1e300.
LEAST, LARGEST = 1e-100, 1e100
LEAST_RATIO, LARGEST_RATIO = 1e-12, 1e12
# Least incidence of `collide` other than 0. The answer is in proportion to v1(0) long before, so
# that a larger friction coefficient changes nothing.
LEAST_INCIDENCE = LEAST
# Largest error of the length of a normal that is taken for one of rounding, float32 too: 1e-6, with
# room for the rounding of the length itself.
LENGTH_ERROR = 1.000001e-6
# Largest frequency of stick over that of the normal element: a contact has thousands of phases.
LARGEST_FREQUENCY = 1e4
# Largest count of samples, points or steps: tables still fit into memory, and so many steps take a
# few minutes.
MOST = 10_000_000

# Decorates all functions that users call. With NumPy's defaults no answer depends on what the
# caller has set by np.seterr or np.errstate, and an unexpected invalid operation still warns.
default_errors = np.errstate(divide="warn", over="warn", under="ignore", invalid="warn")

# What is said of a value with a unit.
UNIT = "has a unit: give plain numbers, in SI units"
# Texts of a loss that is not said, and of missing values.
NO_LOSS = "", "none", "None", "nan", "<NA>", "NaT"
_PLAIN = int, float, np.float64  # nothing is hidden in such a value
_NUMBERS = *_PLAIN, np.integer, np.floating

_DOWN = Context(prec=4, rounding=ROUND_DOWN)
_BRIEF = reprlib.Repr()
_BRIEF.maxlevel, _BRIEF.maxlist, _BRIEF.maxdict, _BRIEF.maxtuple = 1, 4, 4, 4
_BRIEF.maxstring = _BRIEF.maxother = 60


class InputError(ValueError):
    """An argument is not allowed. The message names it, its value and what is allowed."""

    __module__ = "planarimpact"  # where users find it, and what a traceback shows


class OutOfRange(InputError):
    """A quantity beyond the rule of sizes or a law: `messages` of its entries, by flat index."""

    __module__ = "planarimpact.bodies"

    def __init__(self, messages: dict[int, str]) -> None:
        super().__init__(next(iter(messages.values())))
        self.messages = messages

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle it by its arguments, so that another process can raise it again."""
        return type(self), (self.messages,)


class ConvergenceError(ArithmeticError):
    """A numerical method did not reach the tolerance. The message says which error it reached."""

    __module__ = "planarimpact"


def brief(value: object) -> str:
    """A value as a message shows it: in one line, shortened where it is long.

    Examples
    --------
    >>> brief([1.5, "x", 3, 4, 5])
    "[1.5, 'x', 3, 4, ...]"
    """
    return in_ascii(_BRIEF.repr(value).replace("\n", " "))


def in_ascii(text: str) -> str:
    """A text in one line, with the codes of all that is no letter or sign of ASCII."""
    return re.sub("[^ -~]", lambda found: ascii(found[0])[1:-1], text)


def checked(
    name: str,
    value: ArrayLike,
    allowed: str,
    low: float = -LARGEST,
    high: float = LARGEST,
    open_low: bool = False,
    infinite: bool = False,
    missing: bool = False,
) -> Array:
    """Return real numbers as float64 of the same shape, or refuse them and say what is allowed.

    The bounds are inclusive, `low` exclusive with `open_low`, and above 0 means from `LEAST` on.
    Infinity passes with `infinite` only, NaN with `missing` only. Booleans, strings, complex
    numbers, masked entries and what has a unit are refused; all else is what NumPy makes of it.

    Examples
    --------
    >>> float(checked("restitution", 1, "0 to 1", 0, 1))
    1.0
    >>> checked("restitution", [0.5, 1.5], "numbers from 0 to 1", 0, 1)
    Traceback (most recent call last):
    ...
    planarimpact.InputError: restitution[1] = 1.5: allowed are numbers from 0 to 1
    >>> checked("mass", 1e-200, "finite numbers above 0", 0, open_low=True)
    Traceback (most recent call last):
    ...
    planarimpact.InputError: mass = 1e-200: allowed are sizes from 1e-100 to 1e+100
    """
    if open_low and low == 0:
        low, open_low = LEAST, False
    if type(value) in _PLAIN and not open_low and high < math.inf:
        number: Any = value
        if low <= number <= high or (missing and number != number):
            return np.array(value, np.float64)  # in a tenth of the time of all that follows
    parts = () if type(value) in _PLAIN else [*_parts(value)]
    if any(map(has_unit, parts)):
        raise InputError(f"{name} = {brief(value)} {UNIT}")
    if any(map(_is_masked, parts)):
        raise InputError(
            f"{name} has masked entries: allowed are {allowed}; leave the masked entries out with "
            "compressed(), or replace them with filled(value)"
        )
    try:
        array = np.asarray(value)
        if array.dtype == object and set(map(type, array.flat)) <= {int, float}:
            array = array.astype(np.float64)  # NumPy has no integers as large as Python has
    except OverflowError:
        raise InputError(
            f"{name}: an integer is beyond the range of numbers, allowed are {allowed}"
        ) from None
    except ValueError:
        raise InputError(f"{name} = {brief(value)}: not a regular array of numbers") from None
    if array.dtype.kind not in "iuf" or any(map(_is_boolean, parts)):
        raise InputError(f"{name} = {brief(value)}: allowed are {allowed}, as real numbers")
    with np.errstate(invalid="ignore", over="ignore", under="ignore"):
        numbers = array.astype(np.float64)
        passes = (numbers > low if open_low else numbers >= low) & (numbers <= high)
    if infinite:  # what is infinite only as float64 was too large
        passes |= np.isinf(array) & (numbers > 0)
    if missing:
        passes |= np.isnan(numbers)
    if not passes.all():
        where, number = _first(numbers, ~passes)
        raise InputError(refusal(name + where, number, allowed, low, high))
    return numbers


def refusal(
    name: str, number: float, allowed: str, low: float, high: float, shown: str = ""
) -> str:
    """What a message says of a number outside its bounds: what is allowed, or the rule of sizes.

    `shown` is the number as its caller wrote it, if that is another text.
    """
    size = number if math.isfinite(number) else 0.0
    shown = shown or str(number)
    for least, most in ((LEAST, LARGEST), (LEAST_RATIO, LARGEST_RATIO)):
        if size > high == most or size < low == -most or 0 < size < low == least:
            return _beyond(name, shown, least, most)
    return f"{name} = {shown}: allowed are {allowed}"


def _beyond(name: str, shown: str, least: float, most: float) -> str:
    """The one sentence that refuses a size."""
    return f"{name} = {shown}: allowed are sizes from {least:g} to {most:g}"


def in_range(name: str, values: Array, least: float = LEAST, most: float = LARGEST) -> Array:
    """Return quantities unchanged, or refuse those that are no numbers or beyond the rule."""
    size = np.abs(values)
    wrong = np.flatnonzero(~((size >= least) & (size <= most)))
    if wrong.size:
        least = least or LEAST  # what may be 0 may be tiny too
        numbers = np.ravel(values)[wrong].tolist()
        said = (_beyond(name, f"{number:g}", least, most) for number in numbers)
        raise OutOfRange(dict(zip(wrong.tolist(), said, strict=True)))
    return values


def _first(numbers: Array, wrong: Booleans) -> tuple[str, float]:
    """The place of the first wrong number, as a message shows it, and the number."""
    index = tuple(int(i) for i in np.argwhere(wrong)[0])
    where = f"[{', '.join(map(str, index))}]" if index else ""
    return where, float(numbers[index])


def _parts(value: Any) -> Iterator[Any]:
    """What NumPy would convert in silence: a value, or all within lists that is no plain number."""
    if isinstance(value, Sequence) and not isinstance(value, (str, bytes)):
        types = set(map(type, value))  # the only pass over all entries of a long list of numbers
        suspect = {kind for kind in types if not _is_plain(kind)}
        for entry in value if suspect else ():
            if type(entry) in suspect:
                yield from _parts(entry)
    else:
        yield value


def _is_plain(kind: type) -> bool:
    """Whether it is a type of numbers of Python or NumPy; a type made of one may have a unit."""
    own = kind.__module__ in ("builtins", "numpy")
    return own and issubclass(kind, _NUMBERS) and kind is not bool


def has_unit(value: Any) -> bool:
    """Whether a library of units made it: NumPy's conversion would drop the unit."""
    if hasattr(value, "iloc"):  # labels of pandas are attributes, too
        value = getattr(value, "array", None)
    return hasattr(value, "units") or hasattr(value, "unit")


def _is_masked(value: Any) -> bool:
    """Whether an entry is masked: NumPy's conversion ignores the mask."""
    # Plain arrays do without numpy.ma, which takes longer to import than this package.
    is_special = isinstance(value, np.ndarray) and type(value) is not np.ndarray
    return is_special and bool(np.ma.is_masked(value))


def _is_boolean(value: Any) -> bool:
    """Whether it is one, or an array of them: NumPy's conversion makes numbers of them."""
    return isinstance(value, bool) or getattr(getattr(value, "dtype", None), "kind", "") == "b"


def limit(most: float) -> str:
    """A largest number with four digits, rounded down: whoever types it keeps within the limit.

    Examples
    --------
    >>> limit(2 / 3), limit(123456.0)
    ('0.6666', '123400')
    """
    return f"{float(_DOWN.create_decimal_from_float(most)):g}"


finite = partial(checked, allowed="finite numbers")
not_negative = partial(checked, allowed="finite numbers from 0", low=0)
positive = partial(checked, allowed="finite numbers above 0", low=0, open_low=True)


def real(name: str, value: ArrayLike) -> Array:
    """Check that numbers are real, NaN and infinity too; those of an array of float64 are."""
    if type(value) is np.ndarray and value.dtype == np.float64:
        return value
    return checked(name, value, "real numbers", -math.inf, math.inf, missing=True)


def incidence(value: ArrayLike) -> Array:
    """Check an incidence x = v1(0)/(mu v2(0)), of any sign.

    A tiny one is not refused: velocities are in proportion to it. Below 1e-300 digits are lost.
    """
    return finite("incidence", value)


def mass_ratio(value: ArrayLike) -> Array:
    """Check beta = m2/m1 >= 1: a free rigid body has beta = 1 + (x2/k)^2."""
    rule = "finite numbers from 1 (a free body has 1 + (x2/k)^2)"
    return checked("mass_ratio", value, rule, 1, LARGEST_RATIO)


def stiffness_ratio(value: ArrayLike) -> Array:
    """Check zeta^2 > 0; its limit 0, no tangential compliance, is `planarimpact.rigid`."""
    rule = "finite numbers above 0 (for no tangential compliance use planarimpact.rigid)"
    return checked("stiffness_ratio", value, rule, LEAST_RATIO, LARGEST_RATIO)


def tangential_frequency(
    mass_ratio: Array, stiffness_ratio: Array, restitution: Array, of_loss: Array
) -> None:
    """Refuse a tangential element that is too stiff, by the stiffness ratio of its loss."""
    stiff = mass_ratio > LARGEST_FREQUENCY**2 * of_loss
    if stiff.any():
        beta, zeta2, e = (
            float(group[stiff][0]) for group in (mass_ratio, stiffness_ratio, restitution)
        )
        raise InputError(
            f"stiffness_ratio = {zeta2}: at mass_ratio = {beta:g}, restitution = {e:g} allowed are "
            f"tangential frequencies omega/Omega up to {LARGEST_FREQUENCY:g} (for no tangential "
            "compliance use rigid)"
        )


def restitution(value: ArrayLike, missing: bool = False) -> Array:
    """Check the energetic coefficient of restitution, 0 <= e <= 1; NaN passes with `missing`."""
    numbers = checked("restitution", value, "numbers from 0 to 1", 0, 1, missing=missing)
    if not numbers.ndim and numbers >= LEAST_RATIO:
        return numbers
    tiny = (numbers > 0) & (numbers < LEAST_RATIO)
    if tiny.any():
        in_range("restitution", np.where(tiny, numbers, 1.0), LEAST_RATIO, 1)
    return numbers


def word(name: str, value: str, allowed: Collection[str]) -> str:
    """Check a word: one of those that are allowed."""
    if isinstance(value, str) and value in allowed:
        return value
    raise InputError(f"{name} = {brief(value)}: allowed are {', '.join(allowed)}")


# The name of a loss: the law by which a contact loses normal energy where e < 1.
loss = partial(word, "loss")


def losses(value: Any, allowed: Collection[str]) -> Integers:
    """Check names of losses, one or an array: the place of each in `allowed`, -1 where it has none.

    None is said by an empty text, None, NaN or what pandas has where a value is missing.

    Examples
    --------
    >>> losses(["plastic", None, "viscous"], ("viscous", "plastic")).tolist()
    [1, -1, 0]
    """
    if value is None or (type(value) is str and value in allowed):
        return np.array([*allowed].index(value) if value else -1, np.int8)  # in little time
    if any(map(_is_masked, _parts(value))):
        loss(value, allowed)
    words = value
    if not (isinstance(value, np.ndarray) and value.dtype.kind == "U"):  # which needs no time
        cells = np.asarray(value, dtype=object)
        words = np.array([str(cell) for cell in cells.flat], dtype=str).reshape(cells.shape)
    codes = np.where(np.isin(words, NO_LOSS), np.int8(-1), np.int8(-2))
    for code, name in enumerate(allowed):
        codes[words == name] = code
    if (codes < -1).any():
        loss(words[codes < -1].tolist()[0], allowed)
    return codes


def require_loss(value: ArrayLike, choices: Iterable[str], needed: str = "a loss") -> None:
    """Refuse a restitution below 1 without a loss; `choices` are losses, or models with a loss."""
    numbers = restitution(value)
    if (numbers == 1).all():
        return
    names = [f"{one} (the paper's)" if one.endswith("hysteretic") else one for one in choices]
    where, lossy = _first(numbers, numbers < 1)
    said = f"restitution{where} = {lossy}: below 1 it needs {needed}"
    raise InputError(f"{said}: choose {', '.join(names)}")


# The groups, in the order of every model's arguments, and their checks.
RULES = {
    "incidence": incidence,
    "mass_ratio": mass_ratio,
    "stiffness_ratio": stiffness_ratio,
    "restitution": restitution,
}


def impact(*values: ArrayLike, **others: Any) -> tuple[Array, ...]:
    """Check and broadcast incidence, mass_ratio, stiffness_ratio and restitution, in this order.

    Others are checked arrays that broadcast with them.

    Examples
    --------
    >>> [group.tolist() for group in impact([0.5, 2.0], 3.5, 1.21, 1)]
    [[0.5, 2.0], [3.5, 3.5], [1.21, 1.21], [1.0, 1.0]]
    """
    named = zip(RULES, values, strict=True)
    return broadcast(**{name: RULES[name](value) for name, value in named}, **others)


def number(
    name: str,
    value: ArrayLike,
    allowed: str,
    low: float = -LARGEST,
    high: float = LARGEST,
    open_low: bool = False,
) -> float:
    """Check one number as `checked` does arrays."""
    array = checked(name, value, allowed, low, high, open_low)
    if array.ndim:
        raise InputError(f"{name}, shape {array.shape}: allowed is one number")
    return float(array)


def count(name: str, value: int, least: int, most: int = MOST) -> int:
    """Check a number of steps or samples: an integer from `least` to `most`."""
    integer = isinstance(value, (int, np.integer)) and not isinstance(value, bool)
    if not integer or not least <= value <= most:
        raise InputError(f"{name} = {brief(value)}: allowed are integers from {least} to {most}")
    return int(value)


def broadcast(**arguments: Array) -> tuple[Array, ...]:
    """Broadcast checked arguments against each other, or refuse them and name their shapes."""
    if not any([value.shape for value in arguments.values()]):
        return tuple(arguments.values())  # in a tenth of the time
    try:
        return np.broadcast_arrays(*arguments.values())
    except ValueError:
        shapes = ", ".join(f"{name} {np.shape(value)}" for name, value in arguments.items())
        raise InputError(f"shapes do not broadcast: {shapes}") from None
