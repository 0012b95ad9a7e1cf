"""The table of spheres: its interface, its file, and how it is made."""

import numpy as np
import pytest

from planarimpact import Regime, continuum, spheres
from planarimpact.spheres import making, table, thresholds


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
