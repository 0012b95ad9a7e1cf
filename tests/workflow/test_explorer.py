"""The explorer in a browser: what a person does there, and what must be seen then.

All of it is skipped where there is no browser; what the page solves is tested without one.
"""

import io
import itertools
import json
import math
import re

import numpy as np
import pytest
import yaml
from matplotlib.image import imread

from planarimpact import bodies, collision, continuum, lumped
from stronge1994 import settings as figure_settings
from stronge1994.explorer import page as write_explorer
from stronge1994.settings import figures
from tests.reference_solutions import table_files
from tests.workflow import node
from tests.workflow.project import config

SLIDERS = list(write_explorer.LIMITS)
SOLID = "&poisson_ratio=0.3&mass_ratio=3.5"
SUPERBALL = (
    "angle=45&friction=0.8&restitution=0.9&poisson_ratio=0.5&mass_ratio=3.5&speed=7.07&table=0.7"
    "&gravity=0"
)
# A change is drawn in the next frame of the browser.
FRAME = "new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))"
PLAY = "document.getElementById('play').textContent.split(' ').slice(1).join(' ')"


def element(name):
    return f"document.getElementById('{name}')"


def text(tab, name):
    return tab.evaluate(f"{element(name)}.textContent.trim()")


def texts(tab, query):
    return tab.evaluate(f"[...document.querySelectorAll('{query}')].map((e) => e.textContent)")


def is_drawn(tab, name):
    return tab.evaluate(f"{element(name)}.getClientRects().length > 0")


def value(tab, name):
    return float(tab.evaluate(f"{element(name)}.value"))


def type_in(tab, name, typed):
    """Type into a box, or choose in a list or of a slider."""
    tab.evaluate(
        f"{{ const box = {element(name)}; box.value = '{typed}';"
        " for (const kind of ['input', 'change']) box.dispatchEvent(new Event(kind)); }"
    )
    tab.evaluate(FRAME)


def click(tab, name):
    tab.evaluate(f"{element(name)}.click()")
    tab.evaluate(FRAME)


def press(tab, name, *keys):
    """Press keys at an element."""
    tab.evaluate(f"{element(name)}.focus()")
    for key in keys:
        tab.press(key)
    tab.evaluate(FRAME)


def unfold(tab):
    """Open the other controls, and the chart."""
    for name in ("more", "rebound"):
        tab.evaluate(f"{element(name)}.open = true")
    tab.evaluate(FRAME)


def go(tab, address):
    tab.evaluate(f"page.go('{address}')")
    tab.evaluate(FRAME)


def wait_for(tab, expression, wanted):
    """Wait until a JavaScript expression has a value; for what the page does a little later."""
    tab.page.wait_for_function(f"({expression}) === {json.dumps(wanted)}", timeout=5000)


def middle(tab, name):
    """The middle of an element on the screen, once it is in view."""
    return tab.evaluate(
        f"(() => {{ {element(name)}.scrollIntoView({{ block: 'nearest' }});"
        f" const {{ x, y, width, height }} = {element(name)}.getBoundingClientRect();"
        " return [x + width / 2, y + height / 2]; })()"
    )


def drag(tab, how, *places):
    """Press a mouse or put a finger at the first place, move to the others, let go."""
    kinds = ["Pressed", *["Moved"] * len(places[1:]), "Released"]
    for kind, (x, y) in zip(kinds, [*places, places[-1]], strict=True):
        if how == "mouse":
            more = {"button": "left", "buttons": 1, "clickCount": 1}
            tab.call("Input.dispatchMouseEvent", type=f"mouse{kind}", x=x, y=y, **more)
        else:
            points = [] if kind == "Released" else [{"x": x, "y": y}]
            kind = {"Pressed": "Start", "Moved": "Move", "Released": "End"}[kind]
            tab.call("Input.dispatchTouchEvent", type=f"touch{kind}", touchPoints=points)
        tab.evaluate(FRAME)


# ---- the page


def test_a_run_writes_this_page_and_it_needs_nothing_else(first_run, explorer):
    page = explorer.read_text(encoding="utf-8")
    assert (first_run[0] / "figures/explorer.html").read_text(encoding="utf-8") == page
    # All else are links, which load nothing.
    assert not re.search(r"https?:|@import|\bsrc\s*=\s*[\"']", page)
    linked = re.findall(r"<(\w+)[^>]*\bhref=\"([^\"]*)\"", page)
    assert [address for tag, address in linked if tag != "a"] == ["data:,"]
    # Who has no JavaScript reads so before an empty stage.
    assert page.index("<noscript>") < page.index('id="stage-svg"')


def test_a_page_with_a_wrong_solver_says_so(tab, explorer, tmp_path):
    page = explorer.read_text(encoding="utf-8")
    answer = "return { velocity, peak_friction, dissipation, regime }"
    assert page.count(answer) == 1
    wrong = tmp_path / "wrong.html"
    wrong.write_text(page.replace(answer, answer.replace("velocity,", "velocity: 0,")))
    for path, warnings in ((explorer, 0), (wrong, 1)):
        tab.open(path.as_uri())
        assert len(texts(tab, "main > [role=alert]")) == warnings


# ---- what a person does


def test_numbers_are_typed_or_moved_by_keys(show):
    state = "angle=50&friction=0.5&restitution=0.6&poisson_ratio=0.3&mass_ratio=3&compliance=0.9"
    state += "&table=1"
    tab = show(state)
    unfold(tab)
    for slider in SLIDERS:
        go(tab, state)
        parts = "#stage-svg"
        if slider in (*write_explorer.OF_FIGURES, "compliance"):
            parts += ", #incidence"
        # At the end of the show, which has the whole path.
        drawn = f"(() => {{ const time = {element('time')}; time.value = time.max;"
        drawn += " time.dispatchEvent(new Event('input'));"
        drawn += f" return [...document.querySelectorAll('{parts}')].map((e) => e.outerHTML); }})()"
        before, start, box = tab.evaluate(drawn), value(tab, slider), f"{slider}-number"
        press(tab, slider, "ArrowRight")
        assert value(tab, box) == value(tab, slider) > start
        assert all(a != b for a, b in zip(before, tab.evaluate(drawn), strict=True)), slider
        least, largest, _ = write_explorer.LIMITS[slider]
        for typed in (least, largest):
            type_in(tab, box, f" {str(typed).replace('.', ',')} ")
            assert value(tab, slider) == value(tab, box) == typed
        for typed in (f"{least - 0.01}", "1e9", "", "1 000"):
            type_in(tab, box, typed)
            assert value(tab, slider) == value(tab, box) == largest
            words = f"“{typed}” is refused. Allowed: numbers from {least} to {largest}."
            assert text(tab, "refused").endswith(words)
        press(tab, box, "ArrowDown")
        assert value(tab, slider) < largest and text(tab, "refused") == ""


def test_everything_is_reached_and_done_by_keys(show):
    tab, reached = show("angle=30&friction=0.4&restitution=1&speed=5&spin=0", width=390), set()
    controls = "[...document.querySelectorAll('button, input, select, [tabindex]')]"
    there = "!e.disabled && e.getClientRects().length && !e.closest('details:not([open])')"
    first_sight = tab.evaluate(f"{controls}.filter((e) => {there}).length")
    unfold(tab)
    name = "e.id || e.textContent"
    for _ in range(70):
        tab.press("Tab")
        reached.add(tab.evaluate(f"((e) => {name})(document.activeElement)"))
    wanted = tab.evaluate(f"{controls}.filter((e) => {there}).map((e) => {name})")
    assert first_sight <= 20 < len(wanted) and set(wanted) <= reached
    press(tab, "stage-grasp", "ArrowRight", "ArrowRight", "ArrowLeft", "PageUp", "PageUp")
    press(tab, "stage-grasp", "ArrowUp", "ArrowUp", "ArrowDown", "PageDown")
    assert [value(tab, name) for name in ("angle", "speed", "spin", "time")] == [31, 5.2, 20, 0]
    # With less motion one moment comes after the other, whatever throws.
    first, second = tab.evaluate("stage.moments()")[:2]
    for thrown in (lambda: press(tab, "stage-grasp", "Enter"), lambda: click(tab, "play")):
        click(tab, "do-start")
        thrown()
        assert value(tab, "time") == pytest.approx(first)
    press(tab, "do-moment", "Enter")
    assert value(tab, "time") == pytest.approx(second)


def test_the_next_moment_shows_what_begins(show):
    """The superball under a table: what is said of its spring, of each bounce and at the end."""
    tab, said, words = show(SUPERBALL), [], []
    while "the end" not in said:
        click(tab, "do-moment")
        said.append(tab.evaluate(f"{element('time')}.ariaValueText"))
        words.append("".join(texts(tab, "#stage-lower-lens text")))
    first = [one for one, moment in zip(words, said, strict=True) if "bounce 1" in moment]
    sticks = ["spring stretches", "point at rest, spring stretched most"]
    sticks = [f"sticks:{words}" for words in [*sticks, "spring stretches the other way"]]
    assert first == [*sticks, "slips:friction at its limit"]
    assert [moment for moment in said if "bounce" not in moment] == [
        *["in flight, 10 times slower"] * 3,
        "the end",
    ]
    assert said[0] == "bounce 1, 1 % of the contact is over"
    # After the end it begins again.
    click(tab, "do-moment")
    assert "bounce 1, 1 %" in tab.evaluate(f"{element('time')}.ariaValueText")


def test_there_is_no_table_below_four_radii_of_the_ball(show):
    for table in (0.09, 0.11):
        tab = show(f"angle=30&friction=0.4&restitution=1{SOLID}&radius=25&table={table}")
        assert text(tab, "stage-table-word") == ("table" if table > 0.1 else "")


# ---- first a question


def test_who_comes_without_a_throw_is_asked_before_he_sees(show):
    for query in ("", "?stage&ask"):
        tab = show(query=query)
        for step in range(3):
            seen = tab.evaluate("document.body.innerText")
            # No answer, and one ball, before both balls are compared; no words of a contact.
            assert not re.search("comes? back|came back|recoil|turns? round|m/s forw", seen), seen
            assert ("spring along the surface" in seen) == (step == 2), seen
            words = "[...document.querySelectorAll('.lens-words, .lane-name')]"
            assert tab.evaluate(f"{words}.every((e) => !e.getClientRects().length)")
            assert is_drawn(tab, "stage-upper-ball") == (step == 2)
            assert is_drawn(tab, "stage-guess") == (step < 2)
            if step == 0:
                assert "on its way up after its third bounce?" in text(tab, "sentence")
                assert tab.evaluate(f"{element('play')}.disabled")
                press(tab, "stage-guess", "ArrowRight")
                x, y = middle(tab, "stage-svg")
                drag(tab, "mouse", (x + 100, y))
                assert text(tab, "stage-guess-word") == "your guess"
                # No moment of this throw is seen but its end.
                click(tab, "play")
                assert value(tab, "time") == pytest.approx(tab.evaluate("stage.duration()"))
                guess = float(tab.evaluate(f"{element('stage-guess')}.ariaValueNow"))
                off = tab.evaluate("stage.last_place()") - guess
                assert text(tab, "sentence") == f"It is {-off:.1f} m left of your guess."
            else:
                click(tab, "do-ask")
        assert not tab.evaluate(f"{element('do-ask')}.checkVisibility()")
        type_in(tab, "time", "99")
        assert "came back" in text(tab, "sentence")
    # Who is asked about a throw does not change it.
    tab = show()
    press(tab, "stage-grasp", "ArrowRight")
    x, y = middle(tab, "stage-grasp")
    drag(tab, "mouse", (x, y), (x + 70, y + 10))
    assert (value(tab, "angle"), value(tab, "speed"), value(tab, "time")) == (45, 7.1, 0)
    # A lecture that asks explains by itself.
    tab = show(SUPERBALL, query="?stage&ask")
    press(tab, "stage-guess", "ArrowRight")
    click(tab, "play")
    click(tab, "do-ask")
    assert "the lecture comes back to it" in text(tab, "sentence")
    assert not tab.evaluate(f"{element('do-ask')}.checkVisibility()")
    # Who has a throw, or skips the question, is not asked.
    assert "The same throw twice" in text(show(SUPERBALL), "sentence")
    tab = show()
    click(tab, "do-ask")
    assert "The same throw twice" in text(tab, "sentence")
    # Back undoes a change, and neither asks again nor brings the other ball.
    click(tab, "do-lone")
    for angle in (20, 30):
        type_in(tab, "angle", angle)
        wait_for(tab, f"location.hash.startsWith('#angle={angle}&')", True)
    for angle in ("20", "45"):
        tab.evaluate("history.back()")
        wait_for(tab, f"{element('angle')}.value", angle)
        assert not is_drawn(tab, "stage-upper-ball") and is_drawn(tab, "controls")
    assert tab.evaluate(f"{element('do-lone')}.ariaPressed") == "true"
    assert tab.evaluate("location.hash") == ""
    # Who writes a throw behind the address is asked no more.
    tab = show()
    tab.evaluate(f"location.hash = '{SUPERBALL}'")
    wait_for(tab, "document.documentElement.dataset.asks ?? ''", "")


def test_a_hall_sees_a_large_spring_and_one_ball(show):
    width = "document.querySelector('#stage-lower-lens .glass').getBoundingClientRect().width"
    tab = show(SUPERBALL, width=1440, height=900, query="?stage&hall")
    click(tab, "do-moment")
    assert tab.evaluate(width) == pytest.approx(250, abs=5)
    for shown in ([False, True], [True, True]):
        click(tab, "do-lone")
        assert [is_drawn(tab, f"stage-{lane}-ball") for lane in ("upper", "lower")] == shown
        assert tab.evaluate(width) == pytest.approx(250 if shown[0] else 375, abs=5)
        assert is_drawn(tab, "stage-upper-lens") == shown[0]
    assert not tab.evaluate(f"{element('compliance')}.checkVisibility()")


def test_a_copy_inside_a_notebook_has_its_throw_inside(explorer, show, tmp_path):
    page = explorer.read_text(encoding="utf-8")
    inside = page.replace('<html lang="en">', f'<html lang="en" data-address="?stage#{SUPERBALL}">')
    tab = show()
    tab.open("data:text/html,<iframe style='width:900px;height:700px'></iframe>")
    tab.evaluate(f"document.querySelector('iframe').srcdoc = {json.dumps(inside)}")
    inner = "document.querySelector('iframe').contentDocument"
    wait_for(tab, f"{inner}?.getElementById('table')?.value", "0.7")
    tab.evaluate(f"{inner}.getElementById('do-moment').click()")
    wait_for(tab, f"{inner}.getElementById('stage-moment').textContent", "bounce 1, in slow motion")


@pytest.mark.parametrize(
    ("how", "lane", "ball", "spin"),  # the knob turns by more than half a turn
    [("touch", "lower", "stage-grasp", 200), ("mouse", "upper", "stage-other-grasp", -390)],
)
def test_a_ball_is_pulled_and_flies(how, lane, ball, spin, show):
    width = 390 if how == "touch" else 1280
    tab = show(f"angle=30&friction=0.4&restitution=1&speed=5&spin={spin}", width=width)
    knob, centre = (np.array(middle(tab, f"stage-{name}")) for name in ("knob", "grasp"))
    # The knob gives spin about the centre of the ball, here by 0.125 rad, and does not throw.
    across = np.array([centre[1] - knob[1], knob[0] - centre[0]])
    drag(tab, how, knob.tolist(), (knob + 0.125 * across).tolist())
    assert abs(value(tab, "spin") - (spin + 80 * 0.125)) <= 5 and value(tab, "time") == 0
    x, y = middle(tab, ball)
    ends = {way: (x + way * 70, y + way * 30) for way in (1, -1)}
    wanted, pulled = [
        tab.evaluate(f"stage.aim_at({{ clientX: {u}, clientY: {v} }}, '{lane}')")
        for u, v in ends.values()
    ]
    assert wanted["speed"] > 1 and wanted["angle"] > 45
    # Pulled back, as a slingshot, the ball flies the other way.
    assert pulled == pytest.approx(wanted, abs=0.2)
    drag(tab, how, (x, y), (x + 35, y + 15), ends[1])
    assert {name: value(tab, name) for name in wanted} == wanted
    assert value(tab, "time") == pytest.approx(tab.evaluate("stage.moments()[0]"))


# Shows the first bounce at a share of its contact; a share of 1 is just after it.
FIRST_BOUNCE = """((share) => {
  const times = [...Array(2001).keys()].map((i) => (i / 2000) * stage.duration());
  const inside = times.filter((now) => {
    stage.show(now);
    return stage.part('moment').textContent.startsWith('bounce 1,');
  });
  const [slider, start] = [document.getElementById('time'), times.indexOf(inside[0])];
  slider.value = times[start + Math.round(share * inside.length)];
  slider.dispatchEvent(new Event('input'));
})"""


def test_what_is_shown_of_a_bounce_is_what_the_package_says(show):
    """A ball that is thrown with clockwise spin, so that its contact point comes backwards."""
    angle, mu, e, beta, zeta2, speed, spin, radius = 51, 0.5, 0.8, 3.5, 17 / 14, 6, 300, 0.025
    throw = f"angle={angle}&friction={mu}&restitution={e}&speed={speed}&spin={spin}"
    tab = show(f"{throw}{SOLID}")
    along, up = speed * math.sin(math.radians(angle)), speed * math.cos(math.radians(angle))
    unit, x = -mu * up, (radius * spin - along) / (mu * up)
    own = lumped.rebound(x, beta, zeta2, e)
    change = unit * (own.velocity - x)
    tab.evaluate(f"{FIRST_BOUNCE}(0.1)")
    for kind, way in (("velocity", -1), ("friction", 1)):
        arrow = f"document.querySelector('#stage-lower-lens .arrow.{kind}').getAttribute('d')"
        places = f"{arrow}.match(/-?[\\d.]+/g).map(Number)"
        assert tab.evaluate(f"((all) => Math.sign(all[6] - all[0]))({places})") == way, kind
    tab.evaluate(f"{FIRST_BOUNCE}(1)")
    turning = spin - (1 - 1 / beta) * change / radius
    way = f"{abs(along + change / beta):.1f} m/s forwards, {abs(turning):.0f} rad/s "
    assert text(tab, "stage-lower-numbers") == way + (
        "clockwise" if turning > 0 else "anticlockwise"
    )
    share = abs(own.velocity / x)
    said = f"{100 * share:.{int(share < 0.095)}f}\u00a0% of the speed it came with"
    assert said in text(tab, "sentence")


def test_the_show_runs_pauses_and_ends(show):
    tab = show("angle=30&friction=0.4&restitution=0.5&speed=3", motion="no-preference")
    assert tab.evaluate(PLAY) == "Throw" and value(tab, "time") == 0
    click(tab, "play")
    assert tab.evaluate(PLAY) == "Pause"
    wait_for(tab, f"{element('time')}.value > 0.1", True)
    tab.press(" ")
    here = value(tab, "time")
    assert tab.evaluate(PLAY) == "Go on"
    tab.evaluate(FRAME)
    assert value(tab, "time") == here
    # A space at the ball in the hand goes on and pauses as well.
    for said in ("Pause", "Go on"):
        press(tab, "stage-grasp", " ")
        assert tab.evaluate(PLAY) == said
    assert value(tab, "time") >= here
    # Just before its end, which it reaches by itself.
    type_in(tab, "time", str(tab.evaluate("stage.duration()") - 0.1))
    click(tab, "play")
    wait_for(tab, PLAY, "Throw")
    assert value(tab, "time") == pytest.approx(tab.evaluate("stage.duration()"))
    click(tab, "do-start")
    assert value(tab, "time") == 0


def test_a_link_leads_back_to_an_impact(show):
    state = "angle=33.3&friction=0.7&restitution=0.25&poisson_ratio=0.1&mass_ratio=4"
    more = "&compliance=0.4&speed=3&spin=-50&table=0.5&radius=10&gravity=0&view=energy"
    tab = show(f"{state}{more}")
    wanted = [33.3, 0.7, 0.25, 0.1, 4.0, 3, -50, 0.5, 0.4, 10, 0]
    assert [value(tab, name) for name in SLIDERS] == wanted
    # One change, as they follow at once.
    tab.evaluate(
        f"{{ const box = {element('angle-number')}; for (const typed of [40, 45, 50]) {{"
        " box.value = typed; box.dispatchEvent(new Event('input')); } }"
    )
    wait_for(tab, "location.hash", f"#{state}{more}".replace("33.3", "50"))
    type_in(tab, "view", "forces")
    wait_for(tab, "location.hash.endsWith('&view=forces')", True)
    # Back undoes a change.
    tab.evaluate("history.back()")
    wait_for(tab, f"{element('view')}.value", "energy")
    assert value(tab, "angle") == 50
    tab.evaluate("history.back()")
    wait_for(tab, f"{element('angle')}.value", "33.3")
    for copied, words in (("true", "The link is copied."), ("false", "Copy this link: file://")):
        tab.evaluate(f"files.copy = async (text) => {{ window.link = text; return {copied}; }}")
        click(tab, "do-copy")
        wait_for(tab, f"{element('told')}.textContent.startsWith('{words}')", True)
    assert tab.evaluate("link").endswith(f"#{state}{more}")
    # What an address says wrongly is told and is as the page opens; what it says well, counts.
    for wrong in ("angle=200", "radius=0", "view=motion"):
        go(tab, f"friction=0.7&{wrong}")
        assert f"“{wrong.split('=')[1]}” is refused. Allowed: " in text(tab, "refused")
        assert [value(tab, name) for name in ("angle", "friction")] == [50, 0.7]
    # What it has from an explorer of version 0.3 is left out.
    go(tab, "friction=0.7&loss=plastic&beside=continuum&models=lumped")
    assert text(tab, "refused") == "" and value(tab, "friction") == 0.7


def test_the_stage_alone_is_a_frame_of_a_lecture(show):
    throw = f"angle=40&friction=0.4&restitution=1{SOLID}"
    shown = ["stage-svg", "play", "time", "angle", "sentence", "given", "compliance"]
    for query in ("?stage", "?stage=micro"):  # which links of version 0.3 have
        tab = show(throw, query=query)
        for name in [*shown, "preset", "friction", "incidence"]:
            assert tab.evaluate(f"{element(name)}.checkVisibility()") == (name in shown), name


def test_presets_stand_where_the_figures_say():
    settings = figure_settings.of_explorer(config())
    presets, printed = write_explorer.presets(settings), settings["figures"]
    assert sorted(presets) == sorted(figures.with_trait("explorer"))
    for figure in ("fig3", "fig4"):
        x = math.tan(math.radians(presets[figure]["angle"])) / presets[figure]["friction"]
        assert abs(x - printed[figure]["incidence"]) < 1e-4
    assert presets["fig8"]["friction"] == printed["fig8"]["friction"]
    assert presets["fig3"]["restitution"] == printed["fig3"]["restitution"][0]
    assert presets["fig6"]["restitution"] == sorted(printed["fig6"]["restitution"])[1]
    zeta2 = bodies.stiffness_ratio(bodies.Material(1.0, presets["fig5"]["poisson_ratio"]))
    assert abs(zeta2 - settings["stiffness_ratio"]) < 1e-4
    # In the words about it, the lumped model is thrown back less with e = 1, the continuum more.
    state = presets["fig6"]
    x, e = math.tan(math.radians(state["angle"])) / state["friction"], [state["restitution"], 1.0]
    lossy, elastic = lumped.rebound(x, state["mass_ratio"], zeta2, e).velocity
    assert lossy < elastic < 0
    for loss in continuum.LOSSES:
        found = continuum.rebound(x, state["mass_ratio"], zeta2, e, loss=loss, tolerance=1e-2)
        assert found.velocity[1] < found.velocity[0]
    # What the sliders cannot show is not offered.
    for stiffness_ratio in (0.4, 2.5):
        assert write_explorer.presets(settings | {"stiffness_ratio": stiffness_ratio}) == {}


def test_balls_have_the_numbers_of_their_presets_and_sources():
    text = (node.FOLDER / "materials.yaml").read_text(encoding="utf-8")
    for ball, said in zip(yaml.safe_load(text)["balls"], write_explorer.balls(text), strict=True):
        state = dict(one.split("=") for one in said["address"].split("&"))
        zeta2 = bodies.stiffness_ratio(bodies.Material(1.0, float(state["poisson_ratio"])))
        if given := collision.presets().get(ball.get("preset")):
            own = given.pair.friction, given.pair.restitution, 1000 * given.body.radius
            own = dict(zip(("friction", "restitution", "radius"), own, strict=True))
            ball["state"] = own | ball["state"]
            assert zeta2 == pytest.approx(given.pair.stiffness_ratio, abs=1e-3)
        # Of the chart of materials: the row that name and source name.
        if "data/cornell1999" in (words := f"{ball['name']}, {ball.get('source')}"):
            (row,) = [one for one in table_files.read("cornell1999/pairs") if one["pair"] in words]
            for name in ("friction", "restitution"):
                assert ball["state"][name] == float(row[f"{name} [1]"]), ball["name"]
        # No ball is thrown on a threshold, where a last digit would decide what is said.
        x = math.tan(math.radians(float(state["angle"]))) / float(state["friction"])
        beta, e = float(state.get("mass_ratio", 3.5)), float(state["restitution"])
        edges = [zeta2, beta, lumped.slip_throughout_limit(beta, zeta2, e), (1 + e) * beta]
        assert np.abs(np.array(edges) / x - 1).min() > 0.01, ball["name"]
        for name in ball["state"]:
            assert float(state[name]) == pytest.approx(float(ball["state"][name]), rel=2e-3), name


def test_a_figure_or_a_ball_is_chosen(show):
    tab = show()
    choices = tab.evaluate(f"[...{element('preset')}.options].map((one) => one.value)")[1:]
    for address in choices:
        type_in(tab, "preset", address)
        assert tab.evaluate(f"{element('preset')}.value") == address
        assert text(tab, "about")
    type_in(tab, "angle-number", "44")
    assert tab.evaluate(f"{element('preset')}.value") == "" and text(tab, "about") == ""


def test_numbers_and_pictures_are_saved(show):
    tab = show(f"angle=45&friction=0.5&restitution=0.5{SOLID}&view=velocity")
    tab.evaluate("files.save = (name, blob) => (window.saved = { name, blob })")
    click(tab, "do-csv")
    assert tab.evaluate("saved.name") == "impact.csv"
    saved = tab.evaluate("saved.blob.text()")
    notes = [float(one) for one in re.findall(r"# .* = (\S+)\n", saved)]
    assert notes[:7] == pytest.approx([45, 0.5, 0.5, 0.3, 3.5, 17 / 14, 2.0])
    # What is written into a picture, but for its axes.
    tab.evaluate(
        "{ window.written = ''; const { fillText } = CanvasRenderingContext2D.prototype;"
        " CanvasRenderingContext2D.prototype.fillText = function (text, ...place) {"
        " window.written += text; window.end = Math.max(window.end ?? 0, (place[0] +"
        " this.measureText(text).width) * this.getTransform().a / this.canvas.width);"
        " fillText.call(this, text, ...place); };"
        " const { serializeToString } = XMLSerializer.prototype;"
        " XMLSerializer.prototype.serializeToString = function (drawing) {"
        " window.written += drawing.textContent; window.drawn = drawing;"
        " return serializeToString.call(this, drawing); } }"
    )
    for button, name in (("ball", "stage.png"), ("curve", "curve.png")):
        click(tab, f"do-{button}")
        wait_for(tab, "window.saved?.name", name)
        data = tab.evaluate("saved.blob.arrayBuffer().then((all) => [...new Uint8Array(all)])")
        picture = imread(io.BytesIO(bytes(data)))
        assert picture.shape[1] > 600 and picture[..., :3].std() > 0.05
        # A drawing without its style sheet would be black.
        assert np.median(picture[..., :3]) > 0.9
    assert tab.evaluate("end") <= 1, "a line is wider than its picture"
    written = tab.evaluate("written")
    # One ball is alone in its picture, too, which has no style sheet.
    for display in ("none", "inline"):
        click(tab, "do-lone")
        click(tab, "do-ball")
        wait_for(tab, "drawn.querySelector('#stage-upper')?.style.display", display)
    assert "v₁(t_f)/(µv₂(0)) of the contact" in written and "Press Throw" not in written


def test_the_corners_of_the_box_are_drawn_on_a_phone(show):
    rng, states = np.random.default_rng(1994), []
    choices = {name: limit[:2] for name, limit in write_explorer.LIMITS.items()}
    choices["view"] = ("velocity", "forces", "energy")
    for corner in itertools.product(*(choices[name] for name in write_explorer.OF_FIGURES)):
        drawn = {name: rng.choice(ends) for name, ends in choices.items()}
        named = drawn | dict(zip(write_explorer.OF_FIGURES, corner, strict=True))
        states.append("&".join(f"{name}={one}" for name, one in named.items()))
    pages = show(width=320, height=3000).evaluate(
        f"(async () => {{ const pages = [], slider = {element('time')};"
        f" for (const state of {json.dumps(states)}) {{ page.go(state); await {FRAME};"
        " let drawn = ''; for (let share = 0; share <= 1; share += 0.05) {"
        " slider.value = share * slider.max; slider.dispatchEvent(new Event('input'));"
        " drawn += document.querySelector('main').outerHTML; }"
        " pages.push([document.documentElement.scrollWidth, drawn]); } return pages; })()"
    )
    for state, (wide, page) in zip(states, pages, strict=True):
        assert wide <= 320, state
        assert "is refused" not in page, state
        assert not re.search(r"NaN|Infinity|undefined", page), state
