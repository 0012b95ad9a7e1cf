"""The report and the sources: whole, by the tables of the run; a bad run looks bad."""

import html
import re
from collections import Counter

import numpy as np
import pandas as pd
import pytest
import yaml

from stronge1994 import answers, figure_table, tables, verdict_table, versions
from stronge1994.figures.shared.drawing import residuals as draw_residuals
from stronge1994.formulas import mathematical, number
from stronge1994.pages import report as write_report
from stronge1994.pages import templates
from stronge1994.verdict_table import Group
from stronge1994.words import entry as entry_name
from stronge1994.words import of_identifier, with_units
from stronge1994.words import source as name_of_source
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


def test_the_report_counts_all_verdicts_and_links_the_curves(pages, rows_of):
    page = Page(pages("report"))
    others = [row for row in rows_of("verdicts") if row["group"] != Group.SOLVER]
    counts = Counter(row["verdict"] for row in others)
    assert all(f"{verdict} {count} " in page.text for verdict, count in counts.items())
    assert {f"tables/curves/{figure}.csv" for figure in CONFIG["figures"]} <= set(page.links)


# What the page says of a series or of a fact, in words of its file.
SAID = "statement", "where", "figure", "sigma_origin", "tolerance_origin", "measured_by"
SAID += "digitised_by", "method"


def test_each_source_says_all_that_its_file_states(pages, inventory):
    sections = re.split("<tbody>", pages("sources"))[1:]
    shown = {re.search(r'<tr id="source-(\w+)">', one)[1]: one for one in sections}
    assert sorted(shown) == sorted(inventory)
    for source, section in shown.items():
        stated = inventory[source]
        words = f"<b>{html.escape(name_of_source(source))}</b><br><code>data/{source}</code>"
        assert words in section and flat(html.escape(stated["citation"])) in flat(section)
        doi = [f"https://doi.org/{stated['doi']}"] if stated.get("doi") else []
        assert re.findall(r'href="(https:.*?)"', section) == doi
        for key, entry in (stated.get("series", {}) | stated.get("facts", {})).items():
            row = section[section.index(f'<tr id="{source}/{key}"') :].split("</tr>")[0]
            said = [mathematical(entry.get(one) or "") for one in SAID]
            said += [number(entry["tolerance"])] if entry.get("tolerance") else []
            if "kind" in entry:
                said.append(entry["kind"] if entry.get("path") else "awaited")
            assert [one for one in said if flat(one) not in flat(row)] == [], key
            alone = re.findall("only for <code>(.*?)</code>", row, flags=re.S)
            settings = [entry["settings"]] if entry.get("settings") else []
            assert [yaml.safe_load(html.unescape(one)) for one in alone] == settings
        table = section.partition('<th scope="col">parameter</th>')[2].partition("</table>")[0]
        rows = [flat(row) for row in re.findall(r"<tr><td>(.*?)</tr>", table, flags=re.S)]
        for row, (key, entry) in zip(rows, (stated.get("parameters") or {}).items(), strict=True):
            assert row.startswith(flat(mathematical(of_identifier(key)))), row
            assert row.endswith(flat(mathematical(entry["origin"])))
            assert flat(mathematical(f"{entry['value']:g}")) in row
    told = "angle: 0.22°; centre restitution: 0.0016", "0.0127 m 3×10 −5 stated", "nobody yet: th"
    assert all(words in Page(pages("sources")).text for words in told)


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
    seen = re.split(" comparisons?: ", shown)[0]  # others are folded
    assert ">passed</span>" not in seen
    told = pages("sources")
    told = told[told.index(f'<pre id="config-{name}"') :].split("</pre>")[0]
    comparisons = CONFIG["comparisons"].items()
    assert yaml.safe_load(html.unescape(told.partition(">")[2])) == {
        "figures": {name: CONFIG["figures"][name]},
        "comparisons": {key: entry for key, entry in comparisons if entry["figure"] == name},
    }


def test_each_verdict_has_the_numbers_and_the_reason_of_its_row(pages, rows_of):
    text = pages("report")
    for row in rows_of("verdicts"):
        shown = text[text.index(f'<tr id="{row["comparison"]}"') :].split("</tr>")[0]
        source, _, series = row["reference"].partition("/")
        said = [row["verdict"], row["why"], name_of_source(source), of_identifier(series)]
        said += [entry_name(row["entry"]) if row["entry"] else "", row["allowed"]]
        said += [verdict_table.measured(row), verdict_table.chance(row) if row["p"] else ""]
        said.append(verdict_table.noticed(row))
        reason = CONFIG["comparisons"].get(row["comparison"], row)["reason"]
        told = [*map(write_report.numbers, said), mathematical(reason[1:])]
        shown = flat(shown)
        assert [one for one in told if flat(one) not in shown] == [], row["comparison"]


def test_entries_that_no_longer_hold_and_what_nobody_has_accepted_are_named(rows_of):
    nothing = {"table": [], "figures": {}, "cases": [], "commit": "", "significance": 0, "doubt": 0}
    values = nothing | {"captions": dict.fromkeys(write_report.SECTIONS, ""), "new": []}
    values |= {"verdicts": rows_of("verdicts"), "ledger": rows_of("ledger"), "faults": []}
    new = Page(write_report.page(values | {"new": ["fig6-a", "fig6-b"]})).text
    assert "PASSED Nobody has accepted fig6-a, fig6-b yet: new. Every other result is " in new
    ledger = [
        row | {"holds": "no" if row["entry"] == "eq-25" else "yes"} for row in rows_of("ledger")
    ]
    bad = write_report.page(values | {"ledger": ledger, "faults": ["no longer holds: eq-25: <oh>"]})
    assert f"1 of {len(ledger)} verdicts on the paper no longer hold: Eq. 25 ." in Page(bad).text
    assert "<li>no longer holds: eq-25: &lt;oh&gt;</li>" in bad


def test_residuals_are_those_that_were_judged(first_run):
    folder = first_run[0] / "results"
    residuals = pd.concat(map(pd.read_csv, (folder / "residuals").glob("*.csv")))
    far = residuals.groupby("comparison")["distance [sigma]"]
    judged = pd.read_csv(folder / "verdicts.csv").query("points > 0").set_index("comparison")
    assert far.size().to_dict() == judged["points"].to_dict()
    for kind, found in (("max", far.agg(lambda v: v.abs().max())), ("rms", far.agg(rms))):
        stated = judged[f"{kind} [sigma]"].loc[found.index]
        np.testing.assert_allclose(stated, found, rtol=6e-3, err_msg=kind)


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
