"""Continua that lose energy, in Figs 6 and 9."""

from pathlib import Path

import numpy as np
import pytest

from stronge1994 import plan, reference_data
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


@pytest.mark.parametrize(
    ("figure", "curves", "drawing"), [("fig6", fig6, draw_fig6), ("fig9", fig9, draw_fig9)]
)
def test_without_models_none_is_solved_or_named(figure, curves, drawing):
    settings = plan.settings(CONFIG, INVENTORY, figure)
    settings |= {"samples": 41, "continua": settings["continua"] | {"models": []}}
    found = curves.curves(**settings)
    assert found and not [name for name in found if name.startswith("continuum")]
    (legend,) = drawing.draw(found, settings, {}).legends
    assert not [text for text in legend.get_texts() if "continuum" in text.get_text()]


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
