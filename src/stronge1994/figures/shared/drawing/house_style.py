"""House style of the figures: fonts, colours, what each line means, and the parts they share.

A figure is a folder with figure.yaml, curves.py and drawing.py. Its drawing.py has a function
`draw(curves, settings, points)`, which returns a Figure:

- `curves`, the table that curves.py beside it made, see `stronge1994.tables`. `tables.select` gives
  the curves with some values in their columns, and `line` draws two columns of one curve;
- `settings`, as curves.py gets them; only of a reference table they have no more than the name;
- `points`, the series of data/ that are at hand, `{"source/series": Scatter}`, of those that were
  computed only what figure.yaml `draws`; and stated facts. `references` draws all published series
  that have the axes of a panel.

Importing this module sets matplotlib's defaults for all figures. A style that holds only while a
figure is put together would not reach its ticks, which matplotlib makes when it writes the file.
The first panels of a figure of the paper have what the print has, and nothing else: the same axes,
curves and patterns of lines, as far as its text says. What this repository adds stands in panels of
its own below. The colours (Okabe & Ito) differ in grey too, and no two curves differ by colour
alone: they differ in pattern, or have their names beside them, see `name_curve`. Where one figure
shows several restitutions, `of_restitution` gives their lines; where it shows one, a pattern is a
model.
"""

import io
import re
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from types import MappingProxyType
from typing import Any, BinaryIO, TypeAlias

import matplotlib
import numpy as np
from matplotlib import font_manager
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from planarimpact.common.arrays import Array, Booleans
from stronge1994 import names, tables, words
from stronge1994.tables import Table

File: TypeAlias = str | BinaryIO
Style: TypeAlias = dict[str, Any]  # keywords of matplotlib
Dashes: TypeAlias = str | tuple[float, tuple[float, ...]]  # a pattern of line
Settings: TypeAlias = dict[str, Any]
Points: TypeAlias = dict[str, Any]  # `Scatter`s, `Awaited`, and `reference_data.Fact`s
Entries: TypeAlias = list[Any]  # of a legend: artists, and containers of them


@dataclass(frozen=True)
class Scatter:
    """Points of a series as a drawing gets them, with their errors.

    `axes` names the columns of both axes; `columns` is the whole table of the series, `parameters`
    are those of its source, and `legend` is its name for readers, as source.yaml has it.
    """

    is_published: bool
    x: Array
    y: Array
    sigma: tuple[Array, Array]
    axes: tuple[str, str]
    columns: Table
    parameters: Mapping[str, float]
    legend: str = ""

    def at(self, rows: Any) -> "Scatter":
        """Some of its points."""
        x_error, y_error = (errors[rows] for errors in self.sigma)
        return replace(self, x=self.x[rows], y=self.y[rows], sigma=(x_error, y_error))


@dataclass(frozen=True)
class Awaited:
    """A series of which nobody has read the points yet: its name in the legend."""

    legend: str


# Inches. The letters stay readable when a column of a journal shrinks a figure to 3.4 inches.
WIDTH = 5.0
# Size in points of notes, and of names above the axes.
NOTE = 9.5

BLACK, BLUE, VERMILLION, GREEN, PURPLE = "#000000", "#0072B2", "#D55E00", "#009E73", "#CC79A7"
SKY, ORANGE = "#56B4E9", "#E69F00"
GREY, PALE = "0.5", "0.85"
# For printed equations; darker than PURPLE, so that it is seen on both grounds of a slide.
ROSE = "#B0508A"

# No pattern is dotted: a dotted line means "no tangential compliance".
DASHES: tuple[Dashes, ...] = (
    "-",
    (0, (5, 2)),
    (0, (7, 2, 1.5, 2)),
    (0, (3, 1.2)),
    (0, (7, 1.5, 1.5, 1.5, 1.5, 1.5)),
)
COLOURS: tuple[str, ...] = (BLACK, BLUE, VERMILLION, GREEN, PURPLE)

LUMPED: Style = {"color": BLACK, "linestyle": "-", "linewidth": 1.4}
CONTINUUM: Style = {"color": BLACK, "linestyle": (0, (6, 2)), "linewidth": 1.1}
RIGID: Style = {"color": GREY, "linestyle": (0, (1, 1.5)), "linewidth": 1.2, "zorder": 1.8}
GUIDE: Style = {"color": "0.7", "linewidth": 0.6, "zorder": 0.9}
SURFACE: Style = {"facecolor": "0.9", "hatch": "////", "edgecolor": "0.7", "linewidth": 0}
PRINTED: Style = {"color": "0.3", "linewidth": 0.9}
# A series for which a drawing has no style of its own.
POINT: Style = {"marker": "o", "markerfacecolor": "white", "markersize": 3.6}
OF_PRINT = ("read from the printed curves", POINT | {"color": "0.3", "marker": "+"})
AS_PRINTED: Style = {"color": ROSE, "linestyle": "-", "linewidth": 1.2, "zorder": 2.2}
# Stripes across the curve: a pale band would vanish on the dark ground of a slide.
UNSOLVED: Style = {"color": ROSE, "linestyle": (0, (0.18, 0.3)), "linewidth": 7, "zorder": 1.5}
UNSOLVED["dash_joinstyle"] = "bevel"  # a round one makes a dot where two vertices nearly coincide
# Headings of panels of the paper's figures: what the print has, and what it does not have.
PAPERS, OURS = "as the paper describes", "added here"

# Parameters of curves in the paper's letters.
SYMBOLS = {"mu": r"\mu", "nu": r"\nu", "zeta2": r"\zeta^2"}
INCIDENCE = r"$v_1(0)/\mu v_2(0)$"
REBOUND = r"$v_1(t_f)/\mu v_2(0)$"
# Largest forces of an impact, to be put between dollar signs.
F1MAX, F2MAX = r"F_{1\mathrm{max}}", r"F_{2\mathrm{max}}"
# Quantities after an impact and their incidence in the paper's letters.
LETTERS = {
    "incidence [mu v2(0)]": INCIDENCE,
    "velocity [mu v2(0)]": REBOUND,
    "tangential_velocity [v2(0)]": "$v_1(t_f)/v_2(0)$",
    "normal_velocity [v2(0)]": "$v_2(t_f)/v_2(0)$",
    "kinetic_energy [K0]": "$K(t_f)/K(0)$",
}

# These fonts come with matplotlib. Its cached list of fonts may be older than this installation and
# lack them: then it would use another font, whose letters are too wide for their places.
for _font in sorted(Path(matplotlib.get_data_path(), "fonts/ttf").glob("STIX*.ttf")):
    font_manager.fontManager.addfont(_font)
matplotlib.rc_file(Path(__file__).with_name("house.mplstyle"))


def new(height: float) -> Figure:
    """Empty figure of the house's width and a height in inches."""
    return Figure(figsize=(WIDTH, height), layout="constrained")


def save(figure: Figure, svg: File, png: File | None = None, source: str = "") -> None:
    """Write both files of a figure; `source` goes to their metadata.

    The same figure gives the same bytes: they do not say when it was drawn.
    """
    # Matplotlib solves the layout in an order that changes from run to run, which changes the last
    # bits. So the places are rounded.
    if layout := figure.get_layout_engine():
        layout.execute(figure)
    figure.set_layout_engine("none")
    for axes in figure.axes:
        axes.apply_aspect()
        axes.set_position(np.round(axes.get_position().bounds, 6))
    # `Figure.savefig` would draw once more to solve the layout again.
    figure.dpi = 200  # of the PNG, and of pixels inside the SVG
    if png:
        FigureCanvasAgg(figure).print_png(png, metadata={"Source": source})
    text = io.StringIO()
    FigureCanvasSVG(figure).print_svg(text, metadata={"Date": None, "Source": source})
    content = shortened(text.getvalue())
    if isinstance(svg, str):
        Path(svg).write_text(content, encoding="utf-8")
    else:
        svg.write(content.encode())


def shortened(svg: str) -> str:
    """The same picture in a shorter file: short names, no comments, no idle digits.

    A hundredth of a point is far below the width of a line.

    >>> shortened('<g id="line_1">\\n  <!-- e = 1 -->\\n  <path d="M 1.23456 2 \\nL 3.5 4"/></g>')
    '<g><path d="M1.23 2L3.5 4"/></g>'
    """

    def path(match: re.Match[str]) -> str:
        digits = re.sub(r"(\.\d\d)\d+", r"\1", match[1])
        return re.sub(r"\s*([A-Za-z])\s*", r"\1", digits).strip()

    svg = re.sub(r"<!--.*?-->", "", svg, flags=re.DOTALL)
    svg = re.sub(r'<g id="[^"]*"', "<g", svg)
    svg = re.sub(r">\s+<", "><", svg)
    svg = re.sub(r'(?<= d=")([^"]*)(?=")', path, svg)
    short = {name: f"i{place}" for place, name in enumerate(re.findall(r' id="([^"]*)"', svg))}
    return re.sub(r'(?<=[#"])[^#"()]+(?=[")])', lambda named: short.get(named[0], named[0]), svg)


def parameters(curve: Table) -> str:
    r"""The parameters of one curve and their values, in mathematical letters.

    >>> parameters(tables.curve({"x [1]": [0.0]}, "continuum", mu=0.1, e=1.0))
    '$\\mu = 0.1$, $e = 1$'
    """
    own = curve.select_dtypes("number").iloc[0].items()
    values = {key: value for key, value in own if not tables.is_quantity(key)}
    return ", ".join(f"${SYMBOLS.get(key, key)} = {value:g}$" for key, value in values.items())


def of_column(column: str) -> str:
    """Label of a column for a reader."""
    return LETTERS.get(column, words.column(column))


def line(
    axes: Axes, curve: Table, x: str, y: str, rows: Booleans | None = None, **style: Any
) -> Line2D:
    """Draw column `y` of one curve against its column `x`, and label both axes.

    Where `rows` is false there is a gap. `style` may have a label other than the columns that tell
    which curve it is.
    """
    tables.only_curve(curve)
    height = curve[y] if rows is None else curve[y].where(rows)
    axes.set(xlabel=of_column(x), ylabel=of_column(y))
    which = *curve[["model", "variant"]].iloc[0], parameters(curve)
    label = {"label": ", ".join(filter(None, which))}
    return axes.plot(curve[x].to_numpy(), height.to_numpy(), **label | style)[0]


def of_restitution(e: float) -> Dashes:
    """Pattern of a restitution: solid for 1, dashes that shorten with e, dash-dot for 0.

    >>> of_restitution(1), of_restitution(0.5)
    ('-', (0, (5.0, 2)))
    """
    if e == 1:
        return "-"
    return (0, (2 + 6 * e, 2)) if e > 0 else DASHES[2]


def key(label: str, **style: Any) -> Line2D:
    """Entry of a legend for a line that is not drawn."""
    return Line2D([], [], label=label, **style)


def legend_below(
    figure: Figure, *groups: Iterable[Artist | str], titles: Collection[str] = ()
) -> None:
    """Legend below the axes, where it never covers a curve: one column for each group.

    A group has artists with labels, and strings: a string is a heading, an empty one a gap.
    `titles` are headings of the groups.
    """
    columns = [list(group) for group in groups]
    for column, title in zip(columns, titles, strict=False):
        column.insert(0, title)
    # A legend is filled column by column, so all columns must be equally long.
    rows = max(map(len, columns))
    entries = [entry for column in columns for entry in column + [""] * (rows - len(column))]
    headings = {entry for entry in entries if isinstance(entry, str)}
    handles = [key(e, linestyle="none") if isinstance(e, str) else e for e in entries]
    place = {"loc": "outside lower center", "columnspacing": 2, "borderpad": 0.2}
    legend = figure.legend(handles=handles, ncols=len(columns), **place)
    for text in legend.get_texts():
        if text.get_text() in headings:
            text.set_style("italic")


def rigid(
    axes: Axes,
    curve: Table,
    x: str,
    y: str,
    compliant: Table,
    label: str = "no tangential compliance",
    **style: Any,
) -> Line2D:
    """Line without tangential compliance, left out where the compliant curve is the same."""
    rows = ~np.isclose(curve[y], compliant[y])
    return line(axes, curve, x, y, rows, label=label, **RIGID | style)


def as_printed(axes: Axes, curves: Table, x: str, y: str, equations: str) -> Entries:
    """Draw what the printed equations give, see `printed_variants`; entries of the legend.

    A curve of a restitution has its pattern, and an entry that names it. `equations` are the
    numbers of the equations.
    """
    entries = {}
    printed = curves[curves["model"] == names.PRINTED]
    for _, own in printed.groupby("curve", sort=False):
        curve = own.dropna(axis="columns", how="all")
        label, style = f"{equations} as printed", AS_PRINTED
        if curve["variant"].iloc[0] == names.NO_SOLUTION:
            label, style = "no solution as printed", UNSOLVED
        elif "e" in curve:
            e = curve["e"].iloc[0]
            label += f", $e = {e:g}$"
            style = style | {"linestyle": of_restitution(e)}
        entries[label] = line(axes, curve, x, y, label=label, **style)
    return list(entries.values())


def measured(axes: Axes, series: Scatter, **style: Any) -> Artist:
    """Draw points with error bars, label the axes by their columns; the entry of the legend."""
    x_label, y_label = map(of_column, series.axes)
    axes.set(xlabel=x_label, ylabel=y_label)
    x_error, y_error = series.sigma
    bars = {"linestyle": "none", "elinewidth": 0.7, "markeredgewidth": 0.9, "zorder": 3}
    return axes.errorbar(series.x, series.y, yerr=y_error, xerr=x_error, **(bars | style))


def of_print(points: Points, shown: Collection[str] = ()) -> tuple[Points, Points]:
    """Series for the panels of the paper: `shown` there, or read from its curves. And all others.

    >>> [list(part) for part in of_print({"a/b": 0, "c/d": 1, "stronge1994/e": 2}, ["a/b"])]
    [['a/b', 'stronge1994/e'], ['c/d']]
    """
    paper = {k: own for k, own in points.items() if k in shown or k.startswith(f"{names.STRONGE}/")}
    return paper, {name: own for name, own in points.items() if name not in paper}


def references(
    axes: Axes,
    points: Points,
    x: str,
    y: str,
    styles: Mapping[str, Style] = MappingProxyType({}),
) -> dict[str, Any]:
    """Draw all published series with the axes of a panel; entries of the legend by their names.

    `styles` has the styles of some series, which come first; one of them that is awaited has an
    entry with its marker too. Series of the printed curves have one entry.
    """
    entries: dict[str, Any] = {name: None for name in styles if name in points}
    for name, series in points.items():
        if name in styles and isinstance(series, Awaited):
            label = f"{series.legend or name}: points awaited"
            entries[name] = key(label, **{"linestyle": "none"} | styles[name])
        elif isinstance(series, Scatter) and series.is_published and series.axes == (x, y):
            printed = name.startswith(f"{names.STRONGE}/")
            label, style = OF_PRINT if printed else (series.legend or name, POINT)
            style = {"label": label} | styles.get(name, style)
            entries[label if printed else name] = measured(axes, series, **style)
    return {name: entry for name, entry in entries.items() if entry}


def letter(panels: Sequence[Axes], headings: Sequence[str] = (), first: int = 0) -> None:
    """Name panels (a), (b) and so on, at the left above them, from the letter `first` on.

    A panel has the heading of its place behind the letter, or none.
    """
    for place, axes in enumerate(panels):
        words = headings[place] if place < len(headings) else ""
        title = f"({'abcdef'[first + place]}) {words}".strip()
        axes.set_title(title, loc="left", fontsize=NOTE, style="italic")


def above_each_other(panels: Sequence[Axes]) -> None:
    """Of panels with one x axis only the last keeps its label and the numbers below."""
    for axes in panels[:-1]:
        axes.xaxis.label.set_visible(False)
        axes.tick_params(labelbottom=False)


def name_curve(
    axes: Axes,
    curve: Table,
    x: str,
    y: str,
    name: str,
    at: float,
    away: tuple[float, float] = (0, 0),
    **style: Any,
) -> None:
    """Write a name beside one curve, at its point with the abscissa `at`.

    `away` is how far the middle of the name is from that point, in points of type; a thin line
    leads to a name that is farther than 20. Without it the name interrupts the curve.
    """
    order = curve.sort_values(x, kind="stable")
    place = at, float(np.interp(at, order[x], order[y]))
    look: Style = {"fontsize": NOTE, "ha": "center", "va": "center", "zorder": 4}
    look["bbox"] = {"facecolor": "white", "edgecolor": "none", "pad": 0.6}
    if np.hypot(*away) > 20:
        look["arrowprops"] = {"arrowstyle": "-", "linewidth": 0.5, "color": GREY, "shrinkB": 0}
    axes.annotate(name, place, away, textcoords="offset points", **look | style)


def angle_axes(panels: Sequence[Axes], span: Sequence[float]) -> None:
    """Angles of incidence below panels, and above the first the ratios of velocities they mean."""
    degrees = [angle for angle in range(0, 91, 30) if span[0] <= angle <= span[1]]
    for axes in panels:
        axes.set(xlim=span, xlabel=r"angle of incidence $\theta$")
        axes.set_xticks(degrees, [rf"${angle}\degree$" for angle in degrees])
    ratios = np.array([0, 0.2, 0.4, 0.6, 1, 2, 4])
    angles = np.degrees(np.arctan(ratios))
    inside = (angles >= span[0]) & (angles <= span[1])
    top = panels[0].secondary_xaxis("top")
    top.set_xticks(angles[inside], [f"{ratio:g}" for ratio in ratios[inside]])
    top.set_xlabel(r"$v_1(0)/v_2(0)$")


def name_spans(axes: Axes, spans: Sequence[tuple[float, float, str]]) -> None:
    """Names of parts of the x axis above the axes, and lines between them: (start, end, name)."""
    top = axes.secondary_xaxis("top")
    middles = [(start + end) / 2 for start, end, _ in spans]
    top.set_xticks(middles, [name for *_, name in spans], fontsize=NOTE)
    top.tick_params(length=0)
    for start, _, _ in spans[1:]:
        axes.axvline(start, **GUIDE)
