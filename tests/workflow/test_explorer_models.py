"""The explorer's continuum is that of the package, and the page says where models disagree."""

import json
import math
from pathlib import Path

import numpy as np
import pytest

from planarimpact import Regime, continuum, lumped, rigid
from stronge1994.explorer import page as write_explorer
from tests.workflow.controls import SOLID, click, element, number, text, texts

ROOT = Path(__file__).parents[2]
TOLERANCE = 1e-3  # of the package, small against the errors of the page
GROUPS = [(3.5, 17 / 14, 1.0), (3.5, 17 / 14, 0.8), (10.0, 1.5, 0.3)]


def losses_of(e):
    return ["elastic"] if e == 1 else list(continuum.LOSSES)


def packaged(x, beta, zeta2, e, style):
    loss = "viscous" if style == "elastic" else style
    return continuum.rebound(x, beta, zeta2, e, loss=loss, tolerance=TOLERANCE)


def impacts(loss):
    """Impacts over the sliders and on their thresholds, and where errors were largest."""
    rng = np.random.default_rng(1994)
    names = "restitution", "poisson_ratio", "mass_ratio"
    limits = np.array([write_explorer.LIMITS[name][:2] for name in names], float)
    limits[0, 0] = continuum.LEAST_RESTITUTION
    e, nu, beta = rng.uniform(*limits.T, (60, 3)).T
    zeta2 = (2 - nu) / (2 * (1 - nu))
    x = rng.uniform(0, 1.2, 60) * continuum.slip_throughout_limit(beta, zeta2, e, loss=loss)
    rows = np.transpose([x, beta, zeta2, e]).tolist()
    for zeta2 in (1.0, 1.5):  # nu = 0 and 0.5
        for beta in (1.0, zeta2, 10.0):
            for e in (continuum.LEAST_RESTITUTION, 1 - 1e-9, 1.0):
                limit = continuum.slip_throughout_limit(beta, zeta2, e, loss=loss)
                rows += [(x, beta, zeta2, e) for x in (zeta2, 0.999 * limit, limit)]
    rows += [
        (12.654, 10.0, 1.4511, 0.1),
        (1.4, 8.9585, 1.1089, 0.1),
        (1.3707, 9.572, 1.439, 0.8634),
    ]
    return [tuple(map(float, row)) for row in rows]


@pytest.mark.parametrize("loss", continuum.LOSSES)
def test_one_impact_is_within_the_error_that_the_page_says(loss, show):
    rows = impacts(loss)
    one = f"(row) => {{ const found = continuum.rebound(...row, '{loss}');"
    one += " return [found.velocity, found.peak_friction, found.slides]; }"
    *ours, slides = np.transpose(show().evaluate(f"{json.dumps(rows)}.map({one})"))
    theirs = packaged(*np.transpose(rows), loss)
    errors = np.abs([ours[0] - theirs.velocity, ours[1] - theirs.peak_friction])
    assert errors.max() <= write_explorer.CONTINUUM_ERROR, rows[errors.max(axis=0).argmax()]
    exact = slides.astype(bool) & (theirs.regime == Regime.SLIP_THROUGHOUT)
    assert exact.sum() >= 5 and errors[0, exact].max() < 1e-12


def test_curves_are_within_the_error_that_the_page_says(show):
    tab, x = show(), np.linspace(0, 13, 20)
    for beta, zeta2, e in GROUPS:
        given = json.dumps({"beta": beta, "zeta2": zeta2, "e": e})
        styles = tab.evaluate(f"models.chosen({given}, ['continuum'])")
        assert styles == losses_of(e)
        for style in styles:
            solve = f"(x) => models.curve('{style}', {given})(x)"
            ours = tab.evaluate(f"{json.dumps(x.tolist())}.map({solve})")
            theirs = packaged(x, beta, zeta2, e, style)
            for name in ("velocity", "peak_friction"):
                error = np.abs([one[name] for one in ours] - getattr(theirs, name)).max()
                assert error <= write_explorer.CURVE_ERROR, (beta, zeta2, e, style)
    error = f"its curves over all incidences within {write_explorer.CURVE_ERROR}"
    assert error in tab.evaluate("document.body.textContent").replace("\n", " ")


@pytest.mark.parametrize("x", [1.2, 3.0])
@pytest.mark.parametrize(("e", "style"), [(1.0, "elastic"), (0.7, "viscous"), (0.7, "plastic")])
def test_the_contact_in_time_is_that_of_the_package(x, e, style, show):
    groups = {"x": x, "beta": 3.5, "zeta2": 17 / 14, "e": e, "mu": 0.5}
    fields = "[at.time, at.normal, at.friction, at.velocity, at.radius,"
    # The middle sticks where the first springs do.
    fields += " [...at.slips, 1].findIndex((slip) => slip) / at.slips.length]"
    rows = f"models.contact('{style}', {json.dumps(groups)}).rows"
    time, *ours, stick = np.transpose(show().evaluate(f"{rows}.map((at) => {fields})"))
    loss = None if e == 1 else style
    theirs = continuum.history(x, 3.5, 17 / 14, e, loss=loss, tolerance=TOLERANCE)
    assert abs(time[-1] - theirs.time[-1]) < 1e-3
    names = "normal", "friction", "velocity", "contact_radius"
    for name, column in zip(names, ours, strict=True):
        wanted = np.interp(time, theirs.time, getattr(theirs, name))
        # The contact of a plastic body parts with an infinite slope of its radius.
        inside = time < 0.97 * time[-1] if name == "contact_radius" else slice(None)
        assert np.abs(column - wanted)[inside].max() < 0.02, name
    if style == "viscous":
        return  # rounding decides the radius of stick of the package
    wanted = np.interp(time, theirs.time, theirs.stick_radius)
    # Beyond the edge of the contact springs count as if they stuck.
    stick = np.minimum(stick, ours[3])
    # The radius jumps where all of it begins to stick: not all instants, but nearly all.
    assert np.mean(np.abs(stick - wanted)[1:-1] < 0.05) > 0.97


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
        ("restitution=0.09&view=forces", set()),
    ],
)
def test_it_draws_the_models_that_are_chosen(state, styles, show):
    tab = show(f"angle=51&friction=0.5&{state}{SOLID}")
    assert drawn(tab) == {"lumped", "rigid"} | styles
    assert tab.evaluate(f"{element('uncovered')}.checkVisibility()") == (not styles)
    assert f"from {continuum.LEAST_RESTITUTION} on" in text(tab, "uncovered")
    # The continuum does not fly where it has no answer.
    assert tab.evaluate("Object.keys(page.flights()).length") == (2 if styles else 1)
    for name in ("lumped", "rigid"):
        click(tab, f"model-{name}")
    assert drawn(tab) == styles and tab.evaluate("page.address()").endswith("&models=continuum")
    tab = show(tab.evaluate("page.address()"))
    assert drawn(tab) == styles
    click(tab, "model-continuum")
    assert drawn(tab) == set()
    assert any("No model" in word for word in texts(tab, "#incidence .word"))
    assert text(tab, "agreement") == "No model is chosen: tick one above."


def rebounds(x, beta, nu, e):
    """What the models of the package say, in the order of the page's table."""
    groups = x, beta, (2 - nu) / (2 * (1 - nu)), e
    continua = [packaged(*groups, style) for style in losses_of(e)]
    return [lumped.rebound(*groups), rigid.rebound(x, beta, restitution=e), *continua]


def test_the_page_opens_where_the_models_agree_on_the_direction(show):
    tab = show()
    opening = tab.evaluate("page.impact()")
    x, beta, e = opening["x"], opening["beta"], opening["e"]
    found = rebounds(x, beta, 0.5, e)
    # The rigid limit has no spring: it stops, or slides throughout.
    assert [np.sign(one.velocity) for one in found] == [-1, 0, -1, -1]
    assert text(tab, "agreement").startswith("The models shown agree on the direction.")
    share = f"leaves backwards, with {-100 * found[2].velocity / x:.0f}\u00a0%"
    assert text(tab, "doubt") == "" and share in text(tab, "sentence")
    shown = texts(tab, "#outcomes td")
    errors = [0, 0] + 2 * [write_explorer.CONTINUUM_ERROR]
    mu = math.tan(math.radians(50)) / x
    for k, (one, error) in enumerate(zip(found, errors, strict=True)):
        close = error + 6e-4  # three digits are shown
        velocity, way, friction, lost = shown[4 * k : 4 * k + 4]
        assert abs(number(velocity) - one.velocity) < close
        assert way == ("stops" if one.velocity == 0 else "back")
        assert abs(number(friction) - one.peak_friction) < close
        share = 200 * mu**2 * one.dissipation / (1 + (mu * x) ** 2 / beta)
        assert abs(number(lost) - share) < 0.06 + 100 * error


def said(tab, x, e, more=""):
    address = f"angle={math.degrees(math.atan(0.5 * x))}&friction=0.5&restitution={e}{SOLID}{more}"
    return [text(show_at, name) for show_at in [tab(address)] for name in ("agreement", "doubt")]


def test_it_says_which_models_disagree(show):
    # Below e = 1 small incidences turn round in some models.
    assert [np.sign(one.velocity) for one in rebounds(1.0, 3.5, 0.3, 0.8)] == [-1, 0, -1, 1]
    assert said(show, 1.0, 0.8) == [
        "The models disagree on the direction. Forwards: continuum, plastic. Backwards: the paper’s"
        " lumped model; continuum, viscous. The rigid limit has no spring: it only stops.",
        "Other models say otherwise: see the table.",
    ]
    # x = 4 is above the limit of slip throughout for the lumped model, and below that of continua.
    paper, _, *continua = rebounds(4.0, 3.5, 0.3, 0.5)
    assert paper.regime == Regime.SLIP_THROUGHOUT
    assert all(one.velocity < 0 and one.regime != paper.regime for one in continua)
    assert said(show, 4.0, 0.5, "&models=lumped+continuum")[0] == (
        "The models disagree on slip. Slips throughout: the paper’s lumped model. Also sticks:"
        " continuum, viscous; continuum, plastic."
    )
    # Almost nothing is what the continuum of the page cannot tell from nothing.
    grips = rebounds(1.0, 3.5, 0.3, 1.0)
    assert 0 < abs(grips[2].velocity) < write_explorer.CONTINUUM_ERROR
    assert "Stops, or almost: continuum, elastic." in said(show, 1.0, 1.0)[0]


@pytest.mark.parametrize(("of", "style"), [("lumped", "lumped"), ("continuum", "plastic")])
def test_the_closer_look_and_the_bands_are_those_of_the_chosen_model(of, style, show):
    tab = show(f"angle=45&friction=0.5&restitution=0.5&loss=plastic&of={of}{SOLID}", height=3000)
    solved = packaged if style == "plastic" else lambda x, b, z, e, _: lumped.rebound(x, b, z, e)
    found = solved(2.0, 3.5, 17 / 14, 0.5, style)
    assert abs(number(text(tab, "number-velocity")) - found.velocity) < 0.011
    limit = (continuum if style == "plastic" else lumped).slip_throughout_limit
    more = {"loss": "plastic"} if style == "plastic" else {}
    limit = float(limit(3.5, 17 / 14, 0.5, **more))
    assert abs(number(text(tab, "number-slip")) - limit) < 0.01
    names = set(texts(tab, ".of-model"))
    assert names == {"the paper’s lumped model" if of == "lumped" else "continuum, plastic"}
    assert text(tab, "sentence").lower().startswith(names.pop())
    last = "document.querySelector('#incidence .band.slip')"
    edge, end = tab.evaluate(
        f"[{last}.x.baseVal.value, {last}.x.baseVal.value + {last}.width.baseVal.value]"
    )
    first = tab.evaluate("document.querySelector('#incidence .band').x.baseVal.value")
    assert abs((edge - first) / (end - first) - limit / max(8, 1.25 * limit)) < 0.003
    rows = tab.evaluate(f"{element('diagram-svg')}.classList.contains('row')")
    assert rows == (of == "continuum")
