"""The models of the explorer and their drawings say what the package solves."""

import io
import json
import math
import re

import numpy as np
import pandas as pd
import pytest

from planarimpact import Regime, continuum, lumped, rigid
from stronge1994.explorer import page as write_explorer
from tests.workflow import node

TOLERANCE = 1e-3  # of the package, small against the errors of the page
SOLID = 3.5, 17 / 14  # beta and zeta^2 of a solid ball with nu = 0.3


def packaged(style, x, beta, zeta2, e):
    """State at separation of one of the models of the page, by the package."""
    if style == "lumped":
        return lumped.rebound(x, beta, zeta2, e)
    if style == "rigid":
        return rigid.rebound(x, beta, restitution=e)
    loss = None if style == "elastic" else style
    return continuum.rebound(x, beta, zeta2, e, loss=loss, tolerance=TOLERANCE)


def impact(style, x, e, beta=SOLID[0], zeta2=SOLID[1], mu=0.5):
    """JavaScript for one impact as the page knows it."""
    groups = {"x": x, "beta": beta, "zeta2": zeta2, "e": e, "mu": mu}
    return f"impact_of('{style}', {json.dumps(groups)})"


# ---- the continuum


def impacts(loss):
    """Impacts over the sliders and on their thresholds, and where errors were largest."""
    rng = np.random.default_rng(1994)
    names = "restitution", "poisson_ratio", "mass_ratio"
    limits = np.array([write_explorer.LIMITS[name][:2] for name in names], float)
    limits[0, 0] = continuum.LEAST_RESTITUTION
    e, nu, beta = rng.uniform(*limits.T, (8, 3)).T
    inside = np.transpose([beta, (2 - nu) / (2 * (1 - nu)), e])
    # The ends of the box, and m2/m1 = zeta^2.
    least, most = continuum.LEAST_RESTITUTION, 1 - 1e-9
    ends = [(beta, zeta2, most) for zeta2 in (1.0, 1.5) for beta in (1.0, zeta2, 10.0)]
    ends += [(10.0, 1.0, least), (1.0, 1.5, least)]
    groups = np.concatenate([inside, ends])
    limit = continuum.slip_throughout_limit(*groups.T, loss=loss)
    edges = np.concatenate([groups[:, 1], 0.999 * limit, limit])
    rows = np.column_stack([edges, np.tile(groups, (3, 1))]).tolist()
    rows += np.column_stack([rng.random(len(inside)) * limit[: len(inside)], inside]).tolist()
    rows += [
        (12.654, 10.0, 1.4511, 0.1),
        (1.4, 8.9585, 1.1089, 0.1),
        (1.3707, 9.572, 1.439, 0.8634),
    ]
    return [tuple(row) for row in rows]


@pytest.mark.parametrize("loss", continuum.LOSSES)
def test_one_impact_is_within_the_error_that_the_page_says(loss, scripts):
    rows = impacts(loss)
    one = f"(row) => {{ const found = continuum.rebound(...row, '{loss}');"
    one += " return [found.velocity, found.peak_friction, found.slides]; }"
    *ours, slides = np.transpose(scripts.map(one, rows))
    theirs = packaged(loss, *np.transpose(rows))
    errors = np.abs([ours[0] - theirs.velocity, ours[1] - theirs.peak_friction])
    assert errors.max() <= write_explorer.CONTINUUM_ERROR, rows[errors.max(axis=0).argmax()]
    exact = slides.astype(bool) & (theirs.regime == Regime.SLIP_THROUGHOUT)
    assert exact.sum() >= 5 and errors[0, exact].max() < 1e-12
    limit = continuum.slip_throughout_limit(*SOLID, 0.5, loss=loss)
    assert abs(scripts.evaluate(f"{impact(loss, 2.0, 0.5)}.limit") - limit) < 0.01


@pytest.mark.parametrize("x", [1.2, 3.0])
@pytest.mark.parametrize(("e", "style"), [(1.0, "elastic"), (0.7, "viscous"), (0.7, "plastic")])
def test_the_contact_in_time_is_that_of_the_package(x, e, style, scripts):
    fields = "[at.time, at.normal, at.friction, at.velocity, at.radius,"
    # The middle sticks where the first springs do.
    fields += " [...at.slips, 1].findIndex((slip) => slip) / at.slips.length]"
    rows = f"{impact(style, x, e)}.contact.rows"
    time, *ours, stick = np.transpose(scripts.evaluate(f"{rows}.map((at) => {fields})"))
    loss = None if e == 1 else style
    theirs = continuum.history(x, *SOLID, e, loss=loss, tolerance=TOLERANCE)
    assert abs(time[-1] - theirs.time[-1]) < 1e-3
    names = "normal", "friction_force", "velocity", "contact_radius"
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


# Zones of the patch from outside, and friction by stress: 2 pi times the integral of r times
# stress, which Abel's transform keeps.
PATCH = f"""(impact, times) => times.map((time) => {{
  const {{ contact, e }} = impact;
  const row = models.at(contact, time), motion = continuum.normal(e, contact.style);
  const edge = Math.sqrt(row.limit.square), n = 1000;
  const radii = Array.from({{ length: n }}, (_, i) => ((i + 0.5) / n) * edge);
  const {{ stress }} = {node.expression("patch", "return { show,", "return { stress, show,")};
  const values = stress(row.density, motion.radius / motion.springs, edge, radii, 1);
  const sum = radii.reduce((sum, r, i) => sum + r * values[i], 0) * edge / n;
  const zones = patch.show(contact.style, row, 1, motion);
  return [2 * sum / motion.largest, row.friction, zones.map((one) => [one.slip, one.outer])];
}})"""


@pytest.mark.parametrize(("e", "style"), [(1, "elastic"), (0.6, "viscous"), (0.6, "plastic")])
def test_the_patch_shows_friction_and_where_it_slips(e, style, scripts):
    x, times = math.tan(math.radians(30)) / 0.4, [0.3, 0.7, 1, 1.2, 1.5]
    shown = scripts.evaluate(f"({PATCH})({impact(style, x, e)}, {times})")
    ours, friction = np.transpose([row[:2] for row in shown])
    assert np.abs(friction).max() > 0.3
    assert np.abs(ours - friction).max() < 0.03 * np.abs(friction).max()
    if style == "elastic":
        theirs = continuum.history(x, *SOLID)
        for time, (_, _, zones) in zip(times, shown, strict=True):
            radius = np.interp(time, theirs.time, theirs.contact_radius)
            stick = np.interp(time, theirs.time, theirs.stick_radius)
            slip, inner = zones[-1]
            assert abs(zones[0][1] - radius) < 0.05
            assert abs((0 if slip else inner) - stick) < 0.05


# ---- charts and energies

CHART = """(draw, impact, ...more) => {
  const svg = { setAttribute() {} };
  charts[draw](svg, 500, impact, ...more);
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
    styles = scripts.evaluate(f"models.chosen({{ e: {e}, zeta2: {zeta2} }}, models.TOGGLES)")
    assert styles == ["lumped", "rigid", *(continuum.LOSSES if e < 1 else ["elastic"])]
    given = impact("lumped", 2.0, e, beta, zeta2)
    drawn = f"({CHART})('incidence', {given}, '{view}', {styles}, 13)"
    markup = scripts.evaluate(drawn)
    for style in styles:
        every = 1 if style in ("lumped", "rigid") else 8
        place, values = (column[::every] for column in curve(markup, f"curve {style}"))
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
        if view != "energy":
            error = write_explorer.CURVE_ERROR * (share if view == "forces" else 1) * (every > 1)
            assert np.all(np.abs(values - wanted) <= error + 0.3 * abs(scales(markup)[1][1])), style
    # Regimes of the model that is looked at closer.
    edges = np.array([0.0, zeta2, lumped.slip_throughout_limit(beta, zeta2, e), np.inf])
    edges = np.minimum(edges, 13) if view == "velocity" else np.degrees(np.arctan(mu * edges))
    *places, kinds = zip(*bands(markup), strict=True)
    np.testing.assert_allclose(places, [edges[:-1], edges[1:]], atol=1e-6)
    assert kinds == ("stick", "mixed", "slip")
    if view == "forces":
        place, values = curve(markup, "normal")
        assert_near(values, np.cos(np.radians(place)))


SAVED = """(impact, angle) => {
  const styles = models.chosen(impact, models.TOGGLES);
  const state = { angle, poisson_ratio: 0.3, spin: 40 };
  const drawn = charts.incidence({ setAttribute() {} }, 500, impact, "forces", styles, 13);
  return files.csv(impact, state, models.outcomes(styles, impact), drawn);
}"""


def test_the_numbers_saved_are_those_of_the_package(scripts):
    x, e, mu = 2.0, 0.5, 0.3
    saved = scripts.evaluate(f"({SAVED})({impact('lumped', x, e, mu=mu)}, 31)")
    notes = dict(re.findall(r"# (.*) = (\S+)\n", saved))
    assert [float(notes.pop(name)) for name in list(notes)[:7]] == [31, mu, e, 0.3, *SOLID, x]
    table = pd.read_csv(io.StringIO(saved), comment="#")
    every, angle = (table.pop(name).to_numpy() for name in table.columns[:2])
    assert np.abs(angle - np.degrees(np.arctan(mu * every))).max() < 1e-9
    names = "the paper’s lumped model", "rigid limit", "continuum, viscous", "continuum, plastic"
    units = "v1(tf)/(mu v2(0)) [1]", "largest F1/(mu largest F2) [1]"
    units += ("work of friction/(mu^2 m2 v2(0)^2) [1]",)
    assert list(table) == [f"{name}: largest F1 / largest F2 x cos(theta) [1]" for name in names]
    for name, column, style in zip(
        names, table, ("lumped", "rigid", *continuum.LOSSES), strict=True
    ):
        found = packaged(style, x, *SOLID, e)
        wanted = found.velocity, found.peak_friction, found.dissipation
        said = [float(notes[f"{name}: {unit}"]) for unit in units]
        near = 1e-9 if style in ("lumped", "rigid") else write_explorer.CONTINUUM_ERROR
        assert said == pytest.approx(wanted, abs=near)
        some = slice(None, None, 12)
        peak = mu * packaged(style, every[some], *SOLID, e).peak_friction
        peak /= np.hypot(1, mu * every[some])
        assert np.abs(table[column][some] - peak).max() <= mu * write_explorer.CURVE_ERROR


# A rubber ball whose last slip runs forwards or backwards, by its restitution.
BETA, ZETA2, FRICTION = 3.5, 1.5, 0.5
INCIDENCE = math.tan(math.radians(51)) / FRICTION


@pytest.fixture(params=[0.3, 0.9], ids=["last slip forwards", "last slip backwards"])
def rubber(request, scripts):
    """Restitution, history by the package, and a function of an expression of the same impact."""
    e = request.param
    given = impact("lumped", INCIDENCE, e, BETA, ZETA2, FRICTION)
    found = lumped.history(INCIDENCE, BETA, ZETA2, e, samples=4001)
    return e, found, lambda expression: scripts.evaluate(f"((impact) => {expression})({given})")


def test_energies_at_any_time_are_those_of_the_springs_and_of_friction(rubber):
    e, found, evaluate = rubber
    # None in the last step of the page before t_c: what is lost there, is lost in an instant.
    chosen = slice(90, -100, 50)
    times = json.dumps(found.time[chosen].tolist())
    shares = np.array(
        evaluate(f"{times}.map((t) => Object.values(models.at(impact.contact, t).energy))")
    )
    rate = found.friction_force * found.velocity
    work = (rate[1:] + rate[:-1]) / 2 * np.diff(found.time) * math.pi / 2
    sheared = ZETA2 * found.friction_force**2
    slipped = 2 * np.concatenate([[0], np.cumsum(work)]) - sheared
    normal = (found.normal * np.where(found.time > 1, e, 1)) ** 2
    before = 1 + (FRICTION * INCIDENCE) ** 2 / BETA
    wanted = ((2, normal), (3, FRICTION**2 * sheared), (5, FRICTION**2 * slipped))
    for column, energy in wanted:
        assert np.abs(shares[:, column] - energy[chosen] / before).max() < 2e-4
    assert np.abs(shares.sum(axis=1) - 1).max() < 1e-9


def test_the_closer_look_shows_the_contact_in_time(rubber):
    e, found, evaluate = rubber
    wanted = {"normal": found.normal, "limit": -found.normal, "friction": found.friction_force}
    for style, column in (wanted | {"velocity": found.velocity}).items():
        markup = evaluate(f"({CHART})('{'velocity' if style == 'velocity' else 'forces'}', impact)")
        time, values = curve(markup, style)
        assert_near(values, np.interp(time, found.time, column))
        assert ("\u2190" in markup) == (e == 0.9)  # slip backwards
    starts = [event.time for event in found.events if event.kind in ("stick", "slip")]
    phases = evaluate("impact.phases.map((one) => [one.start, one.sticks ? 0 : one.side])")
    assert np.abs(np.array(phases)[:, 0] - starts).max() < 1e-9
    assert [side for _, side in phases] == [1, 0, 1 if e == 0.3 else -1]
    way, share = "forwards" if e == 0.3 else "backwards", 100 * found.velocity[-1] / INCIDENCE
    assert evaluate("words.sentence(impact)").replace("\u00a0", " ") == (
        "The paper’s lumped model: the contact slips forwards first, then sticks, then slips "
        f"{way}. The contact point leaves {'forwards' if share > 0 else 'backwards'}, with "
        f"{abs(share):.{int(abs(share) < 9.5)}f} % of the tangential velocity that it came with."
    )


# ---- what is said


def test_it_says_which_models_answer_and_disagree(scripts):
    said = "models.outcomes(models.chosen(impact, models.TOGGLES), impact)"
    found = f"((impact) => {{ const all = {said}; return [all, words.agreement(all)]; }})"
    for x, e, directions, words in (
        # Below e = 1 small incidences turn round in some models; in the rigid limit they stop.
        (1.0, 0.8, [-1, 0, -1, 1], "disagree on the direction"),
        # Above the limit of slip throughout of the lumped model, and below that of continua.
        (4.0, 0.5, [-1, 0, -1, -1], "disagree on slip"),
        # Almost nothing is what the continuum of the page cannot tell from nothing.
        (1.0, 1.0, [1, 0, 0], "disagree on the direction"),
        (10.0, 1.0, [1, 1, 1], "agree on the direction"),
    ):
        ours, agreement = scripts.evaluate(f"{found}({impact('lumped', x, e)})")
        assert [one["direction"] for one in ours] == directions
        assert words in agreement["text"] and agreement["agrees"] == (x == 10)
        assert [one["style"] for one in ours if one["mute"]] == ["rigid"] * (directions[1] == 0)
    # The continuum answers from 0.1 on.
    chosen = "([e, zeta2]) => models.chosen({ e, zeta2 }, ['continuum']).length"
    assert scripts.map(chosen, [[0.099, 1.2], [0.1, 1.2], [1, 1.2], [1, 0.6]]) == [0, 2, 1, 0]


def test_numbers_in_words_are_those_of_the_package():
    text = (node.FOLDER / "explorer.html").read_text(encoding="utf-8")
    x = np.linspace(0, 7, 36)
    for e, losses, said in ((1.0, ["elastic"], 0.2), (0.8, continuum.LOSSES, (0.7, 0.9))):
        paper = packaged("lumped", x, *SOLID, e).velocity
        for loss in losses:
            error = np.abs(paper - packaged(loss, x, *SOLID, e).velocity).max()
            assert round(error, 1) in np.atleast_1d(said)
    assert "up to 0.2 for <i>e</i> = 1 and by up to 0.9" in text
