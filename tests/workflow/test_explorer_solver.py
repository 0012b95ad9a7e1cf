"""The lumped solver of the explorer agrees with the package."""

import json
import math

import numpy as np

from planarimpact import Regime, lumped, rigid
from stronge1994.explorer import page

ACCURACY = 1e-9
# |T| meets N behind its crest for an instant: a search that ended early has lost that slip.
LOST_SLIPS = [
    (0.7479681011096113, 3.847930832708696, 0.3742534479740521, 0.3433422554521216),
    (0.3050717050640781, 5.529161641552116, 0.25370110146354574, 0.29494552140110963),
]


def impacts():
    """Impacts over the box of the sliders, and on and beside every threshold in it."""
    rng = np.random.default_rng(1994)
    low, high = np.array([page.LIMITS[name][:2] for name in page.OF_FIGURES]).T
    angle, mu, e, nu, beta = rng.uniform(low, high, (400, 5)).T
    e = np.where(rng.random(400) < 0.3, 10.0 ** rng.uniform(-12, 0, 400), e)
    zeta2 = (2 - nu) / (2 * (1 - nu))
    rows = list(zip(np.tan(np.radians(angle)) / mu, beta, zeta2, e, strict=True))
    for beta in (1.0, 1.2, 2.5, 3.5, 10.0):
        for zeta2 in (1.0, 1.2, 1.21, 17 / 14, 1.5):  # 1 and 1.2 in resonance with beta
            resonance = math.sqrt(min(zeta2 / beta, 1.0))  # of restitution
            for e in (0.0, 1e-12, 0.3, 0.588, resonance, 1 - 2**-53, 1.0):
                edges = zeta2, beta, lumped.slip_throughout_limit(beta, zeta2, e), (1 + e) * beta
                beside = [math.nextafter(x, to) for x in edges for to in (0, math.inf)]
                rows += [(x, beta, zeta2, e) for x in (0.0, 1.0, 2.0, *edges, *beside)]
    rows += [(x, 3.5, 1.21, e) for x in (1e-12, 57.0, 57295.0) for e in (0.0, 0.5, 1.0)]
    return [tuple(map(float, row)) for row in rows + LOST_SLIPS]


def disagreements(scripts, rows):
    """Rows whose results by this JavaScript differ from those of the package."""
    found = lumped.rebound(*np.transpose(rows))
    wanted = found.velocity, found.peak_friction, found.dissipation
    fields = "[found.velocity, found.peak_friction, found.dissipation, found.regime]"
    one = f"(row) => {{ const found = solver.rebound(...row); return {fields}; }}"
    *numbers, regimes = zip(*scripts.map(one, rows), strict=True)
    # Velocity and dissipation of a grazing impact are as large as its incidence.
    size = np.maximum(np.array(rows)[:, 0], 1.0)
    close = np.abs(np.array(numbers, float) - wanted) <= ACCURACY * size
    same = np.array(regimes) == [Regime(code).name for code in found.regime]
    return [row for row, good in zip(rows, np.all([*close, same], axis=0), strict=True) if not good]


def test_rebound_is_that_of_the_package(scripts):
    rows = impacts()
    assert len(rows) > 2000
    assert disagreements(scripts, rows) == []


def test_history_is_that_of_the_package(scripts):
    rows = [
        (x, beta, zeta2, e)
        for beta, zeta2 in ((3.5, 1.21), (1.0, 1.0), (1.2, 1.5), (10.0, 1.0))
        for e in (0.0, 1e-9, 0.5, 1.0)
        for x in (0.0, 0.5, 1.0, 2.5, 6.0, 30.0, zeta2, beta)
    ]
    beside = [math.nextafter(x, to) for x in (1.21, 3.5, 5.79) for to in (0, math.inf)]
    rows += [(x, 3.5, 1.21, 1.0) for x in beside]
    columns = ["time", "normal", "friction", "velocity"]
    instant = f"(at) => {json.dumps(columns)}.map((name) => at[name])"
    found = scripts.map(f"(row) => solver.history(...row, 21).map({instant})", rows)
    for row, ours in zip(rows, found, strict=True):
        course = lumped.history(*row, samples=21)
        theirs = np.transpose([course.time, course.normal, course.friction_force, course.velocity])
        # Beside a threshold it sticks or slips for an instant: where |T| touches N again is open by
        # rounding, by its square root, 1.5e-8.
        bound = 1e-7 if row[0] in beside else ACCURACY
        # A phase that takes no time, where two events meet, has vertices of its own in the page.
        ours, theirs = (
            np.delete(c, 1 + np.flatnonzero(np.diff(np.array(c)[:, 0]) <= 1e-7), 0)
            for c in (ours, theirs)
        )
        assert ours.shape == theirs.shape and np.abs(ours - theirs).max() <= bound, row


def test_the_contact_without_a_spring_is_the_rigid_limit(scripts):
    rows = [(x, 3.5, e) for x in (0.0, 1.25, 3.5, 5.0, 8.0) for e in (0.0, 0.35, 0.5, 1.0)]
    columns = ["time", "normal", "friction", "velocity"]
    instant = f"(at) => {json.dumps(columns)}.map((name) => at[name])"
    found = scripts.map(f"(row) => solver.rigid_history(...row, 2001).map({instant})", rows)
    for (x, beta, e), course in zip(rows, found, strict=True):
        time, normal, friction, velocity = np.transpose(course)
        theirs = rigid.rebound(x, beta, restitution=e)
        assert abs(velocity[-1] - theirs.velocity) < 1e-12 and abs(time[-1] - 1 - e) < 1e-12
        # Friction is all that changes the velocity, at its limit until the contact point stops.
        impulse = np.sum((friction[1:] + friction[:-1]) / 2 * np.diff(time)) * np.pi / 2
        assert abs(x - beta * impulse - velocity[-1]) < 0.01 * max(1, x)
        sliding = np.where(velocity > 1e-12, normal, 0)
        assert np.array_equal(friction[:-1], sliding[:-1])
