"""The explorer in a browser: it answers its reader, draws what is true, stands alone."""

import base64
import io
import json
import math
import re
import time
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from matplotlib.image import imread

from planarimpact import bodies, continuum, lumped
from stronge1994 import plan
from stronge1994.explorer import page as write_explorer
from stronge1994.plan import config as configuration
from stronge1994.plan import figures

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
    """What follows from each of the controls."""
    parts = "#incidence, #outcomes, .numbers, #forces, #velocity, #energy"
    return tab.evaluate(f"[...document.querySelectorAll('{parts}')].map((e) => e.outerHTML)")


def type_in(tab, name, typed):
    tab.evaluate(
        f"{{ const box = document.getElementById('{name}'); box.value = '{typed}';"
        " for (const kind of ['input', 'change']) box.dispatchEvent(new Event(kind)); }"
    )


def wait_for(tab, expression, wanted):
    """Wait until a JavaScript expression has a value; for what the page does a little later."""
    deadline = time.monotonic() + 5
    while tab.evaluate(expression) != wanted and time.monotonic() < deadline:
        time.sleep(0.02)
    assert tab.evaluate(expression) == wanted


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
    assert all(a != b for a, b in zip(before, drawn(tab), strict=True))
    least, largest, _ = write_explorer.LIMITS[slider]
    for typed in (least, largest):
        type_in(tab, f"{slider}-number", f" {str(typed).replace('.', ',')} ")
        assert value(tab, slider) == value(tab, f"{slider}-number") == typed
    label = tab.evaluate(f"document.querySelector('label[for={slider}]').textContent")
    for typed in (f"{least - 0.01}", "1e9", "", "1.2.3", "1 000", "abc"):
        type_in(tab, f"{slider}-number", typed)
        assert value(tab, slider) == value(tab, f"{slider}-number") == largest
        refused = f"{label}: \u201c{typed}\u201d is refused."
        assert text(tab, "refused") == f"{refused} Allowed are numbers from {least} to {largest}."
    box = f"document.getElementById('{slider}-number')"
    tab.evaluate(f"{box}.dispatchEvent(new KeyboardEvent('keydown', {{key: 'ArrowDown'}}))")
    step = tab.evaluate(f"{box}.dataset.step")
    assert value(tab, slider) == pytest.approx(largest - float(step), abs=1e-9)
    assert text(tab, "refused") == ""


def test_a_comma_is_a_decimal_point(show):
    tab = show()
    type_in(tab, "angle-number", "12,5")
    assert value(tab, "angle") == 12.5 and text(tab, "refused") == ""


def test_a_preset_shows_the_impact_of_its_figure(show, presets):
    tab = show()
    assert sorted(presets) == sorted(figures.with_trait("explorer"))
    for state in presets.values():
        button = (
            f"document.querySelector('.preset[data-state^=\"{write_explorer.address(state)}\"]')"
        )
        tab.evaluate(f"{button}.click()")
        assert tab.evaluate(f"{button}.ariaPressed") == "true"
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
    assert "Superball" in write_explorer.page(changed, SOURCES, [])


@pytest.mark.parametrize(("e", "cautions"), [(0.99, True), (0.0, True), (1.0, False)])
def test_below_e_1_it_says_that_the_evidence_is_divided(e, cautions, show):
    tab = show(f"restitution={e}")
    style = "getComputedStyle(document.getElementById('caution')).visibility"
    assert tab.evaluate(style) == ("visible" if cautions else "hidden")
    assert "the evidence on it is divided" in text(tab, "caution")


def test_what_is_left_out_is_as_large_as_it_says():
    x = np.linspace(0, 7, 71)
    for e, losses, said in ((1.0, [None], 0.2), (0.8, continuum.LOSSES, (0.7, 0.9))):
        paper = lumped.rebound(x, stiffness_ratio=17 / 14, restitution=e).velocity
        for loss in losses:
            real = continuum.rebound(x, 3.5, 17 / 14, e, loss=loss, tolerance=1e-3).velocity
            assert round(np.abs(paper - real).max(), 1) in np.atleast_1d(said)
    page = (FOLDER / "explorer.html").read_text(encoding="utf-8")
    assert "up to 0.2 for <i>e</i> = 1 and by up to 0.9" in page


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


@pytest.mark.parametrize("width", [390, 1280])
def test_everything_is_reached_by_tab_in_the_order_in_which_it_is_seen(width, show):
    tab, reached = show(width=width), {}
    box = "document.activeElement.getBoundingClientRect()"
    for _ in range(70):
        tab.press("Tab")
        name = tab.evaluate("document.activeElement.id || document.activeElement.textContent")
        section = tab.evaluate("document.activeElement.closest('section')?.id ?? ''")
        reached.setdefault(name, (section, tab.evaluate(f"scrollY + {box}.bottom")))
    controls = "[...document.querySelectorAll('button, input, select')]"
    there = "!e.disabled && !e.closest('details:not([open])')"
    wanted = set(
        tab.evaluate(f"{controls}.filter((e) => {there}).map((e) => e.id || e.textContent)")
    )
    assert len(wanted) > 20 and wanted <= set(reached)
    ours = [one for one in reached.values() if one[0] in ("", "stage", "controls", "rebound")]
    steps = [(a, b) for a, b in zip(ours, ours[1:], strict=False) if width < 500 or a[0] == b[0]]
    assert all(below[1] > above[1] - 12 for above, below in steps)


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
    wait_for(tab, "location.hash", f"#{state}".replace("0.7", "0.8"))
    tab.evaluate("location.hash = 'angle=10&mass_ratio=nonsense&friction=99&who=knows'")
    wait_for(tab, "document.getElementById('angle').value", "10")
    # What an address leaves out, or says wrongly, is as the page opens.
    assert [value(tab, name) for name in ("friction", "mass_ratio")] == [2.0, 3.5]


def test_back_undoes_a_change(show):
    state = "angle=33&friction=0.7&restitution=0.25&poisson_ratio=0.1&mass_ratio=4&view=energy"
    tab = show(state)
    for typed in ("40", "45", "50"):  # one change: they follow at once
        type_in(tab, "angle-number", typed)
    wait_for(tab, "location.hash", f"#{state.replace('33', '50')}")
    tab.evaluate("document.getElementById('model-rigid').click()")
    wait_for(tab, "location.hash.endsWith('&models=lumped+continuum')", True)
    tab.evaluate("history.back()")
    wait_for(tab, "document.getElementById('model-rigid').checked", True)
    assert value(tab, "angle") == 50
    tab.evaluate("history.back()")
    wait_for(tab, "document.getElementById('angle').value", "33")
    # The link to the content is no impact.
    tab.evaluate("document.querySelector('.skip').click()")
    wait_for(tab, "location.hash", "#main")
    assert value(tab, "angle") == 33


@pytest.mark.parametrize("width", [320, 360, 800, 1280])
def test_nothing_is_wider_than_the_screen(width, show):
    tab = show("angle=89.9&friction=0.01", width=width)
    inside = "document.documentElement.scrollWidth <= innerWidth"
    assert tab.evaluate("innerWidth") == width and tab.evaluate(inside)
    for index in range(len(figures.with_trait("explorer"))):
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


# ---- how it looks, and what a reader takes along


def test_the_first_screen_has_examples_the_ball_and_the_curve(show):
    tab = show(width=1440, height=900)
    parts = ".presets, #sentence, #ball-svg, #play, #controls, #incidence, #outcomes, #agreement"
    boxes = (
        f"[...document.querySelectorAll('{parts}')].map((e) => e.getBoundingClientRect().bottom)"
    )
    bottoms = tab.evaluate(boxes)
    assert len(bottoms) == 8 and max(bottoms) <= 900


def luminance(colour):
    """Relative luminance of WCAG of three numbers from 0 to 255."""
    share = np.array(colour) / 255
    linear = np.where(share <= 0.04045, share / 12.92, ((share + 0.055) / 1.055) ** 2.4)
    return linear @ [0.2126, 0.7152, 0.0722]


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_lines_stand_out_from_every_band(theme, show):
    tab = show("angle=51&friction=0.5&restitution=0.5&poisson_ratio=0.3")
    tab.evaluate(f"document.documentElement.dataset.theme = '{theme}'")
    styles = (
        "(all, name) => [...document.querySelectorAll(all)].map((e) => getComputedStyle(e)[name])"
    )

    def colours(query, name):
        found = tab.evaluate(f"({styles})('{query}', '{name}')")
        return {tuple(map(int, re.findall(r"\d+", one)[:3])) for one in found}

    (paper,) = colours("body", "backgroundColor")
    (opacity,) = set(tab.evaluate(f"({styles})('.chart .band', 'opacity')"))
    grounds = [
        float(opacity) * np.array(band) + (1 - float(opacity)) * np.array(paper)
        for band in colours(".chart .band", "fill")
    ]
    lines = colours(".chart polyline", "stroke")
    assert len(lines) >= 5 and len(grounds) == 3
    for line in lines:
        for ground in [np.array(paper), *grounds]:
            dark, light = sorted((luminance(line), luminance(ground)))
            assert (light + 0.05) / (dark + 0.05) > 4.5, (line, ground)


def test_dark_and_projector_are_buttons_that_are_remembered(show):
    tab = show()
    look = "(() => { const style = getComputedStyle(document.body);"
    look += " return [style.backgroundColor, style.fontSize]; })()"
    (paper, size) = tab.evaluate(look)
    for name in ("dark", "projector"):
        tab.evaluate(f"document.getElementById('do-{name}').click()")
    try:
        tab = show()
        dark, large = tab.evaluate(look)
        assert dark != paper and float(large[:-2]) > 1.2 * float(size[:-2])
        assert tab.evaluate(
            "['dark', 'projector'].map((id) => document.getElementById(`do-${id}`).ariaPressed)"
        ) == ["true", "true"]
        # The chart is drawn larger, and still knows where it is pressed.
        assert tab.evaluate("document.getElementById('incidence').clientHeight") > 1.2 * 262
    finally:
        tab.evaluate("localStorage.clear()")


def test_curves_and_numbers_are_saved(show):
    state = "angle=45&friction=0.5&restitution=0.5&poisson_ratio=0.3&mass_ratio=3.5"
    tab = show(f"{state}&view=velocity")
    tab.evaluate("files.save = (name, blob) => (window.saved = { name, blob })")
    tab.evaluate("document.getElementById('do-csv').click()")
    assert tab.evaluate("saved.name") == "impact.csv"
    text = tab.evaluate("saved.blob.text()")
    table = pd.read_csv(io.StringIO(text), comment="#")
    notes = dict(re.findall(r"# (.*) = (\S+)\n", text))
    assert float(notes["friction coefficient mu [1]"]) == 0.5
    x = table["incidence v1(0)/(mu v2(0)) [1]"]
    wanted = lumped.rebound(x, 3.5, 17 / 14, 0.5).velocity
    curve = table["lumped: v1(tf)/(mu v2(0)) [1]"]
    assert np.abs(curve - wanted).max() < 1e-9
    here = lumped.rebound(2.0, 3.5, 17 / 14, 0.5).velocity
    assert abs(float(notes["lumped: v1(tf)/(mu v2(0)) [1]"]) - here) < 1e-9
    assert list(table.columns[3:]) == [
        f"{name}: v1(tf)/(mu v2(0)) [1]"
        for name in ("rigid", "continuum, viscous", "continuum, plastic")
    ]


@pytest.mark.parametrize("name", ["ball", "curve"])
def test_a_picture_is_saved(name, show):
    tab = show("angle=45&friction=0.5&restitution=0.5")
    tab.evaluate("files.save = (name, blob) => (window.saved = { name, blob })")
    tab.evaluate(f"document.getElementById('do-{name}').click()")
    wait_for(tab, "window.saved?.name", f"{name}.png")
    encoded = tab.evaluate(
        "new Promise((done) => { const reader = new FileReader(); reader.onload = () =>"
        " done(reader.result.split(',')[1]); reader.readAsDataURL(saved.blob); })"
    )
    picture = imread(io.BytesIO(base64.b64decode(encoded)))
    assert picture.shape[1] > 600 and picture[..., :3].std() > 0.05
    # A drawing without its style sheet would be black.
    assert np.median(picture[..., :3]) > 0.9


def test_the_link_is_copied_or_shown(show):
    tab = show("angle=45&friction=0.5")
    for copied, words in (("true", "The link is copied."), ("false", "Copy this link: file://")):
        tab.evaluate(f"files.copy = async (text) => {{ window.link = text; return {copied}; }}")
        tab.evaluate("document.getElementById('do-copy').click()")
        wait_for(tab, f"document.getElementById('told').textContent.startsWith('{words}')", True)
    assert tab.evaluate("link").endswith("#" + tab.evaluate("page.address()"))


# ---- it stands alone


def test_the_page_needs_nothing_else(explorer):
    page = explorer.read_text(encoding="utf-8")
    # Four fifths are the table of spheres.
    assert len(page.encode()) < 800_000
    assert "http:" not in page and "https:" not in page and "@import" not in page
    assert not re.search(r"\bsrc\s*=\s*[\"']", page)
    # All else are links, which load nothing: places on the page, and pages beside this one.
    linked = re.findall(r"<(\w+)[^>]*\bhref=\"([^\"]*)\"", page)
    assert [address for tag, address in linked if tag != "a"] == ["data:,"]
    bar = (ROOT / "workflow/report/site.html").read_text(encoding="utf-8")
    pages = re.findall(r'\("(\S+\.html)"', bar)
    assert len(pages) > 5
    assert {address for tag, address in linked if tag == "a"} == {"#main", *pages}


def test_a_run_writes_this_page(first_run, explorer):
    written = first_run[0] / "figures/explorer.html"
    assert written.read_text(encoding="utf-8") == explorer.read_text(encoding="utf-8")
