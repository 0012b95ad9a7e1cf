"""The note on the replication: a page and a PDF of the same words, with the numbers of the run."""

import html
import re

import pytest

from stronge1994 import csv_tables
from stronge1994.pages import key_numbers, note, pdf
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
    table = first_run[0] / "results/key_numbers.csv"
    return key_numbers.by_name(csv_tables.read_rows(table))


@pytest.fixture(scope="module")
def verdicts(first_run):
    return csv_tables.read_rows(first_run[0] / "results/verdicts.csv")


@pytest.fixture
def pictures(first_run):
    return {name: str(first_run[0] / f"figures/{name}.png") for name in SHOWN}


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
    for model in note.MODELS:
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
    rubber = "rubber.lumped.hysteretic.distance"
    for name in ("elastic.largest", "nature.reversal_half.paper", rubber):
        shown = f"{numbers[name]:.3f}" if name == "elastic.largest" else f"{numbers[name]:.2f}"
        assert shown in lost


def test_no_tiny_probability_is_stated(made):
    text = made.read_text(encoding="utf-8").partition("<article>")[2]
    assert not re.search(r"<i>p</i> = \d[.\d]* × 10", text)


def test_the_pdf_has_the_same_words_on_four_pages(made, pictures, tmp_path, monkeypatch):
    said = []
    paragraph = pdf.Paragraph

    def kept(words, *style, **more):
        said.append(words)
        return paragraph(words, *style, **more)

    monkeypatch.setattr(pdf, "Paragraph", kept)
    text = made.read_text(encoding="utf-8")
    path = tmp_path / "note.pdf"
    assert pdf.write(str(path), text, pictures, note.TITLE) == 4
    assert path.read_bytes() == made.with_suffix(".pdf").read_bytes()
    article = text.partition("<article>")[2].partition("</article>")[0]
    plain = [re.sub("<[^>]*>", "", part) for part in (article, " ".join(said))]
    letters = [re.sub(r"\s", "", html.unescape(part)) for part in plain]
    assert letters[0] == letters[1]


def test_it_fits_a_phone(made):
    with browser.page() as tab:
        tab.open(made.as_uri())
        for width in (390, 360):
            tab.resize(width, 800, mobile=True)
            assert tab.evaluate("document.documentElement.scrollWidth") <= width
        assert not tab.problems
