"""The table of spheres against the continuum that it stands for, at 10^4 impacts.

The suite tries a quarter of them, the profile `long` all.

Half of them are random. The others surround the edges of the table, where the answer bends or two
polynomials meet, from 1e-12 to 1e-2 away.
"""

import numpy as np
import pytest

from planarimpact import continuum, spheres
from planarimpact.spheres import table

IMPACTS, PARTS = 10_000, 4
# Of the continuum, whose errors are below half of it.
TOLERANCE = 4e-5


def groups(generator, count):
    """Mass ratio, stiffness ratio and restitution, a third of them at a bound."""
    beta = generator.choice([2.5, 3.5], count)
    zeta2 = generator.uniform(1.0, 1.6, count)
    e = generator.uniform(0.3, 1.0, count)
    for values, bounds in ((zeta2, [1.0, 1.6]), (e, [0.3, 1.0])):
        at = generator.random(count) < 1 / 6
        values[at] = generator.choice(bounds, np.sum(at))
    return beta, zeta2, e


def edges(beta, zeta2, e, plastic):
    """Edges of the patches, shape (edges, n): NaN where a panel has fewer."""
    b, found = beta / zeta2, np.full((6, beta.size), np.nan)
    u = table.over_b(b)
    limit = np.interp(u, np.linspace(0, 1, table.shipped().limit.size), table.shipped().limit)
    for name, rows in zip(
        table.PANELS, (~plastic, plastic & (e < limit), plastic & (e >= limit)), strict=True
    ):
        t = table.over_e(name, e[rows], limit[rows])
        ends, varying = table.edges_of(table.shipped().panels[name], t, u[rows], b[rows], e[rows])
        for row, values in zip(found, [*ends[1:], *varying], strict=False):
            row[rows] = values
    return found


def impacts(seed, count):
    """Incidence, groups and whether the loss is plastic."""
    generator = np.random.default_rng(seed)
    beta, zeta2, e = groups(generator, count)
    plastic = generator.random(count) < 0.5
    y = generator.random(count) * (beta / zeta2) * (1 + e)
    some = edges(beta, zeta2, e, plastic)
    near = some[generator.integers(0, len(some), count), np.arange(count)]
    near += generator.choice([-1, 1], count) * 10 ** generator.uniform(-12, -2, count)
    beside = (np.arange(count) % 2 == 0) & (near >= 0)
    return np.where(beside, near, y) * zeta2, beta, zeta2, e, plastic


LATER = [pytest.param(part, marks=pytest.mark.long) for part in range(1, PARTS)]


@pytest.mark.parametrize("part", [0, *LATER])
def test_the_table_is_within_its_bound_of_the_continuum(part):
    x, beta, zeta2, e, plastic = impacts([20, part], IMPACTS // PARTS)
    for loss, rows in (("viscous", ~plastic), ("plastic", plastic)):
        chosen = x[rows], beta[rows], zeta2[rows], e[rows]
        found = spheres.rebound(*chosen, loss=loss)
        exact = continuum.rebound(*chosen, loss=loss, tolerance=TOLERANCE)
        for field in ("velocity", "peak_friction", "dissipation"):
            error = np.abs(getattr(found, field) - getattr(exact, field))
            worst = int(np.argmax(error))
            words = field, loss, [float(group[worst]) for group in chosen], float(error[worst])
            assert error[worst] <= spheres.ERROR_BOUND[loss], words
        # Whether all of a contact slips twice is told by the first threshold of it alone.
        assert np.mean(found.regime == exact.regime) > 0.95
