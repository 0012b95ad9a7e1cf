"""The report, the sources and the note: whole, by the tables of the run; a bad run looks bad."""

import base64
import html
import re
from collections import Counter

import numpy as np
import pandas as pd
import pytest
import yaml
from scipy.special import chdtrc

from stronge1994 import figure_table, reference_data, tables, verdict_table, versions
from stronge1994.figures.shared.drawing import residuals as draw_residuals
from stronge1994.formulas import mathematical, number
from stronge1994.ledger import finding, outcome
from stronge1994.names import MODELS
from stronge1994.pages import note, which_model
from stronge1994.pages import report as write_report
from stronge1994.studies.inelastic import trials as inelastic
from stronge1994.verdict_table import Group, Verdict, Why
from stronge1994.words import of_identifier
from stronge1994.words import source as name_of_source
from tests.unit.test_figure_table import SIZES
from tests.workflow.page import Page, flat
from tests.workflow.project import config

CONFIG = config()


def points_of(inventory, source, series):
    return reference_data.Series(**inventory[source]["series"][series]).points()


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


@pytest.fixture(scope="module")
def numbers(rows_of):
    return {row["name"]: float(row["value"]) for row in rows_of("key_numbers")}


def test_each_is_one_file_that_needs_nothing_else(pages):
    for name, pictures in (("report", 14), ("sources", 0), ("note", 3)):
        text = pages(name)
        page = Page(text)
        assert len(page.resources) >= pictures
        assert all(r.startswith("data:image/svg+xml;base64,") for r in page.resources)
        outside = [link for link in page.links if ":" in link]
        assert bool(outside) == (name == "sources")
        assert all(link.startswith("https://doi.org/10.") for link in outside)
        assert len(set(page.ids)) == len(page.ids)
        styles = "".join(re.findall(r"<style>.*?</style>", text, flags=re.S))
        assert "url(" not in styles and "@import" not in styles


def test_the_first_words_say_how_it_went_and_what_was_found(pages, rows_of):
    """Each error that changes a result is named, and no other."""
    head = pages("report").split('<h2 id="verdicts">')[0]
    first = Page(head).text
    assert first.index("PASSED") < first.rindex("What we found")
    assert "FAILED" not in pages("report")
    grave = [row["entry"] for row in rows_of("ledger") if row["grade"] == "changes a result"]
    told = head.partition("Errors of the paper that change a result:")[2].split("</p>")[0]
    assert grave and re.findall(r'"ledger.html#([^"]+)"', told) == grave


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
    assert all(words in stated_in for words in (*told, f"numpy {np.__version__}"))


def test_each_source_and_version_stands_with_its_own_name(first_run, pages, inventory):
    text = pages("sources")
    sections = re.split("<section>", text)[1:]
    shown = [re.search(r'<h3 id="source-(\w+)">(.*?)</h3>', section) for section in sections]
    assert sorted(heading[1] for heading in shown) == sorted(inventory)
    for section, heading in zip(sections, shown, strict=True):
        name, stated = heading[1], inventory[heading[1]]
        assert heading[2] == name_of_source(name).replace("&", "&amp;")
        assert f"<code>data/{name}</code>" in section
        assert flat(html.escape(stated["citation"])) in flat(section)
        doi = [f"https://doi.org/{stated['doi']}"] if stated.get("doi") else []
        assert re.findall(r'href="(https:.*?)"', section) == doi
        table = section.partition("<summary>Parameters of ")[2].partition("</details>")[0]
        told = [flat(row) for row in re.findall(r"<tr><td>(.*?)</tr>", table, flags=re.S)]
        parameters = stated.get("parameters") or {}
        for row, (key, entry) in zip(told, parameters.items(), strict=True):
            origin = flat(mathematical(entry["origin"]))
            assert row.startswith(flat(mathematical(of_identifier(key)))), row
            assert row.endswith(origin) and flat(mathematical(f"{entry['value']:g}")) in row
    said = text[text.index("<dt>Versions</dt>") :].split("</dd>")[0]
    made_with = versions.installed()
    assert flat(said) == "Versions" + ",".join(f"{k}{v}" for k, v in made_with.items())
    assert made_with["numpy"] == np.__version__ and made_with["pandas"] == pd.__version__


@pytest.mark.parametrize("name", CONFIG["figures"])
def test_a_figure_has_its_own_picture_verdicts_and_settings(first_run, pages, rows_of, name):
    text = pages("report")
    shown = re.split("<h[23]", text[text.index(f'<h3 id="{name}">') + 3 :])[0]
    svg = (first_run[0] / f"figures/{name}.svg").read_bytes()
    assert base64.b64encode(svg).decode() in shown
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


# The note


# Words behind numbers of the note, and what the names of these numbers have in them.
BEHIND = {
    r" \(viscous\)": "viscous",
    r" \(yields\)": "plastic",
    " against «": "unloading",
    " instead of «": "plastic, 0.6, 7.*unloading",
    r"(?: µ v 2 \(0\))? from the viscous": r"\(viscous.*paper",
    " from the plastic": r"\(plastic.*paper",
    " entries [^a]": "ledger.entries",
    " are confirmed": "ledger.confirmed$",
    " comparisons with the paper": "rows.others$",
    " of them agree": "rows.agrees",
    " differ and we know": "rows.cause known",
    " differ for": "rows.cause unknown",
    " differ from points": "rows.scatter",
    " times by our own": "rows.solver$",
    " checks passed": "rows.solver.passed",
    " wrong ?,": "ledger.wrong",
}


def test_numbers_of_the_note_are_those_that_the_words_behind_them_mean(numbers):
    shown = dict.fromkeys(("fig5", "inelastic", "rubber_sphere"), b"<svg/>")
    spelt = {
        name: 4.0 for name in numbers if name.endswith(("failed", "spreads", "published.agrees"))
    }
    names, marks = list(numbers), {name: 3000.0 + i for i, name in enumerate(numbers)}
    page = note.page(marks | spelt, [], shown)
    marked = re.sub(r"\b3(\d{3})(\.0+)?\b", lambda m: f"«{names[int(m[1])]}»", Page(page).text)
    row_of_table = "pairs.*.chi2» «pairs.*.least» to «pairs.*.most» 4 «pairs.*.without polyurethane"
    row_of_table += ".chi2» «rubber.*.distance» «rubber.*.distance.small»"
    assert all(row_of_table.replace("*", model) in marked for model in MODELS)
    for words, named in BEHIND.items():
        found = re.findall(f"«([^«]*)»{words}", marked)
        assert found and all(re.search(named, name) for name in found), (words, found)


def test_key_numbers_are_those_of_the_tables(numbers, rows_of, first_run, inventory):
    """Computed once more, from the curves and the verdicts."""

    def curves(figure):
        return tables.read(first_run[0] / f"results/curves/{figure}.csv")

    judged = [row for row in rows_of("verdicts") if row["group"] != Group.PRINTED]
    of_solver = Counter(row["group"] == Group.SOLVER for row in judged)
    assert (numbers["rows.solver"], numbers["rows.others"]) == (of_solver[True], of_solver[False])
    for column, words in (("verdict", Verdict), ("why", Why)):
        rows = Counter((row["group"] == Group.SOLVER, row[column]) for row in judged)
        for word in words:
            assert numbers[f"rows.{word}"] == rows[False, word]
            assert numbers[f"rows.solver.{word}"] == rows[True, word]
    ledger = rows_of("ledger")
    counts = Counter(row[key] for row in ledger for key in ("verdict", "grade") if row[key])
    assert {name: numbers[f"ledger.{name}"] for name in counts} == counts
    assert numbers["ledger.causes"] == len({row["cause"] for row in ledger} - {""})
    rows = {row["comparison"]: row for row in rows_of("verdicts")}
    halved = "the stated sigmas are two sigmas."
    for model in MODELS:
        row = rows[f"inelastic-{model}-pairs"]
        assert f"{numbers[f'pairs.{model}.chi2']:.3g}" == row["chi^2"]
        for trial, pairs, sigma in (("", 11, 1), ("without both.", 9, 0), (halved, 11, 0.5)):
            chi2, p = (numbers[f"pairs.{model}.{trial}{key}"] for key in ("chi2", "p"))
            assert p == pytest.approx(chdtrc(pairs, chi2))
            assert not sigma or chi2 == pytest.approx(numbers[f"pairs.{model}.chi2"] / sigma**2)
    paper, soft = "pairs.lumped.hysteretic", "polyurethane.chi2"
    left = numbers[f"{paper}.chi2"] - numbers[f"{paper}.{soft}"]
    assert numbers[f"{paper}.without {soft}"] == pytest.approx(left)
    w, x = "velocity [mu v2(0)]", "incidence [mu v2(0)]"
    fig5 = curves("fig5")
    lumped, continuum = (tables.select(fig5, model=model) for model in ("lumped", "continuum"))
    gap = np.abs(lumped[w] - continuum[w])
    assert numbers["elastic.largest"] == pytest.approx(gap.max(), rel=1e-9)
    assert numbers["elastic.at"] == pytest.approx(lumped[x][gap.argmax()])
    rubber = curves("rubber_sphere")
    for model in MODELS:
        own = tables.select(rubber, model=model, variant="impacts")
        share = "tangential_restitution [1]"
        for kind, e_t in (
            ("distance", points_of(inventory, "cross2014", "impacts")[share]),
            ("from_velocity", tables.select(rubber, variant="velocity alone")[share]),
            ("from_spin", tables.select(rubber, variant="spin alone")[share]),
        ):
            assert numbers[f"rubber.{model}.{kind}"] == pytest.approx(rms(own[share] - e_t))
            small = (own[share] - e_t)[own[x] <= 2.5]
            assert numbers[f"rubber.{model}.{kind}.small"] == pytest.approx(rms(small))
    for row in rows_of("in_nature"):
        for model in finding.MODELS:
            assert numbers[f"nature.{row['measure']}.{model}"] == float(row[model])


def test_the_note_s_farthest_pairs_are_so(numbers, first_run, inventory):
    assert numbers["pairs.lumped.hysteretic.failed"] == numbers["pairs.spreads"]
    curves = tables.read(first_run[0] / "results/curves/inelastic.csv")
    pairs = points_of(inventory, "cornell1999", "pairs")
    judged = {"variant": "pairs", "spread": inelastic.WHOLE}
    beta_0 = [
        tables.select(curves, model=f"continuum.{loss}", **judged)[inelastic.BETA_0]
        for loss in ("viscous", "plastic")
    ]
    off = np.abs(pairs[inelastic.BETA_0].to_numpy() - beta_0) / pairs[inelastic.SIGMA].to_numpy()
    assert pairs["pair"][off.min(axis=0).argmax()] == inelastic.HARD
    assert pairs["pair"][pairs[inelastic.E].argmin()] == inelastic.SOFT


# Runs that fail


# Rows of verdicts, all of whose cells differ, and what the report tells of them.
FOUND = {"chi^2": "7", "degrees of freedom": "6", "degrees of sigma": "5", "p": "0.6"}
KNOWN = {
    "why": "cause known",
    "entry": "eq-25",
    "says": "Eq. 25,",
    "paper": "wrong",
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
lay your copy under it differs Eq. 25, 0.03 μv2(0); the paper is wrong
agrees peak at 7°, model 5
FAILS Maw 1976: rebound, 16 points, rms 0.036 μv2(0) not compared Cross 2014; points awaited
| e = 0.8, plastic loss error up to 0.3 to 0.1 m, 0.05, 3 µs
| by 0.5 µv2(0) (e = 0.8, plastic; 0.6 if
| the wrong loss is an error of up to 0.4 µ"""
ANSWER = {"e": 0.8, "loss": "plastic", "batch": 10, "model": "m"}
ANSWER |= {"max_velocity_with_kinks [mu v2(0)]": "0.05", "whole_time [s]": "3e-6"}
TRADE = {"max_velocity_with_kinks [mu v2(0)]": [0.4], "input_spread [mu v2(0)]": [0.5]}
TRADE |= {"input_spread_stick [mu v2(0)]": [0.6]}


NO_RESIDUALS = pd.DataFrame(columns=["comparison", "quantity", "at", "distance [sigma]"])


def test_a_failed_run_looks_like_one_and_tells_all_that_was_found():
    """Comparisons failed, and an entry of the ledger holds no longer."""
    none = dict.fromkeys(outcome.COLUMNS, "") | {"verdict": "wrong"}
    answers = pd.DataFrame(ANSWER | {"tolerance [mu v2(0)]": allowed} for allowed in (0.3, 0.1))
    trade = tables.curve(TRADE, "continuum.viscous", e=0.8, loss="plastic")
    values = {
        "verdicts": VERDICTS,
        "ledger": [none | {"entry": "eq-25", "holds": "no"}, none | {"entry": "a", "holds": "yes"}],
        "figures": {
            name: write_report.figure(name, b"<svg/>", "Words.", NO_RESIDUALS, VERDICTS, False, {})
            for name in CONFIG["figures"]
        },
        "captions": dict.fromkeys(write_report.SECTIONS, "Words."),
        "cases": which_model.cases(answers, trade),
        "n": {},
        "significance": CONFIG["significance"],
        "doubt": 0.01,
        "run": {"date": "Today", "commit": "abc"},
        "table": figure_table.of_run(VERDICTS, {"fig6": "rebound"}),
        "faults": ["FAILS: fig6-far: max 9", "changed: eq-25: size 3 -> 4"],
    }
    page = write_report.page(values)
    text = Page(page).text
    assert "1 of 2 verdicts on the paper no longer hold: Eq. 25 . Today, commit abc" in text
    assert "FAILED Reasons: 2, named" in text and "FAILS: Fig. 6, far : max 9" in text
    assert "changed: eq-25: size 3 -> 4" in text
    assert "PASSED" not in text and "What we found" not in text
    first, rest = page[page.index('<h3 id="fig6">') :].split("</table>")[:2]
    assert '<tr id="fig6-far" class="FAILS"' in first and flat(first).endswith(flat(TOLD))
    told = "4 more comparisons: 2 agrees, 1 not compared; solver checked: 1 passed"
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
