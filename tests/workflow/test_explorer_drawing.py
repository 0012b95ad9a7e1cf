"""What the explorer draws is what the package solves: directions, lengths, energies, curves."""

import json
import math
import re

import numpy as np
import pytest

from planarimpact import bodies, lumped, rigid, spheres

FRICTION, BETA, ZETA2 = 0.5, 3.5, 1.5  # a rubber ball
INCIDENCE = math.tan(math.radians(51)) / FRICTION
PIXELS = 0.2  # of rounding in what is drawn


def shown(show, restitution, **more):
    state = {"angle": 51, "friction": FRICTION, "restitution": restitution, "poisson_ratio": 0.5}
    state |= {"mass_ratio": BETA, **more}
    return show("&".join(f"{name}={value}" for name, value in state.items()))


@pytest.fixture(params=[0.3, 0.9], ids=["last slip forwards", "last slip backwards"])
def contact(request):
    """Restitution, and a history by the package whose last slip runs either way."""
    return request.param, lumped.history(INCIDENCE, BETA, ZETA2, request.param, samples=4001)


def so_far(contact, rate):
    """Integral of a rate over Omega t up to each instant, by trapezia."""
    pieces = (rate[1:] + rate[:-1]) / 2 * np.diff(contact.time) * math.pi / 2
    return np.concatenate([[0], np.cumsum(pieces)])


def at_times(tab, times, expression):
    """Value of a JavaScript expression at each time of the player."""
    return tab.evaluate(
        "(() => { const slider = document.getElementById('time'),"
        " part = (name) => document.getElementById(`diagram-${name}`);"
        f" return {json.dumps(list(times))}.map((t) => {{ slider.value = t;"
        f" slider.dispatchEvent(new Event('input')); return {expression}; }}); }})()"
    )


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
    start = places(tab, [0.0], "body")[:, 1]
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
    chosen = slice(100, -100, 250)
    rows = "[...document.querySelectorAll('#energies tbody tr')].map((r) => r.cells[2].textContent)"
    said = at_times(shown(show, e), found.time[chosen], rows)
    percent = np.array([[0.0 if cell == "\u2013" else float(cell) for cell in row] for row in said])
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
    for loss in spheres.LOSSES:
        place, values = curve(tab, "incidence", loss)
        x = incidence(np.maximum(place, 0))
        found = spheres.rebound(x, BETA, ZETA2, e, loss=loss)
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


def value_of(tab, name):
    return float(tab.evaluate(f"document.getElementById('{name}').value"))


def test_charts_are_dragged(show):
    tab = shown(show, 0.5)
    for chart, changed, wanted in (("velocity", "time", 0.8), ("incidence", "angle", 45.0)):
        value = wanted if chart == "velocity" else math.tan(math.radians(wanted)) / FRICTION
        where = place_in(tab, chart, value)
        for kind in ("Pressed", "Released"):
            mouse(tab, kind, where)
        assert abs(value_of(tab, changed) - wanted) < 0.02 * wanted


def test_the_axis_stands_still_while_the_curve_is_dragged(show):
    tab = shown(show, 0.5)
    where = place_in(tab, "incidence", 7.9)
    mouse(tab, "Pressed", where)
    pressed = axes_of(tab, "incidence")[0]
    for beyond in (10, 40, 80):
        mouse(tab, "Moved", where | {"x": where["x"] + beyond})
        assert np.array_equal(axes_of(tab, "incidence")[0], pressed)
    mouse(tab, "Released", where | {"x": where["x"] + 80})
    assert abs(value_of(tab, "angle") - math.degrees(math.atan(FRICTION * 8))) < 0.1
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
    assert (value_of(tab, "angle") != 51) == changes


def moved_ball(tab, times):
    """Place of the ball, x to the right and y up, and its turn in radians against the clock."""
    found = at_times(tab, times, "document.getElementById('ball-body').getAttribute('transform')")
    numbers = [[float(number) for number in re.findall(r"-?[\d.]+", one)] for one in found]
    return [(x, -y, math.radians(-turn)) for x, y, turn in numbers]


def ball_arrow(tab, name):
    outline = tab.evaluate(f"document.getElementById('ball-{name}').getAttribute('d')")
    corners = np.array([one.split(",") for one in re.findall(r"[-\d.]+,[-\d.]+", outline)], float)
    tip, tail = corners[3], (corners[0] + corners[-1]) / 2
    return (tip - tail) * [1, -1], tail * [1, -1]


def test_the_ball_flies_and_spins_as_the_package_says(contact, show):
    e, found = contact
    rubber = bodies.solid_sphere(radius=0.025, density=1100.0)
    before = bodies.Motion(math.tan(math.radians(51)), 1.0, 0.0)
    after = bodies.rebound_motion(rubber, before, FRICTION, found.velocity[-1], e)
    # Friction and normal force act at the contact point: about it, no angular momentum changes.
    turning = rubber.gyration**2 * after.spin
    assert abs(rubber.radius * (before.tangential - after.tangential) + turning) < 1e-12
    foot, _ = bodies.contact_velocity(after.tangential, after.normal, after.spin, rubber.radius)
    rim = rubber.radius * after.spin
    tab = shown(show, e)
    for name, wanted in (("centre", after.tangential), ("spin", rim), ("velocity", foot)):
        said = tab.evaluate(f"document.getElementById('number-{name}').textContent")
        assert abs(float(said.replace("\u2212", "-")) - wanted / FRICTION) < 6e-4
    leaves = math.degrees(math.atan2(after.tangential, -after.normal))
    said = tab.evaluate("document.getElementById('ball-angle-out').textContent")
    assert said == f"out: {leaves:.1f}\u00b0"
    # It does not move in contact. Both flights are drawn in the unit of one length and one time.
    start, first, last, end = moved_ball(tab, [-1, 0, 1 + e, 2 + e])
    assert first == last and first[2] == start[2] == 0
    unit = start[1] - first[1]
    assert np.allclose(np.subtract(first, start)[:2] / unit, [before.tangential, -1])
    assert np.allclose(np.subtract(end, last)[:2] / unit, [after.tangential, -after.normal])
    radius = float(tab.evaluate("document.querySelector('#ball-body .rim').getAttribute('r')"))
    assert math.isclose(end[2] * radius / unit, rim, rel_tol=1e-9)
    # The arrows: velocity of the centre from the centre, of the contact point from the foot.
    for name, speed, below in (("centre", after.tangential, 0), ("contact", foot, radius)):
        arrow, tail = ball_arrow(tab, name)
        assert np.abs(tail - [end[0], end[1] - below]).max() < PIXELS
        assert np.abs(arrow * -after.normal - arrow[1] * np.array([speed, e])).max() < PIXELS
    words = tab.evaluate("document.getElementById('of-the-centre').textContent")
    share = 100 * after.tangential / before.tangential
    assert f"The centre goes on forwards with {share:.0f}\u00a0%" in words
    assert f"It leaves at {leaves:.0f}\u00b0." in words
    assert ("contact point runs backwards" in words) == (foot < 0)


def test_angles_of_the_thresholds_and_the_share_of_velocity_left_are_said(show):
    e = 0.9
    tab = shown(show, e)
    limits = ZETA2, lumped.slip_throughout_limit(BETA, ZETA2, e)
    for name, limit in zip(("stick", "slip"), limits, strict=True):
        said = tab.evaluate(f"document.getElementById('number-{name}').textContent")
        assert abs(float(said.strip("°")) - math.degrees(math.atan(FRICTION * limit))) <= 0.051
    share = -100 * lumped.rebound(INCIDENCE, BETA, ZETA2, e).velocity / INCIDENCE
    sentence = tab.evaluate("document.getElementById('sentence').textContent")
    assert f"leaves backwards, with {share:.0f}\u00a0%" in sentence
