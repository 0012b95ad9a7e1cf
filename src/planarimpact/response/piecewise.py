"""Functions of one variable by polynomials between kinks, with an error that is measured.

Right of a kink the rebound of a compliant contact often bends like (x - kink)^(3/2), since a phase
of slip grows from nothing there. It is smooth in sqrt(x - kink). So each piece is a polynomial in
that variable, with the nearest kink on its left. A kink that is not known in advance shows as
pieces that must be halved again and again. It is located, and the fit is made anew beside it.
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
# A part that was halved more often than this may contain a kink.
DEEP = 7
# Narrowest part, relative to x: 256 neighbouring numbers. A function that changes by more than the
# tolerance even there jumps.
NARROWEST = 2.0**-44
# Kinks are located and the fit made anew at most so many times.
ROUNDS = 8
MOST_PIECES = 4096
# The bound is the largest error found times this.
SAFETY = 2
# Beside so many of the largest maxima of the error it is measured at points so many times closer.
PEAKS, CLOSER = 3, 8
# Sizes that are tried for the table that finds the piece of a point.
CELLS = 4096, 8192, 16384, 32768

# Values, shape (functions, n), and labels of points x, shape (n,).
Function: TypeAlias = Callable[[Array], tuple[Array, Integers]]

_NODES = np.cos(np.pi * (2 * np.arange(DEGREE + 1) + 1) / (2 * DEGREE + 2))
_BETWEEN = np.cos(np.pi * np.arange(DEGREE + 2) / (DEGREE + 1))
_BETWEEN[[0, -1]] = 1 - 1e-7, -1 + 1e-4  # a hair inside: a kink itself may have another label
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
        What the dict is called, for the message.
    rows : object
        What was read.
    functions : int
        How many functions the pieces must have.

    Returns
    -------
    Pieces

    Raises
    ------
    InputError
        If these are no pieces, in their order, of [0, end]. Coefficients may be NaN.

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
        words = f"{name}.start = {checks.brief(rows['start'])}"
        raise InputError(f"{words}: allowed is a list of numbers, at least one")
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
    wrong = {
        "start": (start, in_order, f"numbers that ascend from 0 to less than end = {end:g}"),
        "kink": (kink, (kink >= 0) & (kink <= start), "numbers from 0 to the start of the piece"),
        "centre": (centre, np.isfinite(centre), "finite numbers"),
        "coefficients": (coefficients, ~np.isinf(coefficients), "numbers that are not infinite"),
        "label": (label, np.isin(label, np.arange(256)), "integers from 0 to 255"),
    }
    for field, (values, good, allowed) in wrong.items():
        if not good.all():
            index = tuple(int(i) for i in np.argwhere(~good)[0])
            raise InputError(
                f"{name}.{field}{list(index)} = {float(values[index])!r}: allowed are {allowed}"
            )
    return Pieces(start, kink, centre, coefficients, label.astype(np.int64), end)


class _Halves(NamedTuple):
    """Parts of spans between kinks while they are fitted: ends in the root variable, and a fit."""

    kink: Array
    low: Array
    high: Array
    depth: Integers
    coefficients: Array  # (parts, functions, DEGREE + 1), of Chebyshev polynomials
    labels: Integers  # (parts, points)

    def points(self, at: Array) -> Array:
        """Points x of every part, shape (parts, points), at places `at` in -1 to 1."""
        middle, half = (self.low + self.high) / 2, (self.high - self.low) / 2
        return self.kink[:, None] + (middle[:, None] + half[:, None] * at) ** 2

    def take(self, chosen: Booleans | Integers) -> "_Halves":
        return _Halves._make(field[chosen] for field in self)


def fit(
    function: Function, kinks: Sequence[float], tolerance: float, resolution: float = 1e-13
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
        Wanted of the bound, which may come out larger.
    resolution : float
        Precision, relative to the span, to which a change of label is located, or to rounding
        where that is coarser.

    Returns
    -------
    pieces : Pieces
        Each is at least 64 neighbouring numbers wide.
    bound : ndarray, shape (functions,)
        `SAFETY` times the largest error that `largest_errors` finds.

    Raises
    ------
    ConvergenceError
        If the function jumps, or is too rough for the tolerance. The message calls it "it".

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
        parts = _halve(function, spans, tolerance)
        found = [*_changes_of_label(function, parts, resolution * span), *_located(parts)]
        for left, right in spans:
            inside = [left, *(x for x in found if left < x < right), right]
            inside = _apart(inside, resolution * span)[1:-1]
            if attempt < ROUNDS - 1 and inside:
                kinks += inside
            else:
                settled[left, right] = parts.take(parts.kink == left)
        kinks.sort()
    parts = _Halves._make(map(np.concatenate, zip(*settled.values(), strict=True)))
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


def _halve(function: Function, spans: list[tuple[float, float]], tolerance: float) -> _Halves:
    """Parts of the spans, halved until their fits agree with the function between its nodes."""
    left, right = np.array(spans).T
    shares = np.where(right - left > NARROW * right[-1], FIRST, 1)
    low = np.concatenate([np.arange(share) for share in shares])
    left, width = np.repeat([left, np.sqrt(right - left) / shares], shares, axis=1)
    low, count = low * width, left.size
    blank = np.zeros((count, 0, DEGREE + 1)), np.zeros((count, 0))
    todo = _Halves(left, low, low + width, np.zeros(count, int), *blank)
    done, number = [], 0
    while todo.low.size:
        number += todo.low.size
        if number > MOST_PIECES:
            raise ConvergenceError(
                f"it is too rough: after trying {MOST_PIECES} polynomials they are not within "
                f"{tolerance:.1e}"
            )
        x = todo.points(_POINTS)
        values, labels = function(x.reshape(-1))
        values = values.reshape(len(values), *x.shape).swapaxes(0, 1)
        coefficients = values[..., : DEGREE + 1] @ _FROM_VALUES.T
        error = np.abs(coefficients @ _ELSEWHERE.T - values[..., DEGREE + 1 :])
        todo = todo._replace(
            coefficients=coefficients, labels=labels.reshape(x.shape)[:, _ASCENDING]
        )
        good = SAFETY * error.max(axis=(1, 2)) <= tolerance
        low, high = todo.kink + todo.low**2, todo.kink + todo.high**2
        narrow = ~good & (high - low <= NARROWEST * high)
        if narrow.any():
            i = int(narrow.argmax())
            raise ConvergenceError(
                f"it jumps by {np.ptp(values[i], axis=1).max():.1e} at x = {high[i]:.12g}, and "
                f"polynomials are wanted within {tolerance:.1e}"
            )
        done.append(todo.take(good))
        todo = _halved(todo.take(~good))
    return _Halves._make(map(np.concatenate, zip(*done, strict=True)))


def _halved(parts: _Halves) -> _Halves:
    middle, depth = (parts.low + parts.high) / 2, parts.depth + 1
    below = parts._replace(high=middle, depth=depth)
    above = parts._replace(low=middle, depth=depth)
    return _Halves._make(map(np.concatenate, zip(below, above, strict=True)))


def _changes_of_label(function: Function, parts: _Halves, resolution: float) -> list[float]:
    """Where labels change within spans, by bisection."""
    parts = _ordered(parts)
    x, label = parts.points(_POINTS[_ASCENDING]).ravel(), parts.labels.ravel()
    span = np.repeat(parts.kink, _POINTS.size)
    before = np.flatnonzero((label[1:] != label[:-1]) & (span[1:] == span[:-1]))
    low, high, label = x[before], x[before + 1], label[before]
    while True:
        middle = (low + high) / 2
        apart = (high - low > resolution) & (low < middle) & (middle < high)
        if not apart.any():
            return high.tolist()
        same = function(middle)[1] == label
        low, high = np.where(same, middle, low), np.where(same, high, middle)


def _located(parts: _Halves) -> list[float]:
    """Where parts had to be halved too often: around the deepest of such neighbours."""
    parts = _ordered(parts)
    deep = np.flatnonzero(parts.depth > DEEP)
    rows = np.split(deep, np.flatnonzero(np.diff(deep) > 1) + 1) if deep.size else []
    deepest = parts.take(np.array([row[np.argmax(parts.depth[row])] for row in rows], dtype=int))
    # With as much again on both sides: the kink may lie at an end of it.
    width = deepest.high - deepest.low
    ends = np.stack([np.maximum(deepest.low - width, 0.0), deepest.high + width])
    return (deepest.kink + ends**2).ravel().tolist()


def _ordered(parts: _Halves) -> _Halves:
    return parts.take(np.argsort(parts.kink + parts.low**2))


def _pieces(parts: _Halves, end: float) -> Pieces:
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
    """Largest errors of pieces, measured: at `MEASURED` of each, and closer beside the largest.

    A kink that hides between two places and is narrower than their distance may be missed.

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
    beside = np.pad(error, ((0, 0), (1, 1)))
    peak = np.where((error >= beside[:, :-2]) & (error >= beside[:, 2:]), error, 0.0)
    best = np.unique(np.argsort(peak, axis=1)[:, -PEAKS:])
    # One batch: many models take as long for few points as for a hundred.
    share = np.arange(1, CLOSER)[:, None] / CLOSER
    beside = x[np.clip([best - 1, best + 1], 0, x.size - 1)][:, None]
    x = (x[best] + share * (beside - x[best])).ravel()
    piece, root = table.find(x)
    fitted = np.stack([table.value(f, piece, root) for f in range(len(error))])
    return np.maximum(largest, np.abs(fitted - function(x)[0]).max(axis=1))


class Piecewise:
    """Evaluates `Pieces`: which piece, its variable, and one function there.

    The arrays of the pieces are read-only from then on.

    Examples
    --------
    >>> pieces, _ = fit(lambda x: (np.sqrt(x)[None], x.astype(int)), [0.0, 1.0, 2.0], 1e-12)
    >>> found = Piecewise(pieces)
    >>> x = np.array([0.25, 1.44])
    >>> piece, root = found.find(x)
    >>> found.value(0, piece, root).round(12).tolist(), pieces.label[piece].tolist()
    ([0.5, 1.2], [0, 1])
    >>> x, values = found.sample(np.zeros(1))
    >>> float(x[0, 0]), round(float(values[0, 0, 0]), 12), round(float(found.jumps().max()), 12)
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
        # A hair to the left: rounding must not skip a piece, only begin one too early.
        first = np.searchsorted(self.pieces.start, left * (1 - 1e-14), side="right") - 1
        return np.append(np.maximum(first, 0), len(self.pieces.start) - 1)

    def find(self, x: Array) -> tuple[Integers, Array]:
        """Piece of each x in [0, end], and its variable there."""
        piece = self._table.take((x * self._scale).astype(np.intp), mode="clip")
        for _ in range(self._moves):
            piece += x >= self._following.take(piece, mode="clip")
        root = x - self.pieces.kink.take(piece, mode="clip")
        np.sqrt(root, out=root)
        root -= self.pieces.centre.take(piece, mode="clip")
        return piece, root

    def value(self, function: int, piece: Integers, root: Array) -> Array:
        """One function there, by Horner's rule."""
        rows = self.pieces.coefficients[function]
        value = rows[-1].take(piece, mode="clip")
        for row in rows[-2::-1]:
            value *= root
            value += row.take(piece, mode="clip")
        return value

    def sample(self, at: Array) -> tuple[Array, Array]:
        """Points of every piece, and the functions there.

        Parameters
        ----------
        at : ndarray, shape (n,)
            Places in each piece, from -1 at its left end to 1 at its right one.

        Returns
        -------
        x : ndarray, shape (pieces, n)
        values : ndarray, shape (functions, pieces, n)
        """
        low, high = (ends[:, None] for ends in self._ends())
        root = (low + high) / 2 + (high - low) / 2 * at
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
        """Ends of every piece in sqrt(x - kink)."""
        following = np.append(self.pieces.start[1:], self.pieces.end)
        return np.sqrt(self.pieces.start - self.pieces.kink), np.sqrt(following - self.pieces.kink)
