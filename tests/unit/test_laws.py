"""Laws of impulses: their equations, limits and fitted constants."""

import numpy as np
import pytest
from scipy.optimize import minimize_scalar

from planarimpact import Regime, continuum
from planarimpact.models import laws

LAWS = [laws.brach, laws.smith]
X = np.linspace(0, 8, 161)


@pytest.fixture(scope="module")
def elastic():
    return continuum.rebound(X, 3.5, 17 / 14, tolerance=1e-5).velocity


def test_default_is_the_least_squares_fit(elastic):
    default = laws.BRACH_TANGENTIAL_RESTITUTION

    def mean_square(b):
        return np.mean((laws.brach(X, 3.5, tangential_restitution=b).velocity - elastic) ** 2)

    fit = minimize_scalar(mean_square, bounds=(0, 1), method="bounded", options={"xatol": 1e-6})
    assert round(fit.x, 2) == default
    assert np.sqrt(mean_square(default)) == pytest.approx(0.183, abs=1e-3)
    np.testing.assert_array_equal(
        laws.brach(X, 3.5).velocity, laws.brach(X, 3.5, tangential_restitution=default).velocity
    )


def test_smith_without_any_setting(elastic):
    error = np.sqrt(np.mean((laws.smith(X, 3.5).velocity - elastic) ** 2))
    assert error == pytest.approx(0.405, abs=1e-3)


@pytest.mark.parametrize("e", [0.0, 0.4, 1.0])
@pytest.mark.parametrize("beta", [1.0, 3.5, 20.0])
def test_smith_fulfils_his_implicit_equation(beta, e):
    x = np.concatenate([np.geomspace(1e-12, 1e4, 400), [beta * (1 + e)]])
    w = laws.smith(x, beta, restitution=e).velocity
    implied = (1 + e) * (x * np.abs(x) + w * np.abs(w)) / (x**2 + w**2)
    np.testing.assert_allclose(w, x - beta * implied, rtol=0, atol=2e-15 * np.max(x))
    # Near normal incidence the equation itself loses digits: 1 - u^2 by those of u.
    small = x < beta
    np.testing.assert_allclose(w[small], (x - beta * implied)[small], rtol=0, atol=1e-14 * beta)


def test_brach_joins_its_lines():
    at = 7 / 1.4
    around = np.array([np.nextafter(at, 0), at, np.nextafter(at, 9)])
    result = laws.brach(around, tangential_restitution=0.4)
    np.testing.assert_allclose(result.velocity, -2.0, atol=1e-14)
    assert result.regime[0] == Regime.UNRESOLVED and result.regime[2] == Regime.SLIP_THROUGHOUT
    assert np.isnan(result.peak_friction[0]) and result.peak_friction[2] == 1


@pytest.mark.parametrize("law", LAWS)
def test_sliding_loses_no_digits_of_dissipation(law):
    x = np.array([20.0, 1e16, 1e300])
    result = law(x, 3.5, 1.21, 0.5)
    np.testing.assert_allclose(result.dissipation, 1.5 * (x / 2 + result.velocity / 2), rtol=1e-15)
    limit = 1.5 * 3.5 / (1.4 if law is laws.brach else 1.0)
    assert law(limit, 3.5, 1.21, 0.5).regime == Regime.SLIP_THROUGHOUT
