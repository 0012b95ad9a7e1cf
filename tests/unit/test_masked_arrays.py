"""Masked arrays: a masked entry is refused in words, wherever it hides; without one it is data."""

import numpy as np
import pytest

from planarimpact import InputError, bodies, models, noncollinear
from planarimpact.bodies import Body, Material

HALF = np.ma.array([0.5, -1.0], mask=[False, True])
WHOLE = np.ma.array([0.5, 0.75], mask=[False, False])
ROD = noncollinear.inverse_mass(1.0, 1.0, offset=0.2, depth=0.4)
TAKES = {
    "incidence": [
        lambda x, name=name: models.rebound(name, x) for name in ("lumped", "rigid", "annuli")
    ],
    "restitution": [lambda e: models.rebound("lumped.hysteretic", 1.0, restitution=e)],
    "friction": [lambda mu: bodies.incidence(1.0, 1.0, mu)],
    "tangential": [lambda v: noncollinear.rebound(v, 1.0, ROD, 0.5)],
    "other": [lambda r: bodies.effective_radius(0.02, r)],
    "mass": [lambda m: bodies.mass_ratio(Body(m, 1.0, 1.0))],
    "young_modulus": [lambda e: bodies.stiffness_ratio(Material(e, 0.3))],
}
CASES = [(name, call) for name, calls in TAKES.items() for call in calls]


@pytest.mark.parametrize(("name", "call"), CASES, ids=[name for name, _ in CASES])
def test_a_masked_entry_is_refused_and_an_empty_mask_is_none(name, call):
    for given in (HALF, [HALF, HALF], (1.0, np.ma.masked), np.ma.masked, [[0.5], [np.ma.masked]]):
        with pytest.raises(InputError, match=rf"\b{name} has masked entries: allowed .*filled"):
            call(given)
    assert repr(call(WHOLE)) == repr(call(WHOLE.data))
    assert repr(call([WHOLE, WHOLE])) == repr(call([WHOLE.data] * 2))


def test_an_infinity_beside_a_masked_entry_hides_nothing():
    with pytest.raises(InputError, match="other has masked entries"):
        bodies.effective_radius(0.02, np.ma.array([np.inf, -5.0], mask=[False, True]))


def test_what_float64_cannot_hold_is_no_infinity():
    if np.finfo(np.longdouble).max > np.finfo(float).max:
        with pytest.raises(InputError, match="other = inf: allowed are numbers above 0, or inf"):
            bodies.effective_radius(0.02, np.longdouble("1e400"))
