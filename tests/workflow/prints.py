"""Made-up prints of figures in the manner of the paper, as a scan shows them: not straight.

Drawn from arrays, not by the drawing of our figures.
"""

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from PIL import Image

INK = {"color": "black", "linewidth": 0.8}
SIZE = 5.0, 4.0  # in


# How a picture is seen: what a corner moves by perspective, over the width, and the light at the
# right edge over that at the left.
SCAN, PHOTO = (0.006, 1.0), (0.05, 0.6)


def scan(path, limits, lines, circles=(), dpi=300, seen=SCAN, steps=(1, 1)):
    """Save a JPEG; the result gives pixels of the picture for values of the axes.

    `limits` are those of x and y, with ticks at these `steps`; `lines` are x, y and a line style
    each. Pixels count from the upper left corner of the picture.
    """
    figure = Figure(SIZE, dpi=dpi)
    canvas, axes = FigureCanvasAgg(figure), figure.add_axes((0.14, 0.16, 0.78, 0.74))
    (left, right), (low, high) = limits
    for x, y, style in lines:
        axes.plot(x, y, style, **INK)
    for x, y in circles:
        axes.plot(x, y, "o", markersize=4, markerfacecolor="white", markeredgewidth=0.7, **INK)
    axes.set(xlim=limits[0], ylim=limits[1])
    axes.set(xticks=np.arange(left, right + 1, steps[0]), yticks=np.arange(low, high + 1, steps[1]))
    axes.tick_params(direction="in", width=0.6, labelsize=8, labelfontfamily="serif")
    axes.spines[["top", "right"]].set_visible(False)
    axes.spines["bottom"].set_position(("data", 0.0))  # the x axis crosses at y = 0
    for place, words, turn in (((0.53, 0.04), "INCIDENCE", 0), ((0.02, 0.5), "VELOCITY", 90)):
        figure.text(*place, words, family="serif", size=8, ha="center", rotation=turn)
    canvas.draw()
    grey = np.asarray(canvas.buffer_rgba())[..., 0]
    height, width = grey.shape
    bent = _bent(width, height, seen[0])
    ask = np.linalg.inv(bent)  # Pillow asks for each new pixel where it comes from
    picture = Image.fromarray(grey).transform(
        (width, height),
        Image.Transform.PERSPECTIVE,
        (ask / ask[2, 2]).ravel()[:8],
        Image.Resampling.BICUBIC,
        fillcolor=255,
    )
    noise = np.random.default_rng(0).normal(0.0, 8.0, grey.shape)
    paper = (0.9 * np.asarray(picture, float) + 18.0) * np.linspace(1.0, seen[1], width) + noise
    Image.fromarray(np.clip(paper, 0, 255).astype(np.uint8)).save(path, quality=60)

    def pixel(x, y):
        u, v = axes.transData.transform((x, y))
        u, v, w = bent @ (u, height - v, 1.0)
        return np.array([u / w, v / w])

    return pixel


def _bent(width, height, corner):
    """Rotated by 0.7 degrees about the middle, sheared, and with a perspective."""
    turn, (u, v) = np.radians(0.7), (width / 2, height / 2)
    middle = np.array([[1.0, 0.0, u], [0.0, 1.0, v], [0.0, 0.0, 1.0]])
    rotated = [[np.cos(turn), -np.sin(turn), 0], [np.sin(turn), np.cos(turn), 0], [0, 0, 1]]
    sheared = [[1.0, 0.004, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
    perspective = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [2 * corner / width, 0.0, 1.0]]
    return middle @ perspective @ sheared @ rotated @ np.linalg.inv(middle)
