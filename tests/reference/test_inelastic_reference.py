"""The continuum below e = 1 against a second code, which steps plain springs through plain time."""

import numpy as np
import pytest

from planarimpact import continuum
from tests.reference_solutions.inelastic_contact import rebound as stepped

# Error of the second code, extrapolated from 800 and 1600 steps. With twice as many steps its
# answers change by up to 3.4e-4 (e = 0.9, next to x = zeta^2), with four times as many by 2e-5
# more.
SECOND_CODE = 5e-4
CASES = [(0.9, 3.5, 1.21), (0.35, 2.5, 0.9)]
MORE = [pytest.param(*case, marks=pytest.mark.long) for case in [(0.7, 7.5, 0.85), (0.5, 1.2, 1.9)]]


@pytest.mark.parametrize("loss", continuum.LOSSES)
@pytest.mark.parametrize(("e", "beta", "zeta2"), CASES + MORE)
def test_velocities_meet_their_tolerance_by_a_second_code(loss, e, beta, zeta2):
    limit = float(continuum.slip_throughout_limit(beta, zeta2, e, loss=loss))
    # In each regime, and next to each threshold.
    x = np.array([0.3 * zeta2, 0.99 * zeta2, 1.01 * zeta2, 0.98 * beta, (beta + limit) / 2])
    x = np.minimum([*x, 0.97 * limit], 0.97 * limit)
    coarse, fine = (stepped(f"continuum.{loss}", x, beta, zeta2, e, n, n // 4) for n in (800, 1600))
    second = 2 * fine - coarse  # its error falls with the number of steps
    for tolerance in (1e-2, 1e-3, 1e-4):
        found = continuum.rebound(x, beta, zeta2, e, loss=loss, tolerance=tolerance)
        np.testing.assert_allclose(found.velocity, second, atol=tolerance + SECOND_CODE)
