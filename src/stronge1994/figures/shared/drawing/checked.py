"""Check that a picture shows only numbers of its tables. Tests ask for it, no run does.

The points of one line must be rows of one table that follow each other; those of an area or a mesh
must be rows of one table. Their columns must be those that the labels of the axes name. An entry of
a legend must be true of all that is drawn in its style, and a number at a tick must be its place.

Not checked are texts that name no point, artists outside of data units (lines across the axes,
brackets), contours of a mesh, second axes above a panel, and artists or axes whose label is
`NO_DATA`. The check does not notice a curve that is missing or drawn in part.
"""

import itertools
import math
import re
from collections.abc import Iterable, Iterator, Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.collections import LineCollection, PathCollection, PolyCollection, QuadMesh
from matplotlib.colors import to_rgba
from matplotlib.contour import ContourSet
from matplotlib.figure import Figure
from matplotlib.legend import Legend
from matplotlib.lines import Line2D
from matplotlib.patches import Circle, FancyArrowPatch, Patch, Polygon, Rectangle
from matplotlib.spines import Spine
from matplotlib.text import Annotation, Text

from planarimpact.ground.arrays import Array, Booleans
from stronge1994.csv_tables import Curves
from stronge1994.figures.shared.drawing import house_style
from stronge1994.figures.shared.drawing.words import BARS, SHARED, Meanings

# Relative difference up to which two numbers are equal: Matplotlib rounds ends of bars and edges.
CLOSE = 1e-9
# Constants down to which areas are filled, and at which bars begin.
BASES = (0.0, 1.0)
HINT = (
    "Meanings of labels stand in AXIS_MEANS and LEGEND_MEANS of drawing.py, and in shared/drawing/"
    "words.py."
)
_NUMBER = re.compile(r"[-\N{MINUS SIGN}]?\d+(?:\.\d+)?")


class NotInTable(ValueError):
    """A picture shows something that its tables do not hold."""


class _Columns(NamedTuple):
    """Columns that labels allow: curve, names, rows of numbers, and places of equal rows."""

    curve: str
    names: tuple[str, ...]
    rows: Array
    places: dict[tuple[float, ...], list[int]]

    @property
    def is_of_bars(self) -> bool:
        return any(name.endswith(BARS) for name in self.names)

    def has_in_order(self, points: Array) -> bool:
        """Whether points are rows that follow each other, to the last digit, or in reverse."""
        return any(self._follow(ordered.tolist()) for ordered in (points, points[::-1]))

    def _follow(self, points: Iterable[Sequence[float]]) -> bool:
        reached, gap = {-1}, True  # after a gap any later row may follow
        for point in points:
            if any(map(math.isnan, point)):
                gap = True
                continue
            own, first = self.places.get(tuple(point), []), min(reached)
            reached = {at for at in own if (at > first if gap else at - 1 in reached)}
            gap = False
            if not reached:
                return False
        return True


class _Drawn(NamedTuple):
    """An artist, and the columns in which its points stand."""

    artist: Artist
    columns: Sequence[_Columns]


def check(figure: Figure, tables: Curves, name: str, meanings: Meanings = SHARED) -> None:
    """Refuse a figure that shows numbers of no table; `NotInTable` names panel and artist."""
    try:
        bars = [axes for axes in figure.axes if axes.get_label() == "<colorbar>"]
        colour = bars[0].get_ylabel() if bars else ""
        drawn: list[_Drawn] = []
        for axes in figure.axes:
            if axes not in bars and axes.get_label() != house_style.NO_DATA:
                drawn += _Panel(axes, tables, meanings, colour).look_up()
        for legend in figure.findobj(Legend):
            _check_legend(legend, drawn, meanings)
    except NotInTable as error:
        raise NotInTable(f"{name}: {error}") from None


class _Panel:
    """Axes, and the tables that their labels name."""

    def __init__(self, axes: Axes, tables: Curves, meanings: Meanings, colour: str) -> None:
        self.axes, self.meanings, self.colour = axes, meanings, colour
        titled = {n: table for n, table in tables.items() if _belongs(n, axes.get_title("left"))}
        titled |= {n: table for n, table in tables.items() if n == axes.get_title()}
        self.tables = titled or tables
        self.labels = [_label(axes, which) for which in "xy"]
        self.columns = list(self._columns(*self.labels))

    def __str__(self) -> str:
        return "panel '{1}' over '{0}'".format(*self.labels)

    def _columns(self, *labels: str) -> Iterator[_Columns]:
        """Columns that belong to labels; an axis of categories has no label and no column."""
        asked = [label for label in labels if label]
        for curve, table in self.tables.items():
            chosen: list[tuple[str, ...]] = [()]
            for label in asked:
                own = [column for column in table if self.meanings.is_axis(label, curve, column)]
                chosen = [(*before, column) for before in chosen for column in own]
            for names in filter(None, chosen):
                numbers = [np.asarray(table[column], float) for column in names]
                if len({len(column) for column in numbers}) == 1:
                    rows = np.column_stack(numbers)
                    places: dict[tuple[float, ...], list[int]] = {}
                    for place, row in enumerate(rows.tolist()):
                        places.setdefault(tuple(row), []).append(place)
                    yield _Columns(curve, names, rows, places)

    def look_up(self) -> list[_Drawn]:
        """All artists that show numbers, with their places in the tables."""
        drawn = []
        for artist in self.axes.get_children():
            if _is_guide(artist, self.axes):
                continue
            if isinstance(artist, QuadMesh):
                self._check_mesh(artist)
                continue
            parts = list(_points(artist))
            matches = [columns for part in parts for columns in self._find(artist, part)]
            if matches:
                self._check_text(artist, matches, parts[0][0])
                drawn.append(_Drawn(artist, matches))
        for axis in (self.axes.xaxis, self.axes.yaxis):
            if not any("[cell]" in name for columns in self.columns for name in columns.names):
                self._check_ticks(axis)
        return drawn

    def _find(self, artist: Artist, points: Array) -> list[_Columns]:
        """Columns in which the points of an artist stand."""
        labelled = [bool(label) for label in self.labels]
        with_gaps = points[:, labelled]
        points = points[~np.isnan(points).any(axis=1)]
        if not len(points):
            return []
        known = [columns for columns in self.columns if not columns.is_of_bars]
        if not self.labels[1]:  # categories, which the ticks may name
            category = _category(self.axes.yaxis, float(points[:, 1].mean()))
            known = [
                c
                for c in known
                if not category or self.meanings.is_curve(category, c.curve, c.names)
            ]
        points = points[:, labelled]
        if isinstance(artist, PolyCollection | Polygon):
            # Below and above it are lines of one or two curves, or one is a constant.
            inside = [(columns, _are_in(points, columns.rows)) for columns in known]
            based = np.isin(points[:, -1], BASES) & isinstance(artist, PolyCollection)
            pairs = itertools.combinations_with_replacement(inside, 2)
            matches = next(([a, b] for (a, m), (b, n) in pairs if (m | n | based).all()), [])
        elif isinstance(artist, Annotation):
            at = tuple(points[0].tolist())
            matches = [c for c in self.columns if at in c.places]
            matches = matches or [c for c in known if _on_line(points[0], c.rows)]
        elif isinstance(artist, Rectangle):
            ends = points[points[:, 0] != 0]
            matches = [columns for columns in known if _among(ends, columns.rows)]
        elif _is_error_bar(artist):
            parts: dict[str, list[Array]] = {}
            for columns in self.columns:
                parts.setdefault(columns.curve, []).append(columns.rows)
            own = [name for name, rows in parts.items() if _among(points, np.concatenate(rows))]
            matches = [columns for columns in known if columns.curve in own]
        else:
            matches = [columns for columns in known if columns.has_in_order(with_gaps)]
        if matches:
            return matches
        first = ", ".join(f"{number:g}" for number in points[0])
        asked = sorted({columns.curve for columns in known})
        raise NotInTable(
            f"{self}: {_description(artist)} does not show rows of a table. Its ({first}) and what "
            f"follows are in none of {', '.join(asked[:6]) or 'the columns that the labels name'}. "
            f"{HINT} Numbers of no column are made by `drawn_curves` in drawing.py; a guide "
            "has the label house_style.NO_DATA"
        )

    def _check_mesh(self, mesh: QuadMesh) -> None:
        edges = mesh.get_coordinates()
        x, y = _centres(edges[0, :, 0]), _centres(edges[:, 0, 1])
        values = np.ma.filled(mesh.get_array(), np.nan).reshape(len(y), len(x))
        for columns in self._columns(*self.labels, self.colour):
            own = [np.unique(column) for column in columns.rows.T[:2]]
            grid = np.full([len(centres) for centres in own], np.nan)
            places = [
                np.searchsorted(centres, c) for centres, c in zip(own, columns.rows.T, strict=False)
            ]
            grid[tuple(places)] = columns.rows[:, 2]
            at = [
                np.abs(centres[:, None] - c).argmin(axis=0)
                for centres, c in zip(own, (x, y), strict=True)
            ]
            same = [
                np.allclose(centres[i], c, CLOSE)
                for centres, i, c in zip(own, at, (x, y), strict=True)
            ]
            if all(same) and np.array_equal(grid[np.ix_(*at)].T, values, equal_nan=True):
                return
        raise NotInTable(f"{self}: a mesh in colours of '{self.colour}' is in no table")

    def _check_text(self, artist: Artist, matches: Sequence[_Columns], point: Array) -> None:
        """Refuse a label that names another curve, or a number that is not in its row."""
        text = artist.get_text() if isinstance(artist, Annotation) else str(artist.get_label())
        for container in self.axes.containers:
            if artist in container.get_children():
                text = str(container.get_label())
        if text in ("", "None") or text.startswith("_"):
            return
        if isinstance(artist, Annotation | FancyArrowPatch):
            numbers = _NUMBER.findall(re.sub(r"\$.*?\$|\(\d+\)", "", text))
            known = [number for one in matches for number in self._numbers(one, point)]
            if not all(any(_is_written(number, value) for value in known) for number in numbers):
                raise NotInTable(f"{self}: not every number of '{text}' is in its row")
            if not self.meanings.names_a_curve(text):
                return
        if not any(self.meanings.is_curve(text, one.curve, one.names) for one in matches):
            raise NotInTable(f"{self}: '{text}' is the label of {_named(matches)}. {HINT}")

    def _numbers(self, columns: _Columns, point: Array) -> Iterator[float]:
        """Numbers of the rows at a point, and those in the name of the curve."""
        yield from map(float, _NUMBER.findall(columns.curve))
        labelled = point[[bool(label) for label in self.labels]]
        for column in self.tables[columns.curve].values():
            if len(column) == len(columns.rows) and np.asarray(column).dtype.kind in "fi":
                yield from np.asarray(column)[_close(columns.rows, labelled)].tolist()

    def _check_ticks(self, axis: Axis) -> None:
        """Numbers that are written at ticks are those where they stand."""
        places = axis.get_majorticklocs()
        labels = axis.get_major_formatter().format_ticks(places)
        if axis.get_major_formatter().get_offset():  # a factor beside the axis
            return
        for at, written in zip(places, labels, strict=True):
            number = re.sub(r"[${}]|\\(mathdefault|degree)", "", written)
            number = number.replace("\N{MINUS SIGN}", "-")
            if _NUMBER.fullmatch(number) and not np.isclose(float(number), at):
                raise NotInTable(f"{self}: the tick at {at:g} is called {written}")


def _label(axes: Axes, which: str) -> str:
    """Label of an axis without the letter of its panel; also of one that it is shared with."""
    group = getattr(axes, f"get_shared_{which}_axes")().get_siblings(axes)
    labels = [getattr(one, f"get_{which}label")() for one in (axes, *group)]
    return re.sub(r"^\([a-z]\) | \d+(?= pairs)", "", next(filter(None, labels), ""))


def _belongs(name: str, title: str) -> bool:
    return bool(title) and name.startswith(title)


def _is_guide(artist: Artist, axes: Axes) -> bool:
    if (
        artist is axes.patch
        or artist.get_label() == house_style.NO_DATA
        or not artist.get_visible()
    ):
        return True
    if isinstance(artist, Annotation):
        return artist.xycoords != "data"
    if isinstance(artist, Axis | Spine | Legend | Text | ContourSet):
        return True
    if artist in axes.child_axes:
        return True
    transform = Artist.get_transform(artist)
    if isinstance(artist, PathCollection):
        transform = artist.get_offset_transform()
    in_data = all(transform.contains_branch_seperately(axes.transData))
    steps = isinstance(artist, Line2D) and artist.get_drawstyle() != "default"
    if in_data and (steps or transform != axes.transData):
        raise NotInTable(f"{_description(artist)} does not stand where its numbers say")
    return not in_data


def _points(artist: Artist) -> Iterator[Array]:
    """Points in data units, those of one table together."""
    if isinstance(artist, Line2D):
        yield np.ma.filled(artist.get_xydata(), np.nan)
    elif isinstance(artist, LineCollection):
        yield from map(np.asarray, artist.get_segments())
    elif isinstance(artist, PathCollection):
        yield np.ma.filled(artist.get_offsets(), np.nan)
    elif isinstance(artist, PolyCollection):
        for path in artist.get_paths():
            yield path.vertices
    elif isinstance(artist, Polygon):
        yield artist.get_xy()
    elif isinstance(artist, Rectangle):
        (x, y), wide, high = artist.get_xy(), artist.get_width(), artist.get_height()
        yield np.array([[x, y], [x + wide, y + high]])
    elif isinstance(artist, Circle):
        yield np.array([artist.center])
    elif isinstance(artist, FancyArrowPatch):
        yield from (np.array([end]) for end in artist._posA_posB)
    elif isinstance(artist, Annotation):
        yield np.array([artist.xy])
    else:
        raise NotInTable(f"{_description(artist)} is of a kind that cannot be looked up")


def _is_error_bar(artist: Artist) -> bool:
    """Whether an artist is error bars or their caps, whose ends Matplotlib computes."""
    caps = isinstance(artist, Line2D) and artist.get_marker() in ("|", "_")
    return caps or isinstance(artist, LineCollection)


def _close(rows: Array, point: Array) -> Booleans:
    return np.asarray(np.all(np.abs(rows - point) <= CLOSE * np.abs(point), axis=-1))


def _among(points: Array, rows: Array) -> bool:
    return all(_close(rows, point).any() for point in points)


def _are_in(points: Array, rows: Array) -> Booleans:
    """Which points are rows, to the last digit."""
    wanted, all_ = (np.ascontiguousarray(part + 0.0) for part in (points, rows))
    row = np.dtype((np.void, wanted.dtype.itemsize * wanted.shape[1]))
    return np.isin(wanted.view(row).ravel(), all_.view(row).ravel())


def _on_line(point: Array, rows: Array) -> bool:
    """Whether a point stands on the line through the rows."""
    size = np.ptp(rows, axis=0)
    size[size == 0] = 1
    start, step = rows[:-1] / size, np.diff(rows, axis=0) / size
    length = np.sum(step**2, axis=1)
    share = np.sum((point / size - start) * step, axis=1) / np.where(length == 0, 1, length)
    apart = point / size - start - np.clip(share, 0, 1)[:, None] * step
    return bool(np.any(np.sum(apart**2, axis=1) < CLOSE))


def _centres(edges: Array) -> Array:
    """Where the values of cells stand whose edges lie half way between."""
    centres = [(edges[0] + edges[1]) / 2]
    for edge in edges[1:-1]:
        centres.append(2 * edge - centres[-1])
    return np.array(centres)


def _category(axis: Axis, at: float) -> str:
    """Text of the tick next to a place."""
    places = axis.get_majorticklocs()
    if not len(places):
        return ""
    nearest = int(np.abs(places - at).argmin())
    return str(axis.get_major_formatter()(places[nearest], nearest))


def _check_legend(legend: Legend, drawn: Sequence[_Drawn], meanings: Meanings) -> None:
    """Refuse an entry of a legend that is not true of all artists drawn in its style."""
    entries = [
        (text.get_text(), _style(handle))
        for text, handle in zip(legend.get_texts(), legend.legend_handles, strict=True)
    ]
    exact = {style for _, style in entries}
    for text, style in entries:
        # A style that nothing has stands for a colour or a pattern. Then the entry is compared with
        # the artists whose styles no entry has, whatever their width.
        own = [one for one in drawn if _style(one.artist) == style]
        unlisted = [one for one in drawn if _style(one.artist) not in exact]
        own = own or [one for one in unlisted if _style(one.artist)[:-1] == style[:-1]]
        if not any(style) or text in [one.artist.get_label() for one in own]:
            continue
        for one in own:
            if not any(meanings.is_curve(text, c.curve, c.names) for c in one.columns):
                wrong = f"the legend calls '{text}' what is {_named(one.columns)}"
                raise NotInTable(f"{wrong}. {HINT}")


def _style(artist: Artist | None) -> tuple[Any, ...]:
    """Colours, pattern, marker, hatch and last the width, as far as a legend shows them."""
    if isinstance(artist, Line2D):
        has_line, marker = artist.get_linestyle() != "None", artist.get_marker()
        face = artist.get_markerfacecolor() if marker != "None" else "none"
        dashes = _dashes(artist) if has_line else None
        if not has_line and marker == "None":
            return ()
        width = artist.get_linewidth() if has_line else None
        return to_rgba(artist.get_color(), artist.get_alpha()), dashes, marker, to_rgba(face), width
    if isinstance(artist, FancyArrowPatch):  # looks like a line
        width = artist.get_linewidth()
        return artist.get_edgecolor(), _dashes(artist), "None", to_rgba("none"), width
    if isinstance(artist, Patch | PolyCollection):
        face = np.ravel(artist.get_facecolor())
        return "area", tuple(face.tolist()), artist.get_hatch(), None
    return ()


def _dashes(artist: Any) -> Any:
    # Matplotlib has no public access to the pattern of dashes.
    offset, dashes = artist._unscaled_dash_pattern
    return offset, tuple(dashes or ())


def _named(matches: Iterable[_Columns]) -> str:
    return " or ".join(f"'{one.curve}: {one.names[-1]}'" for one in matches)


def _is_written(number: str, value: float) -> bool:
    digits = len(number.partition(".")[2])
    return f"{np.round(value, digits) + 0.0:.{digits}f}" == number.replace(
        "\N{MINUS SIGN}", "-"
    ) or (f"{value:g}" == number)


def _description(artist: Artist) -> str:
    text = artist.get_text() if isinstance(artist, Text) else str(artist.get_label())
    kind = type(artist).__name__
    return kind if text.startswith("_") or not text else f"{kind} '{text}'"
