"""The explorer's models are those of the package, and it says where they disagree."""

import json
import math
from pathlib import Path

import numpy as np
import pytest

from planarimpact import Regime, export, lumped, rigid, spheres
from planarimpact.spheres import table
from stronge1994 import plan
from stronge1994.explorer import page as write_explorer
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
        curves = tab.evaluate(
            f"models.chosen({json.dumps(given)}, ['continuum']).map(({{ style, solve }}) =>"
            f" [style, {json.dumps(INCIDENCES)}.map((x) => Object.values(solve(x)).slice(0, 3))])"
        )
        losses = ["elastic"] if groups[2] == 1 else list(spheres.LOSSES)
        assert [style for style, _ in curves] == losses
        for style, ours in curves:
            loss = "viscous" if groups[2] == 1 else style
            wanted = np.transpose(spheres.rebound(INCIDENCES, *groups, loss=loss)[:3])
            if np.abs(np.array(ours) - wanted).max() > ACCURACY:
                found.append((*groups, loss))
    return found


def test_curves_are_those_of_the_package(show, coarse):
    assert disagreements(show()) == []


def test_a_wrong_table_is_seen(tab, coarse, monkeypatch, tmp_path):
    step = 2.0**-coarse.exponent
    panels = {
        name: panel._replace(velocity=panel.velocity + step, peak=panel.peak + step)
        for name, panel in coarse.panels.items()
    }
    monkeypatch.setattr(table, "shipped", lambda name: coarse._replace(panels=panels))
    settings = plan.settings_of_explorer(configuration.load(ROOT))
    page = tmp_path / "wrong.html"
    page.write_text(write_explorer.page(settings, SOURCES, []), encoding="utf-8")
    monkeypatch.setattr(table, "shipped", lambda name="fine": coarse)
    tab.open(page.as_uri())
    assert len(disagreements(tab)) == 7


def drawn(tab):
    """Models whose curve, point and row of the table the page has."""
    lists = tab.evaluate(
        "['#incidence polyline.curve', '#incidence .present', '#outcomes tbody .ink'].map((all) =>"
        " [...document.querySelectorAll(all)].map((e) => e.getAttribute('class').split(' ')[1]))"
    )
    assert sorted(lists[0]) == sorted(lists[1]) == sorted(lists[2])
    return set(lists[2])


@pytest.mark.parametrize(
    ("state", "styles"),
    [
        ("restitution=1", {"elastic"}),
        ("restitution=0.8&view=energy", {"viscous", "plastic"}),
        ("restitution=0.29&view=forces", set()),
        ("restitution=0.8&mass_ratio=5", set()),
    ],
)
def test_it_draws_the_models_that_are_chosen(state, styles, show):
    tab = show(f"{state}&{SOLID}")
    assert drawn(tab) == {"lumped", "rigid"} | styles
    note = "document.getElementById('uncovered')"
    assert tab.evaluate(f"{note}.checkVisibility()") == (not styles)
    words = tab.evaluate(f"{note}.textContent")
    bounds = spheres.LEAST_RESTITUTION, spheres.LEAST_RATIO, spheres.LARGEST_RATIO
    assert all(str(bound) in words for bound in bounds)
    for name in ("lumped", "rigid"):
        tab.evaluate(f"document.getElementById('model-{name}').click()")
    assert drawn(tab) == styles and tab.evaluate("page.address()").endswith("&models=continuum")
    tab = show(tab.evaluate("page.address()"))
    assert drawn(tab) == styles
    tab.evaluate("document.getElementById('model-continuum').click()")
    assert drawn(tab) == set() and not tab.evaluate(f"{note}.checkVisibility()")


def rebounds(state):
    """What the models of the package say of a state of the controls."""
    x = math.tan(math.radians(state["angle"])) / state["friction"]
    nu, beta, e = (state[name] for name in ("poisson_ratio", "mass_ratio", "restitution"))
    groups = x, beta, (2 - nu) / (2 * (1 - nu)), e
    continua = [spheres.rebound(*groups, loss=loss) for loss in spheres.LOSSES]
    return [lumped.rebound(*groups), rigid.rebound(x, beta, restitution=e), *continua]


def test_the_page_opens_where_the_models_agree_on_the_direction(show):
    settings = plan.settings_of_explorer(configuration.load(ROOT))
    found = rebounds(write_explorer.presets(settings)["fig4"])
    # The rigid limit has no spring: it stops, or slides throughout.
    assert [np.sign(one.velocity) for one in found] == [-1, 0, -1, -1]
    tab = show()
    told = "['agreement', 'doubt', 'sentence'].map((id) => document.getElementById(id).textContent)"
    agreement, doubt, sentence = tab.evaluate(told)
    assert agreement.startswith("The models shown agree on the direction.") and doubt == ""
    assert "leaves backwards" in sentence
    shown = tab.evaluate("[...document.querySelectorAll('#outcomes td')].map((e) => e.textContent)")
    errors = 0, 0, max(export.TABLES)  # of the page's table
    for k, (one, error) in enumerate(zip(found, errors, strict=False)):
        close = error + 6e-4  # three digits are shown
        velocity, way, friction, _ = shown[4 * k : 4 * k + 4]
        velocity = velocity.replace("\u2212", "-")
        assert abs(float(velocity) - one.velocity) < close
        assert way == ("stops" if one.velocity == 0 else "back")
        assert abs(float(friction) - one.peak_friction) < close


def test_it_says_which_models_disagree(show):
    settings = plan.settings_of_explorer(configuration.load(ROOT))
    presets = write_explorer.presets(settings)
    # Below e = 1 small incidences turn round in some models: x = 1, e = 0.8.
    state = {"angle": math.degrees(math.atan(0.5)), "friction": 0.5, "restitution": 0.8}
    state |= {"poisson_ratio": 0.3, "mass_ratio": 3.5}
    velocities = [one.velocity for one in rebounds(state)]
    assert np.sign(velocities).tolist() == [-1, 0, -1, 1]
    said = "['agreement', 'doubt'].map((id) => document.getElementById(id).textContent)"
    agreement, doubt = show(write_explorer.address(state)).evaluate(said)
    assert agreement == (
        "The models disagree on the direction. Forwards: continuum, plastic. Backwards: lumped;"
        " continuum, viscous. The rigid limit has no spring: it only stops."
    )
    assert doubt == "Other models say otherwise: see the table."
    # x = 4 is above the limit of slip throughout for the lumped model, and below that of continua.
    state = {"angle": math.degrees(math.atan(2)), "friction": 0.5, "restitution": 0.5}
    state |= {"poisson_ratio": 0.3, "mass_ratio": 3.5}
    paper, _, *continua = rebounds(state)
    assert paper.regime == Regime.SLIP_THROUGHOUT
    assert all(one.velocity < 0 and one.regime != paper.regime for one in continua)
    address = f"{write_explorer.address(state)}&models=lumped+continuum"
    assert show(address).evaluate(said)[0] == (
        "The models disagree on slip. Slips throughout: lumped. Also sticks: continuum, viscous;"
        " continuum, plastic."
    )
    # About 0 is what the table cannot tell from 0.
    grips = rebounds(presets["fig3"])
    assert 0 < abs(grips[2].velocity) < 0.002
    agreement, _ = show(write_explorer.address(presets["fig3"])).evaluate(said)
    assert "Stops, or almost: continuum, elastic." in agreement
