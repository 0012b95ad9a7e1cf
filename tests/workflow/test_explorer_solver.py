"""Both solvers of the explorer agree with the package, and a wrong one would be seen."""

import json
import math
import re
from pathlib import Path

import numpy as np
import pytest

from planarimpact import Regime, bodies, lumped, rigid
from stronge1994.explorer import page as write_explorer
from tests.workflow import browser

SOLVER = Path(__file__).parents[2] / "workflow/explorer/solver.js"
ACCURACY = 1e-9
# |T| meets N behind its crest for an instant: a search that ended early has lost that slip.
LOST_SLIPS = [
    (0.7479681011096113, 3.847930832708696, 0.3742534479740521, 0.3433422554521216),
    (0.3050717050640781, 5.529161641552116, 0.25370110146354574, 0.29494552140110963),
]


def impacts():
    """Impacts over the box of the sliders, and on and beside every threshold in it."""
    rng = np.random.default_rng(1994)
    low, high = np.array([write_explorer.LIMITS[name][:2] for name in write_explorer.OF_FIGURES]).T
    angle, mu, e, nu, beta = rng.uniform(low, high, (400, 5)).T
    e = np.where(rng.random(400) < 0.3, 10.0 ** rng.uniform(-16, 0, 400), e)
    zeta2 = (2 - nu) / (2 * (1 - nu))
    rows = list(zip(np.tan(np.radians(angle)) / mu, beta, zeta2, e, strict=True))
    for beta in (1.0, 1.2, 2.5, 3.5, 10.0):
        for zeta2 in (1.0, 1.2, 1.21, 17 / 14, 1.5):  # 1 and 1.2 in resonance with beta
            resonance = math.sqrt(min(zeta2 / beta, 1.0))  # of restitution
            for e in (0.0, 5e-324, 1e-12, 0.3, 0.588, resonance, 1 - 2**-53, 1.0):
                edges = zeta2, beta, lumped.slip_throughout_limit(beta, zeta2, e), (1 + e) * beta
                beside = [math.nextafter(x, to) for x in edges for to in (0, math.inf)]
                rows += [(x, beta, zeta2, e) for x in (0.0, 1.0, 2.0, *edges, *beside)]
    rows += [(x, 3.5, 1.21, e) for x in (1e-12, 57.0, 57295.0) for e in (0.0, 0.5, 1.0)]
    return [tuple(map(float, row)) for row in rows]


def expected(rows):
    """Velocity, peak friction, dissipation and regime by the package."""
    found = lumped.rebound(*np.transpose(rows))
    names = [Regime(code).name for code in found.regime]
    return found.velocity, found.peak_friction, found.dissipation, names


def disagreements(tab, rows, wanted, solver="solver", accuracy=ACCURACY):
    """Rows that the solver of the page solves otherwise; `solver` is a JavaScript expression."""
    fields = "[found.velocity, found.peak_friction, found.dissipation, found.regime]"
    one = f"(row) => {{ const found = solver.rebound(...row); return {fields}; }}"
    solved = tab.evaluate(f"((solver) => {json.dumps(rows)}.map({one}))({solver})")
    *numbers, regimes = zip(*solved, strict=True)
    # Velocity and dissipation of a grazing blow are as large as its incidence.
    size = np.maximum(np.array(rows)[:, 0], 1.0)
    close = [
        np.abs(np.array(ours, float) - theirs) <= accuracy * size
        for ours, theirs in zip(numbers, wanted[:3], strict=True)
    ]
    same = [ours == theirs for ours, theirs in zip(regimes, wanted[3], strict=True)]
    return [row for row, good in zip(rows, np.all([*close, same], axis=0), strict=True) if not good]


def test_rebound_is_that_of_the_package(show):
    rows = impacts()
    assert len(rows) > 2000
    assert disagreements(show(), rows, expected(rows)) == []


def last_directions(tab, rows):
    """Directions of the last slips, by the solver of the page."""
    last = "solver.history(...row, 2).at(-1).side"
    return np.array(tab.evaluate(f"{json.dumps(rows.T.tolist())}.map((row) => {last})"))


def beside_switches(tab, count):
    """Impacts around changes of the last direction of slip, where slip may be lost: by bisection.

    Incidence and restitution are moved; e omega/Omega is 1 to 6, beyond the sliders.
    """
    rng = np.random.default_rng(1994)
    beta, e = rng.uniform(1, 10, count), rng.uniform(0.1, 1, count)
    zeta2 = beta * (e / rng.uniform(1, 6, count)) ** 2
    low = np.array([rng.random(count) * zeta2, beta, zeta2, e])
    high = np.array([rng.random(count) * zeta2, beta, zeta2, rng.uniform(0.1, 1, count)])
    side = last_directions(tab, low)
    changes = side != last_directions(tab, high)
    low, high, side = low[:, changes], high[:, changes], side[changes]
    for _ in range(60):
        middle = (low + high) / 2
        same = last_directions(tab, middle) == side
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    near = 10.0 ** np.arange(-16, -3.5)
    around = np.concatenate([1 - near, [1], 1 + near])
    rows = np.repeat(low, around.size, axis=1)
    rows[0] *= np.tile(around, side.size)
    return rows.T.tolist()


def test_no_slip_is_lost_beside_a_change_of_its_last_direction(show):
    """To 1e-12: a hundred times rounding, 2^-53, at a condition of up to 5 beta = 50, in both."""
    tab = show()
    rows = LOST_SLIPS + beside_switches(tab, 400)
    assert len(rows) > 2000
    assert disagreements(tab, rows, expected(rows), accuracy=1e-12) == []


@pytest.mark.parametrize(
    ("search", "row"),
    [
        ("crossing", (1.0, 3.5, 1.21, 1.0)),
        ("reach_behind_crest", (0.75, 8.1, 0.66, 0.74)),
        ("in_compression", (1.9, 1.0, 2.0, 0.5)),
    ],
)
def test_a_search_that_does_not_end_says_so(search, row, show):
    text = SOLVER.read_text(encoding="utf-8")
    assert "MOST_TURNS = 100" in text
    body = text.replace("MOST_TURNS = 100", "MOST_TURNS = 1").replace("const solver = ", "return ")
    with pytest.raises(browser.Error, match=rf"no onset of slip after 1 turns\s.*\s.*{search}"):
        show().evaluate(f"(() => {{ {body} }})().rebound(...{json.dumps(row)})")


FAULTS = {
    "zeta^2 squared": ("    let found;", "    zeta2 *= zeta2; let found;"),
    "restitution off by 1e-8": ("    let found;", "    e *= 1 - 1e-8; let found;"),
    "last slip always reversed": ("wave % 2 === 0 ? held.side : -held.side", "-held.side"),
    "limit as printed": ("beta + restick_coefficient(beta, zeta2, e)", "(1 + e) * beta"),
    "friction always at its limit": ("rising ? force(eta) : held.amplitude", "1"),
    "work of the last slip forgotten": ("+= (ahead * (here + there)) / 2", "+= 0"),
}


@pytest.mark.parametrize("fault", ["none", *FAULTS])
def test_a_wrong_solver_is_seen(fault, show):
    old, new = FAULTS.get(fault, ("", ""))
    text = SOLVER.read_text(encoding="utf-8")
    assert old in text
    body = text.replace(old, new, 1).replace("const solver = ", "return ")
    rows = impacts()[::9]
    found = disagreements(show(), rows, expected(rows), f"(() => {{ {body} }})()")
    assert bool(found) == (fault != "none")


@pytest.mark.parametrize(
    "answer",
    [
        "return { velocity, peak_friction, dissipation, regime }",
        "velocity, peak_friction: peak / largest",
    ],
    ids=["solver", "continuum"],
)
def test_a_page_with_a_wrong_solver_says_so(answer, show, explorer, tmp_path):
    alert = "document.querySelector('main > [role=alert]')?.textContent ?? ''"
    tab = show()
    assert tab.evaluate(alert) == ""
    page = explorer.read_text(encoding="utf-8")
    assert page.count(answer) == 1
    page = page.replace(answer, answer.replace("velocity,", "velocity: 0.9 * velocity,"))
    (tmp_path / "wrong.html").write_text(page, encoding="utf-8")
    tab.open((tmp_path / "wrong.html").as_uri())
    assert tab.evaluate(alert).startswith("Do not trust this page: its solver differs")


def contacts():
    """Impacts whose course is compared: in every regime, on thresholds and beside them."""
    rows = [
        (x, beta, zeta2, e)
        for beta, zeta2 in ((3.5, 1.21), (1.0, 1.0), (1.2, 1.5), (10.0, 1.0))
        for e in (0.0, 1e-9, 0.5, 1.0)
        for x in (0.0, 0.5, 1.0, 2.5, 6.0, 30.0, zeta2, beta)
    ]
    beside = [math.nextafter(x, to) for x in (1.21, 3.5, 5.79) for to in (0, math.inf)]
    return rows + [(x, 3.5, 1.21, 1.0) for x in beside]


COLUMNS = "time", "normal", "friction", "velocity"


def test_history_is_that_of_the_package(show):
    rows, tab = contacts(), show()
    one = (
        f"(row) => solver.history(...row, 21).map((at) => {json.dumps(COLUMNS)}.map((n) => at[n]))"
    )
    found = tab.evaluate(f"{json.dumps(rows)}.map({one})")
    for row, ours in zip(rows, found, strict=True):
        course = lumped.history(*row, samples=21)
        theirs = np.transpose([getattr(course, name) for name in COLUMNS])
        # Just below x = beta it sticks for an instant: where |T| touches N again is open by
        # rounding, by its square root, 1.5e-8.
        bound = 1e-7 if row[0] == math.nextafter(row[1], 0) else ACCURACY
        assert np.shape(ours) == theirs.shape and np.abs(ours - theirs).max() <= bound, row


def test_rigid_limit_and_ratios_are_those_of_the_package(show, explorer):
    tab, rows = show(), impacts()[::7]
    x, beta, _, e = np.transpose(rows)
    one = "([x, beta, zeta2, e]) => Object.values(solver.rigid_rebound(x, beta, e))"
    found = np.array(tab.evaluate(f"{json.dumps(rows)}.map({one})"))
    wanted = np.transpose(rigid.rebound(x, beta, restitution=e)[:3])
    assert np.all(np.abs(found - wanted) <= ACCURACY * np.maximum(x, 1)[:, None])
    for nu in (0.0, 0.3, 0.5):
        tab = show(f"poisson_ratio={nu}")
        ratio = float(tab.evaluate("document.getElementById('stiffness_ratio').textContent"))
        assert abs(ratio - bodies.stiffness_ratio(bodies.Material(1.0, nu))) <= 5e-4
    written = re.findall(r'data-mass_ratio="(.*?)">(.*?)<', explorer.read_text(encoding="utf-8"))
    assert written == [("3.5", "solid sphere"), ("2.5", "thin shell"), ("3.0", "disc")]
