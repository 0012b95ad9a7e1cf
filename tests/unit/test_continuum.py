"""The continuum: many impacts, those without an answer, restitution of spheres that yield."""

import numpy as np
import pytest

from planarimpact import continuum


def test_many_impacts_are_solved_in_parts(monkeypatch):
    x = np.linspace(0.1, 5.0, 3)
    whole = continuum.rebound(x, tolerance=1e-3)
    monkeypatch.setattr(continuum.elastic, "CELLS", 100)
    np.testing.assert_allclose(
        continuum.rebound(x, tolerance=1e-3).velocity, whole.velocity, atol=1e-14
    )


def test_impacts_without_an_answer_are_all_named(monkeypatch):
    """Those beyond all steps at once; those out of reach when the others are solved."""
    with pytest.raises(continuum.Unsolved, match="needs 2.35e.05 steps") as refused:
        continuum.rebound([[1.0, 9.0], [2.0, 3.0]], 3.5, [[1.21, 1e-8], [1e-8, 1.21]])
    assert refused.value.impacts.tolist() == [2]  # 9 slides throughout
    with pytest.raises(continuum.Unsolved) as refused:  # the elastic one is solved apart
        continuum.rebound([2.0, 2.0], 3.5, [1.21, 1e-8], [1.0, 0.6], loss="viscous")
    assert refused.value.impacts.tolist() == [1]
    monkeypatch.setattr(continuum.elastic, "MOST_STEPS", 128)
    with pytest.raises(continuum.Unsolved, match="at incidence = 3, ") as refused:
        continuum.rebound([0.0, 1e-9, 8.0, 3.0, 2.0], tolerance=1e-6)
    assert refused.value.impacts.tolist() == [3, 4]
    # 2.0 is given up later than the others
    monkeypatch.setattr(continuum.elastic, "MOST_STEPS", 1024)
    with pytest.raises(continuum.Unsolved) as refused:
        continuum.rebound([0.5, 0.01, 3.0, 2.0], tolerance=1e-7)
    assert refused.value.impacts.tolist() == [0, 2, 3]
