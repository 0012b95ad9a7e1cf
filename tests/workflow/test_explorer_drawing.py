"""What the explorer draws is what the package solves: directions, lengths, energies, curves."""

import math
import re

import numpy as np
import pytest

from planarimpact import continuum, lumped, rigid
from tests.workflow.controls import (
    FRAME,
    at_times,
    shown_energies,
    value,
)

FRICTION, BETA, ZETA2 = 0.5, 3.5, 1.5  # a rubber ball
INCIDENCE = math.tan(math.radians(51)) / FRICTION
PIXELS = 0.2  # of rounding in what is drawn


def shown(show, restitution, **more):
    """The page with this impact, so high that the closer look is in view, by the lumped model."""
    state = {"angle": 51, "friction": FRICTION, "restitution": restitution, "poisson_ratio": 0.5}
    state |= {"mass_ratio": BETA, "of": "lumped", **more}
    return show("&".join(f"{name}={value}" for name, value in state.items()), height=3000)


@pytest.fixture(params=[0.3, 0.9], ids=["last slip forwards", "last slip backwards"])
def contact(request):
    """Restitution, and a history by the package whose last slip runs either way."""
    return request.param, lumped.history(INCIDENCE, BETA, ZETA2, request.param, samples=4001)


def so_far(contact, rate):
    """Integral of a rate over Omega t up to each instant, by trapezia."""
    pieces = (rate[1:] + rate[:-1]) / 2 * np.diff(contact.time) * math.pi / 2
    return np.concatenate([[0], np.cumsum(pieces)])


def places(tab, times, name):
    """Where a part of the diagram has been moved to, shape (n, 2)."""
    moved = at_times(tab, times, f"part('{name}').getAttribute('transform')")
    return np.array([[float(number) for number in re.findall(r"-?[\d.]+", one)] for one in moved])


def arrows(tab, times, name):
    """Arrows of the diagram as vectors, shape (n, 2); too short ones are left out, as zero."""
    found = []
    for outline in at_times(tab, times, f"part('{name}').getAttribute('d')"):
        corners = np.array([one.split(",") for one in re.findall(r"[-\d.]+,[-\d.]+", outline)])
        corners = corners.astype(float)
        found.append(corners[3] - (corners[0] + corners[-1]) / 2 if len(corners) else (0, 0))
    return np.array(found)


def assert_drawn(drawn, wanted, missing=0):
    """Lengths are right but for one scale, which is not negative."""
    scale = np.sum(drawn * wanted) / np.sum(wanted * wanted)
    assert scale > 10
    assert np.abs(drawn - scale * wanted).max() < PIXELS + missing


def test_the_diagram_shows_directions_and_lengths(contact, show):
    e, found = contact
    tab, chosen = shown(show, e), slice(100, -100, 250)
    t, normal, friction = found.time[chosen], found.normal[chosen], found.friction[chosen]
    back = t > 1
    body, particle = places(tab, t, "body"), places(tab, t, "particle")
    # In the picture, x runs to the right, y down.
    assert_drawn(body[:, 0] - particle[:, 0], found.spring[chosen])
    way = so_far(found, found.velocity)[chosen]
    assert_drawn(body[:, 0] - places(tab, t, "origin")[:, 0], way)
    depth = np.where(back, 1 - e**2 * (1 - normal), normal)
    start = places(tab, [0.0], "body")[:, 1]  # as long as it flies
    assert_drawn(body[:, 1] - start, depth)
    assert_drawn(-arrows(tab, t, "friction-force")[:, 0], friction, missing=3)
    assert_drawn(-arrows(tab, t, "normal-force")[:, 1], normal, missing=3)
    approach = np.cos(math.pi / 2 * np.where(back, 1 + (t - 1) / e, t)) * np.where(back, e, 1)
    velocity = np.stack([FRICTION * found.velocity[chosen], approach], axis=1)
    assert_drawn(arrows(tab, t, "velocity"), velocity)


def test_the_diagram_says_which_way_it_slips(contact, show):
    e, found = contact
    times = [event.time + 0.01 for event in found.events if event.kind in ("stick", "slip")]
    words = "[part('state').textContent, part('chevrons').getAttribute('transform')]"
    seen = at_times(shown(show, e), times, words)
    last = ["SLIPS \u2192", ""] if e == 0.3 else ["\u2190 SLIPS", "scale(-1,1)"]
    assert seen == [["SLIPS \u2192", ""], ["\u25a0 STICKS", ""], last]
    heads = "[...document.querySelectorAll('#forces .word')].map((e) => e.textContent)"
    first, middle, end = shown(show, e).evaluate(heads)
    assert (first, middle, end[-1]) == ("slip \u2192", "stick", "\u2192" if e == 0.3 else "\u2190")


def test_energies_at_any_time_are_those_of_the_springs_and_of_friction(contact, show):
    e, found = contact
    # None in the last step of the page before t_c: what is lost there, is lost in an instant.
    chosen = slice(90, -100, 250)
    tab, columns = shown(show, e), []
    for time in found.time[chosen]:
        at_times(tab, [time], "null")
        columns.append(shown_energies(tab)[:, 1])
    percent = np.array(columns)
    sheared = ZETA2 * found.friction**2
    slipped = 2 * so_far(found, found.friction * found.velocity) - sheared
    normal = (found.normal * np.where(found.time > 1, e, 1)) ** 2
    before = 1 + (FRICTION * INCIDENCE) ** 2 / BETA
    for column, wanted in ((2, normal), (3, FRICTION**2 * sheared), (5, FRICTION**2 * slipped)):
        assert np.abs(percent[:, column] - 100 * wanted[chosen] / before).max() < 0.07
    assert np.abs(percent.sum(axis=1) - 100).max() < 0.31


def axes_of(tab, chart):
    """Affine maps from a place in a chart to the values of its axes, by the labels of these."""
    ticks = tab.evaluate(
        f"[...document.querySelectorAll('#{chart} .tick')].map((e) =>"
        " [e.getAttribute('text-anchor'), +e.getAttribute('x'), +e.getAttribute('y') - 4,"
        " +e.textContent.replace('\u2212', '-')])"
    )
    along = np.array([[x, value] for anchor, x, _, value in ticks if anchor == "middle"])
    up = np.array([[y, value] for anchor, _, y, value in ticks if anchor == "end"])
    maps = [np.polyfit(*one.T, 1) for one in (along, up)]
    assert maps[0][0] > 0 > maps[1][0], "values grow to the right and upwards"
    return maps


def curve(tab, chart, style):
    """Vertices of a curve in the units of its axes."""
    line = f"document.querySelector('#{chart} polyline.{style}').getAttribute('points')"
    points = np.array([one.split(",") for one in tab.evaluate(line).split()], float)
    return [
        np.polyval(one, column) for one, column in zip(axes_of(tab, chart), points.T, strict=True)
    ]


def assert_near(values, wanted):
    """A curve agrees to a hundredth of its range."""
    assert np.abs(values - wanted).max() <= 0.01 * np.ptp(wanted)


def test_curves_in_time_are_those_of_the_package(contact, show):
    e, found = contact
    tab = shown(show, e)
    for chart, style in (("forces", "normal"), ("forces", "friction"), ("velocity", "velocity")):
        time, values = curve(tab, chart, style)
        assert_near(values, np.interp(time, found.time, getattr(found, style)))


@pytest.mark.parametrize("view", ["velocity", "forces", "energy"])
def test_curves_against_incidence_are_those_of_the_package(view, show):
    e = 0.5
    tab = shown(show, e, view=view)

    def drawn(found, cosine):
        share = FRICTION * cosine  # mu v2(0) over the speed before
        return {
            "velocity": found.velocity,
            "forces": share * found.peak_friction,
            "energy": 2 * share**2 * found.dissipation,
        }[view]

    def incidence(place):
        return place if view == "velocity" else np.tan(np.radians(place)) / FRICTION

    for style, solve in (
        ("lumped", lambda x: lumped.rebound(x, BETA, ZETA2, e)),
        ("rigid", lambda x: rigid.rebound(x, BETA, restitution=e)),
    ):
        place, values = curve(tab, "incidence", style)
        x = incidence(np.maximum(place, 0))
        assert_near(values, drawn(solve(x), 1 / np.hypot(1, FRICTION * x)))
    for loss in continuum.LOSSES:
        place, values = (column[::4] for column in curve(tab, "incidence", loss))
        x = incidence(np.maximum(place, 0))
        found = continuum.rebound(x, BETA, ZETA2, e, loss=loss, tolerance=1e-3)
        assert_near(values, drawn(found, 1 / np.hypot(1, FRICTION * x)))
    if view == "forces":
        place, values = curve(tab, "incidence", "normal")
        assert_near(values, np.cos(np.radians(place)))
    dot = "document.querySelector('#incidence .present.lumped')"
    at = tab.evaluate(f"[+{dot}.getAttribute('cx'), +{dot}.getAttribute('cy')]")
    place, value = (np.polyval(*one) for one in zip(axes_of(tab, "incidence"), at, strict=True))
    found = lumped.rebound(INCIDENCE, BETA, ZETA2, e)
    assert abs(incidence(place) - INCIDENCE) < 0.01
    assert abs(value - drawn(found, 1 / math.hypot(1, FRICTION * INCIDENCE))) < 0.01


def place_in(tab, chart, value):
    """Where a value of the horizontal axis of a chart is on the screen, once scrolled to it."""
    tab.evaluate(f"document.getElementById('{chart}').scrollIntoView({{block: 'center'}})")
    corner = f"document.getElementById('{chart}').getBoundingClientRect()"
    left, top = tab.evaluate(f"[{corner}.x, {corner}.y]")
    slope, start = axes_of(tab, chart)[0]
    return {"x": left + (value - start) / slope, "y": top + 60}


def mouse(tab, kind, where):
    more = {"button": "left", "buttons": 1, "clickCount": 1}
    tab.call("Input.dispatchMouseEvent", type=f"mouse{kind}", **more, **where)


def test_charts_are_dragged(show):
    tab = shown(show, 0.5)
    where = place_in(tab, "velocity", 0.8)
    for kind in ("Pressed", "Released"):
        mouse(tab, kind, where)
    assert abs(tab.evaluate(f"stage.first_bounce({value(tab, 'time')}).time") - 0.8) < 0.02
    # The chart says the incidence of the contact point, to which spin adds.
    for spin in (0, 40):
        tab = shown(show, 0.5, spin=spin, speed=5)
        where = place_in(tab, "incidence", math.tan(math.radians(45)) / FRICTION)
        for kind in ("Pressed", "Released"):
            mouse(tab, kind, where)
        tab.evaluate(FRAME)
        speeds = tab.evaluate("(({ along, up }) => [along, up])(page.impact().before)")
        assert abs(speeds[0] - 0.025 * spin + speeds[1]) < 0.12


def test_the_axis_stands_still_while_the_curve_is_dragged(show):
    tab = shown(show, 0.5)
    where = place_in(tab, "incidence", 7.9)
    mouse(tab, "Pressed", where)
    pressed = axes_of(tab, "incidence")[0]
    for beyond in (10, 40, 80):
        mouse(tab, "Moved", where | {"x": where["x"] + beyond})
        tab.evaluate(FRAME)
        assert np.array_equal(axes_of(tab, "incidence")[0], pressed)
    mouse(tab, "Released", where | {"x": where["x"] + 80})
    tab.evaluate(FRAME)
    assert abs(value(tab, "angle") - math.degrees(math.atan(FRICTION * 8))) < 0.1
    assert axes_of(tab, "incidence")[0][0] > pressed[0], "released, the axis has room again"


@pytest.mark.parametrize(
    ("moves", "changes"),
    [
        ([(0, -12), (4, -60), (60, -120)], False),  # scrolls the page
        ([(12, 2), (60, 8)], True),
        ([], True),  # a tap
    ],
)
def test_a_finger_that_scrolls_the_page_changes_nothing(moves, changes, show):
    state = f"angle=51&friction={FRICTION}&restitution=0.5&mass_ratio={BETA}"
    tab = show(state, width=390)
    where = place_in(tab, "incidence", 4.0)
    kinds = [("Start", (0, 0)), *(("Move", move) for move in moves), ("End", None)]
    for kind, move in kinds:
        points = [{"x": where["x"] + move[0], "y": where["y"] + move[1]}] if move else []
        tab.call("Input.dispatchTouchEvent", type=f"touch{kind}", touchPoints=points)
    tab.evaluate(FRAME)
    assert (value(tab, "angle") != 51) == changes


def test_the_row_of_springs_sticks_slips_and_hangs_free(show):
    tab = show("angle=15&friction=0.4&restitution=1&poisson_ratio=0.3", height=3000)
    feet = "['stuck', 'slipping', 'free'].map((one) => part(`row-${one}`)"
    feet += ".getAttribute('d').split('M').length - 1)"
    early, late = at_times(tab, [0.5, 1.5], feet)
    assert sum(early) == sum(late), "each spring has one foot"
    assert early[1] < early[0] and all(late)
    assert at_times(tab, [1.5], "part('state').textContent") == ["\u25a0 MIDDLE STICKS"]
