"""Laws of impulses: an equation and a fitted constant; what all models keep is in test_models."""

import numpy as np
import pytest
from scipy.optimize import minimize_scalar

from planarimpact import continuum
from planarimpact.models import laws

X = np.linspace(0, 8, 161)


def test_default_is_the_least_squares_fit():
    default = laws.BRACH_TANGENTIAL_RESTITUTION
    elastic = continuum.rebound(X, 3.5, 17 / 14, tolerance=1e-5).velocity

    def mean_square(b):
        return np.mean((laws.brach(X, 3.5, tangential_restitution=b).velocity - elastic) ** 2)

    fit = minimize_scalar(mean_square, bounds=(0, 1), method="bounded", options={"xatol": 1e-6})
    assert round(fit.x, 2) == default
    np.testing.assert_array_equal(
        laws.brach(X, 3.5).velocity, laws.brach(X, 3.5, tangential_restitution=default).velocity
    )


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
