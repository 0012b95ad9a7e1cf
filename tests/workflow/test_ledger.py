"""The ledger of the paper: complete, judged in both directions, and shown.

That every entry holds is what a run says. The readings quote numbers, which are found here in other
ways.
"""

import ast
import copy
import inspect
import math
import re
from collections import Counter
from dataclasses import replace

import numpy as np
import pytest
from markupsafe import escape

from planarimpact import continuum, lumped, noncollinear
from stronge1994 import ledger_table, tables
from stronge1994.formulas import mathematical, plain
from stronge1994.pages import ledger_page
from stronge1994.paper import checking, contact, dynamics
from stronge1994.paper.contact import State
from stronge1994.paper.entry import Finding, finding_of
from stronge1994.printed import equations
from tests.workflow.page import flat
from tests.workflow.project import ledger

ENTRIES = ledger()
EXECUTED = {name: entry for name, entry in ENTRIES.items() if entry.check}
EQUATIONS = [name for name, entry in EXECUTED.items() if entry.kind == "equation"]
RIGHT = {"verdict": "confirmed", "criterion": {"at_most": 1e-9}}
LARGE = {"verdict": "confirmed", "criterion": {"at_least": 0.9}}
ROUNDED = {"verdict": "confirmed within rounding", "criterion": {"value": 1.7, "rounding": 0.05}}
WRONG = {"verdict": "wrong", "criterion": {"at_most": 1e-9}}


@pytest.fixture(scope="module")
def rows(first_run):
    """What a run with the right solver has found."""
    return {row["entry"]: row for row in tables.read_rows(first_run[0] / "results/ledger.csv")}


@pytest.mark.parametrize(
    ("entry", "found", "why"),
    [
        (RIGHT, Finding(0.0), ""),
        (RIGHT, Finding(2e-9), "recorded as confirmed, found wrong"),
        (RIGHT, Finding(math.nan), "it found no number"),
        (LARGE, Finding(0.9), ""),
        (LARGE, Finding(0.8999), "recorded as confirmed, found wrong"),
        (ROUNDED, Finding(1.7 + 2e-9), ""),
        (ROUNDED, Finding(1.7), "recorded as confirmed within rounding, found confirmed"),
        (ROUNDED, Finding(1.7501), "recorded as confirmed within rounding, found wrong"),
        (WRONG, Finding(1.0), ""),
        (WRONG, Finding(1.0, 1e-10), ""),
        (WRONG, Finding(1.0, 2e-9), "the corrected formula is off by 2e-09"),
        (WRONG, Finding(1.0, math.nan), "the corrected formula is off by nan"),
        (WRONG, Finding(1e-12), "recorded as wrong, found confirmed"),
        (WRONG, Finding(math.nan), "it found no number"),
    ],
)
def test_an_entry_holds_or_says_why_not(entry, found, why):
    said = replace(ENTRIES["eq-01"], **entry).judge(found)
    assert said.startswith(why) and bool(said) == bool(why)


SWAPPED = {ast.Add: ast.Sub, ast.Sub: ast.Add}


def parts_of(entry):
    """The check of an entry before it became a `Finding`, and its places."""
    made = inspect.getclosurevars(entry.check).nonlocals
    return made["check"], made["at"]


def with_wrong_signs(function):
    """A function once for each plus or minus in it, which is the other one there."""
    tree = ast.parse(inspect.getsource(function))
    tree.body[0].decorator_list = []
    for node in ast.walk(tree):
        if isinstance(node, ast.BinOp) and type(node.op) in SWAPPED:
            right, node.op = node.op, SWAPPED[type(node.op)]()
            names = dict(function.__globals__)
            exec(compile(tree, "<a wrong sign>", "exec"), names)
            yield ast.unparse(node), names[function.__name__]
            node.op = right


def formulas_in(check):
    """What is printed and stands in functions of their own, with the module that has each."""
    for name in sorted({*check.__code__.co_names}):
        if re.match("eq_|table_|force_rate|slip_throughout_limit", name):
            module = inspect.getmodule(check)
            module = module if getattr(module, name, check) != check else equations
            yield module, name, getattr(module, name)


# Signs on which nothing hangs.
IDLE = {"eq-34": {"motion.at_top - 1"}, "eq-35": {"1 + slope / (motion.friction * beta)"}}


@pytest.mark.parametrize("name", EQUATIONS)
def test_a_check_notices_each_wrong_sign(name, monkeypatch):
    """In what is printed and in what it is compared with."""
    entry = EXECUTED[name]
    check, at = parts_of(entry)
    right, unseen = str(entry.run()), set()

    def found(wrong):
        try:
            return str(finding_of(wrong, at)(**entry.given))
        except (ValueError, IndexError, ArithmeticError) as error:
            return type(error).__name__

    with np.errstate(all="ignore"):
        unseen |= {sign for sign, wrong in with_wrong_signs(check) if found(wrong) == right}
        for module, formula, function in formulas_in(check):
            for sign, wrong in with_wrong_signs(function):
                with monkeypatch.context() as patch:
                    patch.setattr(module, formula, wrong)
                    if found(check) == right:
                        unseen.add(sign)
    assert unseen == IDLE.get(name, set())


def spoiled(exact, part):
    """A contact whose exact states are wrong in a part of their samples."""

    def wrong(state):
        inside = np.zeros(len(state.t))
        inside[part(len(state.t))] = 1e3
        return State(state.t, *(column + n * inside for n, column in enumerate(state[1:], 1)))

    other = copy.copy(exact)
    other.path = wrong(exact.path)
    other.between = lambda *times: wrong(exact.between(*times))
    for key in {"brought", "velocity", "displacement", "work"} & set(vars(exact)):
        setattr(other, key, getattr(exact, key) + other.path.v1 - exact.path.v1)
    return other


NOT_ALONG = "eq-04", "eq-10"  # one looks up to maximum compression, one at times alone
ALONG = [
    name
    for name in EQUATIONS
    if name not in NOT_ALONG
    and re.search(r"\.(path|between)", inspect.getsource(parts_of(EXECUTED[name])[0]))
]


@pytest.mark.parametrize("name", [n for n in ALONG if parts_of(EXECUTED[n])[1]])
def test_a_check_along_a_contact_looks_at_both_halves(name):
    check, at = parts_of(EXECUTED[name])
    places = list(at())
    right = str(finding_of(check, lambda: places)())
    for part in (lambda size: slice(size // 2), lambda size: slice(size // 2, None)):
        wrong = finding_of(check, lambda part=part: [spoiled(c, part) for c in places])()
        assert str(wrong) != right


def test_every_numbered_equation_has_an_executed_entry():
    numbers = set()
    for name in EQUATIONS:
        numbers |= {int(n) for n in re.findall(r"Eqs?[.]? (\d+)", ENTRIES[name].where)}
    assert numbers == set(range(1, 42))
    assert ENTRIES["table-1"].check


def test_a_wrong_equation_has_an_exact_correction(rows):
    wrong = [n for n, e in ENTRIES.items() if e.kind == "equation" and e.verdict == "wrong"]
    assert wrong and all(float(rows[name]["corrected"]) < 1e-12 for name in wrong)


def test_a_check_that_crashes_no_longer_holds_nor_does_a_formula_that_cannot_be_set(monkeypatch):
    def crash(*args, **kwargs):
        raise ArithmeticError("oh")

    monkeypatch.setattr(lumped, "history", crash)
    monkeypatch.setattr(contact, "_KNOWN", {})
    row = checking.check([ENTRIES["eq-12"]])[0]
    assert (row["holds"], row["problem"]) == ("no", "ArithmeticError: oh")
    words = {"why": r"$\foo$"}
    row_of_words = checking.check([replace(ENTRIES["wear-tests"], words=words)])[0]
    assert row_of_words["holds"] == "no" and "foo" in row_of_words["problem"]
    said = f"  no longer holds: eq-12 ({ENTRIES['eq-12'].where}): ArithmeticError: oh"
    assert ledger_table.summary([row]).splitlines()[-1] == said


def page_of(rows, folder):
    """The ledger's page of some rows, as a file."""
    page = folder / "ledger.html"
    page.write_text(ledger_page.page(rows), encoding="utf-8")
    return page


def test_the_head_of_the_page_names_all_that_is_wrong_by_cause(rows, tmp_path):
    html = page_of(list(rows.values()), tmp_path).read_text(encoding="utf-8")
    grades = Counter(entry.words["grade"] for entry in ENTRIES.values() if "grade" in entry.words)
    assert (
        f"Of the wrong ones {escape(ledger_table.sentence_of_grades(list(rows.values())))}." in html
    )
    head = html[html.index('<h2 id="wrong">') : html.index('<h2 id="reading">')]
    assert f"The {grades.total()} wrong entries" in head
    groups = head[: head.index("</ol>")].split("<li><p>")[1:]
    by_cause = {frozenset(re.findall(r'href="#([^"]+)"', group)) for group in groups}
    causes = {entry.words["cause"] for entry in ENTRIES.values() if "cause" in entry.words}
    assert by_cause == {
        frozenset(name for name, entry in ENTRIES.items() if entry.words.get("cause") == cause)
        for cause in causes
    }
    order = [re.findall(r'<span class="mark \w+">([^<]+)</span>', group)[0] for group in groups]
    assert order == sorted(order, key=list(ledger_table.GRADES).index)


@pytest.fixture(scope="module")
def articles(first_run):
    """Entries of the page of a run: what is seen at once, and what is folded."""
    page = (first_run[0] / "figures/ledger.html").read_text(encoding="utf-8")
    found = re.findall(r'<article id="([^"]+)".*?>(.*?)<details>(.*?)</article>', page, flags=re.S)
    return {name: parts for name, *parts in found}


def test_the_page_has_every_entry_whole(rows, articles):
    """What is seen at once, printed and corrected side by side, and what is folded."""
    assert list(articles) == list(rows) == list(ENTRIES)
    maths, later = ledger_page.linked_maths(ENTRIES), [*ledger_page.FOLDED, "test", "confirms"]
    for name, (seen, folded) in articles.items():
        row = rows[name]
        assert ('class="sides"' in seen) == (row["verdict"] == "wrong")
        sides = f"Printed: {row['says']}. Corrected: {row['correction']}"
        at_once = [row["where"], row["grade"], sides if row["correction"] else row["says"]]
        at_once.append("" if row["only_if"] else row["verdict"])
        for part, texts in (
            (seen, at_once),
            (folded, [row[key] for key in (*later, "corrected", "code")]),
        ):
            told = flat(part)
            assert [one for one in texts if flat(maths(one.rstrip("."))) not in told] == [], name


def test_an_entry_that_no_longer_holds_says_so_and_links_show_what_their_words_tell(
    first_run, rows, tmp_path
):
    row = rows["eq-25"] | {"holds": "no", "problem": "its problem"}
    head, article = page_of([row], tmp_path).read_text("utf-8").split('<article id="eq-25"')
    assert "nolongerholdsEq.25" in flat(head) and "itsproblem" in flat(article)
    page = (first_run[0] / "figures/ledger.html").read_text("utf-8")
    state = r"angle=(.*?)&friction=(.*?)&restitution=(.*?)&poisson_ratio=0.3&mass_ratio=3.5&view"
    links = re.findall(rf'{state}.*?"(.*?)</p>', page, flags=re.S)
    assert len(links) == sum(bool(entry.explorer) for entry in ENTRIES.values()) > 9
    for angle, mu, e, words in links:
        assert flat("<a" + words).endswith(f"at{angle}°,μ={mu}ande={e}.")


def test_what_is_right_only_under_a_condition_says_so_and_is_not_green(first_run, rows, articles):
    only = {
        name: entry.words["only_if"] for name, entry in ENTRIES.items() if "only_if" in entry.words
    }
    assert "eq-25" in only
    for name, (seen, _) in articles.items():
        assert ('class="mark confirmed"' in seen) == (
            ENTRIES[name].verdict == "confirmed" and name not in only
        )
        if name in only:
            assert flat(f"right only if {mathematical(only[name])}") in flat(seen)
    summary = " ".join(ledger_table.summary(list(rows.values())).split())
    assert f"confirmed, {len(only)} of them only under a condition;" in summary
    head = (first_run[0] / "figures/ledger.html").read_text(encoding="utf-8").split("<h2")[0]
    assert f"Of the confirmed ones {len(only)} are right only under a condition" in head


def test_symbols_are_explained_where_they_are_used_and_common_ones_once(first_run, articles):
    for name, part, symbols in (
        ("eq-25", 0, [r"$s$: direction of slip", "$t_3$: start of the slip"]),
        ("eq-39", 0, [r"$\alpha = \Omega t/e + (\pi/2)(1 - 1/e)$: angle", "$g_1$: normal impulse"]),
        ("eq-39", 1, [r"$\kappa$: normal stiffness"]),
    ):
        for symbol in symbols:
            assert flat(mathematical(symbol)) in flat(articles[name][part])
    head = (first_run[0] / "figures/ledger.html").read_text(encoding="utf-8").split("<h2")[0]
    often = flat(mathematical(r"$\mu$: coefficient of friction"))
    assert often in flat(head)
    assert not any(often in flat(part) for parts in articles.values() for part in parts)


def effect_of_stiffness():
    """Of zeta^2 of nu = 0.5 in place of the paper's on the largest friction, over that of Hertz."""
    theta = np.radians(np.linspace(0.1, 89.9, 2000))

    def peak(model, *groups):
        return (np.cos(theta) * model(np.tan(theta) / 0.1, *groups).peak_friction).max()

    paper, soft = peak(lumped.rebound, *contact.SPHERE), peak(lumped.rebound, 3.5, 1.5)
    return (1 - soft / paper) / abs(peak(contact.without_micro_slip) / paper - 1)


def friction_loss(degrees, friction, restitution):
    """Share of m2 S^2/2 that friction takes, and the same without tangential compliance.

    Both by what is left: m1 v1^2/2 of the tangential motion, all of it or none where slip halts.
    """
    theta = np.radians(degrees)
    x = np.tan(theta) / friction
    left = (lumped.rebound(x, *contact.SPHERE, restitution).velocity / x) ** 2
    return np.sin(theta) ** 2 / 3.5 * np.array([1 - left, np.ones_like(x)])


def losses_at_small_angles():
    """At 10 deg with compliance and without; and the least and largest ratio at 1 to 5 deg."""
    small = {
        e: [np.divide(*friction_loss(np.arange(1.0, 6.0), mu, e)) for mu in (0.1, 0.5)]
        for e in (1.0, 0.5)
    }
    ratios = [extreme(small[e]) for e in small for extreme in (np.min, np.max)]
    return [*friction_loss(10.0, 0.1, 1.0), *ratios]


def gaps_of_micro_slip():
    """Of Hertz' law without micro-slip from the continuum, and from the lumped model."""
    x = np.linspace(0.0, 8.0, 201)[1:]
    both = continuum.rebound(x, *contact.SPHERE, tolerance=1e-3), lumped.rebound(x, *contact.SPHERE)
    whole = contact.without_micro_slip(x).velocity
    return [np.abs(whole - model.velocity).max() for model in both]


def cost_of_a_kept_direction(contacts):
    """How far Eqs 15 and 24 are off where s = -1; with s = +1 they are exact."""
    gaps = [
        abs(
            (found.v1_t3 - found.friction / found.m1 * found.impulse_left - found.final)
            / found.velocity_scale
        )
        for found in contacts
        if found.slip_direction < 0
    ]
    return max(gaps)


def just_sticking(zeta2):
    """Contacts of which stick just lasts, or hardly so."""
    shares, restitutions = (0.7, 0.99, 1.0), np.linspace(0.015, 0.325, 32)
    return [
        contact.Contact(share * zeta2, 3.5, zeta2, e, 2) for share in shares for e in restitutions
    ]


def hysteresis_of_a_rod():
    """Its share of the energy, without friction and with it."""
    rod = noncollinear.inverse_mass(1.0, 12**-0.5, 0.125**0.5, 0.125**0.5)
    own = {"restitution": 0.5, "loss": "hysteretic"}
    lost = noncollinear.rebound(1.0, 1.0, rod, friction=[0.0, 0.5], **own).hysteresis
    return lost / noncollinear.kinetic_energy(1.0, 1.0, rod)


def share_of_the_body():
    """The most that the body gets of what the spring holds at the start of the last slip."""
    return max(
        found.m1
        * (found.final**2 - found.v1_t3**2)
        / (found.stiffness / found.stiffness_ratio * found.onset.u1**2)
        for found in contact.with_stick()
    )


def speeding_up_of_the_particle():
    """In restitution, while the body slows."""
    found = lumped.history(8.0, *contact.SPHERE, 0.5, samples=20001)
    sliding = found.velocity - np.gradient(found.spring, found.time * np.pi / 2)
    inside = (found.time > 1.001) & (found.time < 1.499)
    return sliding[inside][-1] - sliding[inside][0]


def errors_of_frequencies():
    """Of the formula with zeta^2 under the root, and with zeta^4."""
    mass, gyration, x1, x2, zeta2 = 2.3, 0.7, 0.4, -0.9, 1.4
    inverse = dynamics.eq_1(mass, gyration, x1, x2)
    m1, m2 = dynamics.eq_2(mass, gyration, x1, x2)
    exact = np.sqrt(np.sort(np.linalg.eigvals(inverse @ np.diag([1 / zeta2, 1.0]))))
    ratio, coupled = zeta2 * m1 / m2, 4 * m1**2 * x1**2 * x2**2 / (mass**2 * gyration**4)
    for factor in (zeta2, zeta2**2):
        root = np.sqrt((1 - ratio) ** 2 + coupled * factor)
        squares = (1 + ratio + np.array([-root, root])) / (2 * m1 * zeta2)
        yield np.abs(np.sqrt(squares) / exact - 1).max()


def limit_of_a_viscous_material():
    """Where slip throughout begins at e = 0.5."""
    return continuum.slip_throughout_limit(restitution=[0.5], loss="viscous")[0]


def test_what_entries_say_of_continua_that_lose_energy_is_so():
    """Beside the limit of slip throughout, which is among the numbers below."""
    x, (beta, zeta2) = np.linspace(0.1, 8.0, 80), contact.SPHERE
    for loss in ("viscous", "plastic"):
        given = {"loss": loss, "tolerance": 1e-3}
        half, whole = (continuum.rebound(x, beta, zeta2, e, **given) for e in (0.5, 1.0))
        # restitution-leaves-peak, restitution-change-falls
        assert np.abs(half.peak_friction - whole.peak_friction).max() > 0.05
        assert half.velocity.min() > whole.velocity.min() + 0.1
        slid = continuum.rebound(1.65 * beta, beta, zeta2, 0.5, **given).dissipation
        stated = equations.eq_41_friction(1.65 * beta, beta, 1.0, 0.5) / 2  # eq-41
        assert slid < 0.95 * stated if loss == "viscous" else abs(slid / stated - 1) < 1e-3
        half, whole = (continuum.history(1.0, beta, zeta2, e, **given) for e in (0.5, 1.0))
        assert half.time[-1] > 1.55  # duration
        at_top = [np.interp(1.0, one.time, one.velocity) for one in (half, whole)]
        assert abs(at_top[0] - at_top[1]) > 0.05  # compression-unaffected
        impulse = contact.cumulative(half.normal, half.time)
        depth = contact.cumulative(np.interp(1.0, half.time, impulse) - impulse, half.time)
        assert depth[-1] / np.interp(1.0, half.time, depth) < 0.7  # final-indentation
    paper = [lumped.rebound(x, beta, zeta2, e).velocity.min() for e in (0.5, 1.0)]
    assert paper[0] < paper[1] - 0.1
    # peak-in-compression
    late = continuum.history(2.5, beta, zeta2, 0.5, loss="plastic", tolerance=1e-3)
    assert late.time[np.argmax(np.abs(late.friction_force))] > 1.0


# Numbers that the words of an entry quote beside the one that it is judged by: half a unit of the
# last figure, or what a grid misses.
QUOTED = {
    "stiffness-matters-more": (effect_of_stiffness, 0.76, 5e-3),
    "almost-no-dissipation": (
        losses_at_small_angles,
        [0.0083, 0.0086, 0.66, 0.93, 0.46, 0.57],
        [5e-5, 5e-5, 5e-3, 5e-3, 5e-3, 5e-3],
    ),
    "models-differ-most": (gaps_of_micro_slip, [0.52, 0.39], 0.025),
    "eq-24": (lambda: cost_of_a_kept_direction(contact.slip_stick_slip()), 3.75, 5e-3),
    "last-slip-reverses-after-stick": (
        lambda: [cost_of_a_kept_direction(just_sticking(zeta2)) for zeta2 in (1.21, 1.5)],
        [0.008, 0.045],
        5e-4,
    ),
    "losses-decoupled": (hysteresis_of_a_rod, [0.15, 0.21], 5e-3),
    "strain-recovered": (share_of_the_body, 0.85, 5e-3),
    "sliding-slows": (speeding_up_of_the_particle, 0.67, 0.01),
    "formula-natural-frequencies": (errors_of_frequencies, [0.0, 0.06], [1e-12, 5e-3]),
    "slip-throughout-limit": (limit_of_a_viscous_material, 4.645, 1e-12),
}


@pytest.mark.parametrize("name", QUOTED)
def test_numbers_that_an_entry_quotes_are_found_in_another_way(name):
    compute, quoted, within = QUOTED[name]
    assert name in ENTRIES
    found = compute()
    found = found if np.isscalar(found) else np.array(list(found))
    assert np.all(np.abs(found - quoted) <= within), found


def corrected_by(name, **values):
    """Value of the first formula of a correction, whose letters have these values."""
    formula = ENTRIES[name].words["correction"].split("$")[1].rpartition(" = ")[2]
    text = plain(f"${formula}$").replace("^2", "**2")
    return eval(re.sub(r"(?<=[\w)]) (?=[\w(])", " * ", text), {"max": max} | values)


def test_closed_formulas_that_the_ledger_prints_as_corrections_are_right():
    """At restitutions, too, of which the words beside them say nothing."""
    beta, zeta2 = contact.SPHERE
    angles = np.linspace(50.0, 80.0, 3001)
    for e in (0.3, 0.5, 0.8, 1.0):
        letters = {"e": e, "mu": 0.3, "m2": beta, "m1": 1.0, "zeta": np.sqrt(zeta2)}
        limit = max(corrected_by("slip-throughout-limit", **letters), zeta2)
        assert limit == pytest.approx(lumped.slip_throughout_limit(beta, zeta2, e), rel=1e-12)
        largest = angles[np.argmax(friction_loss(angles, 0.3, e)[0])]
        angle = np.degrees(np.arctan(corrected_by("largest-dissipation-angle", **letters))) / 2 + 90
        assert abs(angle - largest) < 0.01


def test_entries_stand_on_pages_of_the_paper_and_equations_in_their_order():
    pages = {n: [int(page) for page in re.findall(r"\d{3}", e.where)] for n, e in ENTRIES.items()}
    assert all(found and 435 <= min(found) <= max(found) <= 450 for found in pages.values())
    numbered = [pages[name][0] for name in sorted(ENTRIES) if re.fullmatch(r"eq-\d\d", name)]
    assert numbered == sorted(numbered) and len(numbered) > 35
