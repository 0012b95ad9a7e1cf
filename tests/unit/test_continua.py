"""Continua that lose energy, in Figs 5, 6 and 9."""

from pathlib import Path

import numpy as np
import pytest

from planarimpact import models
from stronge1994 import plan, reference_data
from stronge1994.curve_names import CONTINUA
from stronge1994.figures.fig5 import curves as fig5
from stronge1994.figures.fig6 import curves as fig6
from stronge1994.figures.fig6 import drawing as draw_fig6
from stronge1994.figures.fig9 import curves as fig9
from stronge1994.figures.fig9 import drawing as draw_fig9
from stronge1994.judging.metrics import measure
from stronge1994.plan import config as configuration

ROOT = Path(__file__).parents[2]
CONFIG = configuration.load(ROOT)
INVENTORY = reference_data.load_all(
    ROOT / "data", reference_data.load_yaml(ROOT / "workflow/schemas/source.schema.yaml")
)
FIGURES = {"fig6": (fig6, draw_fig6), "fig9": (fig9, draw_fig9)}
COARSE = {"fig5": {"samples": 81, "tolerance": 1e-2, "loss_tolerance": 1e-2, "uncertainty": {}}}


def settings_of(figure, **change):
    """Settings of the config, solved coarsely."""
    settings = plan.settings(CONFIG, INVENTORY, figure)
    if "continua" in settings:
        own = {"tolerance": 1e-2} | change
        settings |= {"samples": 41, "continua": settings["continua"] | own}
    return settings | COARSE.get(figure, {})


@pytest.mark.parametrize("figure", ["fig6", "fig9"])
def test_without_models_none_is_solved_or_named(figure):
    settings = settings_of(figure, models=[])
    curves, draw = FIGURES[figure]
    found = curves.curves(**settings)
    assert not [name for name in found if name.startswith("continuum")]
    (legend,) = draw.draw(found, settings, {}).legends
    assert not [text for text in legend.get_texts() if "continuum" in text.get_text()]
    more = curves.curves(**settings_of(figure))
    assert {name.split(",")[0] for name in more if name not in found} == set(CONTINUA)
    assert [name for name in more if name in found] == list(found)


def test_the_shots_lose_energy_as_the_source_says():
    """e of the source, not 1: the elastic continuum is 0.05 mu v2(0) away."""
    settings = settings_of("fig5")
    named, sphere = fig5.curves(**settings), settings["experiment"]
    assert sphere["restitution"] < 1 and "continuum, experiment" not in named
    groups = [sphere[key] for key in ("mass_ratio", "stiffness_ratio")]
    for model in CONTINUA:
        curve = named[f"{model}, experiment"]
        x, w = curve["incidence [mu v2(0)]"], curve["velocity [mu v2(0)]"]
        found = models.rebound(model, x, *groups, sphere["restitution"], tolerance=1e-2)
        assert np.array_equal(w, found.velocity)
        elastic = models.rebound("continuum", x, *groups, tolerance=1e-2).velocity
        assert np.max(np.abs(w - elastic)) > 0.05


def test_a_contraction_is_of_the_curves_that_it_names():
    """Neighbours of one curve leave further apart than they arrive."""
    x = np.array([0.0, 1.0, 2.0])
    curves = {
        "e = 0.5": {"x": x, "w": 0.5 * x},
        "continuum.viscous, e = 0.5": {"x": x, "w": 1.5 * x},
    }
    entry = {"metric": "contraction", "columns": ["x", "w"]}
    for beginning, worst in (("e = ", 0.0), ("continuum", 0.5), ("", 0.5)):
        found = measure(entry | {"beginning": beginning}, None, curves)
        assert np.max(found.residuals.sigmas) == worst
    with pytest.raises(ValueError, match="no curve has the columns"):
        measure(entry | {"beginning": "lumped"}, None, curves)
