"""The explorer's curves of the continuum are those of the coarse table of spheres."""

import json
from pathlib import Path

import numpy as np
import pytest

from planarimpact import spheres
from planarimpact.spheres import table
from stronge1994 import plan
from stronge1994.pages import explorer as write_explorer
from stronge1994.plan import config as configuration

ROOT = Path(__file__).parents[2]
SOURCES = sorted((ROOT / "workflow/explorer").iterdir())
ACCURACY = 1e-12
GROUPS = [(3.5, 17 / 14, 1.0), (3.5, 17 / 14, 0.8), (2.5, 1.6, 0.3), (3.0, 1.0, 0.55)]
INCIDENCES = np.linspace(0, 8, 81).tolist()
SOLID = "angle=51&friction=0.5&poisson_ratio=0.3&mass_ratio=3.5"


@pytest.fixture
def coarse(monkeypatch):
    """The table of the page, in place of the fine one."""
    found = table.shipped("coarse")
    monkeypatch.setattr(table, "shipped", lambda name="fine": found)
    return found


def disagreements(tab):
    """Groups whose curves are not those of the package."""
    found = []
    for groups in GROUPS:
        given = dict(zip(("beta", "zeta2", "e"), groups, strict=True))
        curves = tab.evaluate(f"charts.continuum({json.dumps(given)}, {json.dumps(INCIDENCES)})")
        losses = ["elastic"] if groups[2] == 1 else list(spheres.LOSSES)
        assert [curve["style"] for curve in curves] == losses
        for curve in curves:
            loss = "viscous" if groups[2] == 1 else curve["style"]
            wanted = spheres.rebound(INCIDENCES, *groups, loss=loss).velocity
            if np.abs(np.array(curve["ys"]) - wanted).max() > ACCURACY:
                found.append((*groups, loss))
    return found


def test_curves_are_those_of_the_package(show, coarse):
    assert disagreements(show()) == []


def test_a_wrong_table_is_seen(tab, coarse, monkeypatch, tmp_path):
    panels = {
        name: panel._replace(coefficients=panel.coefficients + 2.0**-table.FINE)
        for name, panel in coarse.panels.items()
    }
    monkeypatch.setattr(table, "shipped", lambda name: coarse._replace(panels=panels))
    settings = plan.settings_of_explorer(configuration.load(ROOT))
    page = tmp_path / "wrong.html"
    page.write_text(write_explorer.page(settings, SOURCES), encoding="utf-8")
    monkeypatch.setattr(table, "shipped", lambda name="fine": coarse)
    tab.open(page.as_uri())
    assert len(disagreements(tab)) == 7


def drawn(tab):
    """Curves of the continuum in the chart, and what the legend has."""
    styles = "elastic", "viscous", "plastic"
    lines = [f"document.querySelectorAll('#incidence .{style}').length" for style in styles]
    named = [f"document.getElementById('legend-{style}').hidden ? 0 : 1" for style in styles]
    lines, named = (tab.evaluate(f"[{', '.join(one)}]") for one in (lines, named))
    assert lines == named
    return dict(zip(styles, lines, strict=True))


@pytest.mark.parametrize(
    ("state", "styles", "says"),
    [
        ("restitution=1", {"elastic"}, False),
        ("restitution=0.8", {"viscous", "plastic"}, False),
        ("restitution=0.29", set(), True),
        ("restitution=0.8&mass_ratio=5", set(), True),
        ("restitution=0.29&view=forces", set(), False),
        ("restitution=0.8&view=energy", set(), False),
    ],
)
def test_it_draws_what_the_table_covers_and_says_what_it_does_not(state, styles, says, show):
    tab = show(f"{state}&{SOLID}")
    assert {style for style, count in drawn(tab).items() if count} == styles
    note = "document.getElementById('uncovered')"
    assert tab.evaluate(f"{note}.checkVisibility()") == says
    words = tab.evaluate(f"{note}.textContent")
    bounds = spheres.LEAST_RESTITUTION, spheres.LEAST_RATIO, spheres.LARGEST_RATIO
    assert all(str(bound) in words for bound in bounds)
    tab.evaluate("document.getElementById('continuum').click()")
    assert not any(drawn(tab).values()) and not tab.evaluate(f"{note}.checkVisibility()")
