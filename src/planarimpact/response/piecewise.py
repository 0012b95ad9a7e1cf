"""Functions of one variable by polynomials between kinks, with an error that is measured.

Right of a kink the rebound of a compliant contact often bends like (x - kink)^(3/2), since a phase
of slip begins with zero length there. It is smooth in sqrt(x - kink). So each piece is a polynomial
in that variable, with the nearest kink on its left. Pieces around a kink that is not known in
advance must be halved again and again. In this way it is located, and both sides of it are fitted
again.

`root` is sqrt(x - kink), and `variable`, that of the polynomials, is root - centre of the piece.
"""

from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.polynomial import chebyshev

from planarimpact.ground import checks
from planarimpact.ground.arrays import Array, Booleans, Integers
from planarimpact.ground.checks import ConvergenceError, InputError

DEGREE = 7
# Each span begins with this many parts: few large batches cost less than many small ones.
FIRST = 2
# A span below this share of the whole begins with one part.
NARROW = 1e-3
# A kink is expected in a part that was halved more often than this.
DEEP = 7
# Narrowest part, relative to x: 256 neighbouring numbers. If a function changes by more than the
# tolerance even there, it has a jump.
NARROWEST = 2.0**-44
# How often kinks are located and their sides are fitted again, at most.
ROUNDS = 8
MOST_PIECES = 4096
# The bound is the largest measured error times this.
SAFETY = 2
# The error is measured again beside its `PEAKS` largest maxima, at distances `CLOSER` times less.
PEAKS, CLOSER = 3, 8
# Numbers of cells that are tried for the table that gives the piece of a point.
CELLS = 4096, 8192, 16384, 32768

# Values, shape (functions, n), and labels of points x, shape (n,).
Function: TypeAlias = Callable[[Array], tuple[Array, Integers]]
# Takes a number that says how far the work is.
Watch: TypeAlias = Callable[[float], None]

_NODES = np.cos(np.pi * (2 * np.arange(DEGREE + 1) + 1) / (2 * DEGREE + 2))
_BETWEEN = np.cos(np.pi * np.arange(DEGREE + 2) / (DEGREE + 1))
_BETWEEN[[0, -1]] = 1 - 1e-7, -1 + 1e-4  # inside the part: a kink itself may have another label
_POINTS = np.concatenate([_NODES, _BETWEEN])
# Where the error of a piece is measured first, from -1 at its left end to 1 at its right one. They
# are close at the ends, where a power 3/2 of the distance has its largest error.
MEASURED = np.sin(np.pi / 2 * np.linspace(-1, 1, 32))
_ASCENDING = np.argsort(_POINTS)
_FROM_VALUES = np.linalg.inv(chebyshev.chebvander(_NODES, DEGREE))
_ELSEWHERE = chebyshev.chebvander(_POINTS[DEGREE + 1 :], DEGREE)
_POWERS = np.stack(
    [
        np.pad(chebyshev.cheb2poly(one[: i + 1]), (0, DEGREE - i))
        for i, one in enumerate(np.eye(DEGREE + 1))
    ]
)


class NotFitted(ConvergenceError):
    """A function jumps, or is too rough for the tolerance. The message calls it "it"."""


class Pieces(NamedTuple):
    """Polynomials over pieces of [0, end], in the variable sqrt(x - kink) - centre.

    Attributes
    ----------
    start : ndarray, shape (pieces,)
        Left ends, ascending from 0.
    kink, centre : ndarray, shape (pieces,)
        The kink nearest on the left, or 0, and the middle of the piece in sqrt(x - kink).
    coefficients : ndarray, shape (functions, DEGREE + 1, pieces)
        Of ascending powers.
    label : ndarray of int, shape (pieces,)
        What the function calls the points of the piece.
    end : float
    """

    start: Array
    kink: Array
    centre: Array
    coefficients: Array
    label: Integers
    end: float


def restored(name: str, rows: Any, functions: int) -> Pieces:
    """Pieces that were read from a file: a dict of numbers and lists, by the fields of `Pieces`.

    Parameters
    ----------
    name : str
        Of the dict, for the message.
    rows : object
        As it was read.
    functions : int
        How many functions the pieces must have.

    Returns
    -------
    Pieces

    Raises
    ------
    InputError
        If the dict does not describe ascending pieces of [0, end]. Coefficients may be NaN.

    Examples
    --------
    >>> pieces, _ = fit(lambda x: (np.sqrt(x)[None], x.astype(int)), [0.0, 1.0, 2.0], 1e-12)
    >>> rows = {key: np.asarray(value).tolist() for key, value in pieces._asdict().items()}
    >>> bool((restored("pieces", rows, 1).coefficients == pieces.coefficients).all())
    True
    >>> restored("pieces", rows | {"end": 0.5}, 1)
    Traceback (most recent call last):
    ...
    planarimpact.InputError: pieces.start[2] = 1.0: allowed are numbers that ascend from 0 \
to less than end = 0.5
    """
    rows = checks.record(name, rows, Pieces._fields)
    end = checks.number(f"{name}.end", rows["end"], "finite numbers above 0", 0, open_low=True)
    if not isinstance(rows["start"], list) or not rows["start"]:
        raise InputError(
            f"{name}.start = {checks.brief(rows['start'])}: allowed is a list of numbers, at least "
            "one"
        )
    count = len(rows["start"])
    start, kink, centre, coefficients, label = (
        checks.listed(f"{name}.{field}", rows[field], shape)
        for field, shape in {
            "start": (count,),
            "kink": (count,),
            "centre": (count,),
            "coefficients": (functions, DEGREE + 1, count),
            "label": (count,),
        }.items()
    )
    in_order = (np.diff(start, prepend=-1.0) > 0) & (start < end)
    in_order[0] = start[0] == 0
    rules = {
        "start": (start, in_order, f"numbers that ascend from 0 to less than end = {end:g}"),
        "kink": (kink, (kink >= 0) & (kink <= start), "numbers from 0 to the start of the piece"),
        "centre": (centre, np.isfinite(centre), "finite numbers"),
        "coefficients": (coefficients, ~np.isinf(coefficients), "numbers that are not infinite"),
        "label": (label, np.isin(label, np.arange(256)), "integers from 0 to 255"),
    }
    for field, (values, passes, allowed) in rules.items():
        if not passes.all():
            index = tuple(int(i) for i in np.argwhere(~passes)[0])
            raise InputError(
                f"{name}.{field}{list(index)} = {float(values[index])!r}: allowed are {allowed}"
            )
    return Pieces(start, kink, centre, coefficients, label.astype(np.int64), end)


class _Parts(NamedTuple):
    """Parts of spans between kinks while they are fitted."""

    kink: Array
    low: Array  # left and right end, as root
    high: Array
    depth: Integers  # how often the part was halved
    coefficients: Array  # (parts, functions, DEGREE + 1), of Chebyshev polynomials
    labels: Integers  # (parts, points)

    def points(self, places: Array) -> Array:
        """Points x of every part, shape (parts, places), at places from -1 to 1."""
        middle, half = (self.low + self.high) / 2, (self.high - self.low) / 2
        return self.kink[:, None] + (middle[:, None] + half[:, None] * places) ** 2

    def take(self, chosen: Booleans | Integers) -> "_Parts":
        """The chosen parts."""
        return _Parts._make(field[chosen] for field in self)


def fit(
    function: Function,
    kinks: Sequence[float],
    tolerance: float,
    resolution: float = 1e-13,
    watch: Watch = lambda share: None,
) -> tuple[Pieces, Array]:
    """Fit functions on a span by polynomials between kinks.

    Parameters
    ----------
    function : callable
        Takes x, shape (n,), ascending or not; returns values, shape (functions, n), and labels of
        integer, shape (n,), which change at kinks.
    kinks : sequence of float
        Known ones, the ends of the span among them; the first is 0.
    tolerance : float
        Aim for the bound, which may be larger in the end.
    resolution : float
        Precision, relative to the span, to which a change of label is located, or to rounding
        where that is coarser.
    watch : callable
        Takes the share of the span that is fitted, after every batch of points. It falls where the
        sides of a kink are fitted again.

    Returns
    -------
    pieces : Pieces
        Each is at least 64 neighbouring numbers wide.
    bound : ndarray, shape (functions,)
        `SAFETY` times the largest error that `largest_errors` finds.

    Raises
    ------
    NotFitted
        If the function jumps, or is too rough for the tolerance.

    Examples
    --------
    >>> def bent(x):
    ...     return np.abs(x - 1 / 3)[None] ** 1.5, np.zeros(x.size, int)
    >>> pieces, bound = fit(bent, [0.0, 1.0], 1e-9)
    >>> bool(bound[0] <= 2e-9), len(pieces.start) < 40
    (True, True)
    """
    kinks, settled = _apart(kinks, 0.0), {}
    span = kinks[-1]
    for attempt in range(ROUNDS):
        spans = [ends for ends in pairwise(kinks) if ends not in settled]
        if not spans:
            break
        parts = _fitted_parts(function, spans, tolerance, lambda width: watch(1 - width / span))
        located = [*_label_changes(function, parts, resolution * span), *_deep_parts(parts)]
        for left, right in spans:
            inside = [left, *(x for x in located if left < x < right), right]
            new_kinks = _apart(inside, resolution * span)[1:-1]
            if attempt < ROUNDS - 1 and new_kinks:
                kinks += new_kinks
            else:
                settled[left, right] = parts.take(parts.kink == left)
        kinks.sort()
    parts = _Parts._make(map(np.concatenate, zip(*settled.values(), strict=True)))
    pieces = _pieces(_ordered(parts), span)
    return pieces, SAFETY * largest_errors(function, pieces)


def _apart(kinks: Sequence[float], least: float) -> list[float]:
    """Kinks in ascending order without those that are too near to another; the ends stay."""
    first, *others, last = sorted(map(float, kinks))
    kept = [first]
    for x in others:
        if x - kept[-1] > max(least, NARROWEST * x) and last - x > max(least, NARROWEST * last):
            kept.append(x)
    return [*kept, last]


def _fitted_parts(
    function: Function, spans: list[tuple[float, float]], tolerance: float, watch: Watch
) -> _Parts:
    """Parts of the spans, halved until their fits agree with the function between its nodes.

    `watch` takes the width of the parts that are not fitted yet.
    """
    left, right = np.array(spans).T
    shares = np.where(right - left > NARROW * right[-1], FIRST, 1)
    low = np.concatenate([np.arange(share) for share in shares])
    left, width = np.repeat([left, np.sqrt(right - left) / shares], shares, axis=1)
    low, count = low * width, left.size
    blank = np.zeros((count, 0, DEGREE + 1)), np.zeros((count, 0))
    pending = _Parts(left, low, low + width, np.zeros(count, int), *blank)
    fitted, tried = [], 0
    while pending.low.size:
        tried += pending.low.size
        if tried > MOST_PIECES:
            raise NotFitted(
                f"it is too rough: {MOST_PIECES} polynomials were tried; allowed are larger "
                "tolerances"
            )
        x = pending.points(_POINTS)
        values, labels = function(x.reshape(-1))
        values = values.reshape(len(values), *x.shape).swapaxes(0, 1)
        coefficients = values[..., : DEGREE + 1] @ _FROM_VALUES.T
        error = np.abs(coefficients @ _ELSEWHERE.T - values[..., DEGREE + 1 :])
        pending = pending._replace(
            coefficients=coefficients, labels=labels.reshape(x.shape)[:, _ASCENDING]
        )
        good = SAFETY * error.max(axis=(1, 2)) <= tolerance
        low, high = pending.kink + pending.low**2, pending.kink + pending.high**2
        narrow = ~good & (high - low <= NARROWEST * high)
        if narrow.any():
            i = int(narrow.argmax())
            jump = np.ptp(values[i], axis=1).max()
            raise NotFitted(
                f"it jumps by {jump:.1e} at x = {high[i]:.12g}; allowed are tolerances "
                f"{max(SAFETY * jump / tolerance, 1):.0f} times as large"
            )
        watch(float((high - low)[~good].sum()))
        fitted.append(pending.take(good))
        pending = _halved(pending.take(~good))
    return _Parts._make(map(np.concatenate, zip(*fitted, strict=True)))


def _halved(parts: _Parts) -> _Parts:
    """Both halves of every part."""
    middle, depth = (parts.low + parts.high) / 2, parts.depth + 1
    below = parts._replace(high=middle, depth=depth)
    above = parts._replace(low=middle, depth=depth)
    return _Parts._make(map(np.concatenate, zip(below, above, strict=True)))


def _label_changes(function: Function, parts: _Parts, resolution: float) -> list[float]:
    """Points where the label changes within a span, by bisection."""
    parts = _ordered(parts)
    x, label = parts.points(_POINTS[_ASCENDING]).ravel(), parts.labels.ravel()
    span = np.repeat(parts.kink, _POINTS.size)
    before = np.flatnonzero((label[1:] != label[:-1]) & (span[1:] == span[:-1]))
    low, high, label = x[before], x[before + 1], label[before]
    while True:
        middle = (low + high) / 2
        wide = (high - low > resolution) & (low < middle) & (middle < high)
        if not wide.any():
            return high.tolist()
        same = function(middle)[1] == label
        low, high = np.where(same, middle, low), np.where(same, high, middle)


def _deep_parts(parts: _Parts) -> list[float]:
    """Ends around parts that were halved too often; of neighbouring ones the deepest counts."""
    parts = _ordered(parts)
    deep = np.flatnonzero(parts.depth > DEEP)
    runs = np.split(deep, np.flatnonzero(np.diff(deep) > 1) + 1) if deep.size else []
    deepest = parts.take(np.array([run[np.argmax(parts.depth[run])] for run in runs], dtype=int))
    # Wider by the width of the part on both sides: the kink may lie at its end.
    width = deepest.high - deepest.low
    ends = np.stack([np.maximum(deepest.low - width, 0.0), deepest.high + width])
    return (deepest.kink + ends**2).ravel().tolist()


def _ordered(parts: _Parts) -> _Parts:
    """Parts from left to right."""
    return parts.take(np.argsort(parts.kink + parts.low**2))


def _pieces(parts: _Parts, end: float) -> Pieces:
    """Polynomials of the parts in powers of `variable`."""
    half = (parts.high - parts.low) / 2
    powers = (parts.coefficients @ _POWERS) / half[:, None, None] ** np.arange(DEGREE + 1)
    return Pieces(
        start=parts.kink + parts.low**2,
        kink=parts.kink,
        centre=(parts.low + parts.high) / 2,
        coefficients=np.ascontiguousarray(powers.transpose(1, 2, 0)),
        label=parts.labels[:, _POINTS.size // 2],
        end=end,
    )


def largest_errors(function: Function, pieces: Pieces) -> Array:
    """Largest errors of pieces: measured at `MEASURED` of each, then beside the largest of these.

    A kink between two of these points that is narrower than their distance may be missed.

    Parameters
    ----------
    function : callable
        As `fit` takes it.
    pieces : Pieces

    Returns
    -------
    ndarray, shape (functions,)

    Examples
    --------
    >>> def bent(x):
    ...     return np.abs(x - 0.6)[None], np.zeros(x.size, int)
    >>> pieces, _ = fit(lambda x: (x[None] - 0.6, np.zeros(x.size, int)), [0.0, 1.0], 1e-9)
    >>> largest_errors(bent, pieces).round(12).tolist()
    [1.2]
    """
    table = Piecewise(pieces)
    x, values = table.sample(MEASURED)
    x, error = x.ravel(), np.abs(values.reshape(len(values), -1) - function(x.ravel())[0])
    largest = error.max(axis=1)
    padded = np.pad(error, ((0, 0), (1, 1)))
    maxima = np.where((error >= padded[:, :-2]) & (error >= padded[:, 2:]), error, 0.0)
    largest_at = np.unique(np.argsort(maxima, axis=1)[:, -PEAKS:])
    # One batch: many models take as long for few points as for a hundred.
    share = np.arange(1, CLOSER)[:, None] / CLOSER
    neighbours = x[np.clip([largest_at - 1, largest_at + 1], 0, x.size - 1)][:, None]
    x = (x[largest_at] + share * (neighbours - x[largest_at])).ravel()
    piece, variable = table.find(x)
    fitted = np.stack([table.value(f, piece, variable) for f in range(len(error))])
    return np.maximum(largest, np.abs(fitted - function(x)[0]).max(axis=1))


class Piecewise:
    """Evaluates `Pieces`: the piece of a point, its variable there, and the functions.

    The arrays of the pieces are read-only from then on.

    Examples
    --------
    >>> pieces, _ = fit(lambda x: (np.sqrt(x)[None], x.astype(int)), [0.0, 1.0, 2.0], 1e-12)
    >>> table = Piecewise(pieces)
    >>> x = np.array([0.25, 1.44])
    >>> piece, variable = table.find(x)
    >>> table.value(0, piece, variable).round(12).tolist(), pieces.label[piece].tolist()
    ([0.5, 1.2], [0, 1])
    >>> x, values = table.sample(np.zeros(1))
    >>> float(x[0, 0]), round(float(values[0, 0, 0]), 12), round(float(table.jumps().max()), 12)
    (0.0625, 0.25, 0.0)
    """

    def __init__(self, pieces: Pieces) -> None:
        for array in pieces[:-1]:
            array.flags.writeable = False
        self.pieces = pieces
        self._following = np.append(pieces.start[1:], np.inf)
        tables = [self._starts(cells) for cells in CELLS]
        moves = [int(np.max(np.diff(table), initial=0)) for table in tables]
        self._moves = min(moves)
        self._table = tables[moves.index(self._moves)]
        self._scale = (self._table.size - 2) / pieces.end

    def _starts(self, cells: int) -> Integers:
        """Piece at the left of each cell, and after the last one: where the search begins."""
        left = np.arange(cells + 1) * (self.pieces.end / cells)
        # Slightly to the left: with rounding the search may begin too early, but never too late.
        first = np.searchsorted(self.pieces.start, left * (1 - 1e-14), side="right") - 1
        return np.append(np.maximum(first, 0), len(self.pieces.start) - 1)

    def find(self, x: Array) -> tuple[Integers, Array]:
        """Piece of each x in [0, end], and its variable there."""
        piece = self._table.take((x * self._scale).astype(np.intp), mode="clip")
        for _ in range(self._moves):
            piece += x >= self._following.take(piece, mode="clip")
        variable = x - self.pieces.kink.take(piece, mode="clip")
        np.sqrt(variable, out=variable)
        variable -= self.pieces.centre.take(piece, mode="clip")
        return piece, variable

    def value(self, function: int, piece: Integers, variable: Array) -> Array:
        """One function at points of these pieces, by Horner's rule."""
        rows = self.pieces.coefficients[function]
        value = rows[-1].take(piece, mode="clip")
        for row in rows[-2::-1]:
            value *= variable
            value += row.take(piece, mode="clip")
        return value

    def sample(self, places: Array) -> tuple[Array, Array]:
        """Points x (pieces, n) at places (n,) from -1 to 1, and values (functions, pieces, n)."""
        low, high = (ends[:, None] for ends in self._ends())
        root = (low + high) / 2 + (high - low) / 2 * places
        # The end of a piece is the last number in front of the next one.
        last = np.append(np.nextafter(self.pieces.start[1:], 0), self.pieces.end)
        x = self.pieces.kink[:, None] + root**2
        x = np.clip(x, self.pieces.start[:, None], last[:, None])
        piece = np.broadcast_to(np.arange(low.size)[:, None], root.shape)
        functions = range(len(self.pieces.coefficients))
        variable = root - self.pieces.centre[:, None]
        return x, np.stack([self.value(f, piece, variable) for f in functions])

    def jumps(self) -> Array:
        """How far the functions jump from piece to piece, shape (functions, pieces - 1)."""
        low, high = (ends - self.pieces.centre for ends in self._ends())
        left = np.arange(low.size - 1)
        functions = range(len(self.pieces.coefficients))
        return np.abs(
            [self.value(f, left + 1, low[1:]) - self.value(f, left, high[:-1]) for f in functions]
        )

    def _ends(self) -> tuple[Array, Array]:
        """Left and right end of every piece, as root."""
        following = np.append(self.pieces.start[1:], self.pieces.end)
        return np.sqrt(self.pieces.start - self.pieces.kink), np.sqrt(following - self.pieces.kink)
