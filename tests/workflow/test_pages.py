"""All pages that a run writes: links, landmarks, a phone's width, and what axe finds.

axe (https://github.com/dequelabs/axe-core) finds what people with a disability cannot read or use.
"""

import doctest
import functools
import html
import inspect
import json
import re
import shutil
from importlib import resources
from urllib.parse import parse_qsl, unquote, urlsplit

import pytest

import planarimpact
from stronge1994.pages import templates
from tests.workflow.page import Page
from tests.workflow.project import LEFT, PARTS, ROOT, copy_of

FOLDER = ROOT / "workflow/report"
BAR = re.findall(r'^  \("(.+?)", ', (FOLDER / "site.html").read_text(encoding="utf-8"), flags=re.M)
INTERFACE = "interface/planarimpact.html"
OF_LECTURES = "slides_", "answers_"
LECTURE = "why_a_superball_comes_back.html"
# pdoc writes the interface and has no option for these: the links beside each name have no words,
# and each "Parameters" is a heading of level 6 with the same id.
NOT_OURS = ["link-name", "heading-order", "duplicate-id"]

# What is folded counts as well.
OPEN = "for (const part of document.querySelectorAll('details')) part.open = true;"
# Colours may fade from light to dark: what counts is where they end.
FIND = """Promise.all(document.getAnimations().map((one) => one.finished))
.then(() => axe.run({resultTypes: ['violations'], iframes: false, ...%s}))
.then((found) => found.violations.map(
  ({id, nodes}) => `${id}: ${nodes.length}, first ${nodes[0].target}: ${nodes[0].html.slice(0, 90)}`
))"""
CUT = "(bar) => bar.scrollWidth > bar.clientWidth"
# A width in px, a colour scheme, and whether axe judges colours, the rest, or both.
WINDOWS = {
    "light": (1440, "light", ("colours", "rest")),
    "dark": (1440, "dark", ("colours",)),
    "phone": (390, "light", ("rest",)),
}


@functools.cache
def parsed(path):
    return Page(path.read_text(encoding="utf-8"))


def wrong_state(controls, state):
    """What the controls of the explorer do not know, or do not allow, in an address behind #."""
    wrong = []
    for name, value in parse_qsl(state, keep_blank_values=True, strict_parsing=True):
        control = controls.get(name, {})
        if name == "models":  # a checkbox each
            known = all(f"model-{model}" in controls for model in value.split())
        elif "min" in control:
            known = float(control["min"]) <= float(value) <= float(control["max"])
        else:
            known = value in control.get("options", [])
        wrong += [] if known else [f"{name}={value}"]
    return wrong


def dead_links(folder, names):
    """Links that lead nowhere, to no state of the explorer, or out of the folder of the pages."""
    folder, dead = folder.resolve(), []
    for name in names:
        start = folder / name
        for link in parsed(start).links + parsed(start).resources:
            scheme, _, path, _, anchor = urlsplit(link)
            if scheme:
                continue
            target = (start.parent / unquote(path)).resolve() if path else start
            if not target.is_file():
                dead.append((name, link, "no such file"))
            elif not target.is_relative_to(folder):
                dead.append((name, link, "outside"))
            elif "=" in anchor and target.name == "explorer.html":
                wrong = wrong_state(parsed(target).controls, anchor)
                dead += [(name, link, wrong)] if wrong else []
            elif anchor and unquote(anchor) not in parsed(target).ids:
                dead.append((name, link, "no such anchor"))
    return dead


@pytest.fixture(scope="module")
def figures(first_run):
    return first_run[0] / "figures"


@pytest.fixture(scope="module")
def site(first_run, tmp_path_factory):
    """The site, made after a run and unpacked somewhere else."""
    folder = tmp_path_factory.mktemp("site")
    project = copy_of(first_run[0].folder, folder / "project", PARTS + LEFT)
    result = project.run("site")
    assert result.returncode == 0, result.stdout
    shutil.unpack_archive(project / "results/site.zip", folder / "unpacked")
    return folder / "unpacked/site"


def test_every_page_has_a_bar_of_all_pages_and_a_landmark(figures):
    # A lecture links its own slides and answers.
    written = {path.name for path in figures.glob("*.html")}
    assert sorted(BAR) == sorted(name for name in written if not name.startswith(OF_LECTURES))
    for name in BAR:
        page = parsed(figures / name)
        assert page.bar == BAR and page.tags["main"] == "main", name


def test_every_link_of_the_site_leads_somewhere_in_it(site, figures):
    pages = [str(path.relative_to(site)) for path in site.rglob("*.html")]
    assert set(pages) > {*BAR, INTERFACE}
    assert INTERFACE in parsed(site / "index.html").links
    assert parsed(site / INTERFACE).bar == [f"../{file}" for file in BAR]
    assert dead_links(site, pages) == []
    assert dead_links(figures, [path.name for path in figures.glob("*.html")]) == []


def test_the_interface_has_a_page_a_module_and_names_types_as_the_sources_do(site):
    page = (site / "interface/planarimpact/lumped.html").read_text(encoding="utf-8")
    words = html.unescape(re.sub("<[^>]+>", "", page))
    assert "incidence: ArrayLike" in words and ") -> Rebound:" in words
    for room in planarimpact.__all__:
        if inspect.ismodule(getattr(planarimpact, room)):
            assert (site / f"interface/planarimpact/{room}.html").is_file(), room


@pytest.mark.parametrize("every", [6, pytest.param(1, marks=pytest.mark.long)])
def test_each_example_of_the_interface_runs_as_the_first_page_says(site, every):
    examples = []
    for path in sorted((site / "interface/planarimpact").rglob("*.html")):
        module = ".".join(path.relative_to(site / "interface").with_suffix("").parts)
        page = path.read_text(encoding="utf-8")
        for shown in re.findall("<pre>(.*?)</pre>", page, flags=re.S):
            text = html.unescape(re.sub("<[^>]+>", "", shown))
            if text.startswith(">>> "):
                examples.append((module, text))
    assert len(examples) > 100
    runner = doctest.DocTestRunner()
    for module, text in examples[::every]:
        text = f">>> import numpy as np\n>>> from {module} import *\n{text}"
        runner.run(doctest.DocTestParser().get_doctest(text, {}, module, module, 0))
    assert runner.failures == 0


def test_presets_of_the_explorer_are_states_that_it_allows(figures):
    page = parsed(figures / "explorer.html")
    states = [state for state in page.controls["preset"]["options"] if state]
    assert len(states) > 10
    assert [wrong for state in states if (wrong := wrong_state(page.controls, state))] == []


def test_a_dead_link_is_found(tmp_path):
    inputs = '<input id="angle" min="0" max="90"><input id="model-a"><input id="model-b">'
    folder = tmp_path / "figures"
    folder.mkdir()
    (tmp_path / "outside.csv").touch()
    (folder / "explorer.html").write_text(f'<p id="top">{inputs}</p>')
    good = ["#here", "explorer.html#top", "explorer.html#angle=9.5&models=a+b"]
    bad = ["#gone", "lost.html", "../outside.csv", "explorer.html#here", "explorer.html#angle=91"]
    bad += ["explorer.html#angel=9", "explorer.html#models=a+c"]
    links = "".join(f'<a href="{link}">.</a>' for link in [*good, "https://doi.org/10.1", *bad])
    (folder / "page.html").write_text(f'<p id="here">{links}</p>')
    assert [link for _, link, _ in dead_links(folder, ["page.html"])] == bad


def options(kinds, left):
    """Options of axe: which rules it tries."""
    if kinds == ("colours",):
        return {"runOnly": ["color-contrast"]}
    left = [*left, *(["color-contrast"] if "colours" not in kinds else [])]
    return {"rules": {rule: {"enabled": False} for rule in left}}


@pytest.fixture(scope="module")
def look(tab):
    """Function that opens a page once and gives its faults in each of the `WINDOWS`."""
    axe = resources.files("axe_core_python").joinpath("axe.min.js").read_text(encoding="utf-8")

    def faults(path, left=()):
        assert path.is_file()
        tab.open(path.as_uri())
        tab.evaluate(f"{axe}; {OPEN}")
        found = {}
        for window, (width, scheme, kinds) in WINDOWS.items():
            tab.resize(width, 900, mobile=width < 500)
            tab.prefer(color_scheme=scheme, reduced_motion="reduce")
            found[window] = tab.evaluate(FIND % json.dumps(options(kinds, left)))
            if (real := tab.evaluate("document.documentElement.scrollWidth")) > width:
                found[window].append(f"too wide: {real} px")
            if tab.evaluate(f"[...document.querySelectorAll('.site ul')].some({CUT})"):
                found[window].append("the bar is cut")
        return found

    patience, tab.timeout = tab.timeout, 120  # s: axe takes seconds for a long page
    yield faults
    tab.timeout = patience


NONE = dict.fromkeys(WINDOWS, [])


@pytest.mark.parametrize("name", [*BAR, *(f"{kind}{LECTURE}" for kind in OF_LECTURES)])
def test_axe_finds_nothing_and_no_page_is_wider_than_its_window(figures, look, name):
    assert look(figures / name) == NONE


def test_axe_finds_nothing_of_ours_on_the_interface(site, look):
    assert look(site / INTERFACE, NOT_OURS) == NONE


def test_links_unfold_what_they_lead_to(figures, tab):
    for page, names in (
        ("report.html", ("fig6-rebound", "fig2-solved")),
        ("sources.html", ("config-fig5", "config-rod")),
    ):
        tab.open(f"{(figures / page).as_uri()}#{names[0]}")
        for name in names:
            tab.evaluate(f"location.hash = '{name}'; new Promise((go) => setTimeout(go, 50))")
            assert tab.evaluate(f"document.getElementById('{name}').closest('details').open")
    assert not tab.problems


FAULTY = """<!DOCTYPE html><html lang="en"><head><title>A page</title>
<meta name="viewport" content="width=device-width, initial-scale=1"><style>
{% include "theme.css" %}
.faint { color: light-dark(#222, #333); }
@media (width > 500px) { .phone { display: none; } }
</style></head><body><main id="main"><h1>Words</h1>{{ part|safe }}</main></body></html>"""
FAULTS = """<img src="data:,"><details><button></button></details>
<p class="faint">Unseen in the dark.</p><p style="width: 500px">Long.</p>
<div class="site"><ul style="overflow:hidden"><li style="min-width:500px">Long.</li></ul></div>
<h4 class="phone">On phones only</h4>"""


def test_faults_of_a_page_are_found(look, tmp_path):
    template = templates.environment(tmp_path).from_string(FAULTY)
    found = {}
    for name, part in (("good", "<p>Good.</p>"), ("bad", FAULTS)):
        (tmp_path / f"{name}.html").write_text(template.render(part=part))
        faults = look(tmp_path / f"{name}.html")
        found[name] = {window: {f.partition(":")[0] for f in faults[window]} for window in faults}
    assert found["good"] == dict.fromkeys(WINDOWS, set())
    without_words = {"image-alt", "button-name"}
    assert found["bad"] == {
        "light": without_words,
        "dark": {"color-contrast"},
        "phone": without_words | {"too wide", "the bar is cut", "heading-order"},
    }
