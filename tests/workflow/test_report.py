"""The report and the sources: whole, by the tables of the run; a bad run looks bad."""

import html
import re
from collections import Counter

import numpy as np
import pandas as pd
import pytest
import yaml

from stronge1994 import answers, figure_table, ledger_table, tables, verdict_table, versions
from stronge1994.figures.shared.drawing import residuals as draw_residuals
from stronge1994.formulas import mathematical, number
from stronge1994.pages import report as write_report
from stronge1994.pages import templates, which_model
from stronge1994.verdict_table import Group
from stronge1994.words import of_identifier, with_units
from stronge1994.words import source as name_of_source
from tests.unit.test_figure_table import SIZES
from tests.workflow.page import Page, flat
from tests.workflow.project import config

CONFIG = config()


def rms(values):
    return np.sqrt(np.mean(np.square(values)))


@pytest.fixture(scope="module")
def pages(first_run):
    """Function: the text of a page."""
    return lambda name: (first_run[0] / f"figures/{name}.html").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def rows_of(first_run):
    """Function: the rows of a table of the run."""
    return lambda name: tables.read_rows(first_run[0] / f"results/{name}.csv")


def test_each_is_one_file_that_needs_nothing_else(pages):
    for name, pictures in (("report", 14), ("sources", 0)):
        text = pages(name)
        page = Page(text)
        assert len(page.resources) >= pictures and len(text.encode()) < 2_000_000
        assert all(r.startswith("data:image/svg+xml,") for r in page.resources)
        outside = [link for link in page.links if ":" in link]
        assert bool(outside) == (name == "sources")
        assert all(link.startswith("https://doi.org/10.") for link in outside)
        assert len(set(page.ids)) == len(page.ids)
        styles = "".join(re.findall(r"<style>.*?</style>", text, flags=re.S))
        assert "url(" not in styles and "@import" not in styles


def test_the_first_words_say_what_was_found_and_how_it_went(pages, rows_of):
    """Pictures of all figures of the paper follow, and each error that changes a result."""
    head = pages("report").split('<h2 id="model">')[0]
    first = Page(head).text
    assert first.index("PASSED") < first.index("Does the solver")
    assert "FAILED" not in pages("report")
    sheet = head.partition('<ul class="sheet">')[2].split("</ul>")[0]
    assert re.findall('href="#(fig.)"', sheet) == [f"fig{number}" for number in range(2, 10)]
    assert re.findall('<use href="#picture-(fig.)"', sheet) == re.findall('href="#(fig.)"', sheet)
    grave = [row["entry"] for row in rows_of("ledger") if row["grade"] == "changes a result"]
    told = head.partition('<h2 id="grave">')[2].split("</table>")[0]
    assert grave and re.findall(r'<td><a href="ledger.html#([^"]+)"', told) == grave


def test_its_answers_are_those_of_the_run(pages, rows_of):
    told = Page(pages("report").split('<ul class="sheet">')[0]).text
    for answer in answers.of_run(rows_of("verdicts"), rows_of("ledger")):
        changed = [
            part for row in answer.table for part in (row.quantity, row.printed, row.by_model)
        ]
        for said in (answer.question, *answer.told, *changed):
            assert flat(mathematical(with_units(said))) in flat(told), said


def test_what_is_said_of_five_models_below_e_1_is_so(rows_of):
    """In src/README.md, in the reasons of comparisons, and in the report."""
    rows = {row["comparison"]: row for row in rows_of("verdicts")}
    assert rows["inelastic-lumped.hysteretic-pairs"]["verdict"] == "differs"
    assert rows["inelastic-continuum.viscous-pairs"]["verdict"] == "cannot tell"
    rms_of = {
        name: float(row["rms"])
        for name, row in rows.items()
        if re.fullmatch("rubber_sphere-.*-impacts", name)
    }
    nearest = min(rms_of, key=rms_of.get)
    assert len(rms_of) == 5 and nearest == "rubber_sphere-lumped.hysteretic-impacts"


def test_the_contact_sheet_names_the_largest_difference_of_a_figure(pages):
    sheet = pages("report").partition('<ul class="sheet">')[2].split("</ul>")[0]
    told = {
        name: Page(f'<a "{rest}').text
        for name, rest in re.findall(r'<a href="#(fig\d)"(.*?)</li>', sheet, flags=re.S)
    }
    assert "differs cannot tell cannot be judged not compared agrees" in told["fig5"]
    assert "largest difference: slip throughout from 7" in told["fig5"]
    assert "differs not compared largest difference: Eq. 25" in told["fig6"]
    assert told["fig2"].endswith("not compared")


def test_the_largest_difference_is_that_of_any_comparison_of_an_item():
    """Also of one that does not stand first; a worse verdict counts more."""
    sizes = {"a": "0.1", "b": "0.9", "c": "0.5", "d": "2", "e": ""}
    verdicts = [{"comparison": name, "max": size} for name, size in sizes.items()]
    items = [
        figure_table.Item(list(names), verdict, "", names, "", "", "", "")
        for names, verdict in (("ab", "differs"), ("c", "differs"), ("d", "agrees"))
    ]
    awaited = figure_table.Item(["e"], "not compared", "", "e", "", "", "", "")
    for paper, others, wanted in ((items, [], "ab"), ([awaited], items[1:], "c")):
        row = figure_table.FigureRow("fig6", "", 0, [], paper, others)
        assert write_report.largest(row, verdicts).name == wanted


def test_sigmas_in_the_reasons_of_comparisons_are_those_of_the_run(first_run):
    """How many sigmas a point is off, as the figure of Kharaz' points says it."""
    residuals = pd.read_csv(first_run[0] / "results/residuals/fig5.csv")
    said = [
        (name, *map(float, found))
        for name, entry in CONFIG["comparisons"].items()
        for found in re.findall(r"at ([\d.]+)° (?:is )?([\d.]+) sigmas", entry["reason"])
    ]
    assert len(said) >= 6
    for name, angle, sigmas in said:
        own = residuals[residuals["comparison"] == name]
        nearest = own.iloc[np.abs(own["at"] - angle).argmin()]
        assert abs(nearest["distance [sigma]"]) == pytest.approx(sigmas, abs=0.5), (name, nearest)


SAID = {"origin of sigma": "sigma_origin", "where": "where", "tolerance": "tolerance_origin"}


def test_every_verdict_figure_and_source_is_there(pages, rows_of, inventory):
    page, text = Page(pages("report")), pages("sources")
    provenance = Page(text)
    stated_in = provenance.text
    others = [row for row in rows_of("verdicts") if row["group"] != Group.SOLVER]
    counts = Counter(row["verdict"] for row in others)
    assert all(f"{verdict} {count} " in page.text for verdict, count in counts.items())
    assert {f"tables/curves/{figure}.csv" for figure in CONFIG["figures"]} <= set(page.links)
    for source, stated in inventory.items():
        assert " ".join(stated["citation"].split()) in stated_in
        for kind in ("series", "facts"):
            for name, entry in stated.get(kind, {}).items():
                assert f"{source}/{name}" in provenance.ids
                assert (entry.get("digitised_by") or "") in stated_in
                row = text[text.index(f'id="{source}/{name}"') :].split("</tr>")[0]
                cells = re.findall(r'data-label="(.*?)">(.*?)</td>', row, flags=re.S)
                cells = {label: flat(cell) for label, cell in cells}
                kinds = {"facts": None, "series": entry["kind"] if entry.get("path") else "awaited"}
                assert cells.get("kind") == kinds[kind]
                for label, key in SAID.items():
                    assert flat(mathematical(entry.get(key, ""))) in cells.get(label, "")
                tolerance = entry.get("tolerance") and flat(number(entry["tolerance"]))
                assert cells.get("tolerance", "").startswith(tolerance or "")
                alone = re.findall("only for <code>(.*?)</code>", row, flags=re.S)
                settings = [entry["settings"]] if entry.get("settings") else []
                assert [yaml.safe_load(html.unescape(one)) for one in alone] == settings
    told = "angle: 0.22°; centre restitution: 0.0016", "0.0127 m 3×10 −5 stated", "nobody yet: th"
    assert all(words in stated_in for words in told)


def test_each_source_stands_with_its_own_name(first_run, pages, inventory):
    text = pages("sources")
    sections = re.split("<tbody>", text)[1:]
    pattern = r'<tr id="source-(\w+)"><td><b>(.*?)</b>'
    shown = [re.search(pattern, section) for section in sections]
    assert sorted(heading[1] for heading in shown) == sorted(inventory)
    for section, heading in zip(sections, shown, strict=True):
        name, stated = heading[1], inventory[heading[1]]
        assert heading[2] == name_of_source(name).replace("&", "&amp;")
        assert f"<code>data/{name}</code>" in section
        assert flat(html.escape(stated["citation"])) in flat(section)
        doi = [f"https://doi.org/{stated['doi']}"] if stated.get("doi") else []
        assert re.findall(r'href="(https:.*?)"', section) == doi
        table = section.partition('<th scope="col">parameter</th>')[2].partition("</table>")[0]
        told = [flat(row) for row in re.findall(r"<tr><td>(.*?)</tr>", table, flags=re.S)]
        parameters = stated.get("parameters") or {}
        for row, (key, entry) in zip(told, parameters.items(), strict=True):
            origin = flat(mathematical(entry["origin"]))
            assert row.startswith(flat(mathematical(of_identifier(key)))), row
            assert row.endswith(origin) and flat(mathematical(f"{entry['value']:g}")) in row


def test_one_file_says_when_and_with_what_the_pages_were_written(first_run):
    lines = (first_run[0] / "figures/run.txt").read_text(encoding="utf-8").splitlines()
    told = dict(line.split(": ", 1) for line in lines)
    assert list(told) == ["date", "commit", "computer", *versions.installed()]
    assert told["numpy"] == np.__version__ and told["pandas"] == pd.__version__


@pytest.mark.parametrize("name", CONFIG["figures"])
def test_a_figure_has_its_own_picture_verdicts_and_settings(first_run, pages, rows_of, name):
    text = pages("report")
    shown = re.split("<h[23]", text[text.index(f'<h3 id="{name}">') + 3 :])[0]
    assert templates.embedded((first_run[0] / f"figures/{name}.svg").read_bytes()) in shown
    assert all(kind == w for kind, w in re.findall(r'_(light|dark)\.png">(\w+)<', shown))
    mine = [row["comparison"] for row in rows_of("verdicts") if row["figure"] == name]
    assert sorted(re.findall(r'<tr id="([^"]*)"', shown)) == sorted(mine)
    told = pages("sources")
    told = told[told.index(f'<pre id="config-{name}"') :].split("</pre>")[0]
    comparisons = CONFIG["comparisons"].items()
    assert yaml.safe_load(html.unescape(told.partition(">")[2])) == {
        "figures": {name: CONFIG["figures"][name]},
        "comparisons": {key: entry for key, entry in comparisons if entry["figure"] == name},
    }


def test_residuals_are_those_that_were_judged(first_run):
    folder = first_run[0] / "results"
    residuals = pd.concat(map(pd.read_csv, (folder / "residuals").glob("*.csv")))
    far = residuals.groupby("comparison")["distance [sigma]"]
    judged = pd.read_csv(folder / "verdicts.csv").query("points > 0").set_index("comparison")
    assert far.size().to_dict() == judged["points"].to_dict()
    for kind, found in (("max", far.agg(lambda v: v.abs().max())), ("rms", far.agg(rms))):
        stated = judged[f"{kind} [sigma]"].loc[found.index]
        np.testing.assert_allclose(stated, found, rtol=6e-3, err_msg=kind)


# Runs that fail


# Rows of verdicts, all of whose cells differ, and what the report tells of them.
FOUND = {"chi^2": "7", "degrees of freedom": "6", "degrees of sigma": "5", "p": "0.6"}
KNOWN = {
    "why": "cause known",
    "entry": "eq-25",
    "says": "Eq. 25,",
}
SAME = {"curve": "lumped", "allowed": "max <= 1 N", "reason": "it is so"}
SAME |= {"reference": "maw1976/rebound", "rms [sigma]": "9"}
CELLS = {
    ("far", "FAILS", "others"): FOUND,
    ("near", "agrees", "others"): {"points": "12", "rms": "0.04"},
    ("known", "differs", "paper"): KNOWN,
    ("stated", "agrees", "paper"): {
        "found": "5", "stated": "7 deg", "unit": "deg", "says": "peak at",
    },
    ("code", "passed", "solver checked"): {"max": "0.5"},
    ("later", "not compared", "others"): {
        "points": "", "reference": "cross2014/a", "why": "points awaited",
    },
    ("print", "differs", "printed figure"): {
        "why": "cause known", "entry": "eq-25",
    },
    ("other-print", "not compared", "printed figure"): {"points": "", "why": "points awaited"},
    ("solved", "FAILS", "solver checked"): {"figure": "trade", "note": "<oh>"},
}  # fmt: skip
VERDICTS = [
    dict.fromkeys(verdict_table.COLUMNS, "")
    | {"figure": "fig6", "comparison": f"fig6-{name}", "group": group, "verdict": verdict}
    | {**SIZES, **SAME, **cells}
    for (name, verdict, group), cells in CELLS.items()
]
TOLD = """
FAILS Far Maw 1976: rebound rms 0.02, max 0.03 μv2(0) (rms 9 sigma); 4 points
F test, sigma as good as from 5 values: p = 0.6 max ≤ 1 N It is so.
not compared points awaited Later Cross 2014: a max ≤ 1 N It is so.
differs cause known Known Maw 1976: rebound rms 0.02, max 0.03 μv2(0); 4 points
max ≤ 1 N Ledger: Eq. 25. It is so.
differs cause known Print Maw 1976: rebound rms 0.02, max 0.03 μv2(0); 4 points max ≤ 1 N
Ledger: Eq. 25. It is so."""
REST = """
agrees Near Maw 1976: rebound rms 0.04, max 0.03 μv2(0); 12 points max ≤ 1 N It is so.
agrees Stated Maw 1976: rebound 5, stated 7° max ≤ 1 N It is so.
passed Code Maw 1976: rebound rms 0.02, max 0.5 μv2(0); 4 points max ≤ 1 N It is so.
not compared points awaited Other print Maw 1976: rebound max ≤ 1 N It is so."""
ROWS = """
Fig. 6 rebound differs 1 of 2, rms 0.02 μv2(0); cause known
lay your copy under it differs Eq. 25, 0.03 μv2(0); changes a result
agrees peak at 7°, model 5
FAILS Maw 1976: rebound, 4 of 16 points, rms 0.02 μv2(0)
agrees Maw 1976: rebound, 12 of 16 points, rms 0.04 μv2(0) not compared Cross 2014; points awaited
| e = 0.8, plastic loss error up to 0.3, down to 0.1 m, 0.05, 3 µs
| by 0.5 µv2(0) (e = 0.8, plastic; 0.6 if
| the wrong loss is an error of up to 0.4 µ"""
ANSWER = {"e": 0.8, "loss": "plastic", "batch": 10, "model": "m"}
ANSWER |= {"max_velocity_with_kinks [mu v2(0)]": "0.05", "whole_time [s]": "3e-6"}
TRADE = {"max_velocity_with_kinks [mu v2(0)]": [0.4], "input_spread [mu v2(0)]": [0.5]}
TRADE |= {"input_spread_stick [mu v2(0)]": [0.6]}


NO_RESIDUALS = pd.DataFrame(columns=["comparison", "quantity", "at", "distance [sigma]"])


def test_a_failed_run_looks_like_one_and_tells_all_that_was_found():
    """Comparisons failed, and an entry of the ledger holds no longer."""
    none = dict.fromkeys(ledger_table.COLUMNS, "") | {"verdict": "wrong"}
    answers = pd.DataFrame(ANSWER | {"tolerance [mu v2(0)]": allowed} for allowed in (0.3, 0.1))
    trade = tables.curve(TRADE, "continuum.viscous", e=0.8, loss="plastic")
    values = {
        "verdicts": VERDICTS,
        "ledger": [none | {"entry": "eq-25", "holds": "no"}, none | {"entry": "a", "holds": "yes"}],
        "figures": {
            name: write_report.figure(
                name, b'<svg viewBox="0 0 3 2"/>', "Words.", NO_RESIDUALS, VERDICTS, False, {}
            )
            for name in CONFIG["figures"]
        },
        "captions": dict.fromkeys(write_report.SECTIONS, "Words."),
        "cases": which_model.cases(answers, trade),
        "significance": CONFIG["significance"],
        "doubt": 0.01,
        "commit": "abc",
        "table": figure_table.of_run(VERDICTS, {"fig6": "rebound"}, {"eq-25": "changes a result"}),
        "faults": ["FAILS: fig6-far: max 9", "changed: eq-25: size 3 -> 4"],
    }
    page = write_report.page(values)
    text = Page(page).text
    assert "1 of 2 verdicts on the paper no longer hold: Eq. 25 . Commit abc; date, " in text
    assert "FAILED Reasons: 2, named" in text and "FAILS: Fig. 6, far : max 9" in text
    assert "changed: eq-25: size 3 -> 4" in text
    assert "PASSED" not in text and "What changes a result" not in text
    first, rest = page[page.index('<h3 id="fig6">') :].split("</table>")[:2]
    assert '<tr id="fig6-far" class="FAILS"' in first and flat(first).endswith(flat(TOLD))
    told = "4 more comparisons: agrees 2, not compared 1; solver checked: passed 1"
    assert told in Page(rest).text
    assert flat(rest).endswith(flat(REST))
    assert all(flat(row) in flat(page) for row in ROWS.split("|"))
    assert "&lt;oh&gt;" in page


def test_strips_show_points_by_their_verdicts():
    others = {"group": "others", "found": "", "curve": "lumped", "reference": "a/b", "why": ""}
    verdicts = [
        others | {"comparison": "low", "verdict": "FAILS"},
        others | {"comparison": "high", "verdict": "agrees"},
        others | {"comparison": "corner", "verdict": "FAILS", "curve": "", "reference": "a/c"},
    ]
    points = {"low": [-1, -3], "high": [2, 0], "corner": [7]}
    residuals = pd.DataFrame(
        {"comparison": name, "quantity": "x [1]", "at": at, "distance [sigma]": far}
        for name, distances in points.items()
        for at, far in enumerate(distances)
    )
    first, second = draw_residuals.draw(draw_residuals.strips(residuals, verdicts)).axes
    drawn = {line.get_marker(): line for line in first.lines if line.get_linestyle() == "None"}
    assert {mark: line.get_ydata().tolist() for mark, line in drawn.items()} == {
        "x": [-1, -3], "o": [2, 0],
    }  # fmt: skip
    assert second.lines[0].get_ydata().tolist() == [7]
