"""Contact laws of discrete-element codes: order of convergence, limits, energy, refusals."""

import math

import numpy as np
import pytest
import scipy.integrate

from planarimpact import InputError, Regime, continuum, lumped, models
from planarimpact.models import timestep

NAMES = ["linear", "mindlin", "mindlin_rescaled"]
LINEAR, MINDLIN, RESCALED = LAWS = [models.get(f"timestep.{name}").rebound for name in NAMES]
HERTZIAN = LAWS[1:]
BETA, ZETA2 = 3.5, 17 / 14
X = np.linspace(0, 8, 161)


def rms(difference):
    return float(np.sqrt(np.mean(difference**2)))


def order(errors, factor):
    """Observed order of convergence between the first and the last error."""
    return math.log(errors[0] / errors[-1], factor)


@pytest.mark.parametrize("e", [1.0, 0.5, 0.0])
@pytest.mark.parametrize(
    ("lowest", "highest"), [(0.0, 1.2), (1.25, 3.8), (6.0, 8.0)], ids=["stick", "mixed", "slip"]
)
def test_linear_converges_to_lumped_with_the_square_of_the_steps(lowest, highest, e):
    """Events fall between steps by chance: the order shows in the mean over many impacts."""
    x = np.linspace(lowest, highest, 101)
    exact = lumped.rebound(x, BETA, ZETA2, e).velocity
    errors = [rms(LINEAR(x, BETA, ZETA2, e, steps=n).velocity - exact) for n in (32, 256, 2048)]
    assert errors[0] < 0.02
    assert order(errors, 64) > 1.8


def test_linear_shows_the_regimes_of_lumped():
    x = np.array([0.0, 0.5, 2.0, 6.0])
    for e in (0.0, 0.5, 1.0):
        result = LINEAR(x, BETA, ZETA2, e, steps=1024)
        exact = lumped.rebound(x, BETA, ZETA2, e)
        np.testing.assert_array_equal(result.regime, exact.regime)
        np.testing.assert_allclose(result.peak_friction, exact.peak_friction, atol=1e-4)
        np.testing.assert_allclose(result.dissipation, exact.dissipation, atol=1e-4)
    again = LINEAR(0.5, 8.0, 0.1, steps=2048), lumped.rebound(0.5, 8.0, 0.1)
    assert again[0].regime == again[1].regime == Regime.MULTIPLE


@pytest.mark.parametrize("law", HERTZIAN)
@pytest.mark.parametrize("e", [1.0, 0.5])
def test_hertzian_laws_converge_with_the_steps(law, e):
    fine, *rest = (law(X, BETA, ZETA2, e, steps=n).velocity for n in (8192, 64, 512))
    errors = [rms(velocity - fine) for velocity in rest]
    assert errors[0] < 0.02 and order(errors, 8) > 0.9


def test_hertz_contact_without_micro_slip():
    """Its limits, and the two effects that the ledger quotes: 0.39 and 0.52."""
    x = np.linspace(0, 8, 161)
    velocity, peak = RESCALED(x, 3.5, 1.21, steps=4096)[:2]
    exact = continuum.rebound(x, 3.5, 1.21, tolerance=1e-5)
    assert np.abs(velocity - x + 7)[x >= 7].max() < 1e-3  # slip throughout
    assert velocity[0] == peak[0] == 0
    assert np.abs(peak - exact.peak_friction).max() < 1e-3
    assert np.abs(velocity - exact.velocity).max() == pytest.approx(0.525, abs=0.005)
    lifted = velocity - lumped.rebound(x, 3.5, 1.21).velocity
    assert lifted.max() == pytest.approx(0.39, abs=0.005) and lifted.min() > -0.01
    energy = (x**2 - velocity**2) / 7
    assert energy.min() > -1e-3


@pytest.fixture(scope="module")
def exact():
    return continuum.rebound(X, BETA, ZETA2, tolerance=1e-5).velocity


@pytest.mark.parametrize(("law", "measured"), list(zip(LAWS, [0.080, 0.291, 0.312], strict=True)))
def test_distance_from_the_elastic_continuum(law, measured, exact):
    """Many steps do not bring a law nearer than its physics allows."""
    for steps in (16, 64, 1024):
        distance = rms(law(X, BETA, ZETA2, steps=steps).velocity - exact)
        assert distance == pytest.approx(measured, rel=0.1)


@pytest.mark.parametrize("law", LAWS, ids=NAMES)
@pytest.mark.parametrize("e", [1.0, 0.6, 0.0])
def test_slip_throughout_has_the_impulse_of_the_normal_force(law, e):
    x = np.array([8.0, 1e6])
    errors = []
    for steps in (64, 1024):
        result = law(x, BETA, ZETA2, e, steps=steps)
        assert (result.regime == Regime.SLIP_THROUGHOUT).all()
        # Near maximum compression the largest force falls between two steps.
        np.testing.assert_allclose(result.peak_friction, 1.0, atol=2 / steps**2)
        errors.append(np.abs(result.velocity - (x - (1 + e) * BETA)).max())
    assert errors[1] < 10 / 1024**2 and errors[0] < 10 / 64**2


def test_rescaled_friction_slides_throughout_from_a_higher_incidence():
    for law, share in zip(HERTZIAN, (1, 2 / 3), strict=True):
        limit = 2 * BETA - share * ZETA2
        around = limit + np.array([-0.05, 0.05])
        slides = law(around, BETA, ZETA2, steps=1024).regime == Regime.SLIP_THROUGHOUT
        assert slides.tolist() == [False, True]


@pytest.mark.parametrize("law", HERTZIAN)
@pytest.mark.parametrize("steps", [64, 4096])
def test_hertz_contact_starts_in_slip_below_zeta2(law, steps):
    """The first increment of friction is 3/2 of what its step would give in the limit."""
    result = law(np.array([0.65, 0.68]) * ZETA2, BETA, ZETA2, steps=steps)
    assert result.regime.tolist() == [Regime.STICK_SLIP, Regime.SLIP_STICK_SLIP]


@pytest.mark.parametrize("law", LAWS, ids=NAMES)
def test_time_to_maximum_compression_is_the_integral_of_the_motion(law):
    closed = timestep.duration(hertzian=law is not LINEAR) / 2
    power = 2.0 if law is LINEAR else 2.5
    # With d = 1 - u^2 the integrand is smooth.
    integral, _ = scipy.integrate.quad(
        lambda u: 2 * u / math.sqrt(-math.expm1(power * math.log1p(-u * u))), 0, 1
    )
    assert closed == pytest.approx(integral, abs=1e-8)


GROUPS = np.random.default_rng(5).uniform(size=(4, 20000))


def random_impacts():
    x = 10 ** (-3 + 4.3 * GROUPS[0])
    beta = 1 + 7 * GROUPS[1]
    zeta2 = 10 ** (2 * GROUPS[2] - 1)
    return x, beta, zeta2


@pytest.mark.parametrize("law", LAWS, ids=NAMES)
@pytest.mark.parametrize("steps", [64, 512])
@pytest.mark.parametrize("e", [1.0, GROUPS[3], 0.0], ids=["elastic", "mixed", "plastic"])
def test_no_energy_is_created_beyond_the_error_of_the_steps(law, steps, e):
    """Mindlin's law without rescaling does create some: up to 5 % in speed."""
    x, beta, zeta2 = random_impacts()
    result = law(x, beta, zeta2, e, steps=steps)
    turned = np.sqrt(beta / zeta2) * np.pi * (1 + np.asarray(e)) / 2 / steps  # angle a step
    by_law = 0.055 if law is MINDLIN else 0.0
    assert (np.abs(result.velocity) <= x * (1 + by_law + 0.15 * turned**2)).all()
    assert (result.peak_friction >= 0).all() and (result.peak_friction <= 1).all()
    if law is RESCALED:
        assert (np.abs(result.velocity) <= x).all()


def test_unrescaled_friction_gains_energy():
    """Its limit, not an error of the steps; a solid sphere with Poisson's ratio 0 does."""
    for steps in (256, 4096):
        assert MINDLIN(1e-3, 3.5, 1.0, steps=steps).velocity > 1.03e-3
    assert RESCALED(1e-3, 3.5, 1.0, steps=256).velocity < 0.95e-3


@pytest.mark.parametrize("law", LAWS, ids=NAMES)
def test_parts_and_shared_normal_motion_change_nothing(law, monkeypatch):
    x = np.linspace(0, 8, 9)[:, None]
    e = np.array([0.0, 1e-9, 0.02, 0.5, 1.0])
    whole = law(x, BETA, ZETA2, e)
    monkeypatch.setattr(timestep, "CHUNK", 7)
    for one, parts in zip(whole[:4], law(x, BETA, ZETA2, e)[:4], strict=True):
        assert one.shape == (9, 5)
        np.testing.assert_array_equal(one, parts)
    monkeypatch.undo()
    for column, single in enumerate(e):
        alone = law(x[:, 0], BETA, ZETA2, single)
        np.testing.assert_array_equal(whole.velocity[:, column], alone.velocity)
        np.testing.assert_array_equal(whole.regime[:, column], alone.regime)


@pytest.mark.parametrize("law", LAWS, ids=NAMES)
def test_at_normal_incidence_nothing_happens(law):
    assert law(0.0)[:4] == (0.0, 0.0, 0.0, Regime.STICK) and law(0.0).reversals is None


@pytest.mark.parametrize("law", LAWS, ids=NAMES)
@pytest.mark.parametrize("steps", [3, 64])
def test_extreme_impacts_have_an_answer(law, steps):
    """No warning either: pytest turns them into errors."""
    x = np.array([0.0, 5e-324, 1e-300, 1.0, 3.5, 1e9, 8e307])[:, None, None]
    beta, zeta2 = np.array(
        [[1, 1], [1, 2.1], [3.5, 1e300], [1e300, 1e300], [1, 1e308], [8e307, 1.7e308]]
    ).T[..., None]
    e = np.array([0.0, 5e-324, 1e-200, 1e-9, 0.01, 1.0])
    result = law(x, beta, zeta2, e, steps=steps)
    assert np.isfinite(np.stack(result[:3])).all()
    np.testing.assert_allclose(
        result.dissipation[-1, 0], 8e307 * (1 + e), rtol=0.5 if steps == 3 else 0.05
    )


@pytest.mark.parametrize("steps", [3, 8, 64])
@pytest.mark.parametrize("law", LAWS, ids=NAMES)
def test_short_restitution_is_wrong_by_three_quarters_of_a_step_at_most(law, steps):
    """Slip throughout, with restitution from no step long to one and a bit."""
    share = np.linspace(0.0, 1.2, 2001)  # of a step
    e = share / (steps - share)
    error = (law(1e3, BETA, ZETA2, e, steps=steps).velocity - (1e3 - (1 + e) * BETA)) / BETA
    to_maximum, largest = (math.pi / 2, 1.0) if law is LINEAR else (1.4716376, 1.25)
    in_steps = np.abs(error) / ((1 + e) * to_maximum / steps * largest)
    assert 0.6 < in_steps.max() < 0.75


def least_zeta2(law, beta, e, steps):
    """Stiffness ratio for which so many steps are the least."""
    angle = math.pi / 2 if law is LINEAR else 1.4716376 * math.sqrt(1.875)
    return beta * ((1 + e) * angle / 2 / steps) ** 2


@pytest.mark.parametrize(
    ("law", "most"),
    [
        (LINEAR, lambda r, steps: min(2 * steps + 1, 1 / math.sqrt(1 - r * r))),
        (RESCALED, lambda r, steps: 1.0 if r <= 0.25 else math.inf),
    ],
)
def test_energy_created_close_to_instability_is_bounded(law, most):
    """From random impacts up to the worst around them."""
    rng = np.random.default_rng(3)
    beta, share = 10 ** rng.uniform(0, 2, 300), 10 ** rng.uniform(-6, 0.6, 300)
    e = np.where(rng.random(300) < 0.3, 1.0, rng.uniform(0.05, 1, 300))
    for steps in (3, 8, 40):
        for r in (1 - 1e-8, 0.97, 0.8, 0.5, 0.25):
            b, s, c = beta, share, e
            for spread in (0.3, 0.1, 1e-2, 1e-3):
                gain = np.abs(
                    law(s * b, b, least_zeta2(law, b, c, steps) / r**2, c, steps=steps)[0]
                )
                gain /= s * b
                assert gain.max() <= most(r, steps) * (1 + 1e-6), (steps, r)
                worst = np.repeat(np.argsort(-gain)[:20], 15)
                b, s, c = (a[worst] * np.exp(spread * rng.standard_normal(300)) for a in (b, s, c))
                b, c = np.maximum(b, 1.0), np.clip(c, 0.0, 1.0)


@pytest.mark.parametrize(("law", "least"), list(zip(LAWS, [30, 38, 38], strict=True)))
def test_too_few_steps_for_the_tangential_oscillation_are_refused(law, least):
    message = rf"steps = {least - 1}: allowed are integers from {least}"
    with pytest.raises(InputError, match=message):
        law([1.0, 2.0], 3.5, [1.0, 0.01], steps=least - 1)
    near = law(1e-6, 3.5, 0.01, steps=least)
    assert abs(near.velocity) < 1e-4
    with pytest.raises(InputError, match="steps = 64: .* inf explicit steps are needed"):
        law(1.0, 8e307, 5e-324)


@pytest.mark.parametrize("law", LAWS, ids=NAMES)
def test_bad_input_is_named(law):
    for steps in (1, 2.5, True, "64"):
        with pytest.raises(InputError, match="steps = .*: allowed are integers from"):
            law(1.0, steps=steps)
    with pytest.raises(InputError, match="incidence = inf"):
        law(np.inf)
    with pytest.raises(InputError, match="mass_ratio = 0.5"):
        law(1.0, 0.5)
    with pytest.raises(InputError, match="stiffness_ratio = -1.0"):
        law(1.0, 3.5, -1.0)
    with pytest.raises(InputError, match="restitution = 1.5"):
        law(1.0, restitution=1.5)
    with pytest.raises(InputError, match="shapes do not broadcast"):
        law([1.0, 2.0], restitution=[0.1, 0.2, 0.3])
