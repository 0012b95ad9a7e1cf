"""Numbers in words: each that a run finds is that of the run, on every page that states it."""

import re

import pytest

from planarimpact import continuum
from stronge1994 import csv_tables
from stronge1994.figures.inelastic import drawing as inelastic
from stronge1994.pages import key_numbers, note
from tests.workflow.project import ROOT

COUNTS = {7: "Seven", 11: "Eleven", 15: "Fifteen", 22: "Twenty-two", 27: "Twenty-seven"}


@pytest.fixture(scope="module")
def numbers(first_run):
    table = first_run[0] / "results/key_numbers.csv"
    return key_numbers.by_name(csv_tables.read_rows(table))


def said(n):
    """Sentences of pages, with the numbers of the run in them."""
    word = {name: note.COUNTS[round(n[name])] for name in n if 0 <= n[name] < 10.5}
    chi2 = {model: f"{n[f'pairs.{model}.chi2']:.0f}" for model in note.MODELS}
    return {
        "README.md": [
            f"{COUNTS[n['rows.inconclusive']]} rows are inconclusive",
            f"count as agreement, with {word['rows.published.agrees']} models",
            f"{COUNTS[n['rows.explained difference']]} differences are explained",
            f"{COUNTS[n['rows.unexplained difference']]} are unexplained",
            f"{COUNTS[n['rows.untested difference']]} are untested",
            f"Of {n['ledger.entries']:.0f} entries {n['ledger.confirmed']:.0f} are confirmed, "
            f"{n['ledger.confirmed within rounding']:.0f} confirmed within rounding, "
            f"{n['ledger.wrong']:.0f} wrong, {n['ledger.not testable']:.0f} not testable here. "
            f"Of the wrong ones {n['ledger.changes a result']:.0f} change a result, "
            f"{n['ledger.sign or misprint']:.0f} are single signs, digits or words",
            f"{n['ledger.matter of judgement']:.0f} are matters of judgement. "
            f"The {n['ledger.wrong']:.0f} have {n['ledger.causes']:.0f} causes.",
            f"impact differs by up to {n['elastic.largest']:.3f} mu v2(0), where",
            f"{COUNTS[n['pairs.number']]} pairs of materials differ from the paper's model (chi^2 "
            f"= {chi2['lumped.hysteretic']}, of which polyurethane gives "
            f"{n['pairs.lumped.hysteretic.polyurethane.chi2']:.0f}) and agree with a viscous "
            "continuum "
            f"({chi2['continuum.viscous']}), a plastic one ({chi2['continuum.plastic']}) and two "
            f"Kelvin-Voigt elements ({chi2['lumped.viscous']})",
            f"of {word['pairs.spreads']} choices the paper's model fails "
            f"{word['pairs.lumped.hysteretic.failed']}, and "
            f"{word['pairs.lumped.hysteretic.both.failed']} without polyurethane and chrome steel; "
            f"the viscous continuum fails {word['pairs.continuum.viscous.failed']}, the plastic "
            f"one {word['pairs.continuum.plastic.failed']}, two Kelvin-Voigt elements "
            f"{word['pairs.lumped.viscous.failed']}.",
            f"tangential restitution is {n['rubber.lumped.hysteretic.distance']:.2f} off, root "
            "mean square, that of a viscous continuum "
            f"{n['rubber.continuum.viscous.distance']:.2f}, without any loss "
            f"{n['rubber.continuum.distance']:.2f}.",
            f"the two continua differ by up to {n['loss.other']:.2f} mu v2(0), the paper's model "
            f"from one of them by {n['loss.paper']:.1f}.",
            f"(continua have {n['nature.limit_half.viscous']:.2f} or "
            f"{n['nature.limit_half.plastic']:.2f}, nearer to 5.25)",
            f"the plastic one is {n['yielding.continuum.plastic.rms']:.2f} from our own finite",
            f"two Kelvin-Voigt elements {n['yielding.lumped.viscous.rms']:.2f}.",
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
    paper = "pairs.lumped.hysteretic.chi2", "rubber.lumped.hysteretic.distance"
    for name in ("elastic.largest", *paper, "loss.other"):
        other = said(numbers | {name: 1.1 * numbers[name]})["README.md"]
        assert any(sentence not in text for sentence in other)


# What is given: settings, equations, what the paper states, and 5.5, which a test holds.
GIVEN = "0 1 2 2e 21 25 38 40 0.1 0.18 0.45 0.5 0.588 0.8 0.9 3.5 5.25 5.5 5.79 7 27.8 35"


def test_no_other_number_is_in_what_the_readme_says_was_found(numbers):
    """What no sentence ties to the run is a setting, of an equation, or tested by name below."""
    text = flat((ROOT / "README.md").read_text(encoding="utf-8"))
    part = text.split("## What we found")[1].split("## An example")[0]
    for sentence in said(numbers)["README.md"]:
        part = part.replace(sentence, " ")
    part = re.sub(r"\]\([^)]*\)|\bv2\b|v2\(0\)|m2/m1|zeta\^2|e\^2", " ", part)
    left = set(re.findall(r"\d+(?:\.\d+)?", part))
    assert left - set(GIVEN.split()) == set()


def typed(path, start, end=None):
    """Numbers that are typed into a template between two marks."""
    source = (ROOT / path).read_text(encoding="utf-8").partition(start)[2]
    source = source.partition(end)[0] if end else source
    words = re.sub(r"\{[%{#].*?[%}#]\}|<[^>]*>", " ", source, flags=re.S)
    return set(re.findall(r"(?<![\d.])\d+(?:\.\d+)?", words))


def test_no_number_that_a_run_finds_is_typed_into_the_first_screen():
    found = typed("workflow/report/report.html", "What we found</h2>", "</section>")
    assert found <= {"0", "1", "0.5", "2", "5", "1976"}  # settings, "Fig. 5", Maw et al. (1976)


# Of the note: sections and figures, equations and what the paper states, settings.
GIVEN_IN_NOTE = "0 1 2 3 4 5 6 7 8 9 10 11 13 15 21 25 27 28 35 38 40 41 435 444 450"
GIVEN_IN_NOTE += (
    " 0.01 0.05 0.1 0.18 0.22 0.3 0.4 0.45 0.5 0.53 0.588 0.6 0.62 0.78 0.8 0.88 0.91 0.92"
)
GIVEN_IN_NOTE += " 0.99 1.00 1.21 2.5 3.5 4.34 5.25 5.5 5.79 27.8"


def test_no_number_that_a_run_finds_is_typed_into_the_note():
    words = typed("workflow/report/note.html", "<article>", "<h2>References</h2>")
    years = {word for word in words if re.fullmatch(r"(19|20)\d\d", word)}
    assert words - years - set(GIVEN_IN_NOTE.split()) == set()


def test_what_the_note_says_in_words_is_so(numbers, first_run):
    """The nearest to the rubber sphere, the farthest pair, and how other limits differ."""
    n = numbers
    nearest = min(note.MODELS, key=lambda model: n[f"rubber.{model}.distance"])
    assert nearest == "lumped.hysteretic"
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
        csv_tables.read(first_run[0] / "results/series/cornell1999.csv")["pairs"]
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
