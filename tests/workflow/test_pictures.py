"""Pictures follow the tables of a run, and what is written in them can be read."""

import importlib
import json
import re

import numpy as np
import pytest
from matplotlib.collections import Collection
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from PIL import Image

from stronge1994 import csv_tables
from stronge1994.curve_names import is_of_paper, is_shifted
from stronge1994.figures.shared import drawing as drawings
from stronge1994.figures.shared.drawing import slide
from stronge1994.plan import figures
from stronge1994.run import plans

# Curves that are only compared, as patterns; of `inelastic` and `trade` only some are tried.
NOT_DRAWN = {
    "fig5": "finite elements",
    "fig9": "no tangential compliance, (mu = 0.1|.*, e = 0.5)",
    "inelastic": "pairs, to",
    "rubber_sphere": "impacts|stated|rms",
    "stability": "contacts",
    "trade": "steps|e = 0.8",
    "yielding": "continuum, nu",
}


@pytest.fixture(scope="module")
def given(first_run):
    """Tables of a figure, and a function that draws it from them."""

    def of(figure):
        project, _ = first_run
        settings = json.loads((project / plans.path(f"draw_{figure}")).read_text())["settings"]
        points = drawings.series(settings["overlays"])
        module = importlib.import_module(f"stronge1994.figures.{figure}.drawing")
        return csv_tables.read(
            project / f"results/curves/{figure}.csv"
        ), lambda curves: module.draw(curves, settings["settings"], points)

    return of


def numbers(picture):
    """All numbers of lines, areas and marks."""
    for artist in picture.findobj():
        if isinstance(artist, Line2D):
            yield artist.get_xydata()
        elif isinstance(artist, Patch):
            yield artist.get_patch_transform().transform(artist.get_path().vertices)
        elif isinstance(artist, Collection):
            yield from (path.vertices for path in artist.get_paths())


def shown(picture):
    return b"".join(np.asarray(part).tobytes() for part in numbers(picture))


@pytest.mark.parametrize("figure", figures.stated())
def test_a_picture_shows_every_curve_of_its_table(given, figure):
    """A curve whose numbers change looks different."""
    curves, draw = given(figure)
    before = shown(draw(curves))
    assert before == shown(draw(curves))
    for name, curve in curves.items():
        if not is_shifted(name) and not re.search(NOT_DRAWN.get(figure, "^$"), name):
            changed = {c: v * 1.01 if v.dtype.kind == "f" else v for c, v in curve.items()}
            assert shown(draw(curves | {name: changed})) != before, name


@pytest.mark.parametrize("figure", [figure for figure in figures.stated() if is_of_paper(figure)])
def test_nothing_written_lies_on_something_else_or_is_cut_off(given, figure):
    curves, draw = given(figure)
    picture = draw(curves)
    picture.draw_without_rendering()
    written = [text for text in texts(picture) if text.get_text() and text.get_visible()]
    boxes = [(text.get_text(), text.get_window_extent()) for text in written]
    edge = picture.bbox
    for place, (words, box) in enumerate(boxes):
        assert edge.x0 <= box.x0 and box.x1 <= edge.x1, words
        assert edge.y0 <= box.y0 and box.y1 <= edge.y1, words
        # Boxes that touch by a pixel belong to letters that do not.
        inner = box.padded(-1)
        on = [other for other, its in boxes[place + 1 :] if inner.overlaps(its.padded(-1))]
        assert not on, (words, on)


@pytest.mark.parametrize("figure", figures.with_trait("slide"))
def test_a_slide_fills_a_projector_and_nothing_is_cut_off(given, figure, tmp_path):
    curves, draw = given(figure)
    files = {ground: str(tmp_path / f"{ground}.png") for ground in ("light", "dark")}
    slide.save(draw(curves), **figures.stated()[figure]["slide"], **files)
    for ground, dark in (("light", False), ("dark", True)):
        pixels = np.asarray(Image.open(files[ground]).convert("L"), float)
        assert pixels.shape == (1080, 1920) and (np.median(pixels) < 30) == dark
        edges = [pixels[0], pixels[-1], pixels[:, 0], pixels[:, -1]]
        assert np.ptp(np.concatenate(edges)) == 0


def texts(picture):
    """All that is written in a figure; ticks outside the axes are not drawn."""
    yield from (text for legend in picture.legends for text in legend.get_texts())
    above = [part for axes in picture.axes for part in axes.child_axes]
    for axes in [*picture.axes, *above]:
        yield from (axes.title, *axes.texts)
        for axis in (axes.xaxis, axes.yaxis):
            low, high = sorted(axis.get_view_interval())
            yield axis.label
            for tick in [*axis.get_major_ticks(), *axis.get_minor_ticks()]:
                if low <= tick.get_loc() <= high:
                    yield from (tick.label1, tick.label2)
