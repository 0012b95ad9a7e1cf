"""The table of spheres against the continuum that it stands for: a search for its largest error.

It begins at the ends of patches, at nodes of the splines and midway between them, beside all these,
and at random places. From the worst of them it climbs: it tries places around them, nearer and
nearer. Errors of velocity and work are in proportion to zeta^2: the largest one of the stated bound
is tried; beyond it the bound is in proportion, too. Those of
plastic dissipation grow with the incidence, so the climb of that one leads to large incidences.
Below x = 1 errors are in proportion to x: there the second code is asked, as the continuum would
take very many steps. The suite tries what searches found and the impacts around it; the profile
`long` climbs.
"""

import io

import numpy as np
import pytest

from planarimpact import Regime, continuum, export, spheres
from planarimpact.spheres import table
from tests.package_tables import spheres_tables, spheres_thresholds
from tests.reference_solutions import inelastic_contact

# Of the continuum, whose errors are below half of it. Next to e = 0.3 a plastic one meets no less.
TOLERANCE = {"viscous": 4e-5, "plastic": 2e-4}
FIELDS = "velocity", "peak_friction", "dissipation"
# Impacts at the beginning; places that are climbed from, places tried around each, and rounds.
LONG, MANY = (6000, 60, 12, 12), (8000, 100, 12, 6)
STEP, NEARER = 0.5, 0.6  # intervals of the splines
# Wrong with a table of a polynomial in each cell: x, m2/m1, zeta^2, e.
FOUND = {
    "viscous": [
        (3.1, 3.5, 3.18, 0.1),  # at the ends of the range, which were not wrong
        (3.9, 3.5, 1.0, 0.988),
        (1.4590344, 3.5, 1.05169847, 0.91186067),
        (2.08094792, 4.99192512, 1.5, 0.91186067),
        (1.96763717, 5.03710089, 1.5, 1.0),
    ],
    "plastic": [
        (0.645215, 3.5, 1.5, 0.435372),
        (1.17699264, 5.01968858, 1.5, 0.30633054),
        (0.505247, 3.5, 17 / 14, 0.314021),
        (1.6000655863, 3.45305838, 1.6, 0.35718138821472795),
        (1.576, 5.6, 1.6, 0.3),  # with coarser splines
        # Dissipation of impacts that leave fast:
        (17.6377, 2.50157, 1.6, 0.303126),
        # Of the upper panel, which was not wrong:
        (1.2, 3.5, 1.2, 0.88),
        (4.0, 5.2, 1.5, 0.95),
        # At the least mass over stiffness ratio, nor were these:
        (4.4728488, 1.77968365, 1.6, 0.55210956),
        (1.0, 1.76, 1.6, 0.8787),
        (1.9383202, 1.77982391, 1.6, 0.95106185),
    ],
}


def bound_of(name):
    """What the package states for a panel, or for a loss as a whole."""
    return (spheres.ERROR_BOUND | spheres.PANEL_BOUND)[name]


def errors(name, x, beta, zeta2, e):
    """Differences of velocity, peak friction and work, and their bounds: shape (2, 3, n)."""
    loss = table.loss_of(name)
    found = spheres.rebound(x, beta, zeta2, e, loss=loss)
    exact = continuum.rebound(x, beta, zeta2, e, loss=loss, tolerance=TOLERANCE[loss])
    return with_bounds(found, exact, beta, bound_of(name) * np.maximum(zeta2 / 1.6, 1.0), loss)


def with_bounds(found, exact, beta, bound, loss):
    """As `errors`; plastic dissipation follows from the velocity, and so does its bound."""
    error = np.stack([np.abs(getattr(found, field) - getattr(exact, field)) for field in FIELDS])
    work = bound * (np.abs(found.velocity) + bound / 2) / beta if loss == "plastic" else bound
    return np.stack([error, [bound, bound, work]])


def places(random, name, count):
    """Patches and places in them, shapes (n,) and (3, n)."""
    panel = table.shipped().panels[name]
    number = random.integers(0, panel.intervals.size, count)
    intervals = np.stack([panel.intervals[number], *intervals_over_groups(panel, count)])
    node = random.integers(0, intervals + 1)
    ends = random.integers(0, 2, (3, count))
    kinds = [random.random((3, count)), node / intervals, (node + 0.5) / intervals, ends]
    at = np.choose(random.integers(0, len(kinds), (3, count)), kinds)
    beside = random.choice([-1, 0, 1], (3, count)) * 10 ** random.uniform(-12, -2, (3, count))
    return number, np.clip(at + beside, 0.0, 1.0)


def intervals_over_groups(panel, count):
    """Intervals of the splines over t and u, for each of so many places."""
    return [np.full(count, size - table.ORDER + 1) for size in panel.velocity.shape[1:]]


def impacts(name, number, at):
    """x, mass ratio, stiffness ratio and restitution at places of patches."""
    shipped = table.shipped()
    panel = shipped.panels[name]
    found = np.empty((3, number.size))
    for patch in range(panel.intervals.size):
        rows = number == patch
        found[:, rows] = spheres_tables.impacts(
            name, panel.edges, shipped.limits, patch, *at[:, rows]
        )
    y, b, e = found
    b, e = admitted(table.loss_of(name), b, e)
    zeta2 = np.full(b.size, spheres.STATED_STIFFNESS)
    return y * zeta2, b * zeta2, zeta2, e


def admitted(loss, b, e):
    """The nearest b and e of the table's range."""
    b = np.clip(b, spheres.LEAST_RATIO, spheres.LARGEST_RATIO)
    return b, np.clip(e, spheres.LEAST_RESTITUTION[loss], 1.0)


def climbed(random, name, budget, errors=errors):
    """The worst error that is found, over its bound, what it is of, and its impact."""
    count, best, around, rounds = budget
    panel = table.shipped().panels[name]
    number, at = places(random, name, count)
    chosen = impacts(name, number, at)
    error = errors(name, *chosen)
    step = STEP
    for _ in range(rounds):
        # The worst places of all three functions; those tried so far stay.
        top = np.unique(np.argsort(error[0], axis=1)[:, -best:])
        number, at, error = number[top], at[:, top], error[..., top]
        near = np.repeat(number, around)
        intervals = np.stack([panel.intervals[near], *intervals_over_groups(panel, near.size)])
        moved = np.repeat(at, around, axis=1) + random.normal(0, step, (3, near.size)) / intervals
        moved = np.clip(moved, 0.0, 1.0)
        number, at = np.concatenate([number, near]), np.concatenate([at, moved], axis=1)
        error = np.concatenate([error, errors(name, *impacts(name, near, moved))], axis=2)
        step *= NEARER
    share = error[0] / error[1]
    field, worst = np.unravel_index(np.argmax(share), share.shape)
    impact = [float(group[worst]) for group in impacts(name, number, at)]
    return share[field, worst], FIELDS[field], impact


@pytest.mark.long
@pytest.mark.parametrize("name", table.ROOTS)
@pytest.mark.parametrize("seed", [1, 2, 3])
def test_no_search_finds_an_error_beyond_the_bound(name, seed):
    share, *words = climbed(np.random.default_rng([20, seed]), name, LONG)
    assert share <= 1, (share, *words)


@pytest.mark.parametrize("name", table.ROOTS)
def test_the_coarse_table_is_as_near_as_it_says(name, monkeypatch):
    """Against the fine one, which is so fast that the search may be long."""
    loss, fine, coarse = table.loss_of(name), table.shipped(), table.shipped("coarse")
    bound = export.BOUNDS["coarse"][loss] - spheres.ERROR_BOUND[loss]

    def differences(_, *impacts):
        answers = []
        for shipped in (fine, coarse):  # the search is in the patches of the last one
            monkeypatch.setattr(table, "shipped", lambda found=shipped: found)
            answers.append(spheres.rebound(*impacts, loss=loss))
        x, beta, *_ = impacts
        return with_bounds(*answers[::-1], beta, bound * np.minimum(x, 1.0), loss)

    monkeypatch.setattr(table, "shipped", lambda: coarse)
    share, *words = climbed(np.random.default_rng(50), name, MANY, differences)
    assert 0 < share <= 1, (share, *words)


@pytest.mark.parametrize("name", table.ROOTS)
@pytest.mark.parametrize(
    "count", [1, pytest.param(60, marks=pytest.mark.long)], ids=["one", "many"]
)
def test_below_x_of_1_the_error_is_over_x(name, count):
    """At random b and e, and incidences down to 1e-9."""
    x, zeta2 = np.array([1e-9, 1e-3, 0.02, 0.05, 0.1, 0.9]), 1.6
    loss, shipped = table.loss_of(name), table.shipped()
    for t, u in np.random.default_rng(21).random((count, 2)):
        b = spheres_tables.b_at(loss, u)
        e = spheres_tables.e_at(name, t, table.limits_at(shipped, np.array([b]))[:, 0])
        b, e = admitted(loss, b, min(e, inelastic_contact.LARGEST_RESTITUTION))
        wanted = inelastic_contact.small_incidences(loss, x, b * zeta2, zeta2, e)
        found = spheres.rebound(x, b * zeta2, zeta2, e, loss=loss).velocity / x
        bound = bound_of(name) + inelastic_contact.SMALL
        np.testing.assert_allclose(found, wanted, rtol=0, atol=bound, err_msg=str((b, e)))


@pytest.mark.parametrize("loss", spheres.LOSSES)
def test_the_regime_is_right_nearly_everywhere(loss):
    """Impacts that slip as a whole more often than once are not told apart."""
    random = np.random.default_rng(40)
    zeta2, e, share = random.uniform([[1.0], [0.3], [0.0]], [[1.5], [1.0], [1.0]], (3, 100))
    chosen = share * 3.5 * (1 + e), 3.5, zeta2, e
    found = spheres.rebound(*chosen, loss=loss)
    exact = continuum.rebound(*chosen, loss=loss, tolerance=1e-3)
    assert np.mean((found.regime == exact.regime)[exact.regime != Regime.MULTIPLE]) > 0.98


@pytest.mark.parametrize("loss", FOUND)
def test_impacts_that_were_wrong_and_those_around_them(loss):
    found, random = np.transpose(FOUND[loss]), np.random.default_rng(21)
    around = found * (1 + 0.01 * random.normal(size=found.shape))
    around[3] = np.clip(around[3], spheres.LEAST_RESTITUTION[loss], 1.0)
    around = around[:, spheres.covers(*around[1:], loss=loss)]
    error, bounds = errors(loss, *np.concatenate([found, around], axis=1))
    assert (error <= bounds).all(), error / bounds


@pytest.mark.parametrize(("loss", "stated"), [("viscous", 4e-6), ("plastic", 1e-3)])
def test_the_velocity_jumps_no_more_than_is_stated(loss, stated):
    """Where slip throughout begins, and at the restitutions where plastic panels meet."""
    random, shipped, count = np.random.default_rng(31), table.shipped(), 5000
    # The largest jumps are next to the lower bounds of restitution and mass over stiffness ratio.
    share, u = random.random(count) ** 2, random.random(count) ** 2
    least, most, low = spheres.LEAST_RATIO, spheres.LARGEST_RATIO, spheres.LEAST_RESTITUTION[loss]
    b = least + u * (most - least)
    e, zeta2 = low + share * (1 - low), np.full(count, spheres.STATED_STIFFNESS)
    sides = np.array([[1 - 1e-13], [1 + 1e-13]])
    limit = b + e * (b - 1)
    if loss == "plastic":
        limit = np.array([table.of_one(shipped, 0.0, *p, True)[1] for p in zip(b, e, strict=True)])
    impacts = [(limit * zeta2 * sides, e)]
    for where in table.limits_at(shipped, b) if loss == "plastic" else ():
        impacts.append((random.random(count) * limit * zeta2, where * sides))
    jumps = [
        np.diff(spheres.rebound(x, b * zeta2, zeta2, e, loss=loss).velocity, axis=0)
        for x, e in impacts
    ]
    assert stated / 5 < np.max(np.abs(jumps)) <= stated


def test_the_work_of_a_viscous_slide_needs_no_table():
    """The rest of sliding is that of all models, see tests/unit/test_models.py."""
    work, exact = (
        model([7.0, -9.0], 3.5, 1.2, 0.6, loss="viscous").dissipation
        for model in (spheres.rebound, continuum.rebound)
    )
    np.testing.assert_allclose(work, exact, rtol=1e-15)


def test_a_table_is_read_as_it_was_written():
    shipped, file = table.shipped("coarse"), io.BytesIO()
    spheres_tables.write(file, shipped)
    again = table.read(io.BytesIO(file.getvalue()))
    assert again.exponent == shipped.exponent and str(again) == str(shipped)
    for one, other in zip(shipped.panels.values(), again.panels.values(), strict=True):
        assert all(map(np.array_equal, one[1:], other[1:]))


@pytest.mark.long
@pytest.mark.parametrize(("name", "number"), [("viscous", 3), ("plastic_middle", 3)])
def test_the_job_makes_the_shipped_table(name, number):
    """One patch of the coarse one, which takes the least time.

    Each day the errors above would show a table that is not the continuum.
    """
    plan, shipped = spheres_tables.PLANS["coarse"], table.shipped("coarse")
    u = np.linspace(0, 1, plan.edges["plastic"][1] + 1)[::8]
    np.testing.assert_allclose(
        shipped.limits[:, ::8],
        spheres_thresholds.limits(spheres_tables.b_at("plastic", u)),
        atol=1e-7,
    )
    panel = shipped.panels[name]
    values = spheres_tables.nodes_of(name, plan, panel.edges, shipped.limits, number)
    first = int(np.sum(panel.intervals[:number] + 3))
    own = slice(first, first + panel.intervals[number] + 3)
    for coefficients, wanted in zip((panel.velocity, panel.peak), values, strict=False):
        fit = spheres_tables.splined(wanted)
        np.testing.assert_allclose(coefficients[own], fit, rtol=0, atol=2.0**-shipped.exponent)
