"""The figure `study`: its grids, and what its maps show."""

import re

import numpy as np
import pytest

from planarimpact import Regime, lumped
from stronge1994.figures.study import curves as study
from stronge1994.figures.study import drawing

SETTINGS = {
    "mass_ratio": 3.5,
    "incidence": [0.0, 8.0],
    "restitution": [0.2, 1.0],
    "stiffness_ratio": [0.5, 1.21],
    "samples": 9,
    "restitutions": 5,
}


def test_every_point_of_a_grid_is_that_impact():
    """Solved alone, by its coordinates: no axis is swapped, no point is shifted."""
    named = study.curves(**SETTINGS, nodes={"incidence": [0.3, 9.0]})
    assert list(named) == ["zeta^2 = 0.5", "zeta^2 = 1.21"]
    for zeta2, columns in zip(SETTINGS["stiffness_ratio"], named.values(), strict=True):
        columns = {name.split(" [")[0]: values for name, values in columns.items()}
        assert columns["velocity"].shape == (10 * 5,)
        for point in range(10 * 5):
            x, e = columns["incidence"][point], columns["restitution"][point]
            alone = lumped.rebound(x, 3.5, zeta2, e)
            for name in ("velocity", "peak_friction", "dissipation"):
                assert columns[name][point] == pytest.approx(getattr(alone, name), abs=1e-14)
            assert columns["regime"][point] == Regime(int(alone.regime)).name
    assert sorted(set(columns["incidence"])) == [0, 0.3, *range(1, 9)]
    assert sorted(set(columns["restitution"].round(12))) == [0.2, 0.4, 0.6, 0.8, 1]


@pytest.mark.parametrize("ratios", [[1.0], [1.0, 2.0], [1.0, 2.0, 3.0, 4.0, 5.0]])
def test_there_is_a_map_for_every_stiffness_ratio(ratios):
    settings = SETTINGS | {"stiffness_ratio": ratios}
    curves = drawing.drawn_curves(study.curves(**settings), settings, {})
    figure = drawing.draw(curves, settings, {})
    figure.draw_without_rendering()
    titles = [panel.get_title() for panel in figure.axes if panel.get_title()]
    assert [float(re.search(r"([\d.]+)$", title)[1]) for title in titles] == ratios


def map_of(velocity, regime):
    """The panel of a map over incidence and restitution, which have a cell for each value."""
    columns, rows = velocity.shape
    x, e = np.meshgrid(np.arange(float(columns)), np.linspace(0, 1, rows))
    columns = {drawing.X: x, drawing.E: e, drawing.VELOCITY: velocity.T}
    columns |= {"regime": Regime.names(regime.T)}
    curve = {name: values.ravel() for name, values in columns.items()}
    return drawing.draw({"a map": curve}, {}, {}).axes[0]


def _is_hatched(artist):
    return any(getattr(artist, "hatches", None) or [])


def test_a_map_shows_where_velocity_is_negative_without_colours():
    velocity = np.linspace(-1, 1, 20)[:, None] * np.ones(20)
    regime = np.full((20, 20), Regime.STICK_SLIP)
    (hatched,) = map_of(velocity, regime).findobj(_is_hatched)
    (area,) = hatched.get_paths()
    assert area.get_extents().intervalx.tolist() == [0, 9.5]
    assert not map_of(velocity + 2, regime).findobj(_is_hatched)


def test_a_map_names_a_regime_where_there_is_room_and_draws_a_boundary_once():
    regime = np.full((40, 40), Regime.SLIP_THROUGHOUT)
    regime[:20] = Regime.STICK_SLIP
    regime[20:22] = Regime.SLIP_STICK_SLIP  # a line, but no room for a name
    regime[:1] = Regime.STICK  # the edge of the grid: neither
    panel = map_of(np.ones((40, 40)), regime)
    assert [text.get_text() for text in panel.texts] == ["stick-\nslip", "slip\nthroughout"]
    paths = [path for lines in panel.collections[1:] for path in lines.get_paths()]
    places = [path.vertices[:, 0] for path in paths]
    assert [np.ptp(place) < 1e-9 for place in places] == [True, True]
    assert [place[0] for place in places] == pytest.approx([19.5, 21.5], abs=0.1)
