"""Pictures show only numbers of their tables, and what is written in them can be read."""

import importlib
import types
from pathlib import Path

import numpy as np
import pytest
from matplotlib import font_manager
from matplotlib.colors import to_rgba
from matplotlib.transforms import Affine2D

from stronge1994.figures.shared import drawing as drawings
from stronge1994.figures.shared.curves import measured as models_beside
from stronge1994.figures.shared.drawing import checked, house_style, measured, slide
from stronge1994.figures.shared.drawing import words as meanings
from stronge1994.figures.shared.drawing.checked import NotInTable
from tests.unit import picture_tables


def peers(module, below=False):
    curves, settings, _ = picture_tables.given("trade")
    codes = ("LAMMPS mindlin", 0.4, 2e-5), ("pooltool", 0.08, 1e-4)
    rows = {f"{code}, e = 1": picture_tables.row(code, *more) for code, *more in codes}
    for e in (0.9, 0.5):
        for loss in ("viscous", "plastic"):
            own = {"loss": loss, "restitution [1]": e}
            law = "LAMMPS mindlin, viscoelastic, xt = 0"
            rows[f"{law}, e = {e:g}, {loss}"] = picture_tables.row(law, 1.1 - e, 1e-5, **own)
            paper = "lumped.hysteretic"
            rows[f"{paper}, e = {e:g}, {loss}"] = picture_tables.row(paper, 1 - e, 1e-5, **own)
    return module.draw_errors(rows) if below else module.draw(curves, rows, settings)


OTHERS = {
    "peers": peers,
    "peers_errors": lambda module: peers(module, below=True),
}
PLACES = {
    "fig3": "shared.drawing.histories",
    "peers": "trade.draw_peers",
}
FIGURES = (*picture_tables.SOLVED, *picture_tables.MADE_UP, *OTHERS)


def drawn(figure, *fault):
    """A picture, its tables and words; with a fault, two texts, by a module that has the second."""
    name = figure.removesuffix("_errors")
    module = importlib.import_module(f"stronge1994.figures.{PLACES.get(name, f'{name}.drawing')}")
    if fault:
        old, new = fault
        text = Path(module.__file__).read_text(encoding="utf-8")
        assert old in text
        module = types.ModuleType(module.__name__)
        exec(compile(text.replace(old, new, 1), name, "exec"), module.__dict__)
    if figure in OTHERS:
        return *OTHERS[figure](module), meanings.of(module)
    return *drawings.drawn(module, *picture_tables.given(figure)), meanings.of(module)


@pytest.mark.parametrize("figure", FIGURES)
def test_a_picture_shows_numbers_of_its_tables(figure):
    picture, tables, own = drawn(figure)
    checked.check(picture, tables, figure, own)


PLOT = "axes.plot(curve[X], curve[Y]"
FAULTS = [
    ("fig2", "line[DEFLECTION], line[FORCE], **house", "line[FORCE], line[DEFLECTION], **house"),
    ("fig2", 'xlabel="normal deflection $u_2$"', 'xlabel="normal force $F_2$"'),
    ("fig2", "(*zip(origin, peak, end", "(*zip(origin, peak, (0.5, 0)"),
    ("fig3", "columns[FRICTION], linestyle", "1.2 * columns[FRICTION], linestyle"),
    ("fig3", "time, columns[LIMIT]", "time, -columns[LIMIT]"),
    ("fig3", "row + 0.5, end - start, 0.76, start", "row + 0.5, end - start, 0.76, start + 0.1"),
    ("fig3", "axes.annotate(house_style.symbols(name)", 'axes.annotate("$e = 0.7$"'),
    ("fig5", PLOT, PLOT.replace("curve[Y]", "1.2 * curve[Y]")),
    ("fig5", PLOT, PLOT + ', drawstyle="steps-post"'),
    ("fig5", PLOT, "axes.plot(curve[X][::16], curve[Y][::16]"),
    ("fig5", "axes.set(xlim", "axes.yaxis.set_major_formatter('{x:g}0'), axes.set(xlim"),
    ("fig5", 'axes, curves["lumped"], lumped', 'axes, curves["continuum"], lumped'),
    ("fig5", '"elastic continuum, computed here"', '"no tangential compliance"'),
    ("fig5", 'curve[Y][lowest]), (0, -4)', '-curve[Y][lowest]), (0, -4)'),
    ("fig6", PLOT, PLOT.replace("curve[Y]", "-curve[Y]")),
    ("fig6", 'house_style.symbols(name("e", e))))', 'house_style.symbols(name("e", 1 - e))))'),
    ("fig6", 'curve = curves[name("e", e)]', 'curve = curves[name("e", 1 - e)]'),
    ("fig7", PLOT, PLOT.replace("curve[X]", "90 - curve[X]")),
    ("fig7", "sliding[X], sliding[Y]", "sliding[X], sliding[Y] / 2"),
    ("fig7", 'lines.append((f"{mu:g}"', 'lines.append((f"{2 * mu:g}"'),
    ("fig8", "friction[X], friction[Y], label", "friction[X], 2 * friction[Y], label"),
    ("fig8", "normal[X], normal[Y], label", "friction[X], friction[Y], label"),
    ("fig8", 'text = rf"{angle:.1f}', 'text = rf"{angle + 5:.1f}'),
    ("fig9", "curves[pair][Y], **style", "curves[pair][Y] / 2, **style"),
    ("fig9", 'symbols(name("mu", mu)), **style', 'symbols(name("mu", 2 * mu)), **style'),
    ("micro_slip", "curve[TIME], curve[STICK]", "curve[TIME], 1 - curve[STICK]"),
    ("micro_slip", 'key("stick"', 'key("contact"'),
    ("inelastic", "curve[X], curve[W]", "curve[X], -curve[W]"),
    ("inelastic", "order], high[BETA_0][order]", "order], 2 * high[BETA_0][order]"),
    ("inelastic", "[OVER_LIMIT], [height]", "[OVER_LIMIT] / 2, [height]"),
    ("inelastic", "house_style.key(model.label", "house_style.key(model.label[::-1]"),
    ("rubber_sphere", "curve[X], curve[E_T]", "curve[X], -curve[E_T]"),
    ("rubber_sphere", "axes.plot([near]", "axes.plot([near / 2]"),
    ("rubber_sphere", "ends[E_T][pair], **HALF", "2 * ends[E_T][pair], **HALF"),
    ("rubber_sphere", 'series["x"], series["y"], yerr=y', 'series["x"], -series["y"], yerr=y'),
    ("rubber_sphere", "house_style.key(model.label", "house_style.key(model.label[::-1]"),
    ("rod", "compliant[TILT], compliant[column]", "compliant[TILT], -compliant[column]"),
    ("rod", "contact[TIME], contact[OVER_MU]", "contact[TIME], -contact[OVER_MU]"),
    ("rod", "1, energy, where", "1, energy / 2, where"),
    ("rod", "axes.barh(0.5, end - start, 0.8, start", "axes.barh(0.5, end - start, 0.8, -end"),
    ("stability", 'table["digits [1]"], **MARK', '16 - table["digits [1]"], **MARK'),
    ("stability", "[MEDIAN].reshape(shape)", "[MEDIAN].reshape(shape)[::-1]"),
    ("superball", "_plain(spin)} rad/s", "_plain(-spin)} rad/s"),
    ("superball", "height = path[PLACE]", "height = -path[PLACE]"),
    ("superball", "arrow[PLACE], arrow[HEIGHT]", "-arrow[PLACE], arrow[HEIGHT]"),
    ("trade", "axes.plot(*at,", "axes.plot(at[0], 2 * at[1],"),
    ("trade", "axes.loglog(batch, time", "axes.loglog(batch, time / 2"),
    ("trade", 'Family("lumped, as in the paper"', 'Family("Mindlin, rescaled"'),
    ("peers", "at = time, row", "at = 2 * time, row"),
    ("peers_errors", "axes.plot(error, height", "axes.plot(error / 2, height"),
    ("peers_errors", 'f"$e = {e:g}$", line', 'f"$e = {1.4 - e:g}$", line'),
]  # fmt: skip


@pytest.mark.parametrize(("figure", "old", "new"), FAULTS)
def test_a_picture_that_shows_something_else_is_seen(figure, old, new):
    """The message names the figure and what is wrong."""
    with pytest.raises(NotInTable, match=rf"^{figure}: (panel|the legend|Line2D)"):
        picture, tables, own = drawn(figure, old, new)
        checked.check(picture, tables, figure, own)


def test_what_stands_elsewhere_than_its_numbers_say_is_seen():
    figure, tables, own = drawn("fig2")
    line = figure.axes[1].lines[-1]
    line.set_transform(Affine2D().scale(1, 2) + figure.axes[1].transData)
    with pytest.raises(NotInTable, match="fig2: Line2D does not stand where its numbers say"):
        checked.check(figure, tables, "fig2", own)


@pytest.fixture(scope="module", params=picture_tables.PAPER)
def picture(request):
    figure, *_ = drawn(request.param)
    figure.draw_without_rendering()
    return figure


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


def test_nothing_written_lies_on_something_else_or_is_cut_off(picture):
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


WITH_SLIDE = [path.parent.name for path in Path(drawings.__file__).parents[2].glob("*/slide.py")]


@pytest.mark.parametrize("figure", WITH_SLIDE)
def test_a_slide_can_be_read_from_the_back_of_a_room(figure):
    """On both grounds: nothing outside the canvas, and no index below 24 pixels."""
    pictures = drawings.slides(figure, *picture_tables.given(figure))
    for name, picture in pictures.items():
        assert picture.get_facecolor() == to_rgba(slide.GROUNDS[name].paper)
        picture.draw_without_rendering()
        assert picture.bbox.size.tolist() == [1920, 1080]
        written = [text for text in [*picture.texts, *texts(picture)] if text.get_text()]
        for text in written:
            index = 0.7 if "$" in text.get_text() and text.get_parse_math() else 1
            assert index * text.get_fontsize() >= 24, text
            box = text.get_window_extent()
            assert box.x0 >= 0 and box.x1 <= 1920 and box.y0 >= 0 and box.y1 <= 1080, text


def test_the_letters_are_found_though_a_machine_s_list_of_fonts_lacks_them():
    assert font_manager.findfont(house_style.STYLE["font.family"], fallback_to_default=False)


def test_restitutions_differ_in_their_lines_and_none_is_dotted():
    patterns = [house_style.of_restitution(e) for e in (0, 0.2, 0.5, 0.8, 0.9, 1)]
    assert len(set(patterns)) == len(patterns)
    assert all(dashes == "-" or dashes[1][0] > dashes[1][1] for dashes in patterns)


def measured_series(y):
    """Two points of a quantity against the angle, with a sigma for each."""
    values = {"x": np.array([20.0, 40.0]), "y": np.array([0.1, 0.3]), "line": False}
    return values | {"sigma": (0.4, np.array([0.02, 0.05])), "axes": ("angle [deg]", y)}


def test_each_measured_series_has_a_panel_with_every_model():
    sphere = {"mass_ratio": 3.5, "stiffness_ratio": 1.2, "restitution": 0.99, "friction": 0.2}
    models = [
        "rigid",
        "laws.smith",
        "laws.brach",
        "lumped.viscous",
        "spheres.viscous",
        "spheres.plastic",
    ]
    curves = models_beside.curves(sphere, models, 40, 1e-3, {"restitution": 0.02})
    shares = "tangential_restitution [1]", "centre_restitution [1]"
    points = {f"ball/{name[0]}": measured_series(name) for name in shares}
    figure, known = drawings.drawn(measured, curves, {}, points)
    checked.check(figure, known, "ball")
    assert [len(axes.lines) - 5 for axes in figure.axes] == [6, 6]  # error bars have five
    with pytest.raises(ValueError, match=r"no column 'spin \[rad/s\]'; the curves have incidence"):
        drawings.drawn(measured, curves, {}, {"ball/s": measured_series("spin [rad/s]")})
