"""Figs 2 to 9 as pictures: what is written in them can be read."""

import importlib
from pathlib import Path

import pytest
from matplotlib import font_manager

from stronge1994 import plan, reference_data
from stronge1994.drawings import house_style
from stronge1994.plan import config as configuration

ROOT = Path(__file__).parents[2]
CONFIG = configuration.load(ROOT)
INVENTORY = reference_data.load_all(
    ROOT / "data", reference_data.load_yaml(ROOT / "workflow/schemas/source.schema.yaml")
)
COARSE = {"samples": 41, "tolerance": 1e-2, "loss_tolerance": 1e-2, "uncertainty": {}}


@pytest.fixture(scope="module", params=[f"fig{number}" for number in range(2, 10)])
def drawn(request):
    """Name of a figure and the figure, drawn from curves that are solved coarsely."""
    settings = plan.settings(CONFIG, INVENTORY, request.param)
    settings |= {key: value for key, value in COARSE.items() if key in settings}
    if "continua" in settings:
        settings |= {"continua": settings["continua"] | {"tolerance": 1e-2}}
    curves = importlib.import_module(f"stronge1994.curves.{request.param}").curves(**settings)
    module = importlib.import_module(f"stronge1994.drawings.{request.param}")
    figure = module.draw(curves, settings, {})
    figure.draw_without_rendering()
    return request.param, figure


def texts(figure):
    """All that is written in a figure; ticks outside the axes are not drawn."""
    yield from (text for legend in figure.legends for text in legend.get_texts())
    above = [part for axes in figure.axes for part in axes.child_axes]
    for axes in [*figure.axes, *above]:
        yield from (axes.title, *axes.texts)
        for axis in (axes.xaxis, axes.yaxis):
            low, high = sorted(axis.get_view_interval())
            yield axis.label
            for tick in [*axis.get_major_ticks(), *axis.get_minor_ticks()]:
                if low <= tick.get_loc() <= high:
                    yield from (tick.label1, tick.label2)


def test_nothing_written_lies_on_something_else_or_is_cut_off(drawn):
    _, figure = drawn
    written = [text for text in texts(figure) if text.get_text() and text.get_visible()]
    boxes = [(text.get_text(), text.get_window_extent()) for text in written]
    edge = figure.bbox
    for place, (words, box) in enumerate(boxes):
        assert edge.x0 <= box.x0 and box.x1 <= edge.x1, words
        assert edge.y0 <= box.y0 and box.y1 <= edge.y1, words
        # Boxes that touch by a pixel belong to letters that do not.
        inner = box.padded(-1)
        on = [other for other, its in boxes[place + 1 :] if inner.overlaps(its.padded(-1))]
        assert not on, (words, on)


def test_the_legend_names_the_continua_once(drawn):
    name, figure = drawn
    (legend,) = figure.legends or [None]
    words = [text.get_text() for text in legend.get_texts()] if legend else []
    for label, _ in house_style.LOSSY.values():
        count = sum(entry.startswith(f"{label}, $e = ") for entry in words)
        assert count == (name in ("fig5", "fig6", "fig9")), words


def test_the_letters_are_found_though_a_machine_s_list_of_fonts_lacks_them():
    assert font_manager.findfont(house_style.STYLE["font.family"], fallback_to_default=False)


def test_restitutions_differ_in_their_lines_and_none_is_dotted():
    patterns = [house_style.of_restitution(e) for e in (0, 0.2, 0.5, 0.8, 0.9, 1)]
    assert len(set(patterns)) == len(patterns)
    assert all(dashes == "-" or dashes[1][0] > dashes[1][1] for dashes in patterns)
