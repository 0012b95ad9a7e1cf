"""The letter to the author: its numbers are those of the run, and it can be read anywhere."""

import csv
import re
import shutil

import numpy as np
import pytest

from stronge1994 import csv_tables
from stronge1994.ledger import in_nature, nature
from stronge1994.pages import letter
from tests.workflow import browser
from tests.workflow.project import ROOT
from tests.workflow.test_report import Page

TEMPLATE = str(ROOT / "workflow/report/letter.html")


@pytest.fixture(scope="module")
def made(first_run):
    return first_run[0] / "figures/below_e_1.html"


@pytest.fixture(scope="module")
def tables(first_run):
    """Curves of the figure, columns of the measured pairs, and what the measures found."""
    results = first_run[0] / "results"
    return (
        csv_tables.read(results / "curves/inelastic.csv"),
        csv_tables.read(results / "series/cornell1999.csv")["pairs"],
        in_nature.read(csv_tables.read_rows(results / "in_nature.csv")),
    )


@pytest.fixture(scope="module")
def text(made):
    return " ".join(" ".join(Page(made.read_text(encoding="utf-8")).words).split())


def test_every_link_leads_somewhere_and_it_needs_no_other_file(made):
    page = Page(made.read_text(encoding="utf-8"))
    assert page.resources and all(
        r.startswith("data:image/svg+xml;base64,") for r in page.resources
    )
    for link in page.links:
        name, _, anchor = link.partition("#")
        other = (made.parent / (name or made.name)).read_text(encoding="utf-8")
        state = name == "explorer.html"  # its address holds the state of the sliders
        assert not anchor or state or f'id="{anchor}"' in other, link
    names = {link.partition("#")[0] for link in page.links}
    assert {"report.html", "ledger.html", "explorer.html", "choosing_a_model.html"} <= names


def test_its_chi_squared_is_that_of_the_verdicts(first_run, tables):
    with open(first_run[0] / "results/verdicts.csv", newline="") as file:
        verdicts = {row["comparison"]: row for row in csv.DictReader(file)}
    for fit in letter.fits(*tables[:2]):
        row = verdicts[f"inelastic-{fit.model}-pairs"]
        assert f"{fit.every.value:.3g}" == row["chi^2"]
        assert f"{fit.every.degrees}" == row["degrees of freedom"]
        assert f"{fit.every.p:.2g}" == f"{float(row['p']):.2g}"
        assert fit.others.degrees == fit.every.degrees - 1


def test_it_tells_the_least_elastic_pair_and_the_farthest(tables, text):
    every = letter.pairs(*tables[:2])
    assert every[0].restitution == tables[1]["restitution [1]"].min() == nature.LEAST_MEASURED
    assert every[0].name == "polyurethane" and f"{every[0].computed['lumped']:.2f}" in text
    assert "chrome steel: β 0 is 0.54 ± 0.05" in text


def test_other_numbers_of_a_run_become_other_words(tables):
    """None is typed into the template."""
    curves, measured, found = tables

    def words(found):
        page = letter.page(found, curves, measured, b"<svg/>", TEMPLATE)
        return set(re.findall(r"\d+\.\d+", page.partition("</style>")[2]))

    other = {name: in_nature.Values(*np.add(values, 50)) for name, values in found.items()}
    lost = words(found) - words(other)
    for name in ("reversal_half", "peak_spread", "from_plastic", "from_viscous"):
        assert {f"{found[name].paper:.2f}", f"{found[name].plastic:.2f}"} & (lost | {"0.00"})
    shifted = dict(measured) | {
        "tangential_restitution [1]": measured["tangential_restitution [1]"] + 0.3
    }
    moved = letter.page(found, curves, shifted, b"<svg/>", TEMPLATE)
    assert "0.60 ± 0.02" in moved


def test_no_number_that_a_run_finds_is_typed():
    """What is left are years, and digits of formulas, of names and of the units of the page."""
    source = (ROOT / "workflow/report/letter.html").read_text(encoding="utf-8")
    words = re.sub(r"\{[%{#].*?[%}#]\}|<[^>]*>", " ", source.partition("<body>")[2], flags=re.S)
    assert set(re.findall(r"\d+(?:\.\d+)?", words)) <= {
        "1994",
        "1997",
        "1999",
        "2004",
        "1",
        "2",
        "0",
    }


def test_a_number_that_is_missing_is_no_number_in_the_letter(first_run, tables, tmp_path):
    results, figures = first_run[0] / "results", first_run[0] / "figures"
    shutil.copy(results / "in_nature.csv", tmp_path)
    rows = csv_tables.read_rows(tmp_path / "in_nature.csv")
    rows[3]["viscous"] = "nan"
    csv_tables.write_table(tmp_path / "in_nature.csv", rows, in_nature.COLUMNS)
    crashed = tmp_path / "crashed.csv"
    csv_tables.write_rows(crashed, ["error"], [["ArithmeticError: <oh>"]])
    good = results / "curves/inelastic.csv", results / "in_nature.csv"
    for curves, measures, why in (
        (good[0], tmp_path / "in_nature.csv", "a number is missing"),
        (crashed, good[1], "ArithmeticError: &lt;oh&gt;"),
    ):
        output = tmp_path / "below_e_1.html"
        series, svg = results / "series/cornell1999.csv", figures / "inelastic.svg"
        letter.write(output, measures, curves, series, svg, TEMPLATE, "pairs")
        assert f"could not be written: {why}" in output.read_text(encoding="utf-8")


def test_it_is_two_screens_long_and_fits_a_phone(made):
    with browser.page() as tab:
        tab.resize(1440, 900, mobile=False)
        tab.open(made.as_uri())
        assert tab.evaluate("document.documentElement.scrollHeight") <= 1800
        for width in (390, 360):
            tab.resize(width, 800, mobile=True)
            assert tab.evaluate("document.documentElement.scrollWidth") <= width
        assert not tab.problems
