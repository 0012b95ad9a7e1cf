"""The ledger of the paper: complete, judged in both directions, and shown.

That every entry holds is what a run says; that each notices a fault, test_mutations.py; what is
refused, tests/refusals. The readings quote numbers, which are found here in other ways.
"""

import csv
import math
import re
from collections import Counter
from pathlib import Path

import numpy as np
import pytest
from markupsafe import escape

from planarimpact import Regime, bodies, continuum, lumped, noncollinear
from stronge1994 import ledger, reference_data
from stronge1994.ledger import checking, contact, entries, finding, outcome
from stronge1994.ledger.finding import Finding
from stronge1994.pages import ledger_page
from stronge1994.plan import config as configuration
from stronge1994.printed import dynamics, slip

ROOT = Path(__file__).parents[2]
FILE = "data/stronge1994/ledger.yaml"
SCHEMA = reference_data.load_yaml(ROOT / "workflow/schemas/ledger.schema.yaml")
ENTRIES = entries.load(ROOT / FILE, SCHEMA)
EXECUTED = {name: entry for name, entry in ENTRIES.items() if "check" in entry}
CLAIMS = {name: entry["in_nature"] for name, entry in ENTRIES.items() if "in_nature" in entry}
JUDGED_CLAIMS = [name for name, claim in CLAIMS.items() if "check" in claim]
RIGHT = {"verdict": "confirmed", "confirms": {"at_most": 1e-9}}
LARGE = {"verdict": "confirmed", "confirms": {"at_least": 0.9}}
ROUNDED = {"verdict": "confirmed within rounding", "confirms": {"value": 1.7, "rounding": 0.05}}
WRONG = {"verdict": "wrong", "confirms": {"at_most": 1e-9}, "between": [0.9, 1.1]}


def by_equations(name):
    """An entry with what follows from the paper's equations alone."""
    return {key: value for key, value in ENTRIES[name].items() if key != "in_nature"}


@pytest.fixture(scope="module")
def rows(first_run):
    """What a run with the right solver has found."""
    with open(first_run[0] / "results/ledger.csv", newline="") as file:
        return {row["entry"]: row for row in csv.DictReader(file)}


@pytest.mark.parametrize(
    ("entry", "found", "why"),
    [
        (RIGHT, Finding(0.0), ""),
        (RIGHT, Finding(0.1), "recorded as confirmed, found wrong"),
        (RIGHT, Finding(math.nan), "recorded as confirmed, found wrong"),
        (LARGE, Finding(1.0), ""),
        (LARGE, Finding(0.8), "recorded as confirmed, found wrong"),
        (ROUNDED, Finding(1.7007), ""),
        (ROUNDED, Finding(1.7), "recorded as confirmed within rounding, found confirmed"),
        (ROUNDED, Finding(1.76), "recorded as confirmed within rounding, found wrong"),
        (WRONG, Finding(1.0), ""),
        (WRONG, Finding(1.0, 1e-14), ""),
        (WRONG, Finding(1.0, 1e-3), "the corrected formula is off by 0.001"),
        (WRONG, Finding(1.0, math.nan), "the corrected formula is off by nan"),
        (WRONG, Finding(1e-12), "recorded as wrong, found confirmed"),
        (WRONG, Finding(1.2), "1.2 lies outside 0.9 to 1.1"),
        (WRONG, Finding(math.nan), "nan lies outside 0.9 to 1.1"),
    ],
)
def test_an_entry_holds_or_says_why_not(entry, found, why):
    assert finding.judge(found, entry).startswith(why)
    assert bool(finding.judge(found, entry)) == bool(why)


def test_every_numbered_equation_has_an_executed_entry():
    numbers = set()
    for entry in EXECUTED.values():
        if entry["kind"] == "equation":
            numbers |= {int(n) for n in re.findall(r"Eqs?[.]? (\d+)", entry["where"])}
    assert numbers == set(range(1, 42))
    assert "check" in ENTRIES["table-1"]


def test_entries_that_hang_together_are_judged_alike():
    # Which one of Eqs 18, 31 and 32 is misprinted the scan does not tell.
    assert "eq-32" not in ENTRIES
    assert ENTRIES["eq-18"]["verdict"] == ENTRIES["eq-31"]["verdict"] == "confirmed"
    assert ENTRIES["eq-18-31-32"]["grade"] == "sign or misprint"
    # What one heading repairs is a misprint.
    late = {n: e["grade"] for n, e in ENTRIES.items() if e.get("cause") == "late-stick"}
    assert len(late) == 4 and set(late.values()) == {"sign or misprint"}
    # Angles that the paper places have 5 deg either way, and beyond that one grade.
    stated, placed = ENTRIES["peak-angle-0.18"], ENTRIES["largest-dissipation-angle"]
    assert stated["confirms"]["rounding"] == placed["confirms"]["at_most"] == 5
    assert stated["grade"] == placed["grade"]
    # Micro-slip is judged by the comparison that the paper draws on.
    sentence, comparison = ENTRIES["micro-slip-insignificant"], ENTRIES["practically-identical"]
    assert all(sentence[key] == comparison[key] for key in ("check", "confirms"))


def test_a_wrong_equation_has_an_exact_correction(rows):
    wrong = [n for n, e in ENTRIES.items() if e["kind"] == "equation" and "between" in e]
    assert wrong and all(float(rows[name]["corrected"]) < 1e-12 for name in wrong)


@pytest.mark.parametrize(
    "name", ["peak_angle_mu_0.1", "peak_angle_mu_0.18", "peak_angle_mu_1", "full_friction_angle"]
)
def test_a_stated_angle_has_the_tolerance_of_its_source(name):
    """In source.yaml alone, whence the comparisons have it too."""
    fact = reference_data.load_yaml(ROOT / "data/stronge1994/source.yaml")["facts"][name]
    entry = name.replace("_mu_", "-").replace("_", "-")
    raw = reference_data.load_yaml(ROOT / FILE)["sentences"][entry]["confirms"]
    assert raw == {"fact": name}
    assert ENTRIES[entry]["confirms"] == {"value": fact["value"], "rounding": fact["tolerance"]}


def test_every_check_is_used():
    called = [entry["check"] for entry in EXECUTED.values()]
    called += [f"nature.{name}" for claim in CLAIMS.values() for name in entries.needed(claim)]
    assert {check.partition("(")[0] for check in called} == set(ledger.checks())
    assert all(ledger.docstring(check).endswith(".") for check in called)


def test_a_formula_put_right_trips_its_entry(monkeypatch):
    """A verdict of wrong fails too, once the printed limit is right."""
    stiffness = dict(contact.PAIRS[1:])  # of each mass ratio one is enough

    def right(beta, e):
        zeta2 = stiffness[beta]
        return beta + max(0.0, e * beta - zeta2 / e if e else 0.0)

    monkeypatch.setattr(contact, "PAIRS", tuple(stiffness.items()))
    monkeypatch.setattr(slip, "slip_throughout_limit", right)
    name = "slip-throughout-limit"
    row = checking.check({name: by_equations(name)})[0]
    assert row["holds"] == "no" and "recorded as wrong, found confirmed" in row["problem"]


def test_a_check_that_crashes_no_longer_holds(monkeypatch):
    def crash(*args, **kwargs):
        raise ArithmeticError("oh")

    monkeypatch.setattr(lumped, "history", crash)
    row = checking.check({"eq-12": ENTRIES["eq-12"]})[0]
    assert row["holds"] == "no" and row["problem"] == "ArithmeticError: oh"


def test_the_second_verdict_never_changes_the_first(rows):
    """Counts of the first are those without it, and each entry keeps what its equations gave."""
    with_both = Counter(row["verdict"] for row in rows.values())
    assert with_both == Counter(entry["verdict"] for entry in ENTRIES.values())
    assert {name: row["in_nature"] for name, row in rows.items() if row["in_nature"]} == {
        name: claim["verdict"] for name, claim in CLAIMS.items()
    }
    name = "restitution-leaves-peak"
    alone = checking.check({name: by_equations(name)})[0]
    assert all(rows[name][key] == alone[key] for key in alone if "nature" not in key)


def test_a_sentence_about_restitution_has_a_second_verdict():
    """The words of the paper in our words, and the limit (1 + e) m2/m1."""
    speaks_of_e = re.compile(
        r"\brestitution\b|\binternal dissipation\b|\(1 \+ e\)|whatever e\b|\be\^2\b"
    )
    sentences = {name for name, entry in ENTRIES.items() if entry["kind"] == "sentence"}
    found = {name for name in sentences if speaks_of_e.search(ENTRIES[name]["says"])}
    # A definition, the shape of a formula, when slip begins, and the work of the elements.
    others = {"hysteresis-caption", "slip-in-restitution", "stored-work"}
    assert found - others <= set(CLAIMS)


@pytest.fixture(scope="module")
def measured(first_run):
    """What the measures in nature found in a run."""
    with open(first_run[0] / "results/in_nature.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    return {row["measure"]: {m: float(row[m]) for m in finding.MODELS} for row in rows}


@pytest.mark.parametrize("name", JUDGED_CLAIMS)
def test_a_wrong_claim_in_nature_does_not_hold(name, measured):
    """Each verdict but the right one, and numbers outside the bounds on either side."""
    claim = CLAIMS[name]
    assert not checking.judge(claim, measured)
    for verdict in {finding.STANDS, finding.FAILS, finding.DEPENDS} - {claim["verdict"]}:
        assert checking.judge(claim | {"verdict": verdict}, measured)
    found = measured[claim["check"]]
    for loss in finding.LOSSES:
        problems = [
            checking.judge(claim, measured | {claim["check"]: found | {loss: wrong}})
            for wrong in (-9.0, 9.0, np.nan)
        ]
        # A sentence that stands has one bound, on the side where it would be false.
        assert problems[2]
        assert all(problems) or (claim["verdict"] == finding.STANDS and any(problems[:2]))


def test_a_measure_that_crashes_no_longer_holds(monkeypatch):
    def crash(*args, **kwargs):
        raise ArithmeticError("oh")

    monkeypatch.setattr(continuum, "rebound", crash)
    name = "limit-falls-with-losses"
    row = checking.check({name: ENTRIES[name]})[0]
    assert row["holds"] == "no" and row["found"]
    assert row["problem"] == "in nature: limit_rise found no number"


def test_comparisons_that_the_ledger_names_are_judged_by_the_run(first_run):
    named = {
        name
        for claim in CLAIMS.values()
        for name in re.findall(r"\binelastic-[a-z.-]+-pairs", claim["says"])
    }
    assert named
    with open(first_run[0] / "results/verdicts.csv", newline="") as file:
        verdicts = {row["comparison"]: row["verdict"] for row in csv.DictReader(file)}
    assert named <= set(configuration.load(ROOT)["comparisons"])
    for name in named:
        wanted = "agrees" if "continuum" in name else "unexplained difference"
        assert verdicts[name] == wanted, name


def test_slip_throughout_begins_in_nature_where_its_words_say(measured):
    beta, zeta2 = 3.5, 1.21
    found = measured["limit_half"]
    assert found["viscous"] == pytest.approx(beta + 0.5 * (beta - zeta2), abs=1e-3)
    # Quoted as Thornton's: the elastic limit times (1 + e)/2. The entry gives the distance.
    quoted = 1.5 * (beta - zeta2 / 2)
    assert quoted == pytest.approx(4.34, abs=5e-3)
    assert found["viscous"] - quoted == pytest.approx(0.5 * zeta2 / 2, abs=1e-3)
    assert found["paper"] == pytest.approx(beta, abs=2e-3)
    # The limit of pooltool, below m2/m1 at this e.
    assert 1.5 * beta - zeta2 / 0.5 == pytest.approx(2.83, abs=1e-9)
    law = [continuum.slip_throughout_limit(restitution=e, loss="plastic") for e in (0.5, 0.53)]
    assert law[0] == pytest.approx(5.14, abs=5e-3)
    assert found["plastic"] == pytest.approx(law[0], abs=2e-3)
    assert law[1] == beta + 0.53 * (beta - zeta2)


def page_of(rows, folder):
    """The ledger's page of some rows, as a file."""
    page = folder / "ledger.html"
    template = ROOT / "workflow/report/ledger.html"
    page.write_text(ledger_page.page(rows, "mu: friction", template), encoding="utf-8")
    return page


def test_the_head_of_the_page_names_all_that_is_wrong_by_cause(rows, tmp_path):
    html = page_of(list(rows.values()), tmp_path).read_text(encoding="utf-8")
    grades = Counter(entry["grade"] for entry in ENTRIES.values() if "grade" in entry)
    assert f"Of the wrong ones {escape(outcome.sentence_of_grades(list(rows.values())))}." in html
    head = html[html.index('<h2 id="wrong">') : html.index('<h2 id="in-nature">')]
    assert f"The {grades.total()} wrong entries" in head
    groups = head[: head.index("</ol>")].split("<li><p>")[1:]
    by_cause = {frozenset(re.findall(r'href="#([^"]+)"', group)) for group in groups}
    causes = {entry["cause"] for entry in ENTRIES.values() if "cause" in entry}
    assert by_cause == {
        frozenset(name for name, entry in ENTRIES.items() if entry.get("cause") == cause)
        for cause in causes
    }
    order = [re.findall(r'<span class="mark \w+">([^<]+)</span>', group)[0] for group in groups]
    assert order == sorted(order, key=list(outcome.GRADES).index)
    assert 'href="#slip-throughout-limit"' in groups[0]


def test_the_explorer_shows_the_impacts_that_the_entries_speak_of():
    assert set(ledger_page.IN_EXPLORER) <= set(ENTRIES)
    regimes = {
        "slip-throughout-limit": Regime.SLIP_THROUGHOUT,
        "limit-falls-with-losses": Regime.SLIP_THROUGHOUT,
        "stick-in-compression": Regime.SLIP_STICK_SLIP,
        "eq-39": Regime.STICK_SLIP,
        "eq-40": Regime.SLIP_STICK_SLIP,
    }
    for name, regime in regimes.items():
        angle, friction, restitution, _ = ledger_page.IN_EXPLORER[name]
        incidence = np.tan(np.radians(angle)) / friction
        assert lumped.rebound(incidence, 3.5, 1.21, restitution).regime == regime, name


def test_the_page_has_every_entry_and_needs_nothing_else(first_run):
    page = (first_run[0] / "figures/ledger.html").read_text()
    assert all(f'<article id="{name}"' in page for name in ENTRIES)
    assert not re.search(r"src=|href=\"(?!#|[a-z_0-9/]+\.html)", page)
    assert len(page) < 600_000
    for name in re.findall(r'href="#([^"]+)"', page):
        assert f'id="{name}"' in page
    # A formula without its dollars would show its commands or plain names.
    text = re.sub(r"<(script|style|math).*?</\1>|<[^>]*>", "", page, flags=re.S)
    assert not re.search(r"\b(zeta|mu|kappa|[Oo]mega|sqrt|sin|cos|[vuFm][12]|t_c)\b|[$^\\]", text)
    for name, entry in ENTRIES.items():
        if "derivation" in entry:
            article = page[page.index(f'<article id="{name}"') :].split("</article>")[0]
            assert "Instead:" in article


def test_an_entry_that_no_longer_holds_is_named_on_the_page(rows, monkeypatch, tmp_path):
    rebound = lumped.rebound
    monkeypatch.setattr(lumped, "rebound", lambda x, b, z, e: rebound(x, b, z, 0.9 * e))
    found = checking.check({"eq-25": ENTRIES["eq-25"]})
    assert found[0]["holds"] == "no"
    pages = [page_of(shown, tmp_path).read_text() for shown in ([rows["eq-25"]], found)]
    assert pages[1].count("no longer holds") > pages[0].count("no longer holds")


def largest_peak(model, friction, *groups):
    """Largest friction of one mu over all angles, by a grid of its own."""
    theta = np.radians(np.linspace(0.1, 89.9, 600))
    return (np.cos(theta) * model(np.tan(theta) / friction, *groups).peak_friction).max()


def test_stiffness_is_judged_over_all_poisson_ratios():
    """Over nu = 0 to 0.5 it matters more than Hertz' compliance; from 0.3 on alone it does not."""
    found = ledger.run("peak_force.stiffness_matters_more").value
    soft, paper, hard = (
        largest_peak(lumped.rebound, 0.1, 3.5, bodies.stiffness_ratio(bodies.Material(1.0, nu)))
        for nu in (0.5, 0.3, 0.0)
    )
    hertz = largest_peak(contact.without_micro_slip, 0.1)
    base = largest_peak(lumped.rebound, 0.1, *contact.SPHERE)
    assert found == pytest.approx((1 - soft / hard) / abs(hertz / base - 1), rel=0.02)
    assert found > 1 > (1 - soft / paper) / abs(hertz / base - 1)


def friction_loss(degrees, friction, restitution):
    """Share of m2 S^2/2 that friction takes, and the same without tangential compliance.

    Both by what is left: m1 v1^2/2 of the tangential motion, all of it or none where slip halts.
    """
    theta = np.radians(degrees)
    x = np.tan(theta) / friction
    left = (lumped.rebound(x, *contact.SPHERE, restitution).velocity / x) ** 2
    return np.sin(theta) ** 2 / 3.5 * np.array([1 - left, np.ones_like(x)])


def test_dissipation_at_small_angles_is_judged_on_the_axes_of_fig_9():
    """It is small with compliance and without, as the reading says."""
    ratios = {e: [] for e in (1.0, 0.5)}
    whole = []
    for e, found in ratios.items():
        for mu in (0.1, 0.5):
            soft, hard = friction_loss(np.array([1.0, 2.0, 3.0, 4.0, 5.0]), mu, e)
            found.append(soft / hard)
            whole.append(friction_loss(np.array([10.0]), mu, e)[:, 0])
    for e, quoted in ((1.0, (0.66, 0.93)), (0.5, (0.46, 0.57))):
        assert np.round([np.min(ratios[e]), np.max(ratios[e])], 2) == pytest.approx(quoted)
    assert np.round(np.max(whole, axis=0), 4).tolist() == [0.0083, 0.0086]
    found = ledger.run("dissipation.small_incidence").value
    # No more than all tangential energy, m1 v1(0)^2/2, can go.
    assert 0 < found <= np.sin(np.radians(10)) ** 2 / 3.5 < 0.01


def test_micro_slip_is_judged_by_what_the_paper_compares():
    """0.215 between its model and the continuum; 0.52 by micro-slip alone, 0.39 by Hertz alone."""
    x = np.linspace(0.0, 8.0, 201)[1:]
    models = {
        "lumped": lumped.rebound(x, *contact.SPHERE).velocity,
        "continuum": continuum.rebound(x, *contact.SPHERE, tolerance=1e-3).velocity,
        "whole": contact.without_micro_slip(x).velocity,
    }
    # Half a unit of the last figure, and what a grid of 0.04 misses of a kink of slope 1.
    for first, second, quoted in (
        ("lumped", "continuum", 0.215),
        ("whole", "continuum", 0.52),
        ("whole", "lumped", 0.39),
    ):
        assert np.abs(models[first] - models[second]).max() == pytest.approx(quoted, abs=0.025)


def test_no_sign_saves_the_equations_of_dissipation():
    """Eqs 38 to 40 are judged by the best choice of the signs that the scan leaves open."""
    gaps = {sign: [] for sign in (-1, 1)}
    for found in contact.initial_stick():
        impulse = found.friction * found.impulse_left
        energy = found.m1 * np.array([found.v1, found.final]) ** 2 / 2
        for sign, gap in gaps.items():
            lost = impulse * found.v1_t1 + sign * impulse**2 / (2 * found.m1)
            gap.append(abs(lost - (energy[0] - energy[1])) / energy[0])
    nearest = min(max(gap) for gap in gaps.values())
    assert ledger.run("dissipation.friction_after_stick").value == pytest.approx(nearest, rel=1e-6)


@pytest.mark.slow
def test_readings_quote_what_a_kept_direction_costs():
    """Eqs 15 and 24 taken for s = -1 too; with s = +1 they are exact.

    Eq. 15 is off by 0.045 mu v2(0) at most over solid spheres, by 0.008 over the paper's, where
    stick just lasts; Eq. 24 by 3.75 over the contacts of its check.
    """

    def cost(found):
        if found.slip_direction > 0:
            return 0.0
        gap = found.printed(slip.eq_24_final_velocity) - found.final
        return abs(gap / found.velocity_scale)

    def over(zeta2):
        shares, restitutions = (0.7, 0.99, 1.0), np.linspace(0.015, 0.325, 32)
        return max(
            (cost(contact.Contact(share * zeta2, 3.5, zeta2, e, 2)), share, e)
            for share in shares
            for e in restitutions
        )

    largest = {zeta2: over(zeta2) for zeta2 in (1.0, 1.21, 1.35, 1.5)}
    costs = [found[0] for found in largest.values()]
    assert costs == sorted(costs)
    assert largest[1.21][0] == pytest.approx(0.008, abs=5e-4)
    assert largest[1.5] == pytest.approx((0.045, 1.0, 0.125), abs=5e-3)
    assert max(map(cost, contact.slip_stick_slip())) == pytest.approx(3.75, abs=5e-3)


def test_losses_are_decoupled_in_collinear_impact_only():
    """Off centre friction changes what the normal element takes: 15 and 21 % of the energy."""
    rod = noncollinear.inverse_mass(1.0, 12**-0.5, 0.125**0.5, 0.125**0.5)
    energy = noncollinear.kinetic_energy(1.0, 1.0, rod)
    own = {"restitution": 0.5, "loss": "hysteretic"}
    lost = noncollinear.rebound(1.0, 1.0, rod, friction=[0.0, 0.5], **own).hysteresis
    assert np.round(lost / energy, 2).tolist() == [0.15, 0.21]


def test_strain_energy_is_given_back_by_the_spring_but_not_all_to_the_body():
    """85 % is quoted in the reading of strain-recovered; at e = 0 the spring keeps all it has."""
    assert abs(lumped.history(2.0, *contact.SPHERE, 0.0).spring[-1]) > 0.1
    shares = []
    for found in contact.with_stick():
        gained = found.m1 * (found.final**2 - found.v1_t3**2) / 2
        held = found.stiffness / found.stiffness_ratio * found.onset.u1**2 / 2
        shares.append(gained / held)
    assert max(shares) == pytest.approx(0.85, abs=5e-3)


def test_sliding_of_the_particle_may_speed_up_where_that_of_the_body_slows():
    """At e = 0.5 by zeta^2/e - e m2/m1 = 0.67, as the reading of sliding-slows has it."""
    found = lumped.history(8.0, *contact.SPHERE, 0.5, samples=20001)
    sliding = found.velocity - np.gradient(found.spring, found.time * np.pi / 2)
    inside = (found.time > 1.001) & (found.time < 1.499)
    change = sliding[inside][-1] - sliding[inside][0]
    assert change == pytest.approx(0.67, abs=0.01)


def test_the_natural_frequencies_hang_on_one_exponent():
    """With zeta^2 under the root the formula of p. 438 is exact, with zeta^4 it is off by 6 %."""
    mass, gyration, x1, x2, zeta2 = 2.3, 0.7, 0.4, -0.9, 1.4
    inverse = dynamics.eq_1_inverse_mass(mass, gyration, x1, x2)
    m1, m2 = dynamics.eq_2_effective_masses(mass, gyration, x1, x2)
    exact = np.sqrt(np.sort(np.linalg.eigvals(inverse @ np.diag([1 / zeta2, 1.0]))))
    ratio, coupled = zeta2 * m1 / m2, 4 * m1**2 * x1**2 * x2**2 / (mass**2 * gyration**4)
    off = {}
    for exponent in (2, 4):
        root = np.sqrt((1 - ratio) ** 2 + coupled * zeta2 ** (exponent / 2))
        squares = (1 + ratio + np.array([-root, root])) / (2 * m1 * zeta2)
        off[exponent] = np.abs(np.sqrt(squares) / exact - 1).max()
    assert off[2] < 1e-12
    assert off[4] == pytest.approx(0.06, abs=5e-3)
