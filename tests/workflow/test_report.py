"""The report and the page of sources: complete, every link leads somewhere, a bad run looks bad."""

import base64
import csv
import doctest
import html
import inspect
import math
import re
from collections import Counter
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest
import yaml

import planarimpact
from stronge1994 import formulas, reference_data
from stronge1994.figures.shared.drawing import residuals as draw_residuals
from stronge1994.ledger import outcome
from stronge1994.pages import ledger_page, names
from stronge1994.pages import report as write_report
from stronge1994.plan import config as configuration
from stronge1994.plan import figures
from stronge1994.verdict_tables import verdict_table
from tests.workflow import browser

ROOT = Path(__file__).parents[2]
CONFIG = configuration.load(ROOT)
SCHEMA = reference_data.load_yaml(ROOT / "workflow/schemas/source.schema.yaml")
VOID = {"meta", "img", "br", "input", "link", "hr"}


class Page(HTMLParser):
    """Anchors, links, resources and words of a page.

    Refuses tags that do not balance, headings that skip a level, pictures without words.
    """

    def __init__(self, text):
        super().__init__()
        self.ids, self.links, self.resources, self.words = [], [], [], []
        self.open, self.level = [], 0
        self.feed(text)
        assert not self.open, self.open

    def handle_starttag(self, tag, attributes):
        found = dict(attributes)
        self.ids += [found["id"]] if "id" in found else []
        self.links += [found["href"]] if tag == "a" else []
        self.resources += [found[key] for key in ("src", "srcset", "data") if key in found]
        self.resources += [found["href"]] if tag == "link" else []
        if tag == "img":
            assert len(found["alt"]) > 10
            assert found["alt"].count("(") == found["alt"].count(")"), found["alt"]
        if re.fullmatch("h[1-6]", tag):
            assert int(tag[1]) <= self.level + 1, self.getpos()
            self.level = int(tag[1])
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag, (tag, self.getpos())

    def handle_data(self, data):
        self.words.append(data)


def rows_of(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


@pytest.fixture(scope="module")
def report(first_run):
    return first_run[0] / "figures/report.html"


@pytest.fixture(scope="module")
def page(report):
    return Page(report.read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def text(page):
    return in_words(page)


@pytest.fixture(scope="module")
def provenance(first_run):
    return Page((first_run[0] / "figures/sources.html").read_text(encoding="utf-8"))


def in_words(page):
    return " ".join(" ".join(page.words).split())


def test_each_is_one_file_that_needs_nothing_else(report, page, provenance):
    assert report.stat().st_size < 6e6
    folded = r"<(details|style)>.*?</\1>"
    assert len(in_words(Page(re.sub(folded, "", report.read_text(), flags=re.S))).split()) < 7000
    assert all(resource.startswith("data:image/svg+xml;base64,") for resource in page.resources)
    outside = [link for link in provenance.links if ":" in link]
    assert outside and all(link.startswith("https://doi.org/10.") for link in outside)
    assert not provenance.resources and not any(":" in link for link in page.links)
    assert all(len(set(found.ids)) == len(found.ids) for found in (page, provenance))
    styles = "".join(re.findall(r"<style>.*?</style>", report.read_text(), flags=re.S))
    assert "url(" not in styles and "@import" not in styles


def test_the_first_words_say_how_it_went_and_what_was_found(first_run, text, report):
    """Numbers are those of the tables, and each error that changes a result is named."""
    first = text[: text.index("Verdicts Each comparison")]
    assert first.index("PASSED") < first.rindex("The model") < first.rindex("What we found")
    assert "FAILED" not in text and "as before" not in first
    ledger = rows_of(first_run[0] / "results/ledger.csv")
    counts = Counter(row["verdict"] for row in ledger)
    assert f"Of {len(ledger)} entries {counts['confirmed']} are confirmed" in first
    head = report.read_text(encoding="utf-8").split('<h2 id="verdicts">')[0]
    for row in ledger:
        if row["grade"] == "changes a result":
            assert f'<a href="ledger.html#{row["entry"]}">' in head
    verdicts = {row["comparison"]: row for row in rows_of(first_run[0] / "results/verdicts.csv")}
    assert f"= {float(verdicts['inelastic-lumped.hysteretic-pairs']['chi^2']):.0f}, of" in first


def test_every_verdict_figure_and_source_is_there(first_run, page, text, provenance):
    verdicts = rows_of(first_run[0] / "results/verdicts.csv")
    assert {row["comparison"] for row in verdicts} <= set(page.ids)
    counts = Counter(row["verdict"] for row in verdicts if row["verdict"] != "as before")
    assert all(f"{verdict} {count} " in text for verdict, count in counts.items())
    for figure in configuration.load(ROOT)["figures"]:
        assert figure in page.ids and f"config-{figure}" in provenance.ids
        assert f"tables/curves/{figure}.csv" in page.links
    stated_in = in_words(provenance)
    for source in (ROOT / "data").glob("*/source.yaml"):
        stated = reference_data.load_yaml(source)
        assert " ".join(stated["citation"].split()) in stated_in
        for kind in ("series", "facts"):
            for name, entry in stated.get(kind, {}).items():
                assert f"{source.parent.name}/{name}" in provenance.ids
                assert (entry.get("digitised_by") or "") in stated_in
    assert stated_in.count("nobody yet: there are no points") == 3
    assert f"numpy {np.__version__}" in stated_in


def test_a_row_of_the_verdicts_says_what_was_allowed_and_why(first_run, report):
    results = first_run[0] / "results"
    entries = {row["entry"] for row in rows_of(results / "ledger.csv")}
    maths = ledger_page.linked_maths(entries, "ledger.html")
    comparisons = configuration.with_values(CONFIG)["comparisons"]
    text = report.read_text(encoding="utf-8")
    for row in rows_of(results / "verdicts.csv"):
        shown = text[text.index(f'<tr id="{row["comparison"]}"') :].split("</tr>")[0]
        assert maths(names.comparison(row["comparison"]))[1:] in shown
        allowed = write_report.bounds(row["allowed"])
        assert f'data-label="to agree">{allowed}' in shown.replace("\n", "")
        assert write_report.bounds(row["regression"]) in shown and row["question"] in shown
        reason = comparisons.get(row["comparison"], row)["reason"]
        assert maths(names.sentence(reason)) in shown and formulas.plain(reason) == row["reason"]
        entry = row["note"].removeprefix("ledger: ")
        assert (f'<a href="ledger.html#{entry}">' in shown) == (entry in entries)


def test_every_known_difference_is_listed_with_its_bound(first_run, report):
    text = report.read_text(encoding="utf-8")
    shown = text[text.index('<p id="known">') :].split("</details>")[0]
    rows = rows_of(first_run[0] / "results/verdicts.csv")
    known = [row for row in rows if row["verdict"] in verdict_table.DIFFERENCES]
    assert f"<summary>The {len(known)} known differences: " in text
    listed = shown.split("<tr>")[2:]
    for row, line in zip(known, listed, strict=True):
        assert f'<a href="#{row["comparison"]}">' in line and row["question"] in line
        bound = line.split('data-label="bound">')[1].split("</td>")[0]
        assert row["regression"] and bound == write_report.bounds(row["regression"])


@pytest.mark.parametrize("name", configuration.load(ROOT)["figures"])
def test_a_figure_has_its_own_picture_words_verdicts_and_settings(first_run, report, name):
    text = report.read_text(encoding="utf-8")
    shown = re.split("<h[23]", text[text.index(f'<h3 id="{name}">') + 3 :])[0]
    svg = (report.parent / f"{name}.svg").read_bytes()
    assert base64.b64encode(svg).decode() in shown
    words = figures.stated()[name]["caption"]
    assert formulas.mathematical(words.split(". ")[0]) in shown
    verdicts = rows_of(first_run[0] / "results/verdicts.csv")
    mine = [row for row in verdicts if row["figure"] == name]
    assert re.findall(r'<tr id="([^"]*)"', shown) == [row["comparison"] for row in mine]
    assert "<tr" not in re.sub("<details>.*?</details>", "", shown, flags=re.S)  # all are folded
    told = (report.parent / "sources.html").read_text(encoding="utf-8")
    told = told[told.index(f'<pre id="config-{name}"') :].split("</pre>")[0]
    settings = yaml.safe_load(html.unescape(told.partition(">")[2]))
    config = configuration.with_values(CONFIG)
    comparisons = config["comparisons"].items()
    assert settings == {
        "figures": {name: config["figures"][name]},
        "comparisons": {key: entry for key, entry in comparisons if entry["figure"] == name},
    }


def test_they_fit_a_phone_and_links_unfold_what_they_lead_to(report):
    with browser.page() as tab:
        for page, names in (
            (report, ("fig6-rebound", "fig2-solved")),
            (report.with_name("sources.html"), ("config-fig5", "config-rod")),
        ):
            tab.resize(360, 800, mobile=True)
            tab.open(f"{page.as_uri()}#{names[0]}")
            for name in names:
                tab.evaluate(f"location.hash = '{name}'; new Promise((go) => setTimeout(go, 50))")
                assert tab.evaluate(f"document.getElementById('{name}').closest('details').open")
            contents = "document.querySelector('.contents a').checkVisibility()"
            assert not tab.evaluate(contents)
            tab.evaluate(
                "document.querySelectorAll('details').forEach((part) => { part.open = true; })"
            )
            assert tab.evaluate("document.documentElement.scrollWidth") <= 360
            for width in (700, 1024, 1440):
                tab.resize(width, 900, mobile=False)
                assert tab.evaluate("document.documentElement.scrollWidth") <= width
            assert tab.evaluate(contents)
        assert not tab.problems


def refuse_other_residuals(verdicts, residuals):
    """Check that rows of residuals are what the verdicts were made from."""
    for row in verdicts:
        mine = [r for r in residuals if r["comparison"] == row["comparison"]]
        assert len(mine) == int(row["points"] or 0), row["comparison"]
        if mine:
            sigmas = [abs(float(r["distance [sigma]"])) for r in mine]
            rms = math.sqrt(math.fsum(s * s for s in sigmas) / len(sigmas))
            assert f"{max(sigmas):.3g}" == row["max [sigma]"], row["comparison"]
            assert f"{rms:.3g}" == row["rms [sigma]"], row["comparison"]


def test_residuals_are_those_that_were_judged(first_run):
    results = first_run[0] / "results"
    verdicts = rows_of(results / "verdicts.csv")
    residuals = [row for path in (results / "residuals").glob("*.csv") for row in rows_of(path)]
    refuse_other_residuals(verdicts, residuals)
    largest = max(residuals, key=lambda row: abs(float(row["distance [sigma]"])))
    falsified = [row | {"distance [sigma]": "0.9"} if row is largest else row for row in residuals]
    with pytest.raises(AssertionError, match=largest["comparison"]):
        refuse_other_residuals(verdicts, falsified)
    # Fig. 5: the lumped model lies above the finite elements where these slip in an annulus.
    sides = [r for r in residuals if r["comparison"] == "fig5-lumped-fem-initial-stick"]
    assert all(float(row["distance [sigma]"]) < 0 for row in sides)


def doctored(*lapsed):
    """The report of a run in which a comparison failed and a solver crashed.

    With a `lapsed` entry of the ledger all comparisons agree.
    """
    figures = [*configuration.load(ROOT)["figures"]]

    def row(figure, comparison, verdict, **cells):
        cells = {"figure": figure, "comparison": comparison, "verdict": verdict} | cells
        return dict.fromkeys(verdict_table.COLUMNS, "") | cells

    sizes = {"points": "2", "rms [sigma]": "7", "max [sigma]": "9"}
    verdicts = [
        row("fig6", "fig6-rebound", "wrong", **sizes),
        row("trade", "trade-solved", "wrong", note="no curves: ArithmeticError: <oh>"),
        *(row(name, f"{name}-solved", "as before") for name in figures if name != "trade"),
    ]
    verdicts = [row | {"verdict": "agrees"} for row in verdicts] if lapsed else verdicts
    config = CONFIG | {"slides": ["fig6"]}
    values = {
        "verdicts": verdicts,
        "ledger": [dict.fromkeys(outcome.COLUMNS, "") | entry for entry in lapsed],
        "figures": {
            name: write_report.figure(name, b"<svg/>", "Words.", [], verdicts, config)
            for name in figures
        },
        "captions": dict.fromkeys(write_report.SECTIONS, "Words."),
        "cases": [],
        "n": {},
        "significance": CONFIG["significance"],
        "run": {"date": "Today", "commit": "abc"},
        "faults": ["eq-1 no longer holds"] if lapsed else ["wrong: fig6-rebound: max 9"],
    }
    return write_report.page(values, ROOT / "workflow/report/report.html")


def test_a_failed_run_looks_like_one():
    page = doctored()
    text = in_words(Page(page))
    first = "FAILED 2 comparisons fail. Today, commit abc Fig. 6, rebound is wrong: max 9"
    assert text.index(first) < text.index("Which figures agree, with what")
    assert '<li><a href="#fig6-rebound">' in page
    # What was found is told of a run that passed.
    assert "PASSED" not in text and "What we found" not in text
    # What fails is unfolded.
    table = page[page.index("<details open><summary>2 comparisons:") :].split("</table>")[0]
    first = table.split("<tr")[2]
    assert 'id="fig6-rebound" class="wrong"' in first and 'class="mark fails">wrong<' in first
    assert "rms 7, max 9 sigma" in first
    assert "No curves: ArithmeticError: &lt;oh&gt;" in page


def test_a_run_with_a_lapsed_entry_looks_like_one():
    page = doctored({"entry": "eq-1", "kind": "equation", "verdict": "wrong", "holds": "no"})
    assert "<title>Failed:" in page and "PASSED" not in page and "comparisons fail" not in page
    words = in_words(Page(page))
    assert "1 of 1 verdicts on the paper no longer hold: Eq. 1 ." in words
    assert 'href="ledger.html#eq-1"' in page


def test_strips_show_points_by_their_verdicts():
    others = {"question": "beside others", "found": "", "curve": "lumped", "reference": "a/b"}
    verdicts = {
        "low": others | {"verdict": "diverges"},
        "high": others | {"verdict": "agrees"},
        "corner": others | {"verdict": "wrong", "question": "solved right", "curve": ""},
        "peak": others | {"verdict": "agrees", "found": "30", "reference": "a/d"},
        "right": others | {"verdict": "right", "question": "solved right", "reference": "a/e"},
        "printed": others | {"verdict": "explained difference", "question": "as printed"},
    }
    points = {"low": [-1, -3], "high": [2, 0], "corner": [7], "peak": [1], "right": [1]}
    residuals = [
        {"comparison": name, "quantity": "x [1]", "at": f"{at}", "distance [sigma]": f"{far}"}
        for name, distances in (points | {"printed": [9]}).items()
        for at, far in enumerate(distances)
    ]
    first, second = draw_residuals.draw(draw_residuals.strips(residuals, verdicts)).axes
    drawn = {line.get_marker(): line for line in first.lines if line.get_linestyle() == "None"}
    assert {mark: line.get_ydata().tolist() for mark, line in drawn.items()} == {
        "x": [-1, -3], "o": [2, 0],
    }  # fmt: skip
    assert second.lines[0].get_ydata().tolist() == [7]


def test_the_interface_has_a_page_a_module_and_names_types_as_the_sources_do(interface):
    page = (interface / "planarimpact/lumped.html").read_text(encoding="utf-8")
    words = html.unescape(re.sub("<[^>]+>", "", page))
    assert "incidence: ArrayLike" in words and ") -> Rebound:" in words
    for room in planarimpact.__all__:
        if inspect.ismodule(getattr(planarimpact, room)):
            assert (interface / f"planarimpact/{room}.html").is_file(), room


def test_each_example_of_the_interface_runs_as_the_first_page_says(interface):
    runner, examples = doctest.DocTestRunner(), 0
    for path in sorted((interface / "planarimpact").rglob("*.html")):
        module = ".".join(path.relative_to(interface).with_suffix("").parts)
        page = path.read_text(encoding="utf-8")
        for shown in re.findall("<pre>(.*?)</pre>", page, flags=re.S):
            text = html.unescape(re.sub("<[^>]+>", "", shown))
            if text.startswith(">>> "):
                text = f">>> import numpy as np\n>>> from {module} import *\n{text}"
                test = doctest.DocTestParser().get_doctest(text, {}, path.stem, str(path), 0)
                runner.run(test)
                examples += 1
    assert runner.failures == 0 and examples > 100
