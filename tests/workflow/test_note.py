"""The note on the replication: words and numbers are those of the run, and it can be printed."""

import base64
import re

import numpy as np
import pytest

from stronge1994 import csv_tables, reference_data
from stronge1994.figures.inelastic import trials as inelastic
from stronge1994.figures.shared.drawing.beside import MODELS
from stronge1994.pages import key_numbers, note
from tests.workflow import browser
from tests.workflow.project import ROOT
from tests.workflow.test_report import Page

TEMPLATE = str(ROOT / "workflow/report/note.html")
SHOWN = ("fig5", "inelastic", "rubber_sphere", "yielding")


@pytest.fixture(scope="module")
def made(first_run):
    return first_run[0] / "figures/note.html"


@pytest.fixture(scope="module")
def numbers(first_run):
    return key_numbers.read(first_run[0] / "results/key_numbers.csv")


@pytest.fixture(scope="module")
def verdicts(first_run):
    return csv_tables.read_rows(first_run[0] / "results/verdicts.csv")


def test_it_needs_no_other_file_and_its_links_lead_somewhere(made):
    page = Page(made.read_text(encoding="utf-8"))
    assert len(page.resources) == 4
    assert all(r.startswith("data:image/svg+xml;base64,") for r in page.resources)
    for link in page.links:
        name, _, anchor = link.partition("#")
        other = made.parent / (name or made.name)
        assert other.is_file() and (not anchor or f'id="{anchor}"' in other.read_text())


def test_its_chi_squared_is_that_of_the_verdicts(verdicts, numbers):
    rows = {row["comparison"]: row for row in verdicts}
    for model in MODELS:
        row = rows[f"inelastic-{model}-pairs"]
        assert f"{numbers[f'pairs.{model}.chi2']:.3g}" == row["chi^2"]
        assert f"{numbers[f'pairs.{model}.p']:.2g}" == f"{float(row['p']):.2g}"


def test_other_numbers_become_other_words(numbers):
    def words(numbers):
        page = note.page(numbers, [], dict.fromkeys(SHOWN, b"<svg/>"), TEMPLATE)
        return set(re.findall(r"\d+\.\d+", page.partition("<article>")[2]))

    spelt = ("failed", "spreads", "published.agrees")
    counted = {name: value for name, value in numbers.items() if name.endswith(spelt)}
    other = {name: value + 50 for name, value in numbers.items()} | counted
    lost = words(numbers) - words(other)
    assert f"{numbers['elastic.largest']:.3f}" in lost
    for name in ("nature.reversal(0.5).paper", "rubber.lumped.hysteretic.distance"):
        assert f"{numbers[name]:.2f}" in lost


def test_what_it_says_in_words_is_so(numbers, first_run, inventory):
    """The rubber sphere by velocity and spin, the farthest pair, and how other limits differ."""
    n = numbers
    assert n["pairs.lumped.hysteretic.failed"] == n["pairs.spreads"] == 10
    for model in MODELS:
        assert n[f"pairs.{model}.the stated sigmas are two sigmas.p"] < 0.01
    for model in MODELS[1:]:  # the range of the verdicts is about the kindest to them
        assert n[f"pairs.{model}.chi2"] < n[f"pairs.{model}.least"] + 0.1
    distance = {model: n[f"rubber.{model}.distance"] for model in MODELS}
    assert min(distance, key=distance.get) == "lumped.hysteretic"
    assert n["rubber.lumped.hysteretic.from_velocity"] < n["rubber.continuum.viscous.from_velocity"]
    assert n["rubber.lumped.hysteretic.from_spin"] > n["rubber.continuum.viscous.from_spin"]
    for loss in ("viscous", "plastic"):
        limits = [n[f"nature.limit_half.{model}"] for model in (loss, "paper")]
        assert abs(limits[0] - 5.25) < abs(limits[0] - limits[1])
        near = [
            n[f"nature.distance({loss}, 0.8, 1.21).{m}"] for m in ("paper", "unloading_stiffness")
        ]
        assert near[0] < near[1]
        far = [
            n[f"nature.distance({loss}, 0.6, 7).{model}"]
            for model in ("unloading_stiffness", "paper")
        ]
        assert far[0] < far[1]
    curves = csv_tables.read(first_run[0] / "results/curves/inelastic.csv")
    pairs = reference_data.arrays(inventory["cornell1999"]["series"]["pairs"])
    names, beta_0, sigma = (pairs[key] for key in ("pair", inelastic.BETA_0, inelastic.SIGMA))
    off = {}
    for loss in ("viscous", "plastic"):
        own = curves[f"continuum.{loss}, pairs"]
        computed = [own[inelastic.BETA_0][own["pair"] == name][0] for name in names]
        off[loss] = abs(beta_0 - computed) / sigma
    farthest = np.minimum(off["viscous"], off["plastic"]).argmax()
    assert names[farthest] == inelastic.HARD
    assert names[pairs[inelastic.E].argmin()] == inelastic.SOFT


def test_no_tiny_probability_is_stated(made):
    text = made.read_text(encoding="utf-8").partition("<article>")[2]
    assert not re.search(r"<i>p</i> = \d[.\d]* × 10", text)


def test_it_fits_a_phone_and_is_printed_on_four_pages(made):
    with browser.page() as tab:
        tab.open(made.as_uri())
        printed = tab.call("Page.printToPDF", preferCSSPageSize=True)["data"]
        assert len(re.findall(rb"/Type\s*/Page\b", base64.b64decode(printed))) == 4
        for width in (390, 360):
            tab.resize(width, 800, mobile=True)
            assert tab.evaluate("document.documentElement.scrollWidth") <= width
        assert not tab.problems
