"""A slide: one panel of a figure for a projector, on a light and on a dark ground.

figure.yaml names the panel by its letter and gives the slide a title. The slide has the entries of
the figure's legend whose labels are those of lines, marks and areas in the panel.
"""

import re
import textwrap

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from PIL import Image
from PIL.PngImagePlugin import PngInfo

# Inches: the letters are as large as in the figure, and 1920 pixels wide.
WIDTH, HEIGHT = 6.4, 3.6
DOTS_PER_INCH = 300
DARK = np.array([0x15, 0x18, 0x1C])  # ground of the pages and of the lectures


def save(figure: Figure, panel: str, title: str, light: str, dark: str, source: str = "") -> None:
    """Reduce a figure to one panel, and write both files; `source` goes to their metadata."""
    kept = next(a for a in figure.axes if f"({panel})" in a.get_title("left") + a.get_title())
    # A legend inside the panel stays; that of the figure has entries of other panels, too.
    legends = list(figure.legends)
    known = {text.get_text() for legend in legends for text in legend.get_texts()}
    pairs = zip(*kept.get_legend_handles_labels(), strict=True)
    shown = {label: artist for artist, label in pairs if label in known}
    for part in [*legends, *(axes for axes in figure.axes if axes is not kept)]:
        part.remove()
    kept.set_subplotspec(figure.add_gridspec()[0])
    for place in ("left", "center"):
        words = re.sub(r"^\(\w\) ?", "", kept.get_title(place))
        kept.set_title(words, loc=place)
    for axis in (kept.xaxis, kept.yaxis):
        axis.label.set_visible(True)
        axis.set_tick_params(labelbottom=True, labelleft=True)
    figure.set_size_inches(WIDTH, HEIGHT)
    figure.suptitle(textwrap.fill(title, 80), x=0.01, ha="left", fontsize=13)
    if shown:
        figure.legend(shown.values(), shown.keys(), loc="outside right center")
    figure.dpi = DOTS_PER_INCH
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    pixels = np.asarray(canvas.buffer_rgba())[..., :3].astype(int)
    # The other lightness with the same hue and saturation, from the dark ground on.
    ends = pixels.max(axis=2, keepdims=True) + pixels.min(axis=2, keepdims=True)
    other = DARK + (pixels + 255 - ends) * (255 - DARK) // 255
    made_by = PngInfo()
    made_by.add_text("Source", source)
    for picture, file in ((pixels, light), (other, dark)):
        # 256 colours make a small file; lines have few.
        few = Image.fromarray(picture.astype(np.uint8)).quantize(256)
        few.save(file, pnginfo=made_by)
