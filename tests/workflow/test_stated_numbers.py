"""Numbers in words: each that a run finds is that of the run, on every page that states it."""

import re

import pytest

import planarimpact
from planarimpact import continuum, lumped
from planarimpact.models import timestep
from stronge1994 import csv_tables, reference_data
from stronge1994.figures.inelastic import drawing as inelastic
from stronge1994.pages import key_numbers, note
from stronge1994.verdict_tables import verdict_table
from tests.workflow.project import ROOT


@pytest.fixture(scope="module")
def numbers(first_run):
    table = first_run[0] / "results/key_numbers.csv"
    return key_numbers.by_name(csv_tables.read_rows(table))


def said(n):
    """Sentences of pages, with the numbers of the run in them."""
    chi2 = {model: f"{n[f'pairs.{model}.chi2']:.0f}" for model in note.MODELS}
    known = sum(n[f"rows.{verdict}"] for verdict in verdict_table.DIFFERENCES)
    return {
        "README.md": [
            f"one of {known:.0f} known differences changes",
            f"of the {n['ledger.entries']:.0f} entries of its ledger, one for each",
            f"{n['ledger.confirmed']:.0f} are confirmed, "
            f"{n['ledger.confirmed within rounding']:.0f} confirmed within rounding, "
            f"{n['ledger.wrong']:.0f} wrong, {n['ledger.not testable']:.0f} not testable here; "
            f"{n['ledger.changes a result']:.0f} of the wrong ones change a result.",
            f"differs by up to {n['elastic.largest']:.3f} mu v2(0) from that of an elastic",
            f"{n['pairs.number']:.0f} measured pairs of materials differ from the paper's model "
            f"(chi^2 = {chi2['lumped.hysteretic']}, of which polyurethane gives "
            f"{n['pairs.lumped.hysteretic.polyurethane.chi2']:.0f}) and agree with a viscous "
            f"continuum ({chi2['continuum.viscous']}), but",
            f"differ by up to {n['loss.other']:.2f} mu v2(0), and the paper's model from one of "
            f"them by {n['loss.paper']:.2f}.",
        ],
        "src/README.md": [
            f"{n['yielding.continuum.plastic.rms']:.2f} mu v2(0) (root mean square), "
            f"{n['yielding.continuum.plastic.max']:.2f} at most",
            "The viscous continuum differs from them by "
            f"{n['yielding.continuum.viscous.rms']:.2f}, the paper's model by "
            f"{n['yielding.lumped.hysteretic.rms']:.1f}, that with e^2 zeta^2 by "
            f"{n['yielding.lumped.unloading-stiffness.rms']:.2f}. Two Kelvin-Voigt elements differ "
            f"by {n['yielding.lumped.viscous.near.rms']:.2f} for e from 0.62 to 0.92, "
            f"{n['yielding.lumped.viscous.near.max']:.2f} at most",
        ],
        "workflow/notebooks/choosing_a_model.ipynb": [
            f"wrong loss is off by up to {n['loss.other']:.2f}",
            f"off by up to {n['loss.paper']:.2f} from the plastic continuum",
        ],
        "workflow/notebooks/where_friction_turns_round.ipynb": [
            f"but **{n['nature.limit_half.viscous']:.2f}** in the viscous continuum",
            f"at **{n['nature.limit_half.plastic']:.2f}** for *e* = 0.5",
        ],
        "src/stronge1994/figures/fig8/figure.yaml": [f"begins at {n['fig8.normal']:.1f} N"],
        "data/stronge1994/ledger.yaml": [f"differ by up to {n['elastic.largest']:.3f} mu v2(0)"],
    }


def flat(text):
    """The text with its lines joined, also those of a notebook."""
    return " ".join(text.replace('\\n",', " ").replace('    "', " ").split())


def test_sentences_have_the_numbers_of_the_run(numbers):
    for name, sentences in said(numbers).items():
        text = flat((ROOT / name).read_text(encoding="utf-8"))
        assert [sentence for sentence in sentences if sentence not in text] == []


def test_another_number_is_noticed(numbers):
    """Each number is off by a tenth: no sentence that has one of them stays as it is."""
    text = flat((ROOT / "README.md").read_text(encoding="utf-8"))
    for name in ("elastic.largest", "pairs.lumped.hysteretic.chi2", "loss.other", "loss.paper"):
        other = said(numbers | {name: 1.1 * numbers[name]})["README.md"]
        assert any(sentence not in text for sentence in other)


# References, settings and symbols have digits that no run finds.
GIVEN = (
    r"Eqs?\.? \d+( to \d+)?|Fig\. \d|= \d(\.\d)?\b|falls from 1 to \d\.\d|m2/m1|\bv2\(0\)|chi\^2|"
    r"\((19|20)\d\d\)"
)


def left(text):
    """Numbers of a text that are none of those: somebody typed them.

    >>> left("At e = 0.8, by Eqs 17 to 20, v2(0) is 5.5 % more.")
    ['5.5']
    """
    return re.findall(r"\d+(?:\.\d+)?", re.sub(GIVEN, " ", text))


def test_no_number_that_a_run_finds_is_typed_into_the_readme(numbers):
    """None is left of what was found but what the sentences above take from the run."""
    text = flat((ROOT / "README.md").read_text(encoding="utf-8"))
    part = text.split("## What we found")[1].split("##")[0]
    assert left(part)
    for sentence in said(numbers)["README.md"]:
        part = part.replace(sentence, " ")
    assert left(part) == []


def test_no_number_that_a_run_finds_is_typed_into_the_first_screen():
    source = (ROOT / "workflow/report/report.html").read_text(encoding="utf-8")
    part = source.partition("What we found</h2>")[2].partition("</section>")[0]
    words = re.sub(r"<(sub|sup)>\d</\1>", "", part).replace("&nbsp;", " ")
    words = re.sub(r"\{[%{#].*?[%}#]\}|<[^>]*>", " ", words, flags=re.S)
    assert left(words) == []


def test_pages_say_of_restitution_what_the_evidence_is(numbers):
    """Pairs of materials differ from the paper's model, and a rubber sphere is nearest to it."""
    assert numbers["pairs.lumped.hysteretic.p"] < 0.01
    distance = {model: numbers[f"rubber.{model}.distance"] for model in note.MODELS}
    assert min(distance, key=distance.get) == "lumped.hysteretic"
    pages = [(ROOT / name).read_text(encoding="utf-8") for name in ("README.md", "src/README.md")]
    for text in (*pages, planarimpact.__doc__, lumped.__doc__, timestep.__doc__):
        assert "is divided" in flat(text) and "easurements contradict" not in flat(text)


def test_what_the_note_says_in_words_is_so(numbers, first_run, inventory):
    """The rubber sphere by velocity and spin, the farthest pair, and how other limits differ."""
    n = numbers
    assert n["rubber.lumped.hysteretic.from_velocity"] < n["rubber.continuum.viscous.from_velocity"]
    assert n["rubber.lumped.hysteretic.from_spin"] > n["rubber.continuum.viscous.from_spin"]
    limits = [n[f"nature.limit_half.{loss}"] for loss in ("viscous", "plastic")]
    paper = n["nature.limit_half.paper"]
    assert all(abs(limit - 5.25) < abs(limit - paper) for limit in limits)
    for model in note.MODELS[1:]:  # the range of the verdicts is about the kindest to them
        assert n[f"pairs.{model}.chi2"] < n[f"pairs.{model}.least"] + 0.1
    assert all(
        n[f"pairs.{model}.the stated sigmas are two sigmas.p"] < 0.01 for model in note.MODELS
    )
    assert n["pairs.lumped.hysteretic.failed"] == n["pairs.spreads"] == 10
    for loss in ("viscous", "plastic"):
        stiff, paper = (
            n[f"nature.stick_from_{loss}.{m}"] for m in ("unloading_stiffness", "paper")
        )
        assert stiff > paper
        assert n[f"nature.from_{loss}.unloading_stiffness"] < n[f"nature.from_{loss}.paper"]
    for e, quoted in ((1.0, 5.79), (0.5, 4.34)):
        assert round((1 + e) * (3.5 - 1.21 / 2), 2) == quoted
    assert round(float(continuum.slip_throughout_limit()), 2) == 5.79
    curves = csv_tables.read(first_run[0] / "results/curves/inelastic.csv")
    series = key_numbers.series_of(
        reference_data.arrays(inventory["cornell1999"]["series"]["pairs"])
    )
    own = [curves[f"continuum.{loss}, pairs"] for loss in ("viscous", "plastic")]
    off = {
        pair: min(abs(y - c[inelastic.BETA_0][c["pair"] == pair][0]) / sigma for c in own)
        for pair, y, sigma in zip(
            series["columns"]["pair"], series["y"], series["sigma"][1], strict=True
        )
    }
    assert max(off, key=off.get) == inelastic.HARD
    assert min(zip(series["x"], series["columns"]["pair"], strict=True))[1] == inelastic.SOFT
