"""The printed formulas put together as the paper does, against the solver where they hold."""

import numpy as np
import pytest

from planarimpact import continuum, lumped
from stronge1994 import settings as figure_settings
from stronge1994.figures.fig5 import curves as fig5
from stronge1994.figures.fig6 import curves as fig6
from stronge1994.figures.fig7 import curves as fig7
from stronge1994.figures.fig9 import curves as fig9
from stronge1994.figures.shared.curves import curves_below_one
from stronge1994.names import PRINTED
from stronge1994.printed import impact
from tests.workflow.project import config, sources

BETA, ZETA2 = 3.5, 1.21


@pytest.mark.parametrize("e", [0.6, 1.0])
def test_velocity_is_exact_below_both_limits_and_above(e):
    limit = float(lumped.slip_throughout_limit(BETA, ZETA2, e))
    end = (1 + e) * BETA
    x = np.concatenate([np.linspace(0, limit - 1e-9, 60), np.linspace(end, 3 * end, 10)])
    velocity, _, _ = impact.rebound(x, BETA, ZETA2, e)
    assert np.abs(velocity - lumped.rebound(x, BETA, ZETA2, e).velocity).max() < 1e-12


def test_peaks_hold_up_to_beta_only():
    x = np.array([0.5, 1.2, 2.0, 3.49, 4.0, 5.0])
    _, peak, _ = impact.rebound(x, BETA, ZETA2, 1.0)
    gap = np.abs(peak - lumped.rebound(x, BETA, ZETA2, 1.0).peak_friction)
    assert (gap[:4] < 1e-12).all() and (gap[4:] > 0.01).all()


# Without loss Fig. 5 as printed has no curve that differs.
FIGURES = {fig5: {"restitution": 0.5}, fig6: {}, fig7: {}, fig9: {}}


@pytest.fixture
def quick(monkeypatch):
    """The lumped model in place of the continua, which the printed equations do not concern."""
    monkeypatch.setattr(continuum, "rebound", lambda *groups, **_: lumped.rebound(*groups))
    quick = lambda _, tolerance, *groups: lumped.rebound(*groups)  # noqa: E731
    monkeypatch.setattr(curves_below_one, "rebound", quick)


@pytest.mark.parametrize("figure", FIGURES, ids=lambda figure: figure.__name__.split(".")[-2])
def test_as_printed_curves_are_added_on_request_and_change_no_other(figure, quick):
    settings = figure_settings.physics(config(), sources(), figure.__name__.split(".")[-2])
    settings |= FIGURES[figure] | {"samples": 51}
    plain, both = (figure.curves(**settings | {"as_printed": it}) for it in (False, True))
    added = both["model"] == PRINTED
    assert set(both["variant"][added]) == {"", "no solution"}
    assert both[~added].reset_index(drop=True)[list(plain)].equals(plain)
