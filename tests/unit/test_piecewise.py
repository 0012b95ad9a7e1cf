"""Fits by polynomials between kinks: the error that they state, the kinks that they find."""

import re

import numpy as np
import pytest

from planarimpact import ConvergenceError
from planarimpact.response import piecewise

END, KINK, TOLERANCE = 5.0, 1.7320508, 1e-9


def bend(power):
    return lambda x: np.abs(x - KINK) ** power


FUNCTIONS = {
    "corner": bend(1.0),
    "root of the third power": bend(1.5),
    "jump of the second derivative": lambda x: np.maximum(x - KINK, 0.0) ** 2 + x,
    "root at 0": np.sqrt,
    "smooth": lambda x: np.sin(3 * x),
    "two kinks": lambda x: np.abs(np.abs(x - 2) - 0.3) ** 1.5,
}


def unlabelled(function):
    return lambda x: (function(x)[None], np.zeros(x.size, int))


def evaluate(pieces, x, function=0):
    found = piecewise.Piecewise(pieces)
    return found.value(function, *found.find(x))


def labels_at(pieces, x):
    return pieces.label[piecewise.Piecewise(pieces).find(x)[0]]


@pytest.fixture(scope="module")
def elsewhere():
    x = np.random.default_rng(11).uniform(0, END, 100_000)
    return np.concatenate([x, [0.0, END, KINK, np.nextafter(KINK, 0), np.nextafter(KINK, 9)]])


@pytest.mark.parametrize("kinks", [[0.0, END], [0.0, KINK, END]], ids=["unknown", "known"])
@pytest.mark.parametrize("name", FUNCTIONS)
def test_the_stated_bound_holds_at_many_other_points(name, kinks, elsewhere):
    function = FUNCTIONS[name]
    pieces, bound = piecewise.fit(unlabelled(function), kinks, TOLERANCE)
    error = np.abs(evaluate(pieces, elsewhere) - function(elsewhere)).max()
    assert bound.shape == (1,) and error <= bound[0] + 1e-13
    assert error <= TOLERANCE


@pytest.mark.parametrize("power", [0.5, 1.0, 1.5, 2.5])
def test_right_of_a_known_kink_half_powers_take_few_pieces(power, elsewhere):
    def function(x):
        return np.maximum(x - KINK, 0.0) ** power * (1 + x)

    pieces, bound = piecewise.fit(unlabelled(function), [0.0, KINK, END], TOLERANCE)
    error = np.abs(evaluate(pieces, elsewhere) - function(elsewhere)).max()
    assert error <= bound[0] + 1e-13 and error <= TOLERANCE
    assert pieces.start.size <= 2 * piecewise.FIRST


def test_the_bound_knows_of_points_that_no_part_was_accepted_by():
    """A bump at an independent point alone is not smoothed away."""
    place = 1 + (piecewise.MEASURED[5] + 1) / 2  # in sqrt(x), of the second of two parts

    def function(x):
        return np.where(np.abs(np.sqrt(x) - place) < 1e-9, 1.0, 0.0)

    _, bound = piecewise.fit(unlabelled(function), [0.0, 4.0], TOLERANCE)
    assert bound[0] >= 1.0


@pytest.mark.parametrize("width", [0.3, 1.0])
def test_the_bound_sees_a_kink_between_the_points(width):
    """The polynomials miss a tent as high as their tolerance allows, wherever it stands."""
    x = np.linspace(0, END, 20_001)
    for middle in np.random.default_rng(4).uniform(0.1, END - 0.1, 40):

        def tent(x, middle=middle):
            return 0.1 * np.maximum(1 - np.abs(x - middle) / width, 0)

        pieces, bound = piecewise.fit(unlabelled(tent), [0.0, END], 0.3)
        error = np.abs(evaluate(pieces, x) - tent(x)).max()
        assert error <= bound[0], middle


JUMPS = [1e-9, 0.3, KINK, np.nextafter(KINK, 9), 4.99, np.nextafter(END, 0)]


@pytest.mark.parametrize("place", JUMPS)
@pytest.mark.parametrize("known", [[], [KINK]])
def test_a_jump_is_refused_where_it_is(place, known):
    """However it lies to a known kink; at the kink itself the pieces may jump as the function does.

    Between two pieces the bound alone sees it.
    """

    def function(x):
        return np.sin(x) + 1e-3 * (x >= place)

    try:
        _, bound = piecewise.fit(unlabelled(function), [0.0, *known, END], TOLERANCE)
    except ConvergenceError as refused:
        words = re.fullmatch(r"it jumps by 1.0e-03 at x = (\S+); allowed .*", str(refused))
        assert abs(float(words[1]) - place) <= 1e-11 * place
    else:
        assert (bound[0] <= TOLERANCE) if place in known else (bound[0] >= 1e-3)


@pytest.mark.parametrize("resolution", [0.0, 1e-13, 1e-3])
def test_every_piece_has_a_width(resolution):
    """Kinks and changes of label one number beside each other, at random places and the ends."""
    random = np.random.default_rng(12)
    for _ in range(40):
        some = np.append(random.uniform(0, END, 3), [END, 1e-20, 1e-3])
        beside = np.concatenate([some, np.nextafter(some, 0), np.nextafter(some, 9), some + 1e-9])
        bends = random.choice(beside[beside < END], 2, replace=False)
        labels = np.sort(random.choice(beside[beside < END], 2, replace=False))

        power = random.choice([1, 1.5])

        def function(x, bends=bends, labels=labels, power=power):
            value = np.maximum(x[:, None] - bends, 0.0) ** power
            return value.sum(axis=1)[None], np.searchsorted(labels, x)

        known = random.choice(beside[beside < END], 6, replace=False)
        pieces, bound = piecewise.fit(function, [0.0, *known, END], 1e-4, resolution)
        ends = np.append(pieces.start, END)
        assert (np.diff(ends) >= 32 * np.spacing(ends[1:])).all()
        x = np.concatenate([ends, np.nextafter(ends, 0), np.nextafter(ends, 9)]).clip(0, END)
        error = np.abs(evaluate(pieces, x) - function(x)[0][0])
        assert error.max() <= bound[0] + 1e-13


def test_a_kink_that_is_known_saves_pieces():
    known, unknown = (
        piecewise.fit(unlabelled(bend(1.5)), kinks, TOLERANCE)[0].start.size
        for kinks in ([0.0, KINK, END], [0.0, END])
    )
    assert known <= unknown < 100


def test_every_function_has_its_own_bound(elsewhere):
    def pair(x):
        return np.stack([bend(1.5)(x), 2 * x]), np.zeros(x.size, int)

    pieces, bound = piecewise.fit(pair, [0.0, END], TOLERANCE)
    assert bound[1] < 1e-13 < bound[0]
    for i in range(2):
        error = np.abs(evaluate(pieces, elsewhere, i) - pair(elsewhere)[0][i])
        assert error.max() <= bound[i] + 1e-14


@pytest.mark.parametrize("resolution", [1e-13, 1e-6])
def test_a_change_of_label_is_located(resolution):
    """The function itself does not show it."""
    pieces, _ = piecewise.fit(
        lambda x: (x[None] ** 2, 2 + (x >= KINK)), [0.0, END], TOLERANCE, resolution
    )
    near = 2 * resolution * END
    x = np.array([0.0, 1.0, KINK - near, KINK + near, END])
    assert labels_at(pieces, x).tolist() == [2, 2, 2, 3, 3]


def test_a_label_is_located_to_rounding_at_best():
    """A finer resolution than neighbouring numbers have does not halve for ever."""
    calls = []

    def labelled(x):
        calls.append(x.size)
        assert len(calls) < 200
        return x[None], (x > KINK).astype(int)

    pieces, _ = piecewise.fit(labelled, [0.0, END], TOLERANCE, resolution=0.0)
    assert np.nextafter(KINK, END) in pieces.start


def test_several_labels_in_one_part_are_located():
    edges = np.array([2.01, 2.02, 2.05])

    def steps(x):
        return x[None], np.searchsorted(edges, x, side="right")

    pieces, _ = piecewise.fit(steps, [0.0, END], TOLERANCE)
    x = np.array([2.0, 2.011, 2.019, 2.021, 2.049, 2.051])
    assert labels_at(pieces, x).tolist() == [0, 1, 1, 2, 2, 3]


def test_noise_is_refused():
    rng = np.random.default_rng(3)
    rough = unlabelled(lambda x: x + 1e-6 * rng.standard_normal(x.size))
    with pytest.raises(ConvergenceError, match="too rough"):
        piecewise.fit(rough, [0.0, END], TOLERANCE)
    pieces, bound = piecewise.fit(rough, [0.0, END], 1e-3)
    assert bound[0] < 1e-3


def test_an_oscillation_too_fine_for_the_tolerance_is_refused():
    with pytest.raises(ConvergenceError, match="too rough"):
        piecewise.fit(unlabelled(lambda x: np.sin(1e5 * x)), [0.0, END], TOLERANCE)


def table_of(starts, end=END):
    """Pieces that only know where they start: their value is their number."""
    starts = np.asarray(starts, float)
    value = np.zeros((1, piecewise.DEGREE + 1, starts.size))
    value[0, 0] = np.arange(starts.size)
    number = np.arange(starts.size)
    return piecewise.Pieces(starts, starts, np.zeros(starts.size), value, number, end)


@pytest.mark.parametrize(
    "starts",
    [
        [0.0],
        [0.0, KINK],
        np.linspace(0, END, 500, endpoint=False),
        # Many within one cell of the finest table, and a few an ulp apart.
        [0.0, *(KINK + 1e-7 * np.arange(40)), 4.0],
        [0.0, KINK, np.nextafter(KINK, 9), np.nextafter(np.nextafter(KINK, 9), 9), 4.999],
        [0.0, 1e-300, 1e-12, 1e-9, 4.0, np.nextafter(END, 0)],
        np.arange(5.0) * (END / 4096),  # on the edges of cells
        np.arange(0, 32768, 1117) * (END / 32768),
    ],
    ids=["one", "two", "even", "crowd", "ulps", "ends", "edges", "fine edges"],
)
def test_the_piece_is_found_at_every_start_and_an_ulp_beside(starts):
    pieces = table_of(starts)
    found = piecewise.Piecewise(pieces)
    start = pieces.start
    x = np.concatenate([start, np.nextafter(start, 9), np.nextafter(start, 0), [0.0, END]])
    x = np.minimum(x, END)
    piece, root = found.find(x)
    expected = np.searchsorted(start, x, side="right") - 1
    np.testing.assert_array_equal(piece, expected)
    np.testing.assert_array_equal(root, np.sqrt(x - start[expected]))
    np.testing.assert_array_equal(found.value(0, piece, root), expected)


def test_the_span_may_be_of_any_size():
    for end in (1e-9, 1e9):
        x = np.linspace(0, end, 1001)
        pieces, bound = piecewise.fit(
            unlabelled(lambda x, end=end: np.cos(3 * x / end)), [0, end], 1e-9
        )
        assert np.abs(evaluate(pieces, x) - np.cos(3 * x / end)).max() <= bound[0] <= 2e-9


def test_a_label_of_a_known_kink_itself_is_not_searched_for():
    calls = []

    def function(x):
        calls.append(x.size)
        return np.sin(x)[None], (x > KINK).astype(int)  # KINK has the label of its left

    piecewise.fit(function, [0.0, KINK, END], 1e-3)
    assert len(calls) == 3  # one for the fit, and two that measure its error
