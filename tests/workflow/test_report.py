"""The report, the sources and the note: whole, by the tables of the run; a bad run looks bad."""

import base64
import html
import re
from collections import Counter

import numpy as np
import pytest
import yaml

from stronge1994 import csv_tables, reference_data
from stronge1994.figures.inelastic import trials as inelastic
from stronge1994.figures.shared.drawing import residuals as draw_residuals
from stronge1994.figures.shared.drawing.beside import MODELS
from stronge1994.pages import key_numbers, note
from stronge1994.pages import report as write_report
from stronge1994.plan import config as configuration
from stronge1994.verdict_tables import verdict_table
from tests.workflow.page import Page
from tests.workflow.project import ROOT, config

CONFIG = config()


@pytest.fixture(scope="module")
def pages(first_run):
    """Function: the text of a page."""
    return lambda name: (first_run[0] / f"figures/{name}.html").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def tables(first_run):
    """Function: the rows of a table of the run."""
    return lambda name: csv_tables.read_rows(first_run[0] / f"results/{name}.csv")


@pytest.fixture(scope="module")
def numbers(first_run):
    return key_numbers.read(first_run[0] / "results/key_numbers.csv")


def test_each_is_one_file_that_needs_nothing_else(pages):
    for name, pictures in (("report", 17), ("sources", 0), ("note", 4)):
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


def test_the_first_words_say_how_it_went_and_what_was_found(pages, tables, numbers):
    """Numbers are those of the tables, and each error that changes a result is named."""
    head = pages("report").split('<h2 id="verdicts">')[0]
    first = Page(head).text
    assert first.index("PASSED") < first.rindex("What we found")
    assert "FAILED" not in pages("report")
    ledger = tables("ledger")
    counts = Counter(row["verdict"] for row in ledger)
    assert f"Of {len(ledger)} entries {counts['confirmed']} are confirmed" in first
    grave = [row["entry"] for row in ledger if row["grade"] == "changes a result"]
    assert grave and all(f'<a href="ledger.html#{entry}">' in head for entry in grave)
    assert f"= {numbers['pairs.lumped.hysteretic.chi2']:.0f}, of" in first


def test_every_verdict_figure_and_source_is_there(pages, tables):
    page, provenance = Page(pages("report")), Page(pages("sources"))
    stated_in = provenance.text
    verdicts = tables("verdicts")
    assert {row["comparison"] for row in verdicts} <= set(page.ids)
    counts = Counter(row["verdict"] for row in verdicts if row["verdict"] != "as before")
    assert all(f"{verdict} {count} " in page.text for verdict, count in counts.items())
    for figure in CONFIG["figures"]:
        assert figure in page.ids and f"config-{figure}" in provenance.ids
        assert f"tables/curves/{figure}.csv" in page.links
    for source in (ROOT / "data").glob("*/source.yaml"):
        stated = reference_data.load_yaml(source)
        assert " ".join(stated["citation"].split()) in stated_in
        for kind in ("series", "facts"):
            for name, entry in stated.get(kind, {}).items():
                assert f"{source.parent.name}/{name}" in provenance.ids
                assert (entry.get("digitised_by") or "") in stated_in
    awaited = sum(row["verdict"] == "awaited" for row in verdicts)
    assert stated_in.count("nobody yet: there are no points") >= bool(awaited)
    assert f"numpy {np.__version__}" in stated_in


def test_rows_say_what_was_allowed_and_every_known_difference_is_listed(pages, tables):
    text, verdicts = pages("report"), tables("verdicts")
    for row in verdicts:
        shown = text[text.index(f'<tr id="{row["comparison"]}"') :].split("</tr>")[0]
        allowed = write_report.bounds(row["allowed"])
        assert f'data-label="to agree">{allowed}' in shown.replace("\n", "")
        assert f">{row['verdict']}<" in shown and write_report.bounds(row["regression"]) in shown
        measured = row["chi^2"] or row["max [sigma]"]
        assert measured in shown or "e" in measured or row["found"], row["comparison"]
    known = [row for row in verdicts if row["verdict"] in verdict_table.DIFFERENCES]
    listed = text[text.index('<p id="known">') :].split("</details>")[0].split("<tr>")[2:]
    for row, line in zip(known, listed, strict=True):
        assert f'<a href="#{row["comparison"]}">' in line
        bound = line.split('data-label="bound">')[1].split("</td>")[0]
        assert row["regression"] and bound == write_report.bounds(row["regression"])


@pytest.mark.parametrize("name", CONFIG["figures"])
def test_a_figure_has_its_own_picture_verdicts_and_settings(first_run, pages, tables, name):
    text = pages("report")
    shown = re.split("<h[23]", text[text.index(f'<h3 id="{name}">') + 3 :])[0]
    svg = (first_run[0] / f"figures/{name}.svg").read_bytes()
    assert base64.b64encode(svg).decode() in shown
    mine = [row["comparison"] for row in tables("verdicts") if row["figure"] == name]
    assert re.findall(r'<tr id="([^"]*)"', shown) == mine
    told = pages("sources")
    told = told[told.index(f'<pre id="config-{name}"') :].split("</pre>")[0]
    config = configuration.with_values(CONFIG)
    comparisons = config["comparisons"].items()
    assert yaml.safe_load(html.unescape(told.partition(">")[2])) == {
        "figures": {name: config["figures"][name]},
        "comparisons": {key: entry for key, entry in comparisons if entry["figure"] == name},
    }


def test_residuals_are_those_that_were_judged(first_run, tables):
    residuals = {}
    for path in (first_run[0] / "results/residuals").glob("*.csv"):
        for row in csv_tables.read_rows(path):
            sigmas = residuals.setdefault(row["comparison"], [])
            sigmas.append(float(row["distance [sigma]"]))
    assert residuals
    for row in tables("verdicts"):
        sigmas = np.array(residuals.get(row["comparison"], []))
        assert sigmas.size == int(row["points"] or 0), row["comparison"]
        if sigmas.size:
            assert f"{abs(sigmas).max():.3g}" == row["max [sigma]"], row["comparison"]
            rms = np.sqrt(np.mean(sigmas**2))
            assert rms == pytest.approx(float(row["rms [sigma]"]), rel=6e-3), row["comparison"]
    # Fig. 5: the lumped model lies above the finite elements where these slip in an annulus.
    assert max(residuals["fig5-lumped-fem-initial-stick"]) < 0


# The note


def test_other_numbers_become_other_words(numbers):
    def words(numbers):
        shown = dict.fromkeys(("fig5", "inelastic", "rubber_sphere", "yielding"), b"<svg/>")
        page = note.page(numbers, [], shown, str(ROOT / "workflow/report/note.html"))
        return set(re.findall(r"\d+\.\d+", page.partition("<article>")[2]))

    spelt = ("failed", "spreads", "published.agrees")
    counted = {name: value for name, value in numbers.items() if name.endswith(spelt)}
    other = {name: value + 50 for name, value in numbers.items()} | counted
    lost = words(numbers) - words(other)
    assert f"{numbers['elastic.largest']:.3f}" in lost
    for name in ("nature.reversal(0.5).paper", "rubber.lumped.hysteretic.distance"):
        assert f"{numbers[name]:.2f}" in lost


def test_key_numbers_are_those_of_the_tables(numbers, tables, first_run, inventory):
    """Computed once more, from the curves and the verdicts."""

    def curves(figure):
        return csv_tables.read(first_run[0] / f"results/curves/{figure}.csv")

    def rms(values):
        return pytest.approx(np.sqrt(np.mean(np.square(values))), rel=1e-9)

    verdicts = Counter(row["verdict"] for row in tables("verdicts"))
    for verdict in verdict_table.ORDER:
        assert numbers[f"rows.{verdict}"] == verdicts[verdict]
    assert numbers["rows.judged"] == verdicts.total() - verdicts["as before"]
    rows = {row["comparison"]: row for row in tables("verdicts")}
    for model in MODELS:
        row = rows[f"inelastic-{model}-pairs"]
        assert f"{numbers[f'pairs.{model}.chi2']:.3g}" == row["chi^2"]
        assert f"{numbers[f'pairs.{model}.p']:.2g}" == f"{float(row['p']):.2g}"
    w, x = "velocity [mu v2(0)]", "incidence [mu v2(0)]"
    fig5 = curves("fig5")
    gap = np.abs(fig5["lumped"][w] - fig5["continuum"][w])
    assert numbers["elastic.largest"] == pytest.approx(gap.max(), rel=1e-9)
    assert numbers["elastic.at"] == pytest.approx(fig5["lumped"][x][gap.argmax()])
    runs = reference_data.arrays(inventory["finite_elements"]["series"]["spheres"])
    e = runs["restitution [1]"]
    kept = (runs["friction [1]"] < 0.101) & (e >= 0.45) & (runs["set"] != "calibration")
    near = kept & (e >= 0.62) & (e <= 0.92)
    rubber, yielding = curves("rubber_sphere"), curves("yielding")
    for model in MODELS:
        off = yielding[f"{model}, runs"][w] - runs[w]
        assert numbers[f"yielding.{model}.rms"] == rms(off[kept])
        assert numbers[f"yielding.{model}.near.max"] == pytest.approx(abs(off[near]).max())
        own = rubber[f"{model}, impacts"]
        share = "tangential_restitution [1]"
        for kind, half in (("velocity", "velocity alone"), ("spin", "spin alone")):
            off = own[share] - rubber[half][share]
            assert numbers[f"rubber.{model}.from_{kind}"] == rms(off)
            assert numbers[f"rubber.{model}.from_{kind}.small"] == rms(off[own[x] <= 2.5])
    for row in tables("in_nature"):
        assert numbers[f"nature.{row['measure']}.paper"] == float(row["paper"])


def test_the_note_s_farthest_pairs_are_so(numbers, first_run, inventory):
    assert numbers["pairs.lumped.hysteretic.failed"] == numbers["pairs.spreads"]
    curves = csv_tables.read(first_run[0] / "results/curves/inelastic.csv")
    pairs = reference_data.arrays(inventory["cornell1999"]["series"]["pairs"])
    beta_0 = [
        curves[f"continuum.{loss}, pairs"][inelastic.BETA_0] for loss in ("viscous", "plastic")
    ]
    off = np.abs(pairs[inelastic.BETA_0] - beta_0) / pairs[inelastic.SIGMA]
    assert pairs["pair"][off.min(axis=0).argmax()] == inelastic.HARD
    assert pairs["pair"][pairs[inelastic.E].argmin()] == inelastic.SOFT


# Runs that fail


def test_a_failed_run_looks_like_one():
    """A comparison failed, and a solver crashed."""
    figures = [*CONFIG["figures"]]

    def row(figure, comparison, verdict, **cells):
        cells = {"figure": figure, "comparison": comparison, "verdict": verdict} | cells
        return dict.fromkeys(verdict_table.COLUMNS, "") | cells

    sizes = {"points": "2", "rms [sigma]": "7", "max [sigma]": "9"}
    verdicts = [
        row("fig6", "fig6-rebound", "wrong", **sizes),
        row("trade", "trade-solved", "wrong", note="no curves: ArithmeticError: <oh>"),
        *(row(name, f"{name}-solved", "as before") for name in figures if name != "trade"),
    ]
    config = CONFIG | {"slides": ["fig6"]}
    values = {
        "verdicts": verdicts,
        "ledger": [],
        "figures": {
            name: write_report.figure(name, b"<svg/>", "Words.", [], verdicts, config)
            for name in figures
        },
        "captions": dict.fromkeys(write_report.SECTIONS, "Words."),
        "cases": [],
        "n": {},
        "significance": CONFIG["significance"],
        "run": {"date": "Today", "commit": "abc"},
        "faults": ["wrong: fig6-rebound: max 9"],
    }
    page = write_report.page(values, ROOT / "workflow/report/report.html")
    text = Page(page).text
    assert text.count(
        "FAILED 2 comparisons fail. Today, commit abc Fig. 6, rebound is wrong: max 9"
    )
    # What was found is told of a run that passed.
    assert "PASSED" not in text and "What we found" not in text
    # What fails is unfolded.
    table = page[page.index("<details open><summary>2 comparisons:") :].split("</table>")[0]
    assert '<tr id="fig6-rebound" class="wrong"' in table and "rms 7, max 9 sigma" in table
    assert "No curves: ArithmeticError: &lt;oh&gt;" in page


def test_strips_show_points_by_their_verdicts():
    others = {"question": "beside others", "found": "", "curve": "lumped", "reference": "a/b"}
    verdicts = {
        "low": others | {"verdict": "diverges"},
        "high": others | {"verdict": "agrees"},
        "corner": others | {"verdict": "wrong", "question": "solved right", "curve": ""},
    }
    points = {"low": [-1, -3], "high": [2, 0], "corner": [7]}
    residuals = [
        {"comparison": name, "quantity": "x [1]", "at": f"{at}", "distance [sigma]": f"{far}"}
        for name, distances in points.items()
        for at, far in enumerate(distances)
    ]
    first, second = draw_residuals.draw(draw_residuals.strips(residuals, verdicts)).axes
    drawn = {line.get_marker(): line for line in first.lines if line.get_linestyle() == "None"}
    assert {mark: line.get_ydata().tolist() for mark, line in drawn.items()} == {
        "x": [-1, -3], "o": [2, 0],
    }  # fmt: skip
    assert second.lines[0].get_ydata().tolist() == [7]
