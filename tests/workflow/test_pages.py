"""All pages that a run writes: links, a phone's width, and what axe finds.

axe (https://github.com/dequelabs/axe-core) finds what people with a disability cannot read or use.
"""

import contextlib
import functools
import inspect
import json
import pathlib
import re
import shutil
from importlib import resources
from urllib.parse import parse_qsl, unquote, urlsplit

import pytest

import planarimpact
from stronge1994.pages import interface
from stronge1994.pages import site as write_site
from tests.workflow.page import Page, seen
from tests.workflow.project import ROOT, ledger, sources

FOLDER = ROOT / "workflow/report"
BAR = re.findall(r'^  \("(.+?)", ', (FOLDER / "site.html").read_text(encoding="utf-8"), flags=re.M)
INTERFACE, SLIDES = "interface/planarimpact.html", "slides_why_a_superball_comes_back.html"
OF_LECTURES = "slides_", "answers_"
ANSWERS = "answers_choosing_a_model.html"
COLOURS = "color-contrast"  # a rule of axe
# pdoc writes the interface and has no option for these: the links beside each name have no words,
# and each "Parameters" is a heading of level 6 with the same id.
NOT_OURS = ["link-name", "heading-order", "duplicate-id"]

# What is folded counts as well. No colour is looked at on its way from light to dark.
OPEN = """for (const part of document.querySelectorAll('details')) part.open = true;
document.head.append(Object.assign(document.createElement('style'),
  {textContent: '* { transition: none !important; }'}));"""
FIND = """axe.run(%s, {resultTypes: ['violations'], iframes: false, ...%s})
.then((found) => found.violations.map(
  ({id, nodes}) => `${id}: ${nodes.length}, first ${nodes[0].target}`
))"""
# The other rules see nothing in the parts of a formula, and take long for them.
SHORT = "for (const one of document.querySelectorAll('math')) one.replaceChildren('formula')"
# Of words with the same tags, classes and styles, theirs and what they stand in, one is enough.
KINDS = """(() => {
  const kinds = new Map();
  for (const one of document.querySelectorAll('body *')) {
    if (![...one.childNodes].some((node) => node.nodeType == 3 && node.data.trim())) continue;
    let kind = '';
    for (let at = one; at; at = at.parentElement)
      kind += `${at.localName}.${at.getAttribute('class')}.${at.getAttribute('style')} `;
    if (!kinds.has(kind)) kinds.set(kind, one);
  }
  return {include: [...kinds.values()]};
})()"""
CUT = "(bar) => bar.scrollWidth > bar.clientWidth"


@functools.cache
def parsed(path):
    return Page(path.read_text(encoding="utf-8"))


def wrong_state(controls, state):
    """What the controls of the explorer do not know, or do not allow, in an address behind #."""
    wrong = []
    for name, value in parse_qsl(state, keep_blank_values=True, strict_parsing=True):
        control = controls.get(name, {})
        if "min" in control:
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
            elif target.name == "your_copy.html" and anchor.startswith("fig"):
                panels = parsed(target).controls["panel"]["options"]
                if not any(panel.startswith(anchor) for panel in panels):
                    dead.append((name, link, "no such figure"))
            elif anchor and unquote(anchor) not in parsed(target).ids:
                dead.append((name, link, "no such anchor"))
    return dead


@pytest.fixture(scope="module")
def figures(first_run):
    return first_run[0] / "figures"


@pytest.fixture(scope="module")
def site(figures, tmp_path_factory):
    """The site, written after a run and unpacked somewhere else."""
    folder = tmp_path_factory.mktemp("site")
    with contextlib.chdir(figures.parent):
        pages = [path for path in pathlib.Path("figures").iterdir() if path.suffix != ".md"]
        pages = [path for path in pages if not path.name.startswith("answers_")]
        write_site.write(f"{folder}/site", pages, ["LICENSE", "CITATION.cff"])
    interface.write(f"{folder}/site/interface")
    write_site.pack(f"{folder}/site", f"{folder}/site.zip")
    shutil.unpack_archive(folder / "site.zip", folder / "unpacked")
    return folder / "unpacked/site"


@pytest.mark.long
def test_snakemake_makes_the_same_site(finished, site):
    result = finished.run("site")
    assert result.returncode == 0, result.stdout
    files = [
        {str(path.relative_to(folder)) for path in folder.rglob("*") if path.name[0] != "."}
        for folder in (site, finished / "results/site")
    ]
    assert files[0] == files[1]


def test_the_bar_has_every_page(figures):
    # A lecture links its own slides; its answers are for the teacher.
    written = {path.name for path in figures.glob("*.html")}
    assert sorted(BAR) == sorted(name for name in written if not name.startswith(OF_LECTURES))


def test_every_link_of_the_site_leads_somewhere_in_it(site, figures):
    pages = [str(path.relative_to(site)) for path in site.rglob("*.html")]
    assert set(pages) > {*BAR, INTERFACE}
    assert INTERFACE in parsed(site / "index.html").links
    assert {path.name for path in site.glob("*.ipynb")} < {*parsed(site / "index.html").links}
    assert len([*site.glob("student_*.ipynb")]) == 3
    text = seen((site / "index.html").read_text(encoding="utf-8"))
    assert ANSWERS not in pages and "they are not published here" in text
    assert parsed(site / INTERFACE).bar == [f"../{file}" for file in BAR]
    names = [name for name in planarimpact.__all__ if inspect.ismodule(getattr(planarimpact, name))]
    assert {f"interface/planarimpact/{name}.html" for name in names} < set(pages)
    assert dead_links(site, pages) == []
    assert dead_links(figures, [path.name for path in figures.glob("*.html")]) == []


def test_presets_of_the_explorer_are_states_that_it_allows(figures):
    page = parsed(figures / "explorer.html")
    states = [state for state in page.controls["preset"]["options"] if state]
    assert len(states) > 10
    assert [wrong for state in states if (wrong := wrong_state(page.controls, state))] == []


@pytest.fixture(scope="module")
def look(tab):
    """Function that opens a page once and gives its faults: all, colours in the dark, width."""
    axe = resources.files("axe_core_python").joinpath("axe.min.js").read_text(encoding="utf-8")

    def window(width, scheme):
        tab.resize(width, 900, mobile=width < 500)
        tab.prefer(color_scheme=scheme, reduced_motion="reduce")

    def faults(path, left=()):
        assert path.is_file()
        window(1440, "light")
        tab.open(path.as_uri())
        tab.evaluate(f"{axe}; {OPEN}")
        colours = FIND % (KINDS, json.dumps({"runOnly": [COLOURS]}))
        found = {"light": tab.evaluate(colours)}
        window(1440, "dark")
        found["dark"] = tab.evaluate(colours)
        window(390, "light")
        real = tab.evaluate("document.documentElement.scrollWidth")
        found["phone"] = [f"too wide: {real} px"] if real > 390 else []
        if tab.evaluate(f"[...document.querySelectorAll('.site ul')].some({CUT})"):
            found["phone"].append("the bar is cut")
        window(1440, "light")
        rules = json.dumps({"rules": {rule: {"enabled": False} for rule in [*left, COLOURS]}})
        found["light"] += tab.evaluate(f"{SHORT}; {FIND % ('document', rules)}")
        return found

    patience, tab.timeout = tab.timeout, 120  # s: axe takes seconds for a long page
    yield faults
    tab.timeout = patience


@pytest.mark.parametrize("name", [*BAR, SLIDES, ANSWERS, INTERFACE])
def test_axe_finds_nothing_of_ours_and_no_page_is_wider_than_a_phone(figures, site, look, name):
    left = NOT_OURS if name == INTERFACE else ()
    assert look((site if left else figures) / name, left) == {"light": [], "dark": [], "phone": []}


@pytest.mark.parametrize("name", ["ledger.html", "sources.html"])
def test_no_sentence_runs_into_the_next(figures, name):
    text = seen((figures / name).read_text(encoding="utf-8"))
    assert re.findall(r"\S*[a-z)][.:;,][A-Z][a-z]\S*", text) == []


SHOWN = """[...document.querySelectorAll('[data-kind]')].filter((part) => part.checkVisibility())
.map((part) => part.id)"""


def test_the_filter_of_the_ledger_works_by_keyboard_on_a_phone(figures, tab):
    """It says how many entries are shown, and hides none to which an address leads."""
    tab.resize(390, 900, mobile=True)
    tab.open((figures / "ledger.html").as_uri())
    count = tab.page.locator("output[name=shown]")
    every = tab.evaluate(SHOWN)
    assert every == list(ledger())
    tab.page.focus("[name=words]")
    tab.press("Tab")
    tab.page.keyboard.type("wrong")
    wrong = [name for name in every if ledger()[name]["verdict"] == "wrong"]
    assert tab.evaluate(SHOWN) == wrong
    tab.page.select_option("[name=page]", "443")
    of_page = [name for name in wrong if "443" in ledger()[name]["where"]]
    assert tab.evaluate(SHOWN) == of_page
    tab.page.fill("[name=words]", "Three PHASES")
    assert tab.evaluate(SHOWN) == ["three-sequences"]
    assert count.text_content() == f"1 of {len(every)} entries shown"
    for _ in range(2):  # and again after a filter has hidden it
        tab.evaluate("location.hash = 'eq-25'")
        tab.page.wait_for_selector("#eq-25 details[open]")
        assert tab.evaluate(SHOWN) == ["eq-25", "three-sequences"]
        assert (
            0 <= tab.evaluate("document.querySelector('#eq-25').getBoundingClientRect().top") < 900
        )
        tab.page.fill("[name=words]", "three phases")
        assert tab.evaluate(SHOWN) == ["three-sequences"]
    tab.open("about:blank")
    tab.open(f"{(figures / 'ledger.html').as_uri()}#eq-25")
    assert tab.evaluate(SHOWN) == every
    tab.page.select_option("[name=equation]", "25")
    assert tab.evaluate(SHOWN) == ["eq-25"]
    assert tab.problems == []


def test_sources_stand_in_the_order_of_their_kinds_and_are_filtered_by_them(figures, tab):
    tab.resize(1440, 900)
    tab.open((figures / "sources.html").as_uri())
    series = {
        f"{source}/{name}": entry.get("kind", "stated")
        for source, stated in sources().items()
        for kind in ("series", "facts")
        for name, entry in stated.get(kind, {}).items()
    }
    assert set(tab.evaluate(SHOWN)) == set(series)
    order = ["measured", "digitised", "stated", "computed", "awaited"]
    names = [name.split("/")[0] for name in tab.evaluate(SHOWN)]
    ranks = {
        name: min(order.index(series[s]) for s in series if s.startswith(f"{name}/"))
        for name in names
    }
    assert list(ranks.values()) == sorted(ranks.values())
    for kind in order:
        tab.page.select_option("[name=kind]", kind)
        wanted = {name for name in series if series[name] == kind}
        assert set(tab.evaluate(SHOWN)) == wanted
        said = f"{len(wanted)} of {len(series)} series and facts shown"
        assert tab.page.text_content("output[name=shown]") == said
        headings = tab.page.locator("h3:visible").count()
        assert headings == len({name.split("/")[0] for name in wanted})
    assert tab.problems == []


FAULTY = """<!DOCTYPE html><html lang="en"><head><title>A page</title>
<meta name="viewport" content="width=device-width, initial-scale=1"><style>
:root { color-scheme: light dark; background: light-dark(#fff, #111); }
.faint { color: light-dark(#222, #333); }
</style></head><body><main><h1>Words</h1><details><button></button></details>
<p class="faint">Unseen in the dark.</p><p style="width: 500px">Long.</p></main></body></html>"""


def test_faults_of_a_page_are_found(look, tmp_path):
    (tmp_path / "bad.html").write_text(FAULTY)
    faults = look(tmp_path / "bad.html")
    assert {window: {f.partition(":")[0] for f in faults[window]} for window in faults} == {
        "light": {"button-name"},
        "dark": {COLOURS},
        "phone": {"too wide"},
    }
