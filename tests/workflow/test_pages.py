"""All pages that a run writes: links, a phone's width, and what axe finds.

axe (https://github.com/dequelabs/axe-core) finds what people with a disability cannot read or use.
"""

import base64
import functools
import json
import re
from importlib import resources
from urllib.parse import parse_qsl, unquote, urlsplit

import pytest

from tests.workflow.page import Page, seen
from tests.workflow.project import ROOT, ledger

FOLDER = ROOT / "workflow/report"
BAR = re.findall(r'^  \("(.+?)", ', (FOLDER / "site.html").read_text(encoding="utf-8"), flags=re.M)
SLIDES = "slides_why_a_superball_comes_back.html"
OF_LECTURES = "slides_", "answers_"
ANSWERS = "answers_choosing_a_model.html"
COLOURS = "color-contrast"  # a rule of axe

# What is folded counts as well. No colour is looked at on its way from light to dark.
OPEN = """for (const part of document.querySelectorAll('details')) part.open = true;
document.head.append(Object.assign(document.createElement('style'),
  {textContent: '* { transition: none !important; }'}));"""
FIND = """axe.run(%s, {resultTypes: ['violations'], iframes: false, ...%s})
.then((found) => found.violations.map(
  ({id, nodes}) => `${id}: ${nodes.length}, first ${nodes[0].target}`
))"""
# Of rows, entries and paragraphs that are built alike, one is enough: axe takes long for each part.
ALIKE = """{
  const kinds = new Set();
  const words = ({firstChild: first}) => first?.nodeType == 3 && first.data.trim();
  const look = (one) => `${one.localName}.${[...one.attributes].map(
    ({name, value}) => /class|style|role|lang/.test(name) ? name + value : name)}.${!words(one)}`;
  for (const one of document.querySelectorAll('article, tr, li, section, p, details')) {
    if (!one.isConnected) continue;
    const kind = [one.parentElement, one, ...one.querySelectorAll('*')].map(look).join();
    kinds.has(kind) ? one.remove() : kinds.add(kind);
  }
}"""
# The other rules see nothing in the parts of a formula.
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


def test_the_bar_has_every_page(figures):
    # A lecture links its own slides; its answers are for the teacher.
    written = {path.name for path in figures.glob("*.html")}
    assert sorted(BAR) == sorted(name for name in written if not name.startswith(OF_LECTURES))


def test_every_link_leads_somewhere_in_the_folder(figures):
    """So the folder is a web site. The start page gives notebooks, and no answers."""
    links = parsed(figures / "index.html").links
    assert sorted(path.name for path in figures.glob("student_*.ipynb")) == sorted(
        link for link in links if link.endswith(".ipynb")
    )
    assert not [link for link in links if "answers" in link]
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

    def faults(path):
        assert path.is_file()
        window(390, "light")
        tab.open(path.as_uri())
        tab.evaluate(f"{axe}; {OPEN}")
        real = tab.evaluate("document.documentElement.scrollWidth")
        found = {"phone": [f"too wide: {real} px"] if real > 390 else []}
        if tab.evaluate(f"[...document.querySelectorAll('.site ul')].some({CUT})"):
            found["phone"].append("the bar is cut")
        tab.evaluate(ALIKE)
        colours = FIND % (KINDS, json.dumps({"runOnly": [COLOURS]}))
        for scheme in ("dark", "light"):
            window(1440, scheme)
            found[scheme] = tab.evaluate(colours)
        rules = json.dumps({"rules": {COLOURS: {"enabled": False}}})
        found["light"] += tab.evaluate(f"{SHORT}; {FIND % ('document', rules)}")
        return found

    patience, tab.timeout = tab.timeout, 120  # s: axe takes seconds for a long page
    yield faults
    tab.timeout = patience


@pytest.mark.parametrize("name", [*BAR, SLIDES, ANSWERS])
def test_axe_finds_nothing_and_no_page_is_wider_than_a_phone(figures, look, name):
    assert look(figures / name) == {"light": [], "dark": [], "phone": []}


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
    wrong = [name for name in every if ledger()[name].verdict == "wrong"]
    assert tab.evaluate(SHOWN) == wrong
    tab.page.select_option("[name=page]", "443")
    of_page = [name for name in wrong if "443" in ledger()[name].where]
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
    for number, shown in (("25", ["eq-25"]), ("1", ["eq-01"])):  # 1 is none of 10 to 19
        tab.page.select_option("[name=equation]", number)
        assert tab.evaluate(SHOWN) == shown
    assert tab.problems == []


def test_sources_stand_in_the_order_of_their_kinds(figures):
    text = (figures / "sources.html").read_text(encoding="utf-8")
    cells = re.findall('<td data-label="series and facts">(.*?)</td>', text)
    kinds = [re.sub(r"\d+ ", "", cell).split(", ") for cell in cells]
    order = ["measured", "digitised", "stated", "computed", "awaited"]
    ranks = [min(map(order.index, of_source)) for of_source in kinds]
    assert len(ranks) > 20 and ranks == sorted(ranks)


def test_an_address_opens_the_fold_of_its_series(figures, tab):
    tab.open(f"{(figures / 'sources.html').as_uri()}#kharaz2001/spin")
    shown = "document.getElementById('kharaz2001/spin').checkVisibility()"
    assert tab.evaluate(shown) and tab.evaluate("document.querySelectorAll('[open]').length") == 1


PRINTED = """(() => {
  const clipped = [...document.querySelectorAll('main :is(table, svg, pre, p)')].filter(
    (one) => one.checkVisibility() && one.getBoundingClientRect().right > innerWidth + 1);
  const marks = [...document.querySelectorAll('.mark')].filter(
    (one) => getComputedStyle(one).printColorAdjust != 'exact');
  return [...clipped, ...marks].map((one) => one.outerHTML.slice(0, 99));
})()"""


def printed(tab, path, script):
    """What a script finds of a page as it is printed, and the number of its sheets."""
    tab.open(path.as_uri())
    tab.resize(703, 1030)  # A4 in pixels, without its margins of 12 mm
    tab.prefer(media="print")
    try:
        found = tab.evaluate(script)
        pdf = base64.b64decode(tab.call("Page.printToPDF", preferCSSPageSize=True)["data"])
    finally:
        tab.prefer(media="screen")
    return found, len(re.findall(rb"/Type\s*/Page\b", pdf))


def test_the_report_prints_on_twelve_pages_with_nothing_clipped(figures, tab):
    """The marks keep their colours, without which their white words cannot be read."""
    clipped, sheets = printed(tab, figures / "report.html", PRINTED)
    assert clipped == []
    assert 1 < sheets <= 12
    assert tab.problems == []


# What a reader would miss of a slide: parts that are not on it.
LOST = """[...document.querySelectorAll('.slide')].flatMap((slide, n) => {
  const all = slide.getBoundingClientRect();
  const parts = [...slide.querySelectorAll('h1, h2, h3, h4, p, li, td, pre, img, svg')];
  return parts.filter((part) => {
    const { height, top, right, bottom } = part.getBoundingClientRect();
    return !(height && top >= all.top && right <= all.right && bottom <= all.bottom);
  }).map((part) => `${n + 1}: ${part.outerHTML.slice(0, 60)}`);
})"""
LECTURES = sorted(path.stem for path in (ROOT / "workflow/notebooks").glob("*.ipynb"))


@pytest.mark.parametrize("name", LECTURES)
def test_each_slide_is_printed_whole_on_a_page_whatever_the_window(figures, tab, name):
    lost, sheets = printed(tab, figures / f"slides_{name}.html", LOST)
    assert lost == []
    assert sheets == tab.evaluate("document.querySelectorAll('.slide').length") > 20


def test_a_key_in_a_box_turns_no_slide(figures, tab):
    tab.resize(1440, 900)
    tab.open((figures / SLIDES).as_uri())
    tab.evaluate("document.querySelector('.slide').append(document.createElement('textarea'))")
    box = tab.page.locator("textarea")
    for key, turned in (("a b", False), (None, True)):
        box.press_sequentially(key) if key else box.blur()
        tab.press(" ")
        tab.page.wait_for_timeout(50)
        assert (tab.evaluate("scrollY") > 100) == turned


FAULTY = """<!DOCTYPE html><html lang="en"><head><title>A page</title>
<meta name="viewport" content="width=device-width, initial-scale=1"><style>
:root { color-scheme: light dark; background: light-dark(#fff, #111); }
.faint { color: light-dark(#222, #333); }
</style></head><body><main><h1>Words</h1><details><button></button></details>
<p class="faint">Unseen in the dark.</p><p style="width: 500px">Long.</p></main>
<script>console.error('oh'); missing()</script></body></html>"""


def test_faults_of_a_page_are_found(look, tab, tmp_path):
    tab.problems.clear()
    (tmp_path / "bad.html").write_text(FAULTY)
    faults = look(tmp_path / "bad.html")
    assert {window: {f.partition(":")[0] for f in faults[window]} for window in faults} == {
        "light": {"button-name"},
        "dark": {COLOURS},
        "phone": {"too wide"},
    }
    assert [name for name in ("oh", "missing is not") if name not in str(tab.problems)] == []
    tab.problems.clear()
