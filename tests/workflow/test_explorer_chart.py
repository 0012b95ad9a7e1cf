"""The chart of the explorer and the numbers that it saves are those of the package."""

import io
import json
import re

import numpy as np
import pandas as pd
import pytest

from planarimpact import continuum, lumped, rigid
from tests.workflow import node

SOLID = 3.5, 17 / 14  # beta and zeta^2 of a solid ball with nu = 0.3


def packaged(style, x, beta, zeta2, e):
    """State at separation of one of the contacts of the page, by the package."""
    if style == "lumped":
        return lumped.rebound(x, beta, zeta2, e)
    return rigid.rebound(x, beta, restitution=e)


def impact(x, e, beta=SOLID[0], zeta2=SOLID[1], mu=0.5):
    """JavaScript for one impact as the page knows it."""
    limit = float(lumped.slip_throughout_limit(beta, zeta2, e))
    return json.dumps({"x": x, "beta": beta, "zeta2": zeta2, "e": e, "mu": mu, "limit": limit})


DRAWN = """(impact, view) => {
  const svg = { setAttribute() {} };
  charts.incidence(svg, 500, impact, view, 13);
  return svg.innerHTML;
}"""


def scales(markup):
    """Functions from places in a chart to the units of its axes, by their labels."""
    labels = re.findall(
        r'text-anchor="(\w+)" x="(\S+)"\s+y="(\S+)">(.*?)<', markup.replace("\u2212", "-")
    )
    along = np.array([(x, value) for anchor, x, _, value in labels if anchor == "middle"], float)
    up = np.array([(y, value) for anchor, _, y, value in labels if anchor == "end"], float)
    up[:, 0] -= 4  # from the foot of a label to its middle
    return [np.poly1d(np.polyfit(*axis.T, 1)) for axis in (along, up)]


def curve(markup, style):
    """Vertices of a curve in the units of the axes of its chart."""
    (points,) = re.findall(rf'class="{style}" points="(.*?)"', markup)
    columns = np.transpose([point.split(",") for point in points.split()]).astype(float)
    return [scale(column) for scale, column in zip(scales(markup), columns, strict=True)]


def bands(markup):
    """Starts and ends of the bands of a chart, in the units of its axis, and their styles."""
    found = re.findall(r'"band (\w+)" x="(\S+)" width="(\S+)"', markup)
    along = scales(markup)[0]
    return [(along(float(x)), along(float(x) + float(w)), style) for style, x, w in found]


def assert_near(values, wanted):
    """A curve agrees to a hundredth of its range."""
    assert np.abs(values - wanted).max() <= 0.01 * np.ptp(wanted)


@pytest.mark.parametrize("view", ["velocity", "forces", "energy"])
@pytest.mark.parametrize(("beta", "zeta2", "e"), [(*SOLID, 1), (*SOLID, 0.8), (10.0, 1.5, 0.3)])
def test_curves_against_incidence_are_those_of_the_package(view, beta, zeta2, e, scripts):
    mu = 0.5
    markup = scripts.evaluate(f"({DRAWN})({impact(2.0, e, beta, zeta2)}, '{view}')")
    for style in ("lumped", "rigid"):
        place, values = curve(markup, f"curve {style}")
        place = np.maximum(place, 0)
        x = place if view == "velocity" else np.tan(np.radians(place)) / mu
        found = packaged(style, x, beta, zeta2, e)
        share = mu / np.hypot(1, mu * x)  # mu v2(0) over the speed before
        wanted = {
            "velocity": found.velocity,
            "forces": share * found.peak_friction,
            "energy": 2 * share**2 * found.dissipation,
        }[view]
        if (beta, zeta2) == SOLID or view == "energy":
            assert_near(values, wanted)
        else:
            assert np.all(np.abs(values - wanted) <= 0.3 * abs(scales(markup)[1][1])), style
    # Regimes of the contact with the spring.
    edges = np.array([0.0, zeta2, lumped.slip_throughout_limit(beta, zeta2, e), np.inf])
    edges = np.minimum(edges, 13) if view == "velocity" else np.degrees(np.arctan(mu * edges))
    *places, kinds = zip(*bands(markup), strict=True)
    np.testing.assert_allclose(places, [edges[:-1], edges[1:]], atol=1e-6)
    assert kinds == ("stick", "mixed", "slip")
    if view == "forces":
        place, values = curve(markup, "normal")
        assert_near(values, np.cos(np.radians(place)))


SAVED = """(impact, angle) => {
  const state = { angle, poisson_ratio: 0.3, spin: 40 };
  const drawn = charts.incidence({ setAttribute() {} }, 500, impact, "forces", 13);
  return files.csv(impact, state, drawn);
}"""


def test_the_numbers_saved_are_those_of_the_package(scripts):
    x, e, mu = 2.0, 0.5, 0.3
    saved = scripts.evaluate(f"({SAVED})({impact(x, e, mu=mu)}, 31)")
    notes = dict(re.findall(r"# (.*) = (\S+)\n", saved))
    assert [float(notes.pop(name)) for name in list(notes)[:7]] == [31, mu, e, 0.3, *SOLID, x]
    table = pd.read_csv(io.StringIO(saved), comment="#")
    every, angle = (table.pop(name).to_numpy() for name in table.columns[:2])
    assert np.abs(angle - np.degrees(np.arctan(mu * every))).max() < 1e-9
    names = {"the paper’s lumped model": "lumped", "rigid limit": "rigid"}
    units = "v1(tf)/(mu v2(0)) [1]", "largest F1/(mu largest F2) [1]"
    units += ("work of friction/(mu^2 m2 v2(0)^2) [1]",)
    assert list(table) == [f"{name}: largest F1 / largest F2 x cos(theta) [1]" for name in names]
    for (name, style), column in zip(names.items(), table, strict=True):
        found = packaged(style, x, *SOLID, e)
        wanted = found.velocity, found.peak_friction, found.dissipation
        said = [float(notes[f"{name}: {unit}"]) for unit in units]
        assert said == pytest.approx(wanted, abs=1e-9)
        peak = mu * packaged(style, every, *SOLID, e).peak_friction / np.hypot(1, mu * every)
        assert table[column].to_numpy() == pytest.approx(peak, abs=1e-9)


def test_numbers_in_words_are_those_of_the_package():
    text = (node.FOLDER / "explorer.html").read_text(encoding="utf-8")
    x = np.linspace(0, 7, 36)
    for e, losses, said in ((1.0, [None], 0.2), (0.8, continuum.LOSSES, (0.7, 0.9))):
        paper = lumped.rebound(x, *SOLID, e).velocity
        for loss in losses:
            found = continuum.rebound(x, *SOLID, e, loss=loss, tolerance=1e-3).velocity
            assert round(np.abs(paper - found).max(), 1) in np.atleast_1d(said)
    assert "by up to 0.2 for\n<i>e</i> = 1 and by up to 0.9" in text
