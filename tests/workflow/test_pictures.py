"""Pictures follow the tables of a run, and what is written in them can be read."""

import importlib
import json
import re

import numpy as np
import pytest
from matplotlib.collections import Collection
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from stronge1994 import csv_tables
from stronge1994.curve_names import is_shifted
from stronge1994.figures.shared import drawing as drawings
from stronge1994.figures.shared.drawing import house_style
from stronge1994.figures.shared.drawing.beside import MODELS, STYLES
from stronge1994.pages import key_numbers
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
# Lines that are computed for the picture: their own labels, or titles of their panels.
COMPUTED = r"limit \$-\\mu F_2|\$F_1/\\mu\$|right of the line|against finite|slip throughout as"
COMPUTED += (
    r"|\(d\) velocity|\(e\) peak|\(f\) diss|stated in the paper|measured|LAMMPS|pooltool|\(d\) \$e"
)
# What the label or the title of a line says if the name of its curve or column has such words.
NAMED = {
    r"lumped\.viscous": "Kelvin–Voigt|lumped, viscous",
    "unloading-stiffness": r"e\^2\\zeta\^2",
    r"lumped(,|\.hyst)": "lumped",
    r"continuum\.viscous": "continuum, viscous",
    r"continuum\.plastic": "continuum, plastic|elastic in shear",
    "continuum(,|$)": "continuum|stick|contact|F",
    "rubber": "rubber",
    "as printed": "as printed",
    "no solution": "no solution",
    "no tang": "no tang",
    "Newton": "Newton",
    "rigid, v": "rigid impulse",
    "normal": r"normal|F_2|loading|v_2|\$x|compliant|rigid",
    "friction_f|^friction": r"tangential|F_1|\$x",
    "before": "usual",
    "after": "fitted",
    "hooke": "linear springs",
    "hertz": "Hertz",
    "stick_": "stick",
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


def drawn(picture):
    """Lines with labels, and what the labels, titles and axes say."""
    for axes in picture.axes:
        for line in axes.lines:
            if not line.get_label().startswith("_"):
                yield line, " ".join([line.get_label(), axes.get_title(), axes.get_ylabel()])


def curves_of(line, curves):
    """Curves, and columns of them, that a line shows, where it has no gap."""
    x, y = line.get_xydata().T
    for name, curve in curves.items():
        alike = {c: v for c, v in curve.items() if v.dtype.kind == "f" and v.shape == x.shape}
        same = [column for column, values in alike.items() if np.array_equal(values, x)]
        for column, values in alike.items() if same else ():
            if np.array_equal(values[~np.isnan(y)], y[~np.isnan(y)]) and same != [column]:
                yield name, column


def agrees(words, name, column):
    """Whether words about a line tell the model, the column and the values of its curve."""
    said = [
        re.search(told, words)
        for part, told in NAMED.items()
        if re.search(part, f"{name}, {column}")
    ]
    for symbol, value in re.findall(r"(\w+) = ([\d.]+)", name):
        stated = re.findall(rf"\b{symbol} = ([\d., to$]*\d)", words)
        said.append(not stated or value in re.findall(r"[\d.]+", " ".join(stated)))
    return all(said)


def shown(picture):
    return b"".join(np.asarray(part).tobytes() for part in numbers(picture))


class Watched(dict):
    """Columns of a curve, which know whether a picture has asked for them."""

    asked = False

    def __getitem__(self, column):
        self.asked = True
        return super().__getitem__(column)


@pytest.mark.parametrize("most", [2, pytest.param(1000, marks=pytest.mark.long)])
@pytest.mark.parametrize("figure", figures.stated())
def test_a_picture_shows_every_curve_of_its_table(given, figure, most):
    """It asks for each, and looks different if the numbers of one change: `long` tries all."""
    curves, draw = given(figure)
    watched = {name: Watched(curve) for name, curve in curves.items()}
    picture = draw(watched)
    before = shown(picture)
    for line, words in drawn(picture):
        found = list(curves_of(line, curves))
        assert found or re.search(COMPUTED, words), words
        assert not found or any(agrees(words, *curve) for curve in found), (words, found)
    compared = NOT_DRAWN.get(figure, "^$")
    names = [n for n in curves if not is_shifted(n) and not re.search(compared, n)]
    assert [name for name in names if not watched[name].asked] == []
    places = np.linspace(0, len(names) - 1, min(most, len(names)))
    for name in [names[round(place)] for place in places]:
        curve = curves[name]
        changed = {c: v * 1.01 if v.dtype.kind == "f" else v for c, v in curve.items()}
        assert shown(draw(curves | {name: changed})) != before, name


def test_other_codes_stand_at_their_ratio_times_the_time_of_our_table(given, first_run):
    curves, draw = given("trade")
    case = ("0.8", "viscous")
    rows = csv_tables.read_rows(first_run[0] / "data/other_codes/impacts.csv")
    ours = curves["spheres.viscous, e = 0.8, viscous"]["time_100 [s]"][0]
    wanted = [
        (ours * float(row["times_table [1]"]), float(row["rms_velocity [mu v2(0)]"]))
        for row in rows
        if (row["restitution [1]"], row["loss"]) == case
    ]
    lines = [line for axes in draw(curves).axes for line in axes.lines]
    named = [line for line in lines if line.get_label() in ("LAMMPS", "pooltool")]
    points = np.vstack([line.get_xydata() for line in named])
    assert len(wanted) == 11
    for point in wanted:
        assert np.isclose(points, point, rtol=1e-9).all(axis=1).any(), point


def test_friction_reaches_its_limit_where_a_contact_slips_and_never_exceeds_it(given):
    for figure, friction, limit in (("fig4", "$F_1/", "limit"), ("rod", "$F_1/", "$F_2$")):
        curves, draw = given(figure)
        lines = [
            next(line for line, words in drawn(draw(curves)) if words.startswith(start))
            for start in (friction, f"added here: {limit}" if figure == "fig4" else limit)
        ]
        left = np.abs(lines[1].get_ydata()) - np.abs(lines[0].get_ydata())
        assert left.min() > -1e-9 and np.sum(left < 1e-9) > 20, figure


def test_a_trial_lies_right_of_the_line_where_a_model_differs(given, first_run):
    curves, draw = given("inelastic")
    numbers = key_numbers.read(first_run[0] / "results/key_numbers.csv")
    axes = draw(curves).axes[2]
    trials = [label.get_text() for label in axes.get_yticklabels()]
    for model, line in zip(MODELS, axes.lines, strict=False):
        for over, row in line.get_xydata():
            trial = trials[round(row)]
            name = f"pairs.{model}" + ("" if trial == "as judged" else f".{trial}")
            assert (over >= 1) == (numbers[f"{name}.p"] <= 0.01), name
        assert line.get_label() == STYLES[model]["label"]


def test_the_rod_of_the_sketch_leans_back_by_its_tilt(given):
    """A tip that is ahead of the centre has a positive tilt, and moves to the right."""
    curves, draw = given("rod")
    axes = next(axes for axes in draw(curves).axes if "tilt $" in axes.get_xlabel())
    (x, y) = max(axes.lines, key=Line2D.get_linewidth).get_xydata()[-1]
    tilt, ratio = (float(v) for v in re.findall(r"= ([-\d.]+)", axes.get_xlabel()))
    assert np.degrees(np.arctan2(-x, y)) == pytest.approx(tilt)
    assert np.sign(axes.texts[1].xy[0] - axes.texts[1].xyann[0]) == np.sign(ratio)


# Parts that the drawings share


def test_a_line_has_the_numbers_and_names_of_its_columns():
    axes = house_style.new(2).subplots()
    curves = {"lumped, e = 0.5": {"time [t_c]": np.arange(3.0), "spin_y [rad/s]": np.ones(3)}}
    rows = np.array([True, False, True])
    line = house_style.line(axes, curves, *curves, "time [t_c]", "spin_y [rad/s]", rows)
    assert line.get_xydata() == pytest.approx(np.array([[0, 1], [1, np.nan], [2, 1]]), nan_ok=True)
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("time, $t_c$", "spin y, rad/s")
    assert line.get_label() == "lumped, $e = 0.5$"


def test_points_have_the_errors_of_their_axes():
    axes = house_style.new(2).subplots()
    series = {"x": [3.0], "y": [5.0], "sigma": (0.25, 2.0)}
    columns = {"axes": ("time [t_c]", "spin_y [rad/s]")}
    bars = house_style.measured(axes, series | columns)
    across, along = (bar.get_segments()[0] for bar in bars.lines[2])
    assert across.tolist() == [[2.75, 5], [3.25, 5]] and along.tolist() == [[3, 3], [3, 7]]
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("time, $t_c$", "spin y, rad/s")


def test_above_angles_stand_their_tangents():
    axes = house_style.new(2).subplots()
    house_style.angle_axes([axes], (10, 60))
    (top,) = axes.child_axes
    for part, scale in ((top, lambda at: np.tan(np.radians(at))), (axes, float)):
        ticks = {
            float(re.sub(r"[^\d.]", "", t.get_text())): t.get_position()[0]
            for t in part.get_xticklabels()
        }
        assert [scale(at) for at in ticks.values()] == pytest.approx(list(ticks))
        assert len(ticks) >= 2 and 10 <= min(ticks.values()) <= max(ticks.values()) <= 60
