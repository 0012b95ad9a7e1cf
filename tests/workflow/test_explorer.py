"""The explorer in a browser: it answers its reader, draws what is true, stands alone."""

import io
import json
import math
import re
import signal
import time
from pathlib import Path

import browser
import numpy as np
import pytest
from matplotlib.image import imread

from planarimpact import bodies, continuum, lumped
from stronge1994 import plan
from stronge1994.pages import explorer as write_explorer
from stronge1994.plan import config as configuration

ROOT = Path(__file__).parents[2]
FOLDER = ROOT / "workflow/explorer"
SOURCES = sorted(FOLDER.iterdir())
SLIDERS = list(write_explorer.LIMITS)


@pytest.fixture(scope="module")
def settings():
    return plan.settings_of_explorer(configuration.load(ROOT))


@pytest.fixture(scope="module")
def presets(settings):
    return write_explorer.presets(settings)


# ---- it answers its reader


def text(tab, name):
    return tab.evaluate(f"document.getElementById('{name}').textContent")


def value(tab, name):
    return float(tab.evaluate(f"document.getElementById('{name}').value"))


def drawn(tab):
    """All that follows from the controls."""
    parts = "#sentence, #diagram-svg, #forces, #velocity, #incidence, .numbers, #energy"
    return tab.evaluate(f"[...document.querySelectorAll('{parts}')].map((e) => e.outerHTML)")


def type_in(tab, name, typed):
    tab.evaluate(
        f"{{ const box = document.getElementById('{name}'); box.value = '{typed}';"
        " box.dispatchEvent(new Event('input', {bubbles: true})); box.blur(); }"
    )


def shown_energies(tab):
    rows = "[...document.querySelectorAll('#energies tbody tr')]"
    cells = tab.evaluate(f"{rows}.map((r) => [...r.cells].slice(1).map((c) => c.textContent))")
    return np.array([[0.0 if cell == "\u2013" else float(cell) for cell in row] for row in cells])


@pytest.mark.parametrize("slider", SLIDERS)
def test_a_slider_is_moved_by_keys_and_by_typing(slider, show):
    tab = show("angle=50&friction=0.5&restitution=0.6&poisson_ratio=0.3&mass_ratio=3")
    before, start = drawn(tab), value(tab, slider)
    tab.evaluate(f"document.getElementById('{slider}').focus()")
    for _ in range(5):
        tab.press("ArrowRight")
    assert value(tab, slider) > start
    assert value(tab, f"{slider}-number") == value(tab, slider)
    assert all(a != b for a, b in zip(before[2:], drawn(tab)[2:], strict=True))
    least, largest, _ = write_explorer.LIMITS[slider]
    for typed, kept in (("-1e9", least), ("1e9", largest), ("", largest)):
        type_in(tab, f"{slider}-number", typed)
        assert value(tab, slider) == value(tab, f"{slider}-number") == kept


def test_a_preset_shows_the_impact_of_its_figure(show, presets):
    tab = show()
    assert list(presets) == plan.EXPLORED
    for index, state in enumerate(presets.values()):
        tab.evaluate(f"document.querySelectorAll('.preset')[{index}].click()")
        assert tab.evaluate(f"document.querySelectorAll('.preset')[{index}].ariaPressed") == "true"
        nu, mu, e = (state[name] for name in ("poisson_ratio", "friction", "restitution"))
        x = math.tan(math.radians(state["angle"])) / mu
        zeta2 = (2 - nu) / (2 * (1 - nu))
        wanted = lumped.rebound(x, state["mass_ratio"], zeta2, e)
        shown = [text(tab, f"number-{name}") for name in ("incidence", "velocity", "friction")]
        for ours, theirs in zip(shown, (x, *wanted[:2]), strict=True):
            assert abs(float(ours.replace("\u2212", "-")) - theirs) <= 6e-4
        total = 1 + (mu * x) ** 2 / state["mass_ratio"]
        energies = shown_energies(tab)
        assert np.abs(energies.sum(axis=0) - 100).max() <= 0.31
        assert abs(energies[-1, -1] - 200 * mu**2 * wanted.dissipation / total) <= 0.06
        assert len(text(tab, "about")) > 20


def test_presets_stand_where_the_figures_say(presets, settings):
    for figure in ("fig3", "fig4"):
        x = math.tan(math.radians(presets[figure]["angle"])) / presets[figure]["friction"]
        assert abs(x - settings["figures"][figure]["incidence"]) < 1e-4
    assert presets["fig8"]["friction"] == settings["figures"]["fig8"]["friction"]
    assert presets["fig3"]["restitution"] == settings["figures"]["fig3"]["restitution"][0]
    listed = settings["figures"]["fig6"]["restitution"]
    assert sorted(listed)[1] == presets["fig6"]["restitution"]
    zeta2 = bodies.stiffness_ratio(bodies.Material(1.0, presets["fig5"]["poisson_ratio"]))
    assert abs(zeta2 - settings["stiffness_ratio"]) < 1e-4
    assert abs(math.tan(math.radians(presets["superball"]["angle"])) - 6 / 5) < 1e-5


def test_words_about_two_presets_hold(presets, settings):
    state = presets["fig6"]
    x = math.tan(math.radians(state["angle"])) / state["friction"]
    groups = state["mass_ratio"], settings["stiffness_ratio"]
    lossy, elastic = lumped.rebound(x, *groups, [state["restitution"], 1.0]).velocity
    assert lossy < elastic < 0, "raise e to 1: thrown back less"
    for loss in continuum.LOSSES:
        e = [state["restitution"], 1.0]
        lossy, elastic = continuum.rebound(x, *groups, e, loss=loss, tolerance=1e-2).velocity
        assert elastic < lossy, "measured contacts do the opposite, and so do the continua"
    state = presets["superball"]
    x, e = math.tan(math.radians(state["angle"])) / state["friction"], state["restitution"]
    w = lumped.rebound(x, 3.5, 1.5, e).velocity
    assert w < 0, "leaves with its contact point running backwards"
    # 2/7 of the change goes to the ball, 5/7 to its spin; the table meets that the other way round.
    along = x + 2 / 7 * (w - x)
    above = along - 5 / 7 * (w - x)
    change = e * lumped.rebound(above / e, 3.5, 1.5, e).velocity - above
    assert along + 2 / 7 * change < 0, "a table throws it back"


def test_spin_before_a_throw_counts(settings):
    throw = settings["figures"]["superball"]["throw"] | {"spin": 40.0}
    figures = settings["figures"] | {"superball": {"throw": throw}}
    found = write_explorer.presets(settings | {"figures": figures})["superball"]
    assert abs(math.tan(math.radians(found["angle"])) - 7 / 5) < 1e-5


@pytest.mark.parametrize("stiffness_ratio", [0.4, 2.5])
def test_what_the_sliders_cannot_show_is_not_offered(stiffness_ratio, settings):
    changed = settings | {"stiffness_ratio": stiffness_ratio}
    assert list(write_explorer.presets(changed)) == ["superball"]
    assert "Superball" in write_explorer.page(changed, SOURCES)


@pytest.mark.parametrize(("e", "cautions"), [(0.99, True), (0.0, True), (1.0, False)])
def test_below_e_1_it_says_that_measurements_contradict_it(e, cautions, show):
    tab = show(f"restitution={e}")
    style = "getComputedStyle(document.getElementById('caution')).visibility"
    assert tab.evaluate(style) == ("visible" if cautions else "hidden")
    assert "measurements contradict it" in text(tab, "caution")


def test_what_is_left_out_is_as_large_as_it_says():
    x = np.linspace(0, 7, 71)
    for e, losses, said in ((1.0, [None], 0.2), (0.8, continuum.LOSSES, 0.7)):
        paper = lumped.rebound(x, stiffness_ratio=17 / 14, restitution=e).velocity
        for loss in losses:
            real = continuum.rebound(x, 3.5, 17 / 14, e, loss=loss, tolerance=1e-3).velocity
            assert round(np.abs(paper - real).max(), 1) == said
    page = (FOLDER / "explorer.html").read_text(encoding="utf-8")
    assert "up to 0.2 for <i>e</i> = 1 and by up to 0.7" in page


@pytest.mark.parametrize(
    ("address", "words"),
    [
        ("angle=0", "A straight blow"),
        (
            "angle=80&friction=0.1",
            "It slips forwards throughout. The contact point leaves forwards",
        ),
        (
            "angle=51&friction=0.5&restitution=1",
            "It slips forwards first, then sticks, then slips b",
        ),
        ("angle=20&friction=0.5&restitution=0", "It sticks throughout. The contact point does not"),
    ],
)
def test_it_says_what_happens(address, words, show):
    assert text(show(address), "sentence").startswith(words)


def test_the_corners_of_the_box_are_drawn(show):
    limits = [write_explorer.LIMITS[name][:2] for name in SLIDERS]
    corners = np.stack(np.meshgrid(*limits), axis=-1).reshape(-1, 5).tolist()
    states = [
        "&".join(f"{name}={value}" for name, value in zip(SLIDERS, corner, strict=True))
        for corner in corners
    ]
    go = (
        "([state, view]) => { const button = document.querySelector('.preset');"
        " button.dataset.state = `${state}&view=${view}`; button.click();"
        " return document.querySelector('main').outerHTML; }"
    )
    given = [[state, view] for state in states for view in ("velocity", "forces", "energy")]
    found = show().evaluate(f"{json.dumps(given)}.map({go})")
    assert len(set(found)) == len(given) == 96
    for state, page in zip(given, found, strict=True):
        assert not re.search(r"NaN|Infinity|undefined", page), state


def test_everything_is_reached_by_tab(show):
    tab, reached = show(), set()
    for _ in range(60):
        tab.press("Tab")
        reached.add(tab.evaluate("document.activeElement.id || document.activeElement.textContent"))
    controls = "document.querySelectorAll('button, input, select')"
    wanted = set(tab.evaluate(f"[...{controls}].map((e) => e.id || e.textContent)"))
    assert len(wanted) > 20 and wanted <= reached


def test_space_plays_and_pauses(show):
    tab = show()
    label = "document.getElementById('play').ariaLabel"
    for focus in ("document.body", "document.getElementById('angle')"):
        tab.evaluate(f"({focus}).focus()")
        tab.press(" ")
        assert tab.evaluate(label) == "Pause"
        start = value(tab, "time")
        deadline = time.monotonic() + 5
        while value(tab, "time") == start and time.monotonic() < deadline:
            time.sleep(0.02)
        assert value(tab, "time") != start
        tab.press(" ")
        assert tab.evaluate(label) == "Play"
    # A button that is pressed by space does not play too.
    tab.evaluate("document.querySelectorAll('.body')[1].focus()")
    tab.press(" ")
    assert tab.evaluate(label) == "Play" and value(tab, "mass_ratio") == 2.5


def test_motion_waits_for_a_reader_who_wants_less(show):
    label = "document.getElementById('play').ariaLabel"
    assert show(motion="reduce").evaluate(label) == "Play"
    assert show(motion="no-preference").evaluate(label) == "Pause"


def test_the_address_leads_back_to_an_impact(show):
    state = "angle=33.3&friction=0.7&restitution=0.25&poisson_ratio=0.1&mass_ratio=4&view=energy"
    tab = show(state)
    assert [value(tab, name) for name in SLIDERS] == [33.3, 0.7, 0.25, 0.1, 4.0]
    type_in(tab, "friction-number", "0.8")
    wanted, deadline = f"#{state}".replace("0.7", "0.8"), time.monotonic() + 5
    while tab.evaluate("location.hash") != wanted and time.monotonic() < deadline:
        time.sleep(0.05)
    assert tab.evaluate("location.hash") == wanted
    tab.evaluate("location.hash = 'angle=10&mass_ratio=nonsense&friction=99&who=knows'")
    tab.evaluate("new Promise((done) => setTimeout(done, 50))")
    assert [value(tab, name) for name in SLIDERS[:2]] == [10.0, 2.0]
    assert value(tab, "mass_ratio") == 4.0


@pytest.mark.parametrize("width", [320, 360, 800, 1280])
def test_nothing_is_wider_than_the_screen(width, show):
    tab = show("angle=89.9&friction=0.01", width=width)
    inside = "document.documentElement.scrollWidth <= innerWidth"
    assert tab.evaluate("innerWidth") == width and tab.evaluate(inside)
    for index in range(len(plan.EXPLORED)):
        tab.evaluate(f"document.querySelectorAll('.preset')[{index}].click()")
        assert tab.evaluate(inside)


def test_the_picture_moves(show):
    tab = show("angle=50&friction=0.5")
    first = imread(io.BytesIO(tab.screenshot()))
    assert first.std() > 0.05
    type_in(tab, "angle-number", "20")
    second = imread(io.BytesIO(tab.screenshot()))
    diagram = "document.getElementById('diagram-svg').outerHTML"
    still = tab.evaluate(diagram)
    type_in(tab, "time", "0.8")
    third = imread(io.BytesIO(tab.screenshot()))
    assert (first != second).mean() > 0.001 and (second != third).mean() > 0.001
    assert tab.evaluate(diagram) != still


def test_a_change_is_drawn_within_a_frame(show):
    change = (
        "(() => { const slider = document.getElementById('angle'), times = [];"
        " for (let i = 1; i <= 20; i++) { const start = performance.now(); slider.value = 4 * i;"
        " slider.dispatchEvent(new Event('input')); document.body.offsetHeight;"
        " times.push(performance.now() - start); } return Math.min(...times); })()"
    )
    assert show().evaluate(change) < 16


# ---- it stands alone


def test_the_page_needs_nothing_else(explorer):
    page = explorer.read_text(encoding="utf-8")
    # Nine tenths are the table of spheres.
    assert len(page.encode()) < 800_000
    assert "http:" not in page and "https:" not in page and "@import" not in page
    # The letter is not loaded: it is a link to the page beside this one.
    addresses = re.findall(r"""(?:src|href)\s*=\s*["']?([^"'\s>]*)""", page)
    assert addresses == ["data:,", "below_e_1.html"]


def test_a_run_writes_this_page(first_run, explorer):
    written = first_run[0] / "figures/explorer.html"
    assert written.read_text(encoding="utf-8") == explorer.read_text(encoding="utf-8")


# ---- the browser of these tests


def test_without_a_browser_tests_are_skipped(monkeypatch):
    monkeypatch.setattr(browser.shutil, "which", lambda name: None)
    with pytest.raises(pytest.skip.Exception, match="chromium"), browser.page():
        pass


def test_a_browser_that_hangs_is_given_up_and_killed(monkeypatch):
    started = []
    popen = browser.subprocess.Popen
    monkeypatch.setattr(
        browser.subprocess, "Popen", lambda *a, **k: started.append(popen(*a, **k)) or started[-1]
    )
    with pytest.raises(browser.BrowserError, match="no answer within"), browser.page() as tab:
        tab.timeout = 0.5
        tab.evaluate("(() => { for (;;); })()")
    assert started[0].returncode == -signal.SIGKILL


def test_problems_of_a_page_are_noticed(tab):
    tab.problems.clear()
    tab.open("data:text/html,<script>console.error('oh'); missing()</script>")
    assert any("oh" in words for words in tab.problems)
    assert any("missing is not defined" in words for words in tab.problems)
    with pytest.raises(browser.BrowserError, match="lost"):
        tab.evaluate("(() => { throw new Error('lost'); })()")
