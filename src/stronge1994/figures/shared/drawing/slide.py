"""The frame of a slide: one point of a figure, for a projector, on a light and on a dark ground.

A figure has a slide if its folder has a slide.py, with a function
`draw(curves, settings, points, ground)`. It gets what `draw` of drawing.py beside it gets, and a
`Ground`. Its title is a sentence that says the point; numbers in it are computed from the curves,
and if the curves no longer show the point, another title says only what is drawn. Names stand at
the curves.
"""

import textwrap
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patheffects import withStroke
from PIL import Image

from planarimpact.ground.arrays import Array
from stronge1994.figures.shared.drawing import house_style

# Pixels. A point of matplotlib is a pixel here, so that sizes of letters and lines are pixels too.
WIDTH, HEIGHT = 1920, 1080
DOTS_PER_INCH = 72
TITLE, LETTERS, SOURCE = 60, 40, 28  # sizes of letters
LINE, MARK = 6.0, 20.0  # width of a line, size of a marker
LEFT, RIGHT, TOP, BOTTOM = 180, 1840, 800, 200  # edges of the axes
MARGIN = 60  # of the title and of the source


class Ground(NamedTuple):
    """A ground and the colours on it, those of the pages and of the lectures."""

    paper: str
    ink: str
    quiet: str
    blue: str
    vermillion: str
    green: str


# Darker or lighter than the house's colours, so that words in them can be read.
LIGHT = Ground("#ffffff", "#222222", "#666666", "#005f9e", "#b84a00", "#00755a")
DARK = Ground("#15181c", "#e9e7e3", "#a5a39e", "#8fc7ff", "#ff9d5c", "#4fd0ae")
GROUNDS = {"light": LIGHT, "dark": DARK}


def new(title: str, data: str, ground: Ground) -> tuple[Figure, Axes]:
    """Empty slide with its title and the source of its `data`, and its axes."""
    size = WIDTH / DOTS_PER_INCH, HEIGHT / DOTS_PER_INCH
    figure = Figure(figsize=size, dpi=DOTS_PER_INCH, facecolor=ground.paper)
    style = {"color": ground.ink, "fontsize": TITLE}
    style |= {"va": "top", "linespacing": house_style.LINES}
    left = MARGIN / WIDTH
    lines = -(-len(title) // 72)
    wrapped = textwrap.fill(title, len(title) // lines + 8)  # into lines of nearly one length
    figure.text(left, 1 - MARGIN / HEIGHT, wrapped, **style)
    source = f"planarimpact; data: {data}"
    figure.text(left, 0.5 * MARGIN / HEIGHT, source, color=ground.quiet, fontsize=SOURCE)
    frame = LEFT / WIDTH, BOTTOM / HEIGHT, (RIGHT - LEFT) / WIDTH, (TOP - BOTTOM) / HEIGHT
    axes = figure.add_axes(frame, facecolor=ground.paper)
    axes.spines[["top", "right"]].set_visible(False)
    axes.spines[:].set(color=ground.quiet, linewidth=LINE / 2)
    ticks = {"color": ground.quiet, "labelcolor": ground.ink, "labelsize": LETTERS}
    axes.tick_params(direction="out", width=LINE / 2, length=12, pad=12, **ticks)
    axes.tick_params(which="minor", length=0)
    return figure, axes


def name_axes(axes: Axes, x: str, y: str, ground: Ground) -> None:
    """Label both axes; the vertical one above its end, in a line that can be read."""
    style = {"color": ground.ink, "fontsize": LETTERS}
    axes.set_xlabel(x, labelpad=8, **style)
    axes.set_ylabel(y, rotation=0, ha="left", va="bottom", **style)
    axes.yaxis.set_label_coords((MARGIN - LEFT) / (RIGHT - LEFT), 1.03)


def name_curve(
    axes: Axes,
    text: str,
    x: Array,
    y: Array,
    at: float,
    offset: tuple[float, float],
    colours: tuple[str, str],
) -> None:
    """Write a text beside a curve at the abscissa `at`, by an offset in pixels.

    It lies on the side of the offset; without one, it is centred. `colours` are that of the letters
    and that of the ground, which keeps lines away from them.
    """
    across, up = offset
    at = float(np.clip(at, x[0], x[-1]))  # other settings may end the curve earlier
    axes.annotate(
        text,
        (at, float(np.interp(at, x, y))),
        offset,
        textcoords="offset points",
        ha="left" if across > 0 else "right" if across < 0 else "center",
        va="bottom" if up > 0 else "top" if up < 0 else "center",
        color=colours[0],
        fontsize=LETTERS,
        linespacing=house_style.LINES,
        path_effects=[withStroke(linewidth=10, foreground=colours[1])],
    )


def save(figure: Figure, png: str) -> None:
    """Write a slide with 256 colours, which makes a small file; lines have few."""
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    Image.fromarray(np.asarray(canvas.buffer_rgba())).convert("RGB").quantize(256).save(png)
