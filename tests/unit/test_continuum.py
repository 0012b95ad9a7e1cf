"""The elastic continuum: exact limits, shapes, refusals."""

import functools

import numpy as np
import pytest

from planarimpact import ConvergenceError, InputError, Regime, continuum, lumped
from planarimpact.continuum import annuli

# What is tested of them here does not depend on how exact they are.
COARSE = {continuum.rebound: {"tolerance": 1e-3}, annuli.rebound: {"circles": 8, "steps": 64}}


def test_slip_throughout_is_exact():
    limit = lumped.slip_throughout_limit(3.5, 1.21)
    x = np.array([limit, 6.0, 8.0, 1e6])
    result = continuum.rebound(x)
    np.testing.assert_array_equal(result.velocity, x - 7)
    assert (result.regime == Regime.SLIP_THROUGHOUT).all() and (result.peak_friction == 1).all()


def test_nothing_happens_at_normal_incidence():
    assert continuum.rebound(0.0) == (0.0, 0.0, 0.0, Regime.STICK, 0)
    assert annuli.rebound(0.0, circles=4, steps=8) == (0.0, 0.0, 0.0, Regime.STICK, 0)


def test_gross_slip_to_maximum_compression_has_full_friction():
    assert (continuum.rebound([3.5, 4.5, 5.5], tolerance=1e-4).peak_friction == 1).all()


def test_the_limit_of_slip_throughout_is_crossed_without_a_jump():
    below = continuum.rebound(np.nextafter(5.79, 0), tolerance=1e-8)
    assert below.regime == Regime.SLIP_STICK_SLIP
    assert abs(below.velocity - (5.79 - 7)) < 1e-8


@pytest.mark.parametrize("solver", [continuum.rebound, annuli.rebound])
def test_results_have_the_shape_of_the_arguments(solver):
    solver = functools.partial(solver, **COARSE[solver])
    result = solver([[0.5], [2.0], [-2.0]], 3.5, [1.21, 1.5])
    assert all(field.shape == (3, 2) for field in result)
    np.testing.assert_allclose(result.velocity[1], -result.velocity[2], atol=1e-12)
    np.testing.assert_allclose(result.dissipation[1], result.dissipation[2], atol=1e-12)
    alone = solver(2.0, 3.5, 1.5)
    assert isinstance(alone.regime, Regime) and isinstance(alone.reversals, int)
    assert alone.velocity == pytest.approx(result.velocity[1, 1], abs=1e-12)


@pytest.mark.parametrize("solver", [continuum.rebound, annuli.rebound])
def test_many_impacts_are_solved_in_parts(solver, monkeypatch):
    x, coarse = np.linspace(0.1, 5.0, 3), COARSE[solver]
    whole = solver(x, **coarse)
    monkeypatch.setattr(continuum.elastic, "CELLS", 100)
    monkeypatch.setattr(annuli, "CELLS", 2 * 8**2)
    np.testing.assert_allclose(solver(x, **coarse).velocity, whole.velocity, atol=1e-14)


def test_history_ends_where_rebound_does():
    for x in (0.0, 0.7, 2.5, -2.5, 7.0):
        contact = continuum.history(x)
        assert abs(contact.velocity[-1] - continuum.rebound(x, tolerance=1e-5).velocity) <= 1e-4
        assert contact.velocity[0] == x and contact.time[0] == 0 and contact.time[-1] == 2
        assert (np.diff(contact.time) > 0).all() and len(contact.time) >= 129
        assert (contact.stick_radius <= contact.contact_radius).all()
        assert contact.normal[-1] == contact.friction[-1] == 0


def test_a_tolerance_out_of_reach_is_refused(monkeypatch):
    monkeypatch.setattr(continuum.elastic, "MOST_STEPS", 1024)
    with pytest.raises(
        ConvergenceError, match="tolerance = 1e-12: not met with .* out of reach of 1024"
    ):
        continuum.rebound(2.0, tolerance=1e-12)
    with pytest.raises(ConvergenceError, match="at incidence = 2, mass_ratio = 3.5"):
        continuum.history(2.0, tolerance=1e-12)


def test_extrapolation_saves_steps(monkeypatch):
    """Where it leaves a share of the error that falls with the square of the steps, 512 are few."""
    monkeypatch.setattr(continuum.elastic, "MOST_STEPS", 512)
    continuum.rebound(np.linspace(0.2, 5.6, 28), tolerance=1e-4)


def test_annuli_without_an_answer_say_so(monkeypatch):
    monkeypatch.setattr(annuli, "MOST_TRIALS", 1)
    with pytest.raises(ConvergenceError, match="no distribution of stick and slip over"):
        annuli.rebound(2.0)


BAD = [
    (lambda: continuum.rebound(np.nan), "incidence = nan"),
    (lambda: continuum.rebound(1.0, 0.5), "mass_ratio = 0.5"),
    (lambda: continuum.rebound(1.0, 3.5, 0.0), "stiffness_ratio = 0.0"),
    (lambda: continuum.rebound(1.0, tolerance=0.0), "tolerance = 0.0: .* above 0"),
    (lambda: continuum.history(1.0, tolerance=[1e-3, 1e-4]), r"tolerance, shape \(2,\)"),
    (
        lambda: continuum.rebound([1, 2, 3], tolerance=[1e-3, 1e-4]),
        r"broadcast: .*tolerance \(2,\)",
    ),
    (lambda: continuum.rebound([1.0, 2.0], [3.0, 3.5, 4.0]), "shapes do not broadcast"),
    (lambda: continuum.history([1.0, 2.0]), r"shape = \(2,\): one contact takes scalars"),
    (lambda: annuli.rebound("fast"), "incidence = 'fast'"),
    (lambda: annuli.rebound(1.0, circles=2.5), "circles = 2.5: allowed are integers from 1"),
    (lambda: annuli.rebound(1.0, steps=1), "steps = 1: allowed are integers from 3"),
    (lambda: annuli.rebound(1.0, 3.5, 1e-5), "steps = 512: allowed are integers from 1859"),
]


@pytest.mark.parametrize(("call", "words"), BAD, ids=[words for _, words in BAD])
def test_bad_input_is_named(call, words):
    with pytest.raises(InputError, match=words):
        call()


def test_groups_that_no_steps_resolve_are_refused_at_once():
    for solve in (continuum.rebound, continuum.history):
        with pytest.raises(ConvergenceError, match="stiffness_ratio = 1e-08 at mass_ratio = 3.5"):
            solve(1e-9, 3.5, 1e-8)


def test_dissipation_keeps_its_digits_at_huge_incidence():
    for solver in (continuum.rebound, annuli.rebound):
        assert solver(1e17).dissipation == pytest.approx(2e17, rel=1e-7)


@pytest.mark.parametrize("x", [1.21, 1.2100001, 2.0, 5.7899999])
def test_time_of_a_history_never_stands_still(x):
    assert (np.diff(continuum.history(x, tolerance=1e-5).time) > 0).all()


def test_a_solver_gone_wrong_gives_up_at_once(monkeypatch):
    """Values that are not finite are not refined to the last step."""
    calls = []

    def lost(groups, _):
        calls.append(groups)
        n = groups[0].size
        return np.full((2, n), np.nan), np.zeros((2, n), dtype=int), np.ones(n)

    monkeypatch.setattr(continuum.elastic, "_integrate", lost)
    with pytest.raises(ConvergenceError, match="incidence = 2.*estimated error nan"):
        continuum.rebound(2.0)
    assert len(calls) == 1


def test_impacts_without_an_answer_are_all_named(monkeypatch):
    """Those beyond all steps at once; those out of reach when the others are solved."""
    with pytest.raises(continuum.Unsolved, match="needs 2.35e.05 steps") as refused:
        continuum.rebound([[1.0, 9.0], [2.0, 3.0]], 3.5, [[1.21, 1e-8], [1e-8, 1.21]])
    assert refused.value.impacts.tolist() == [2]  # 9 slides throughout
    monkeypatch.setattr(continuum.elastic, "MOST_STEPS", 128)
    with pytest.raises(continuum.Unsolved, match="at incidence = 3, ") as refused:
        continuum.rebound([0.0, 1e-9, 8.0, 3.0, 2.0], tolerance=1e-6)
    assert refused.value.impacts.tolist() == [3, 4]
    monkeypatch.setattr(
        continuum.elastic, "MOST_STEPS", 1024
    )  # 2.0 is given up later than the others
    with pytest.raises(continuum.Unsolved) as refused:
        continuum.rebound([0.5, 0.01, 3.0, 2.0], tolerance=1e-7)
    assert refused.value.impacts.tolist() == [0, 2, 3]
