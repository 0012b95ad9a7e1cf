"""The explorer in a browser: it answers its reader, draws what is true, stands alone."""

import base64
import io
import itertools
import json
import math
import re
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
from tests.workflow.controls import (
    FRAME,
    SOLID,
    click,
    element,
    number,
    shown_energies,
    text,
    type_in,
    value,
    wait_for,
)

ROOT = Path(__file__).parents[2]
FOLDER = ROOT / "workflow/explorer"
SLIDERS = [name for name in write_explorer.LIMITS if name not in ("radius", "gravity")]


@pytest.fixture(scope="module")
def settings():
    return plan.settings_of_explorer(configuration.load(ROOT))


@pytest.fixture(scope="module")
def presets(settings):
    return write_explorer.presets(settings)


# ---- it answers its reader


def drawn(tab, slider):
    """What follows from a control: from the last three, which have units, only the flight."""
    parts = "#stage-svg, .numbers"
    if slider in write_explorer.OF_FIGURES:
        parts = "#stage-svg, #incidence, #outcomes, .numbers, #forces, #velocity, #energy"
    if slider == "table":
        parts = "#stage-svg"
    return tab.evaluate(f"[...document.querySelectorAll('{parts}')].map((e) => e.outerHTML)")


@pytest.mark.parametrize("slider", SLIDERS)
def test_a_slider_is_moved_by_keys_and_by_typing(slider, show):
    state = "angle=50&friction=0.5&restitution=0.6&poisson_ratio=0.3&mass_ratio=3&table=1"
    tab = show(state, height=3000)
    before, start = drawn(tab, slider), value(tab, slider)
    tab.evaluate(f"{element(slider)}.focus()")
    for _ in range(5):
        tab.press("ArrowRight")
    tab.evaluate(FRAME)
    assert value(tab, slider) > start
    assert value(tab, f"{slider}-number") == value(tab, slider)
    assert all(a != b for a, b in zip(before, drawn(tab, slider), strict=True))
    least, largest, _ = write_explorer.LIMITS[slider]
    for typed in (least, largest):
        type_in(tab, f"{slider}-number", f" {str(typed).replace('.', ',')} ")
        assert value(tab, slider) == value(tab, f"{slider}-number") == typed
    label = tab.evaluate(f"document.querySelector('label[for={slider}]').textContent")
    for typed in (f"{least - 0.01}", "1e9", "", "1 000", "abc"):
        type_in(tab, f"{slider}-number", typed)
        assert value(tab, slider) == value(tab, f"{slider}-number") == largest
        refused = f"{label}: \u201c{typed}\u201d is refused."
        assert text(tab, "refused") == f"{refused} Allowed: numbers from {least} to {largest}."
    box = element(f"{slider}-number")
    tab.evaluate(f"{box}.dispatchEvent(new KeyboardEvent('keydown', {{key: 'ArrowDown'}}))")
    tab.evaluate(FRAME)
    step = tab.evaluate(f"{box}.dataset.step")
    assert value(tab, slider) == pytest.approx(largest - float(step), abs=1e-9)
    assert text(tab, "refused") == ""


@pytest.mark.parametrize(
    ("address", "words"),
    [
        ("angle=200", "Angle of incidence θ: “200” is refused. Allowed: numbers from 0 to 89.9."),
        ("radius=0", "radius: “0” is refused. Allowed: numbers from 1 to 200."),
        (
            "view=motion",
            "At every incidence: “motion” is refused. Allowed: velocity, forces, energy.",
        ),
        ("models=a", "models: “a” is refused. Allowed: lumped, rigid, continuum."),
        ("loss=none", "loses energy: “none” is refused. Allowed: viscous, plastic."),
    ],
)
def test_an_address_that_is_not_allowed_is_told(address, words, show):
    tab = show(f"friction=0.7&{address}")
    assert text(tab, "refused") == words
    # What an address says wrongly is as the page opens; what it says well, counts.
    assert [value(tab, name) for name in ("angle", "friction")] == [50, 0.7]


def test_presets_stand_where_the_figures_say(presets, settings):
    assert sorted(presets) == sorted(figures.with_trait("explorer"))
    for figure in ("fig3", "fig4"):
        x = math.tan(math.radians(presets[figure]["angle"])) / presets[figure]["friction"]
        assert abs(x - settings["figures"][figure]["incidence"]) < 1e-4
    assert presets["fig8"]["friction"] == settings["figures"]["fig8"]["friction"]
    assert presets["fig3"]["restitution"] == settings["figures"]["fig3"]["restitution"][0]
    assert presets["fig6"]["restitution"] == sorted(settings["figures"]["fig6"]["restitution"])[1]
    zeta2 = bodies.stiffness_ratio(bodies.Material(1.0, presets["fig5"]["poisson_ratio"]))
    assert abs(zeta2 - settings["stiffness_ratio"]) < 1e-4


def test_a_preset_shows_the_impact_of_its_figure(show, presets):
    tab = show(height=3000)
    for state in presets.values():
        address = tab.evaluate(
            f"[...{element('preset')}.options].map((one) => one.value)"
            f".find((one) => one.startsWith('{write_explorer.address(state)}'))"
        )
        type_in(tab, "preset", address)
        assert tab.evaluate(f"{element('preset')}.value") == address
        nu, mu, e = (state[name] for name in ("poisson_ratio", "friction", "restitution"))
        x, beta = math.tan(math.radians(state["angle"])) / mu, state["mass_ratio"]
        wanted = lumped.rebound(x, beta, (2 - nu) / (2 * (1 - nu)), e)
        for name, theirs in zip(
            ("incidence", "velocity", "friction"), (x, *wanted[:2]), strict=True
        ):
            assert abs(number(text(tab, f"number-{name}")) - theirs) <= 6e-4
        total = 1 + (mu * x) ** 2 / beta
        energies = shown_energies(tab)
        assert np.abs(energies.sum(axis=0) - 100).max() <= 0.31
        assert abs(energies[-1, -1] - 200 * mu**2 * wanted.dissipation / total) <= 0.06
        assert len(text(tab, "about")) > 20
    type_in(tab, "angle-number", "44")
    assert tab.evaluate(f"{element('preset')}.value") == "" and text(tab, "about") == ""


def test_a_ball_to_throw_sets_all_that_it_names(show):
    tab = show()
    for ball in write_explorer.balls((FOLDER / "materials.yaml").read_text(encoding="utf-8")):
        type_in(tab, "preset", ball["address"])
        assert tab.evaluate(f"{element('preset')}.value") == ball["address"]
        assert text(tab, "refused") == "" and "Numbers: " in text(tab, "about")
        said = dict(pair.split("=") for pair in tab.evaluate("page.address()").split("&"))
        given = dict(pair.split("=") for pair in ball["address"].split("&"))
        # What is as the page opens is not said again.
        assert {name: said.get(name, given[name]) for name in given} == given


def test_what_the_sliders_cannot_show_is_not_offered(settings):
    for stiffness_ratio in (0.4, 2.5):
        assert write_explorer.presets(settings | {"stiffness_ratio": stiffness_ratio}) == {}


def test_words_about_a_preset_hold(presets, settings):
    state = presets["fig6"]
    x = math.tan(math.radians(state["angle"])) / state["friction"]
    groups = state["mass_ratio"], settings["stiffness_ratio"]
    lossy, elastic = lumped.rebound(x, *groups, [state["restitution"], 1.0]).velocity
    assert lossy < elastic < 0, "raise e to 1: thrown back less"
    for loss in continuum.LOSSES:
        e = [state["restitution"], 1.0]
        lossy, elastic = continuum.rebound(x, *groups, e, loss=loss, tolerance=1e-2).velocity
        assert elastic < lossy, "in the continuum it is the other way round"


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
        (
            "angle=0",
            "The paper’s lumped model: the contact point comes straight, and nothing slips.",
        ),
        (
            "angle=80&friction=0.1",
            "The paper’s lumped model: the contact slips forwards throughout. The contact point"
            " leaves forwards",
        ),
        (
            "angle=51&friction=0.5&restitution=1&of=continuum",
            "Continuum, elastic: the contact slips forwards first, then sticks in the middle, then"
            " slips backwards.",
        ),
        (
            "angle=20&friction=0.5&restitution=0",
            "The paper’s lumped model: the contact sticks throughout. The contact point does not",
        ),
    ],
)
def test_it_says_what_happens(address, words, show):
    tab = show(f"{address}&of=lumped")
    assert text(tab, "sentence").startswith(words)
    # Below e = 1 it says that the evidence is divided.
    cautions = tab.evaluate(f"{element('caution')}.checkVisibility()")
    assert cautions == ("restitution=0" in address)


def test_the_corners_of_the_box_are_drawn(show):
    rng, states = np.random.default_rng(1994), []
    choices = {name: limit[:2] for name, limit in write_explorer.LIMITS.items()}
    choices |= {"radius": (5, 50), "loss": continuum.LOSSES, "of": ("lumped", "continuum")}
    choices["view"] = ("velocity", "forces", "energy")
    for corner in itertools.product(*(choices[name] for name in write_explorer.OF_FIGURES)):
        drawn = {name: rng.choice(ends) for name, ends in choices.items()}
        named = drawn | dict(zip(write_explorer.OF_FIGURES, corner, strict=True))
        states.append("&".join(f"{name}={one}" for name, one in named.items()))
    pages = show(height=3000).evaluate(
        f"(async () => {{ const pages = [], slider = {element('time')};"
        f" for (const state of {json.dumps(states)}) {{ page.go(state); await {FRAME};"
        " slider.value = stage.duration() / 2; slider.dispatchEvent(new Event('input'));"
        " pages.push(document.querySelector('main').outerHTML); } return pages; })()"
    )
    for state, page in zip(states, pages, strict=True):
        assert "is refused" not in page, state
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
    controls = "[...document.querySelectorAll('button, input, select, [tabindex]')]"
    there = "!e.disabled && e.checkVisibility() && !e.closest('details:not([open])')"
    wanted = set(
        tab.evaluate(f"{controls}.filter((e) => {there}).map((e) => e.id || e.textContent)")
    )
    assert len(wanted) > 20 and wanted <= set(reached)
    ours = [one for one in reached.values() if one[0] in ("", "stage", "controls", "rebound")]
    steps = [(a, b) for a, b in zip(ours, ours[1:], strict=False) if width < 500 or a[0] == b[0]]
    # Two controls beside each other need not end at the same height.
    assert all(below[1] > above[1] - (12 if width < 500 else 40) for above, below in steps)


def test_space_plays_and_pauses(show):
    tab = show()
    playing = f"{element('play')}.textContent.endsWith('Pause')"
    for focus in ("document.body", element("angle")):
        tab.evaluate(f"({focus}).focus()")
        tab.press(" ")
        assert tab.evaluate(playing)
        tab.press(" ")
        assert not tab.evaluate(playing)
    # A button that is pressed by space does not play too.
    tab.evaluate("document.querySelectorAll('.body')[1].focus()")
    tab.press(" ")
    tab.evaluate(FRAME)
    assert not tab.evaluate(playing) and value(tab, "mass_ratio") == 2.5


def test_the_address_leads_back_to_an_impact(show):
    state = "angle=33.3&friction=0.7&restitution=0.25&poisson_ratio=0.1&mass_ratio=4"
    more = "&speed=3&spin=-50&table=0.5&radius=10&gravity=0&loss=plastic&of=lumped&view=energy"
    tab = show(f"{state}{more}")
    assert [value(tab, name) for name in SLIDERS] == [33.3, 0.7, 0.25, 0.1, 4.0, 3, -50, 0.5]
    type_in(tab, "friction-number", "0.8")
    wait_for(tab, "location.hash", f"#{state}{more}".replace("0.7", "0.8"))
    tab.evaluate("location.hash = 'angle=10&mass_ratio=nonsense&friction=99&who=knows'")
    wait_for(tab, f"{element('angle')}.value", "10")
    assert [value(tab, name) for name in ("friction", "mass_ratio")] == [0.4, 3.5]
    # A link that is short is a link to what the page opens with.
    type_in(tab, "friction-number", "0.5")
    short = "#angle=10&friction=0.5&restitution=1&poisson_ratio=0.3&mass_ratio=3.5"
    wait_for(tab, "location.hash", short)


def test_back_undoes_a_change(show):
    state = "angle=33&friction=0.7&restitution=0.25&poisson_ratio=0.1&mass_ratio=4&view=energy"
    tab = show(state)
    for typed in ("40", "45", "50"):  # one change: they follow at once
        type_in(tab, "angle-number", typed)
    wait_for(tab, "location.hash", f"#{state.replace('33', '50')}")
    click(tab, "model-rigid")
    wait_for(tab, "location.hash.endsWith('&models=lumped+continuum')", True)
    tab.evaluate("history.back()")
    wait_for(tab, f"{element('model-rigid')}.checked", True)
    assert value(tab, "angle") == 50
    tab.evaluate("history.back()")
    wait_for(tab, f"{element('angle')}.value", "33")
    # The link to the content is no impact.
    tab.evaluate("document.querySelector('.skip').click()")
    wait_for(tab, "location.hash", "#main")
    assert value(tab, "angle") == 33


@pytest.mark.parametrize("width", [320, 360, 800, 1280])
def test_nothing_is_wider_than_the_screen(width, show):
    tab = show("angle=89.9&friction=0.01", width=width)
    assert tab.evaluate("innerWidth") == width
    inside = "document.documentElement.scrollWidth <= innerWidth"
    wide = (
        f"(async () => {{ const wide = [{inside}]; for (const {{ value }} of"
        f" [...{element('preset')}.options].slice(1)) {{ page.go(value); await {FRAME};"
        f" wide.push({inside}); }} return wide; }})()"
    )
    assert all(tab.evaluate(wide))


def test_a_change_is_drawn_within_two_frames(show):
    change = (
        "(async () => { const slider = document.getElementById('angle'), times = [];"
        " const frame = (act) => new Promise((done) => requestAnimationFrame(() => done(act?.())));"
        " for (let i = 1; i <= 20; i++) { let start;"
        " requestAnimationFrame(() => (start = performance.now())); slider.value = 4 * i;"
        " slider.dispatchEvent(new Event('input')); await frame(() => document.body.offsetHeight);"
        " times.push(performance.now() - start); } return Math.min(...times); })()"
    )
    assert show().evaluate(change) < 33  # ms, half of that where nothing else runs


# ---- how it looks, and what a reader takes along


def test_the_first_screen_has_the_ball_the_throw_and_the_curve(show):
    tab = show(width=1440, height=900)
    parts = "#preset, #stage-svg, #play, #patches, #sentence, #control-angle, #incidence"
    boxes = (
        f"[...document.querySelectorAll('{parts}')].map((e) => e.getBoundingClientRect().bottom)"
    )
    bottoms = tab.evaluate(boxes)
    assert len(bottoms) == 7 and max(bottoms) <= 900


def luminance(colour):
    """Relative luminance of WCAG of three numbers from 0 to 255."""
    share = np.array(colour) / 255
    linear = np.where(share <= 0.04045, share / 12.92, ((share + 0.055) / 1.055) ** 2.4)
    return linear @ [0.2126, 0.7152, 0.0722]


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_lines_stand_out_from_every_band(theme, show):
    tab = show(f"angle=51&friction=0.5&restitution=0.5&of=lumped{SOLID}", height=3000)
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
        click(tab, f"do-{name}")
    try:
        tab = show()
        dark, large = tab.evaluate(look)
        assert dark != paper and float(large[:-2]) > 1.2 * float(size[:-2])
        pressed = (
            "['dark', 'projector'].map((id) => document.getElementById(`do-${id}`).ariaPressed)"
        )
        assert tab.evaluate(pressed) == ["true", "true"]
        tab.press("Escape")
        assert tab.evaluate(pressed) == ["true", "false"]
    finally:
        tab.evaluate("localStorage.clear()")


def test_curves_and_numbers_are_saved(show):
    tab = show(f"angle=45&friction=0.5&restitution=0.5{SOLID}&view=velocity")
    tab.evaluate("files.save = (name, blob) => (window.saved = { name, blob })")
    click(tab, "do-csv")
    assert tab.evaluate("saved.name") == "impact.csv"
    saved = tab.evaluate("saved.blob.text()")
    table = pd.read_csv(io.StringIO(saved), comment="#")
    notes = dict(re.findall(r"# (.*) = (\S+)\n", saved))
    assert float(notes["friction coefficient mu [1]"]) == 0.5
    x = table["incidence v1(0)/(mu v2(0)) [1]"]
    wanted = lumped.rebound(x, 3.5, 17 / 14, 0.5).velocity
    names = "the paper’s lumped model", "rigid limit", "continuum, viscous", "continuum, plastic"
    assert list(table.columns[2:]) == [f"{name}: v1(tf)/(mu v2(0)) [1]" for name in names]
    assert np.abs(table[table.columns[2]] - wanted).max() < 1e-9
    here = lumped.rebound(2.0, 3.5, 17 / 14, 0.5).velocity
    assert abs(float(notes[table.columns[2]]) - here) < 1e-9


@pytest.mark.parametrize(("button", "name"), [("ball", "stage.png"), ("curve", "curve.png")])
def test_a_picture_is_saved(button, name, show):
    tab = show("angle=45&friction=0.5&restitution=0.5")
    tab.evaluate("files.save = (name, blob) => (window.saved = { name, blob })")
    click(tab, f"do-{button}")
    wait_for(tab, "window.saved?.name", name)
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
        click(tab, "do-copy")
        wait_for(tab, f"{element('told')}.textContent.startsWith('{words}')", True)
    assert tab.evaluate("link").endswith("#" + tab.evaluate("page.address()"))


# ---- it stands alone


def test_the_page_needs_nothing_else(explorer):
    page = explorer.read_text(encoding="utf-8")
    assert len(page.encode()) < 1_000_000
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
