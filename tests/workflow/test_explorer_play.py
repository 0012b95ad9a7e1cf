"""The balls that are thrown in the explorer: how they fly, how they are thrown, what is seen."""

import json
import math
import re
from pathlib import Path

import numpy as np
import pytest

from planarimpact import bodies, continuum, lumped
from stronge1994.explorer import page as write_explorer
from tests.workflow.controls import (
    FRAME,
    SOLID,
    at_times,
    click,
    element,
    middle,
    number,
    numbers_of,
    text,
    texts,
    type_in,
    value,
    wait_for,
)

PATCH = Path(__file__).parents[2] / "workflow/explorer/patch.js"
PLAY = f"{element('play')}.textContent.split(' ').slice(1).join(' ')"


# ---- flights


@pytest.fixture(scope="module")
def throws():
    """Throws over the sliders, with a table and without, with gravity and without."""
    rng = np.random.default_rng(1969)
    limits = {name: limit[:2] for name, limit in write_explorer.LIMITS.items() if name != "table"}
    rows = [{name: rng.uniform(*limit) for name, limit in limits.items()} for _ in range(60)]
    for i, row in enumerate(rows):
        row |= {"radius": 0.025, "gravity": [9.81, 0][i % 3 == 0], "table": [0, 0.7][i % 2]}
        row["restitution"] = max(row["restitution"], 0.2)
    return rows


def flown(tab, throws):
    """Flights of all throws, by the lumped model."""
    contact = "(x) => ({ state: solver.rebound(x, one.mass_ratio, 1.2, one.restitution) })"
    return tab.evaluate(f"{json.dumps(throws)}.map((one) => flight.fly(one, {contact}))")


def test_a_bounce_keeps_what_mechanics_keeps(throws, show):
    walls = []
    for given, parts in zip(throws, flown(show(), throws), strict=True):
        e, radius = given["restitution"], given["radius"]
        inertia = radius**2 / (given["mass_ratio"] - 1)
        assert [part["kind"] for part in parts] == ["flight", "bounce"] * (len(parts) // 2) + (
            ["flight"] * (len(parts) % 2)
        )
        for part in parts[1::2]:
            before, after, wall = part["ball"], part["after"], part["wall"]
            walls.append(wall)
            arm = -radius if wall == "floor" else radius  # from the centre up to the contact
            # Friction and normal force act at the contact: about it, no angular momentum changes.
            turning = inertia * (after["spin"] - before["spin"])
            assert turning == pytest.approx(arm * (after["along"] - before["along"]), abs=1e-9)
            energies = [
                one["along"] ** 2 + one["up"] ** 2 + inertia * one["spin"] ** 2
                for one in (before, after)
            ]
            assert energies[1] <= energies[0] * (1 + 1e-12)
            assert after["up"] == pytest.approx(-e * before["up"], rel=1e-12)
            assert (after["up"] > 0) == (wall == "floor")
            # The package says the same of the contact point.
            unit = given["friction"] * abs(before["up"])
            point, point_after = (one["along"] + arm * one["spin"] for one in (before, after))
            found = lumped.rebound(point / unit, given["mass_ratio"], 1.2, e).velocity
            assert point_after / unit == pytest.approx(found, abs=1e-9 * max(1, abs(point / unit)))
    assert len(walls) > 100 and set(walls) == {"floor", "table"}


def test_a_ball_flies_with_gravity_between_floor_and_table(throws, show):
    tab = show()
    for given, parts in zip(throws, flown(tab, throws), strict=True):
        gap = given["table"] - 2 * given["radius"] if given["table"] else math.inf
        for flight, bounce in zip(parts[::2], parts[1::2], strict=False):
            start, end = flight["ball"], bounce["ball"]
            t = np.linspace(0, flight["time"], 9)
            ways = tab.evaluate(
                f"{json.dumps(t.tolist())}.map((t) => flight.later({json.dumps(start)}, t))"
            )
            heights = start["height"] + start["up"] * t - start["gravity"] * t**2 / 2
            assert np.abs([one["height"] for one in ways] - heights).max() < 1e-9
            assert heights.min() > -1e-9 and heights.max() < gap + 1e-9
            assert end["height"] == pytest.approx(0 if bounce["wall"] == "floor" else gap, abs=1e-9)
            assert end["place"] == pytest.approx(start["place"] + start["along"] * t[-1])
            assert end["turn"] == pytest.approx(start["turn"] + start["spin"] * t[-1])
            energy = [one["up"] ** 2 / 2 + start["gravity"] * one["height"] for one in (start, end)]
            assert energy[0] == pytest.approx(energy[1], rel=1e-9)


def test_the_aim_is_the_throw(throws, show):
    pairs = show().evaluate(
        f"{json.dumps(throws)}.map((one) => [flight.aimed(flight.start(one)), flight.first(one)])"
    )
    for given, (aimed, first) in zip(throws, pairs, strict=True):
        for name in ("angle", "speed"):
            assert aimed[name] == pytest.approx(given[name], rel=1e-9)
        angle = math.degrees(math.atan2(first["along"], -first["up"]))
        assert angle == pytest.approx(given["angle"], rel=1e-9)


def test_a_ball_that_does_not_bounce_stays_on_the_floor(show):
    parts = show("angle=40&friction=0.3&restitution=0").evaluate("page.flights()")
    assert list(parts) == ["lumped"] and [one["kind"] for one in parts["lumped"]] == [
        "flight", "bounce", "flight",
    ]  # fmt: skip
    assert abs(parts["lumped"][2]["ball"]["up"]) == parts["lumped"][2]["ball"]["height"] == 0


@pytest.mark.parametrize(("e", "spin"), [(0.3, 0), (0.9, -130), (1, 200)])
def test_the_ball_leaves_as_the_package_says(e, spin, show):
    state = f"angle=51&friction=0.5&restitution={e}&speed=5&spin={spin}&of=lumped{SOLID}"
    tab = show(state, height=3000)
    ball = bodies.solid_sphere(radius=0.025, density=1100.0)
    along, down = 5 * math.sin(math.radians(51)), 5 * math.cos(math.radians(51))
    # Positive in the package is a spin that moves the foot of the ball forwards.
    before = bodies.Motion(along, down, -float(spin))
    x = bodies.contact_velocity(along, down, -spin, ball.radius)[0] / (0.5 * down)
    velocity = lumped.rebound(x, 3.5, 17 / 14, e).velocity
    after = bodies.rebound_motion(ball, before, 0.5, velocity, e)
    assert abs(number(text(tab, "number-centre")) - after.tangential) < 6e-4
    assert abs(number(text(tab, "number-spin")) + after.spin) < 0.051
    leaves = math.degrees(math.atan2(abs(after.tangential), -after.normal))
    assert f"leaves at {leaves:.0f}\u00b0 to the normal." in text(tab, "of-the-centre")
    assert ("turns back" in text(tab, "of-the-centre")) == (after.tangential < -0.005)
    assert abs(number(text(tab, "number-incidence")) - abs(x)) < 6e-4


# ---- the show


def ball_places(tab):
    moved = tab.evaluate(
        "['lumped', 'continuum'].map((one) =>"
        " document.getElementById(`stage-${one}-ball`).getAttribute('transform'))"
    )
    return [numbers_of(one)[:3] for one in moved]


def mouse(tab, kind, x, y):
    more = {"button": "left", "buttons": 1, "clickCount": 1}
    tab.call("Input.dispatchMouseEvent", type=f"mouse{kind}", x=x, y=y, **more)


def touch(tab, kind, *point):
    points = [dict(zip("xy", point, strict=True))] if point else []
    tab.call("Input.dispatchTouchEvent", type=f"touch{kind}", touchPoints=points)


@pytest.mark.parametrize(
    ("how", "lane", "ball"),
    [
        ("mouse", "continuum", "stage-grasp"),
        ("touch", "continuum", "stage-grasp"),
        ("mouse", "lumped", "stage-other-grasp"),
    ],
)
def test_the_ball_is_pulled_and_flies(how, lane, ball, show):
    tab = show("angle=30&friction=0.4&restitution=1", width=390 if how == "touch" else 1280)
    x, y = middle(tab, ball)
    aim = json.dumps({"clientX": x + 70, "clientY": y + 30})
    wanted = tab.evaluate(f"stage.aim_at({aim}, '{lane}')")
    assert wanted["speed"] > 1 and wanted["angle"] > 45
    scrolled = tab.evaluate("scrollY")
    kinds = ("Pressed", "Moved", "Released") if how == "mouse" else ("Start", "Move", "End")
    send = mouse if how == "mouse" else touch
    send(tab, kinds[0], x, y)
    for share in (0.5, 1):
        send(tab, kinds[1], x + 70 * share, y + 30 * share)
        tab.evaluate(FRAME)
    assert value(tab, "time") == 0, "it does not fly before it is let go"
    send(tab, kinds[2], *([x + 70, y + 30] if how == "mouse" else []))
    tab.evaluate(FRAME)
    assert {name: value(tab, name) for name in wanted} == wanted
    assert tab.evaluate("scrollY") == scrolled
    # With less motion the whole path is there at once.
    assert value(tab, "time") == pytest.approx(tab.evaluate("stage.duration()"))
    saying = f"angle={wanted['angle']:g}&"
    wait_for(tab, f"location.hash.startsWith('#{saying}')", True)
    assert f"speed={wanted['speed']:g}" in tab.evaluate("location.hash")
    # Pulled back, as a slingshot, the ball flies the other way.
    click(tab, "do-start")
    x, y = middle(tab, ball)
    back, aim = (json.dumps({"clientX": x + s * 70, "clientY": y + s * 30}) for s in (-1, 1))
    assert tab.evaluate(f"stage.aim_at({back}, '{lane}')") == pytest.approx(
        tab.evaluate(f"stage.aim_at({aim}, '{lane}')"), abs=0.2
    )


def test_a_touch_beside_the_ball_scrolls(show):
    tab = show(width=390)
    tab.evaluate(f"{element('stage-svg')}.scrollIntoView()")
    before, (x, y) = tab.evaluate("scrollY"), middle(tab, "stage-svg")
    touch(tab, "Start", x + 60, y - 40)
    for way in range(5, 61, 5):
        touch(tab, "Move", x + 60, y - 40 - way)
    touch(tab, "End")
    wait_for(tab, f"scrollY > {before}", True)


@pytest.mark.parametrize("spin", [0, 200, 395, -395])
def test_the_knob_gives_spin(spin, show):
    tab = show(f"angle=30&friction=0.4&restitution=1&spin={spin}")
    x, y = middle(tab, "stage-knob")
    # About the centre of the ball, by 0.125 rad.
    u, v = middle(tab, "stage-grasp")
    turn = 0.125 if spin < 300 else -0.125
    x_end = u + (x - u) * math.cos(turn) - (y - v) * math.sin(turn)
    y_end = v + (x - u) * math.sin(turn) + (y - v) * math.cos(turn)
    mouse(tab, "Pressed", x, y)
    mouse(tab, "Moved", x_end, y_end)
    mouse(tab, "Released", x_end, y_end)
    tab.evaluate(FRAME)
    assert abs(value(tab, "spin") - (spin + 80 * turn)) <= 5
    wait_for(tab, "location.hash.includes('spin=')", True)
    assert value(tab, "time") == 0, "the knob does not throw"


def test_the_ball_is_thrown_by_keys(show):
    tab = show("angle=30&friction=0.4&restitution=1&speed=5&spin=0")
    tab.evaluate(f"{element('stage-grasp')}.focus()")
    for key in ("ArrowRight", "ArrowRight", "ArrowLeft", "ArrowUp", "PageUp", "PageDown", "PageUp"):
        tab.press(key)
    tab.evaluate(FRAME)
    assert [value(tab, name) for name in ("angle", "speed", "spin")] == [31, 5.2, 20]
    assert value(tab, "time") == 0
    tab.press("Enter")
    assert value(tab, "time") == pytest.approx(tab.evaluate("stage.duration()"))
    wait_for(tab, "location.hash.includes('speed=5.2&spin=20')", True)


def test_the_show_runs_pauses_and_ends(show):
    tab = show("angle=30&friction=0.4&restitution=0.5&speed=3", motion="no-preference")
    assert tab.evaluate(PLAY) == "Throw" and value(tab, "time") == 0
    start = ball_places(tab)
    type_in(tab, "pace", "2")
    click(tab, "play")
    assert tab.evaluate(PLAY) == "Pause"
    wait_for(tab, f"{element('time')}.value > 0.3", True)
    click(tab, "play")
    here = value(tab, "time")
    assert tab.evaluate(PLAY) == "Go on" and ball_places(tab) != start
    tab.evaluate(FRAME)
    assert value(tab, "time") == here
    # Just before its end, which it reaches by itself.
    type_in(tab, "time", str(tab.evaluate("stage.duration()") - 0.2))
    click(tab, "play")
    wait_for(tab, PLAY, "Throw")
    assert value(tab, "time") == pytest.approx(tab.evaluate("stage.duration()"))
    click(tab, "do-start")
    assert value(tab, "time") == 0 and ball_places(tab) == start
    assert text(tab, "stage-moment") == ""


def test_the_slider_of_time_shows_flights_and_bounces(show):
    tab = show(f"angle=40&friction=0.4&restitution=1&speed=5{SOLID}", height=3000)
    flights, (hand, _) = tab.evaluate("page.flights()"), ball_places(tab)
    first = flights["lumped"][0]
    type_in(tab, "time", "0.001")
    assert text(tab, "stage-moment").startswith("in flight")
    assert texts(tab, ".patch b") == ["no contact"] * 2
    assert text(tab, "diagram-state") == "in flight: no contact"
    ((lumped_now, continuum_now),) = at_times_places(tab, [1.0])
    assert text(tab, "stage-moment").startswith("bounce 1")
    scale = (lumped_now[0] - hand[0]) / (first["ball"]["along"] * first["time"])
    assert lumped_now[1] - hand[1] == pytest.approx(scale * first["ball"]["height"], abs=0.2)
    turned = lumped_now[2] - hand[2]
    assert turned == pytest.approx(math.degrees(first["ball"]["spin"] * first["time"]), abs=0.2)
    # After the bounce the spins of the two models part.
    type_in(tab, "time", str(tab.evaluate("stage.duration()")))
    ends = [flights[lane][2]["ball"]["spin"] for lane in ("lumped", "continuum")]
    assert abs(ends[0] - ends[1]) > 1


def at_times_places(tab, times):
    found = at_times(
        tab,
        times,
        "['lumped', 'continuum'].map((one) =>"
        " document.getElementById(`stage-${one}-ball`).getAttribute('transform'))",
    )
    return [[numbers_of(one)[:3] for one in both] for both in found]


# What is wrong in the picture now: a ball in a floor; words on other words or on the scale, or cut.
PICTURE = """(() => {
  const svg = document.getElementById("stage-svg"), [floor, wrong] = [stage.part("floor"), []];
  for (const ball of svg.querySelectorAll(".lane:not(.absent) .rim")) {
    const [place, radius] = [ball.getCTM(), ball.r.baseVal.value - 1];
    const rim = [...Array(24).keys()].map((k) =>
      new DOMPoint(radius * Math.cos(k), radius * Math.sin(k)).matrixTransform(place));
    if (rim.some((point) => floor.isPointInFill(point))) wrong.push("a ball in the floor");
  }
  const words = [...svg.querySelectorAll("text, .ruler")]
    .filter((e) => e.checkVisibility({ visibilityProperty: true }) && e.getBBox().width);
  const boxes = words.map((e) => [e.id || "name", e.getBoundingClientRect()]);
  const [{ left, right, top, bottom }, slack] = [svg.getBoundingClientRect(), 1];
  boxes.forEach(([id, box], i) => {
    if (box.left < left || box.right > right || box.top < top - slack || box.bottom > bottom)
      wrong.push(`${id} is cut`);
    for (const [other, { left, right, top, bottom }] of boxes.slice(i + 1))
      if (Math.min(box.right, right) - Math.max(box.left, left) > slack &&
        Math.min(box.bottom, bottom) - Math.max(box.top, top) > slack)
        wrong.push(`${other} on ${id}`);
  });
  return wrong;
})()"""


@pytest.mark.parametrize("width", [360, 1280])
def test_balls_are_above_their_floors_and_no_words_cover_others(width, show):
    tab, found = show(width=width), {}
    for angle, speed, e, spin, more in (
        (50, 6, 0.9, 0, ""),
        (5, 12, 1, 300, ""),
        (89, 12, 0.5, -300, ""),
        (60, 12, 0.1, 0, "&loss=plastic"),
        (70, 5, 0, -400, ""),
        (50, 8, 0.9, 0, "&table=0.7&gravity=0"),
        (30, 2, 0.9, 100, "&table=0.15"),
    ):
        state = f"angle={angle}&speed={speed}&restitution={e}&spin={spin}{more}{SOLID}"
        tab.evaluate(f"page.go('friction=0.8&{state}')")
        tab.evaluate(FRAME)
        found[state, "at rest"] = tab.evaluate(PICTURE)
        for time, wrong in zip((0.1, 1, 1.5), at_times(tab, (0.1, 1, 1.5), PICTURE), strict=True):
            found[state, time] = wrong
        type_in(tab, "time", str(tab.evaluate("stage.duration()")))
        found[state, "end"] = tab.evaluate(PICTURE)
    assert [(where, wrong) for where, wrong in found.items() if wrong] == []


def test_the_stage_alone(show):
    state = f"angle=40&friction=0.4&restitution=1{SOLID}"
    tab = show(state, query="?stage")
    parts = ["stage-svg", "play", "time", "patches", "angle", "angle-number"]
    gone = ["preset", "friction", "incidence", "outcomes", "challenge", "diagram-svg", "forces"]
    gone += ["do-dark", "energies", "numbers"]
    for name in parts + gone:
        assert tab.evaluate(f"{element(name)}.checkVisibility()") == (name in parts), name
    entries = tab.evaluate("history.length")
    type_in(tab, "angle-number", "25")
    wait_for(tab, "location.hash.startsWith('#angle=25&')", True)
    assert tab.evaluate("history.length") == entries


# ---- the contact, seen through the floor


def patch_at(tab, time, lane="continuum"):
    """Radii and kinds of the zones at t/t_c, from outside, and the words below."""
    zones = (
        f"[...document.querySelectorAll('#patch-{lane} .zone')].filter((e) => +e.getAttribute('r'))"
        ".map((e) => [+e.getAttribute('r') / patch.RADIUS, e.classList.contains('sticks')])"
    )
    words = f"document.getElementById('patch-{lane}-words').textContent"
    (found,) = at_times(tab, [time], f"[{zones}, {words}]")
    return found


@pytest.mark.parametrize("time", [1.2, 1.4, 1.6])
def test_the_middle_sticks_and_the_edge_slips(time, show):
    tab = show(f"angle=15&friction=0.4&restitution=1{SOLID}")
    x = math.tan(math.radians(15)) / 0.4
    theirs = continuum.history(x, 3.5, 17 / 14)
    stick, radius = (
        np.interp(time, theirs.time, column)
        for column in (theirs.stick_radius, theirs.contact_radius)
    )
    zones, words = patch_at(tab, time)
    assert words == "middle sticks, edge slips"
    assert [sticks for _, sticks in zones] == [False, True]
    assert abs(zones[0][0] - radius) < 0.05 and abs(zones[1][0] - stick) < 0.05
    click(tab, "do-micro")
    assert text(tab, "patch-continuum-words") == words
    # The lumped model has one point.
    zones, words = patch_at(tab, time, "lumped")
    assert len(zones) == 1 and words == f"all of it {'sticks' if zones[0][1] else 'slips'}"


@pytest.mark.parametrize(("e", "loss"), [(1, "viscous"), (0.6, "viscous"), (0.6, "plastic")])
def test_the_stress_over_the_patch_is_the_friction(e, loss, show):
    """Friction is 2 pi times the integral of r times stress: Abel's transform keeps it."""
    tab = show(f"angle=30&friction=0.4&restitution={e}&loss={loss}{SOLID}")
    body = PATCH.read_text(encoding="utf-8").replace("const patch = ", "return ")
    body = body.replace("return { show,", "return { stress, show,")
    total = (
        f"(() => {{ const {{ stress }} = (() => {{ {body} }})();"
        " const { contact, e } = page.impact(), motion = continuum.normal(e, contact.style);"
        " return [0.3, 0.7, 1, 1.2, 1.5].map((time) => { const row = models.at(contact, time);"
        " const edge = Math.sqrt(row.limit.square), n = 4000;"
        " const radii = Array.from({ length: n }, (_, i) => ((i + 0.5) / n) * edge);"
        " const values = stress(row.density, motion.radius / motion.springs, edge, radii, 1);"
        " const sum = radii.reduce((sum, r, i) => sum + r * values[i], 0) * edge / n;"
        " return [2 * sum / motion.largest, row.friction]; }); })()"
    )
    ours, friction = np.transpose(tab.evaluate(total))
    assert np.abs(friction).max() > 0.3
    assert np.abs(ours - friction).max() < 0.03 * np.abs(friction).max()


def test_arrows_show_friction_on_the_ball(show):
    tab = show(f"angle=70&friction=0.2&restitution=1{SOLID}")  # slips throughout
    for lane in ("lumped", "continuum"):
        outline = f"document.querySelector('#patch-{lane} .stress').getAttribute('d')"
        (marks,) = at_times(tab, [1.0], outline)
        lines = np.array(re.findall(r"M(\S+?),(\S+?)H(\S+?)M", marks), float)
        x, y, neck = lines.T
        assert (neck <= x).all() and (neck < x).sum() > 60, "it holds the ball back"
        # Each is as long as the pressure there is large: largest in the middle.
        long, far = x - neck, np.hypot((x + neck) / 2, y)
        assert long[far < 30].min() > long[far > 70].max()


# ---- the challenges

# For each wish an impact that misses it, and the words that say so.
WRONG = [
    ("angle=45&friction=0.3&restitution=1", "The impulse of friction is"),
    ("angle=45&friction=0.7&restitution=1", "µζ² is 85.0 % of tan θ"),
    ("angle=45&friction=1&restitution=1", "The share that friction takes is"),
    ("angle=55&friction=0.5&restitution=1", "The share that comes back is 44.6 %"),
    ("angle=50&friction=0.5&restitution=0.9", "Restitution is too small by 0.10."),
]


def test_each_wish_has_an_answer_and_a_wrong_one(show):
    tab = show("angle=0")
    assert len(texts(tab, ".verdict")) == len(WRONG)
    for index, (address, words) in enumerate(WRONG):
        tab.evaluate(f"page.go('{address}{SOLID}')")
        tab.evaluate(FRAME)
        assert texts(tab, ".verdict")[index].startswith(words)
        tab.evaluate(f"document.querySelectorAll('#challenge button')[{index}].click()")
        tab.evaluate(FRAME)
        # The continuum agrees, or it would be named.
        assert texts(tab, ".verdict")[index] == "\u2713 You have met it."
        assert texts(tab, "#challenge .heard") == [f"Challenge {index + 1} is met."]


@pytest.mark.parametrize(
    ("address", "words"),
    [
        # Below e = 1 the lumped contact slips throughout where the continua still stick.
        (
            f"angle=45&friction=0.25&restitution=0.5{SOLID}",
            r"✓ .* continuum, viscous: The impulse.* continuum, plastic: The impulse",
        ),
        ("angle=45&friction=0.1&restitution=0.05", "✓ .* The continuum has no answer"),
    ],
)
def test_it_says_where_the_continuum_disagrees(address, words, show):
    assert re.match(words, texts(show(address), ".verdict")[0])


def test_a_solid_ball_gets_back_at_most_what_the_hint_says(show):
    zeta2 = np.linspace(1, 1.5, 26)[:, None]  # Poisson's ratio 0 to 1/2
    x = np.linspace(0.02, 7, 150)
    shares = [
        (-found.velocity / x).max()
        for found in (
            lumped.rebound(x, 3.5, zeta2, 1.0),
            continuum.rebound(x, 3.5, zeta2, 1.0, tolerance=1e-4),
        )
    ]
    said = "its best is {:.0f} % here, {:.1f} % in the continuum".format(*(100 * np.array(shares)))
    assert said in show().evaluate("document.querySelector('#challenge').textContent")
