"""Pictures follow the tables of a run, and what is written in them can be read."""

import functools
import importlib
import re

import numpy as np
import pandas as pd
import pytest
import yaml
from matplotlib.axis import Axis
from matplotlib.collections import Collection
from matplotlib.colors import to_hex
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.text import Text

import planarimpact
from stronge1994 import reference_data, tables
from stronge1994 import settings as figure_settings
from stronge1994.figures.shared import drawing as drawings
from stronge1994.figures.shared.drawing import house_style, slide
from stronge1994.names import home, is_of_paper
from stronge1994.settings import figures
from tests.workflow.project import checked, config, sources

PAPER = [figure for figure in figures.stated() if is_of_paper(figure)]
# Curves of the paper's figures that are only compared, as patterns; and one that is an area.
NOT_DRAWN = {
    "fig5": "finite elements",
    "fig7": "slip throughout",
    "fig9": "rigid, (mu = 0.1|.*, e = 0.5)",
}


@pytest.fixture(scope="module")
def given(first_run):
    """Tables of a figure, a function that draws it from them, and its points."""

    def of(figure):
        project, _ = first_run
        settings = figure_settings.of_figure(config(), sources(), checked({}), figure)["drawing"]
        points = drawings.references(settings["overlays"])
        module = importlib.import_module(f"stronge1994.{home(figure)}.{figure}.drawing")
        curves = tables.read(project / f"results/curves/{figure}.csv")

        def draw(curves, points=points):
            return module.draw(curves, settings["settings"], points)

        return curves, draw, points

    return of


@pytest.fixture(scope="module")
def drawn(given):
    """Table and picture of a figure as the run has them. Do not change them."""

    @functools.cache
    def of(figure):
        curves, draw, _ = given(figure)
        return curves, draw(curves)

    return of


def curves_of(line, curves):
    """Names of curves of which a line shows one column against another, where it has no gap."""
    x, y = line.get_xydata().T
    there = ~np.isnan(y)
    for name, curve in curves.groupby("curve", sort=False):
        numbers = [curve[column].to_numpy() for column in filter(tables.is_quantity, curve)]
        alike = [v for v in numbers if v.shape == x.shape]
        across = any(np.array_equal(values, x) for values in alike)
        if across and any(np.array_equal(values[there], y[there]) for values in alike):
            yield name


@pytest.mark.parametrize("figure", PAPER)
def test_a_line_is_a_curve_of_the_table_and_each_curve_is_drawn(drawn, figure):
    """Column against column; a line without label may be made of two columns."""
    curves, picture = drawn(figure)
    seen = set()
    for line in [line for axes in picture.axes for line in axes.lines]:
        label, found = line.get_label(), list(curves_of(line, curves))
        assert found or label[0] == "_" or len(line.get_xdata()) < 30, label
        seen |= set(found)
    own = curves[curves["shifted"] == ""] if "shifted" in curves else curves
    names = [n for n in own["curve"].unique() if not re.search(NOT_DRAWN.get(figure, "^$"), n)]
    assert [name for name in names if name not in seen] == []


def words_of(picture):
    """All words of a picture with the box around each, in pixels."""
    picture.draw_without_rendering()
    unseen = set()
    for axis in picture.findobj(Axis):
        low, high = sorted(axis.get_view_interval())
        ticks = [*axis.get_major_ticks(), *axis.get_minor_ticks()]
        beyond = [tick for tick in ticks if not low <= tick.get_loc() <= high]
        unseen |= {label for tick in beyond for label in (tick.label1, tick.label2)}
    for text in picture.findobj(Text):
        box = text.get_window_extent()
        if text not in unseen and text.get_visible() and text.get_text().strip() and box.width:
            yield text.get_text(), box


def outside(picture, words):
    """Words that reach over the edge of a picture by more than a pixel."""
    left, low, right, high = picture.bbox.padded(1).extents
    return [
        text
        for text, box in words
        if box.x0 < left or box.y0 < low or box.x1 > right or box.y1 > high
    ]


@pytest.mark.parametrize("figure", figures.stated())
def test_a_picture_has_curves_and_names_inside_its_edges_and_apart(drawn, figure):
    """Of every figure, also of one that somebody adds."""
    _, picture = drawn(figure)
    for axes in picture.axes:
        assert axes.has_data() or axes.child_axes
        assert np.isfinite(axes.dataLim.get_points()).all() or not axes.lines
    words = list(words_of(picture))
    inside = [artist for axes in picture.axes for artist in (axes.get_legend(), *axes.texts)]
    assert picture.legends or any(inside)
    assert outside(picture, words) == []
    for place, (text, box) in enumerate(words):
        others = [other for other, room in words[:place] if box.overlaps(room.shrunk(0.9, 0.7))]
        assert others == [], text


def test_a_picture_says_what_has_made_it_and_not_when(first_run):
    for kind in ("svg", "png"):
        content = (first_run[0] / f"figures/fig3.{kind}").read_bytes()
        assert f"planarimpact {planarimpact.__version__}, commit ".encode() in content
        assert b"<dc:date>" not in content and b"Creation Time" not in content


# What published series can have as axes, by the figures of the paper that draw them.
AXES = {
    "fig5": ("incidence [mu v2(0)]", "velocity [mu v2(0)]"),
    "fig6": ("incidence [mu v2(0)]", "velocity [mu v2(0)]"),
    "fig7": ("angle [deg]", "peak_force [m2 Omega S]"),
    "fig8": ("angle [deg]", "peak_force [N]"),
    "fig9": ("angle [deg]", "friction_dissipation [m2 S^2/2]"),
} | dict.fromkeys(("fig3", "fig4"), ("time [t_c]", "velocity [mu v2(0)]"))


@pytest.mark.parametrize("figure", AXES)
def test_a_published_series_is_drawn_with_the_axes_of_a_panel(given, figure):
    """Without an edit of the drawing, and with its name in the legend; one of other axes is not."""
    curves, draw, points = given(figure)
    x, y = np.array([2.0, 6.0]), np.array([0.5, 1.0])
    for axes, count in ((AXES[figure], 1), (("tilt [deg]", AXES[figure][1]), 0)):
        series = house_style.Scatter(True, x, y, (x / 9, y / 9), axes, None, {})
        points["mine/spheres"] = series
        picture = draw(curves)
        (texts,) = (legend.get_texts() for legend in picture.legends)
        assert [text.get_text() for text in texts].count("mine/spheres") == count
        lines = [line.get_xydata() for part in picture.axes for line in part.lines]
        assert sum(np.array_equal(line, np.transpose([x, y])) for line in lines) == count


def shown(figure):
    """What a picture shows: words, and numbers in hundredths of its panel.

    Of a line they are its first and last point and its mean, of an arrow both ends, of all else the
    corners around it.
    """
    figure.draw_without_rendering()
    inside = [legend for axes in figure.axes if (legend := axes.get_legend())]
    legends = (legend.get_texts() for legend in [*figure.legends, *inside])
    for texts in (figure.texts, *legends):
        yield " | ".join(text.get_text() for text in texts), []
    for axes in figure.axes:
        for axis in (axes.xaxis, axes.yaxis):
            ticks = " ".join(text.get_text() for text in axis.get_ticklabels())
            yield f"{axis.get_label_text()}, {axis.get_scale()}: {ticks}", []
        for part in axes.get_children():
            arrow = getattr(part, "arrow_patch", None)
            nothing = isinstance(part, Text) and not (part.get_text() or arrow)
            nothing |= part in (axes.patch, *axes.spines.values())
            if nothing or not isinstance(part, Line2D | Patch | Collection | Text):
                continue
            if isinstance(part, Line2D):
                places = part.get_transform().transform(part.get_xydata())
                places = places[np.isfinite(places).all(axis=1)]
                places = [places[0], places[-1], places.mean(axis=0)]
                looks = part.get_label(), part.get_color(), part.get_linestyle(), part.get_marker()
            elif isinstance(part, Text):
                places, looks = part.get_window_extent().get_points(), [part.get_text()]
                if arrow:
                    places = axes.transData.transform([part.xy, part.xyann])
            else:
                places = part.get_window_extent().get_points()
                colours = [to_hex(colour) for colour in np.atleast_2d(part.get_facecolor())]
                looks = part.get_label(), *colours[:1], part.get_hatch()
            places = axes.transAxes.inverted().transform(places).ravel()
            if part.get_visible() and np.isfinite(places).all():
                yield " ".join(map(str, looks)), [round(100 * place) for place in places.tolist()]


@pytest.mark.parametrize("figure", PAPER)
def test_a_picture_is_the_one_that_was_looked_at(drawn, given, figure):
    """After a change that is meant, delete the figure's picture.yaml, run this, and look.

    A series that came later changes no picture that was looked at: the test above draws it.
    """
    path = figures.folder_of(figure) / "picture.yaml"
    curves, draw, points = given(figure)
    if not path.exists():
        found = [[words, *numbers] for words, numbers in shown(drawn(figure)[1])]
        looked_at = {"series": sorted(points), "shown": found}
        text = yaml.safe_dump(looked_at, default_flow_style=None, width=1000, sort_keys=False)
        path.write_text(text, encoding="utf-8")
    looked_at = reference_data.load_yaml(path)
    picture = draw(curves, {name: points[name] for name in looked_at["series"]})
    found, wanted = list(shown(picture)), looked_at["shown"]
    assert [words for words, _ in found] == [words for words, *_ in wanted]
    for (words, numbers), (_, *places) in zip(found, wanted, strict=True):
        assert numbers == pytest.approx(places, abs=1), words


@pytest.mark.parametrize("figure", figures.with_trait("slide"))
def test_a_slide_has_one_panel_with_all_its_words(given, tmp_path, figure):
    curves, draw, _ = given(figure)
    picture, grounds = draw(curves), (tmp_path / "light.png", tmp_path / "dark.png")
    stated = figures.stated()[figure]["slide"]
    slide.save(picture, **stated, light=grounds[0], dark=grounds[1])
    (panel,) = picture.axes
    words = list(words_of(picture))
    texts = [text for text, _ in words]
    assert not any(re.match(r"\([a-f]\)", text) for text in texts)
    assert {panel.get_xlabel(), panel.get_ylabel()} <= {*texts, ""}
    assert outside(picture, words) == []


def test_other_codes_stand_at_their_ratio_times_the_time_of_our_table(given, first_run):
    """A line reaches from the least to the largest of a code."""
    curves, draw, _ = given("trade")
    rows = pd.read_csv(first_run[0] / "data/other_codes/impacts.csv")
    rows = rows[(rows["restitution [1]"] == 0.8) & (rows["loss"] == "viscous")]
    (table,) = curves[tables.where(curves, model="spheres.viscous", loss="viscous")]["time_100 [s]"]
    error, times, _ = draw(curves).axes
    values = rows["rms_velocity [mu v2(0)]"], rows["times_table [1]"] * table
    for axes, column in zip((error, times), values, strict=True):
        ends = [line.get_xdata() for line in axes.lines if line.get_marker() == "s"]
        for _, own in column.groupby(rows["code"]):
            wanted = sorted({own.min(), own.max()})
            assert any(list(found) == pytest.approx(wanted) for found in ends)


@pytest.mark.parametrize("order", [1, -1])
def test_times_against_the_batch_are_those_of_the_finest_setting(given, order):
    curves, draw, _ = given("trade")
    (axes,) = [axes for axes in draw(curves[::order]).axes if axes.get_title().startswith("(c)")]
    rows = curves[curves["e"] == 1]
    fineness = rows["steps"].fillna(1 / rows["tolerance"]).fillna(0)
    finest = rows.loc[fineness.groupby(rows["model"]).idxmax()].filter(regex="^time")
    wanted = {tuple(row.dropna()) for _, row in finest.iterrows()}
    assert {tuple(line.get_ydata()) for line in axes.lines} <= wanted and len(axes.lines) == 5


def test_the_rod_is_hatched_at_the_tilts_at_which_each_contact_jams(drawn):
    curves, picture = drawn("rod")
    ticks = dict(zip(("lumped", "rigid"), picture.axes[0].get_yticklabels()[1:], strict=True))
    assert [tick.get_text() for tick in ticks.values()] == ["jams", "rigid: jams"]
    jamming = set()
    columns = tables.each(curves, "velocity_ratio", variant="")
    for axes, (_, own) in zip(picture.axes, columns, strict=False):
        bars = [bar for bar in axes.collections if bar.get_hatch()]
        boxes = [path.get_extents() for bar in bars for path in bar.get_paths()]
        for model, tick in ticks.items():
            row = [box for box in boxes if box.y0 < tick.get_position()[1] < box.y1]
            for tilt, jams in tables.select(own, model=model)[["tilt [deg]", "jams [1]"]].values:
                assert any(box.x0 <= tilt <= box.x1 for box in row) == jams, (model, tilt)
                jamming |= {model} if jams else set()
    assert jamming == {*ticks}


# Parts that the drawings share


def test_above_angles_stand_their_tangents():
    axes = house_style.new(2).subplots()
    house_style.angle_axes([axes], (10, 60))
    (top,) = axes.child_axes
    ratios = [float(label.get_text()) for label in top.get_xticklabels()]
    assert len(ratios) == 4 and np.tan(np.radians(top.get_xticks())) == pytest.approx(ratios)
