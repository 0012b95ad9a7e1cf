"""Parts that the drawings share."""

import numpy as np
import pytest
from matplotlib import font_manager

from stronge1994.figures.shared.curves import measured as models_beside
from stronge1994.figures.shared.drawing import house_style, measured


def test_a_line_has_the_numbers_and_names_of_its_columns():
    axes = house_style.new(2).subplots()
    curves = {"lumped, e = 0.5": {"time [t_c]": np.arange(3.0), "spin_y [rad/s]": np.ones(3)}}
    (name,) = curves
    rows = np.array([True, False, True])
    line = house_style.line(axes, curves, name, "time [t_c]", "spin_y [rad/s]", rows)
    assert line.get_xydata() == pytest.approx(np.array([[0, 1], [1, np.nan], [2, 1]]), nan_ok=True)
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("time, $t_c$", "spin y, rad/s")
    assert line.get_label() == "lumped, $e = 0.5$"


def test_the_letters_are_found_though_a_machine_s_list_of_fonts_lacks_them():
    assert font_manager.findfont(house_style.STYLE["font.family"], fallback_to_default=False)


def test_restitutions_differ_in_their_lines_and_none_is_dotted():
    patterns = [house_style.of_restitution(e) for e in (0, 0.2, 0.5, 0.8, 0.9, 1)]
    assert len(set(patterns)) == len(patterns)
    assert all(dashes == "-" or dashes[1][0] > dashes[1][1] for dashes in patterns)


def measured_series(y):
    """Two points of a quantity against the angle, with a sigma for each."""
    values = {"x": np.array([20.0, 40.0]), "y": np.array([0.1, 0.3])}
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
    figure = measured.draw(curves, {}, points)
    assert [len(axes.lines) - 5 for axes in figure.axes] == [6, 6]  # error bars have five
    with pytest.raises(ValueError, match=r"no column 'spin \[rad/s\]'; the curves have incidence"):
        measured.draw(curves, {}, {"ball/s": measured_series("spin [rad/s]")})
