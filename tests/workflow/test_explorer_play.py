"""The superball scene agrees with the superball's curve; each challenge has an answer."""

import json
import re
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from planarimpact import lumped, rigid, spheres
from planarimpact.spheres import table
from stronge1994 import plan
from stronge1994.figures.superball import curves as superball
from stronge1994.plan import config as configuration

ROOT = Path(__file__).parents[2]
ACCURACY = 1e-9
MODELS = {
    "lumped": lambda x, zeta2, e: lumped.rebound(x, 3.5, zeta2, e).velocity,
    "rigid": lambda x, zeta2, e: rigid.rebound(x, 3.5, zeta2, e).velocity,
}


@pytest.fixture(scope="module")
def throw():
    return plan.settings_of_explorer(configuration.load(ROOT))["figures"]["superball"]["throw"]


def flights(tab, throws, model):
    return tab.evaluate(f"{json.dumps(throws)}.map((one) => superball.fly(one, '{model}'))")


def column(path, *names):
    return np.array([[state[name] for name in names] for state in path])


def test_the_classic_throw_is_that_of_the_curve(throw, show, monkeypatch):
    tab = show()
    given = tab.evaluate("Object.fromEntries(new FormData(document.querySelector('.scene form')))")
    assert given.pop("model") == "continuum" and throw["loss"] == "viscous"
    given = {name: float(value) for name, value in given.items()}
    along, up = throw["velocity"]
    wanted = {"along": along, "down": -up, "spin": -throw["spin"]}
    assert given == wanted | {name: throw[name] for name in given.keys() - wanted.keys()}

    # A spin too: the page has the coarse table, so has the package here.
    coarse = table.shipped("coarse")
    monkeypatch.setattr(table, "shipped", lambda name="fine": coarse)
    monkeypatch.setattr(superball, "TOLERANCE", 1e-2)
    for spin in (0.0, -130.0, 220.0):
        path = superball.curves(throw | {"spin": -spin})["path"]
        (found,) = flights(tab, [given | {"spin": spin}], "continuum")
        places, heights = column(found, "place", "height").T
        close = {
            "place [m]": places - places[1],
            "height [m]": heights + throw["radius"],
            "velocity_x [m/s]": column(found, "along")[:, 0],
            "velocity_z [m/s]": column(found, "up")[:, 0],
            "spin_y [rad/s]": column(found, "spin")[:, 0],
        }
        for name, ours in close.items():
            size = max(1.0, np.abs(path[name]).max())
            assert np.abs(ours - path[name]).max() <= ACCURACY * size, name


@pytest.mark.parametrize("model", MODELS)
def test_impacts_keep_what_mechanics_keeps(model, throw, show):
    rng = np.random.default_rng(1969)
    names = "along", "down", "spin", "friction", "restitution", "poisson_ratio"
    low, high = [0, 2, -400, 0.05, 0.3, 0], [10, 10, 400, 2, 1, 0.5]
    throws = [dict(zip(names, row, strict=True)) for row in rng.uniform(low, high, (60, 6))]
    radius = throw["radius"]
    for given, path in zip(throws, flights(show(), throws, model), strict=True):
        e, nu = given["restitution"], given["poisson_ratio"]
        for number, (before, after) in enumerate(pairwise(path[:-1])):
            arm = np.array([0, 0, radius if number == 1 else -radius])
            (v, v_after), (w, w_after) = (
                [np.array([state["along"], 0, state["up"]]) for state in (before, after)],
                [np.array([0, state["spin"], 0]) for state in (before, after)],
            )
            inertia = 2 / 5 * radius**2
            momenta = [np.cross(-arm, one) + inertia * o for one, o in ((v, w), (v_after, w_after))]
            assert np.abs(momenta[0] - momenta[1])[1] < 1e-12
            energies = [a @ a + inertia * b @ b for a, b in ((v, w), (v_after, w_after))]
            assert energies[1] <= energies[0] * (1 + 1e-12)
            assert v_after[2] == pytest.approx(-e * v[2], rel=1e-12)
            unit = given["friction"] * abs(v[2])
            x, x_after = (v + np.cross(w, arm))[0] / unit, (v_after + np.cross(w_after, arm))[0]
            wanted = MODELS[model](abs(x), (2 - nu) / (2 * (1 - nu)), e) * np.sign(x)
            assert x_after / unit == pytest.approx(wanted, abs=ACCURACY * max(1, abs(x)))


def middle(tab, selector):
    box = f"document.querySelector('{selector}').getBoundingClientRect()"
    return tab.evaluate(f"(({{x, y, width, height}}) => [x + width / 2, y + height / 2])({box})")


def test_a_drag_throws(show):
    tab = show(width=390, height=844)
    said = "document.querySelector('.said').textContent"
    heard = "document.querySelector('#superball .heard').textContent"
    first = tab.evaluate(said)
    assert re.match(r"After floor, table and floor the superball flies back towards you", first)
    tab.evaluate("document.querySelector('.scene').scrollIntoView()")
    x, y = middle(tab, ".grasp")
    scale = tab.evaluate("document.querySelector('.scene svg').getScreenCTM().a")
    mouse = {"button": "left", "clickCount": 1, "buttons": 1}
    x_end, y_end = x + 2 * 16 * scale, y + 9 * 16 * scale
    tab.call("Input.dispatchMouseEvent", type="mousePressed", x=x, y=y, **mouse)
    tab.call("Input.dispatchMouseEvent", type="mouseMoved", x=x_end, y=y_end, **mouse)
    assert tab.evaluate(said) != first and tab.evaluate(heard) == ""
    tab.call("Input.dispatchMouseEvent", type="mouseReleased", x=x_end, y=y_end, **mouse)
    thrown = "['along', 'down'].map((one) => +document.querySelector(`[name=${one}]`).value)"
    assert np.abs(np.array(tab.evaluate(thrown)) - [2, 9]).max() < 0.11
    assert tab.evaluate(heard) == tab.evaluate(said)
    # The classic throw again: with less motion its whole trace is there at once.
    tab.evaluate("document.querySelector('[type=reset]').click()")
    tab.evaluate("new Promise((done) => setTimeout(done, 50))")
    assert tab.evaluate(heard) == first
    trace = "document.querySelector('.thrown path').getAttribute('d').split('L').length"
    assert tab.evaluate(trace) >= 5
    tab.prefer(reduced_motion="no-preference")
    tab.evaluate("document.querySelector('.scene form').requestSubmit()")
    tab.evaluate("new Promise((done) => setTimeout(done, 100))")
    assert tab.evaluate(trace) == 2


def test_a_touch_scrolls_unless_it_starts_on_the_ball(show):
    tab = show(width=390, height=844)
    for selector, scrolls in ((".grasp", False), (".scene svg", True)):
        tab.evaluate("document.querySelector('.scene').scrollIntoView()")
        before = tab.evaluate("scrollY")
        x, y = middle(tab, selector)
        for way in range(0, 61, 5):
            kind = "touchMove" if way else "touchStart"
            point = {"x": x + way / 5, "y": y - way}
            tab.call("Input.dispatchTouchEvent", type=kind, touchPoints=[point])
        tab.call("Input.dispatchTouchEvent", type="touchEnd", touchPoints=[])
        tab.evaluate("new Promise((done) => setTimeout(done, 100))")
        assert (tab.evaluate("scrollY") != before) == scrolls


# ---- the challenges

# For each wish an impact that misses it, and the words that say so.
WRONG = [
    ("angle=45&friction=0.3&restitution=1", "Friction’s impulse is"),
    ("angle=45&friction=0.7&restitution=1", "µζ² is 85.0 % of tan θ"),
    ("angle=45&friction=1&restitution=1", "Friction takes"),
    ("angle=55&friction=0.5&restitution=1", "It comes back with 44.6 %"),
    ("angle=50&friction=0.5&restitution=0.9", "Restitution is too small by 0.10."),
]
SOLID = "&poisson_ratio=0.3&mass_ratio=3.5"


def verdicts(tab):
    return tab.evaluate("[...document.querySelectorAll('.verdict')].map((one) => one.textContent)")


def test_each_wish_has_an_answer_and_a_wrong_one(show):
    tab = show("angle=0")
    assert len(verdicts(tab)) == len(WRONG)
    for index, (address, words) in enumerate(WRONG):
        tab.evaluate(f"page.go('{address}{SOLID}')")
        assert verdicts(tab)[index].startswith(words)
        tab.evaluate(f"document.querySelectorAll('#challenge button')[{index}].click()")
        # The continuum agrees, or it would be named.
        assert verdicts(tab)[index] == "\u2713 You have met it."
        heard = tab.evaluate("document.querySelector('#challenge .heard').textContent")
        assert heard == f"Challenge {index + 1} is met."


@pytest.mark.parametrize(
    ("address", "words"),
    [
        # Below e = 1 the lumped contact slips throughout where the continua still stick.
        (
            f"angle=45&friction=0.25&restitution=0.5{SOLID}",
            r"✓ .* viscous continuum: Friction.* plastic continuum: Friction",
        ),
        ("angle=45&friction=0.1&restitution=0.2", "✓ .* The continuum has no table"),
    ],
)
def test_it_says_where_the_continuum_disagrees(address, words, show):
    assert re.match(words, verdicts(show(address))[0])


def test_a_solid_ball_gets_back_at_most_what_the_hint_says(show):
    zeta2 = np.linspace(1, 1.5, 101)[:, None]  # Poisson's ratio 0 to 1/2
    x = np.linspace(0.02, 7, 1000)
    hints = "document.querySelector('#challenge').textContent"
    lumped_share, share = (
        (-found.velocity / x).max()
        for found in (lumped.rebound(x, 3.5, zeta2, 1.0), spheres.rebound(x, 3.5, zeta2, 1.0))
    )
    said = f"its best is {100 * lumped_share:.0f} % here, {100 * share:.1f} % in the continuum"
    assert said in show().evaluate(hints) and share < 0.599
