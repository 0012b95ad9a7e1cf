"""The table of spheres: its interface, its file, and how it is made."""

import io

import numpy as np
import pytest

from planarimpact import Regime, continuum, spheres
from planarimpact.spheres import making, table, thresholds


def test_every_argument_may_be_an_array_of_its_own():
    x, beta = np.array([[0.5], [2.0], [-3.0]]), [2.5, 3.5]
    words = np.array([["viscous"], ["plastic"], ["plastic"]])
    found = spheres.rebound(x, beta, [1.0, 1.4], [0.9, 0.5], loss=words)
    assert found.velocity.shape == (3, 2)
    for i, j in np.ndindex(3, 2):
        one = spheres.rebound(x[i, 0], beta[j], [1.0, 1.4][j], [0.9, 0.5][j], loss=str(words[i, 0]))
        assert isinstance(one.regime, Regime)
        for field in ("velocity", "peak_friction", "dissipation", "regime"):
            assert getattr(found, field)[i, j] == getattr(one, field)


def test_what_needs_no_table_is_exact():
    still = spheres.rebound(0.0)
    assert (still.velocity, still.regime) == (0.0, Regime.STICK)
    for loss in spheres.LOSSES:
        slides, exact = (
            model([7.0, -9.0], 3.5, 1.2, 0.6, loss=loss)
            for model in (spheres.rebound, continuum.rebound)
        )
        np.testing.assert_array_equal(slides.regime, Regime.SLIP_THROUGHOUT)
        for field in ("velocity", "peak_friction", "dissipation"):
            np.testing.assert_allclose(getattr(slides, field), getattr(exact, field), rtol=1e-15)


def test_a_table_is_read_as_it_was_written():
    shipped, file = table.shipped("coarse"), io.BytesIO()
    table.write(file, shipped)
    again = table.read(io.BytesIO(file.getvalue()))
    np.testing.assert_array_equal(again.limits, shipped.limits)
    assert again.exponent == shipped.exponent
    for panel, other in zip(shipped.panels.values(), again.panels.values(), strict=True):
        for one, two in zip(panel, other, strict=True):
            np.testing.assert_array_equal(one, two)


@pytest.mark.parametrize(
    ("name", "number"), [("viscous", 3), pytest.param("plastic_middle", 3, marks=pytest.mark.long)]
)
def test_the_job_makes_the_shipped_table(name, number):
    """One patch of the coarse one, which takes the least time."""
    plan, shipped = making.PLANS["coarse"], table.shipped("coarse")
    u = np.linspace(0, 1, plan.edges[1] + 1)[::16]
    np.testing.assert_allclose(
        shipped.limits[:, ::16], thresholds.limits(making.b_at(u)), atol=1e-7
    )
    panel = shipped.panels[name]
    values = making.nodes_of(name, plan, panel.edges, shipped.limits, number)
    first = int(np.sum(panel.intervals[:number] + 3))
    own = slice(first, first + panel.intervals[number] + 3)
    for coefficients, wanted in zip((panel.velocity, panel.peak), values, strict=False):
        fit = making.splined(wanted)
        np.testing.assert_allclose(coefficients[own], fit, rtol=0, atol=2.0**-shipped.exponent)
