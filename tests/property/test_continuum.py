"""The continuum, elastic and with a loss: what holds for every impact, and its limits."""

from itertools import product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from planarimpact import Regime, continuum, lumped
from planarimpact.continuum import annuli, inelastic, micro_slip
from planarimpact.continuum.inelastic import plastic as plastic_springs
from planarimpact.continuum.inelastic import viscous as viscous_springs
from planarimpact.continuum.inelastic.plastic import PlasticSprings
from planarimpact.continuum.inelastic.viscous import ViscousSprings
from planarimpact.ground import sliding

LOSSES = list(continuum.LOSSES)
ELASTIC_SHEAR = "plastic-elastic-shear"
EVERY = [None, *LOSSES, ELASTIC_SHEAR]
BETA, ZETA2 = 3.5, 1.21
PATH = st.lists(st.tuples(st.floats(0.05, 1.0), st.floats(-1.5, 1.5)), min_size=1, max_size=25)
FEWER = settings(max_examples=settings.default.max_examples // 2)


def solved(x, beta=BETA, zeta2=ZETA2, e=0.6, loss="viscous", tolerance=1e-4):
    return continuum.rebound(x, beta, zeta2, e if loss else 1.0, loss=loss, tolerance=tolerance)


def spray(rng, n, loss):
    """Groups and incidences near every threshold: zeta^2, beta and slip throughout."""
    beta, zeta2 = rng.uniform(1, 8, n), rng.uniform(0.8, 2.0, n)
    e = np.where(rng.random(n) < 0.2, 1 - 10 ** rng.uniform(-9, -2, n), rng.uniform(0.3, 1, n))
    e = e if loss else np.ones(n)
    limit = sliding.limit_alike(beta, zeta2, e)
    flowing = continuum.slip_throughout_limit(beta, zeta2, e, loss="plastic")
    places = [zeta2, beta, limit, limit * rng.random(n), flowing]
    near = np.choose(rng.integers(0, 5, n), places)
    x = near * (1 + 10 ** rng.uniform(-12, -1, n) * rng.choice([-1, 1], n))
    return x, beta, zeta2, e


# ---- every impact ----


@pytest.mark.parametrize("loss", EVERY)
def test_no_impact_of_a_spray_around_the_thresholds_gains_energy_or_fails(loss):
    x, beta, zeta2, e = spray(np.random.default_rng(11), 120, loss)
    found = solved(x, beta, zeta2, e, loss, 1e-3)
    assert (np.abs(found.velocity) <= x * (1 + 1e-15)).all()
    lost = (x**2 - found.velocity**2) / (2 * beta)
    allowed = 1e-3 * (1 + x) if loss else 1e-12 * (1 + x**2)
    assert (found.dissipation <= lost + allowed).all()
    assert (found.dissipation >= (-1e-3 if loss else 0)).all()
    assert ((found.peak_friction >= 0) & (found.peak_friction <= 1)).all()
    # Velocity is continuous: on both sides of each threshold it is the same.
    beside = solved(x * (1 + 1e-9), beta, zeta2, e, loss, 1e-3)
    np.testing.assert_allclose(beside.velocity, found.velocity, atol=2e-3)
    np.testing.assert_allclose(beside.peak_friction, found.peak_friction, atol=2e-3)


@pytest.mark.parametrize(
    ("loss", "x"),
    [
        *product([None, *LOSSES], [0.0, 0.8, -2.0, 9.0]),
        # About zeta^2, and just below slip throughout.
        *product([None], [1.21, 1.2100001, 5.7899999]),
        *product(LOSSES, [4.6]),
    ],
)
def test_a_history_keeps_the_laws_and_ends_where_the_rebound_does(loss, x):
    e = 0.5 if loss else 1.0
    contact = continuum.history(x, restitution=e, loss=loss, tolerance=1e-3)
    after = solved(x, e=e, loss=loss, tolerance=1e-3)
    assert contact.velocity[0] == x and contact.time[0] == 0
    assert contact.velocity[-1] == pytest.approx(after.velocity, abs=2e-3)
    assert np.abs(contact.friction).max() == pytest.approx(after.peak_friction, abs=5e-3)
    assert (np.abs(contact.friction) <= contact.normal + 1e-12).all()
    assert (np.diff(contact.time) > 0).all() and len(contact.time) >= 129
    assert (contact.stick_radius <= contact.contact_radius).all()
    assert contact.normal[-1] == contact.friction[-1] == 0
    gross = contact.stick_radius == 0
    full = contact.normal[gross] * (x != 0)
    atol = 1e-3 if loss else 0  # one of the springs may still stick
    np.testing.assert_allclose(np.abs(contact.friction[gross]), full, atol=atol)
    # Both velocities change by the impulses of their forces.
    impulse, normal_impulse = (
        np.trapezoid(force, contact.time) for force in (contact.friction, contact.normal)
    )
    change = BETA * (1 + e) * impulse / normal_impulse
    assert x - contact.velocity[-1] == pytest.approx(change, abs=1e-3 * BETA)
    if loss is None:
        assert contact.time[-1] == 2


@given(PATH)
def test_tractions_stay_within_friction_on_any_path(path):
    radius, displacement = np.array(path).T
    force, stick = micro_slip.friction(radius, displacement)
    assert (np.abs(force) <= radius**3 * (1 + 1e-9) + 1e-12).all()
    assert ((stick >= 0) & (stick <= radius)).all()


@FEWER
@given(PATH, st.integers(1, 6))
def test_straight_steps_may_be_divided(path, parts):
    """The row is exact for straight steps in r^2 and u, however they are cut."""
    corners = np.concatenate([[[0.0, 0.0]], np.array(path) ** [2, 1]])
    at = np.arange(len(path) * parts + 1) / parts
    fine = [np.interp(at, np.arange(len(corners)), column)[1:] for column in corners.T]
    whole, _ = micro_slip.friction(np.sqrt(corners[1:, 0]), corners[1:, 1])
    cut, _ = micro_slip.friction(np.sqrt(fine[0]), fine[1])
    np.testing.assert_allclose(cut[parts - 1 :: parts], whole, atol=1e-9)


def test_annuli_the_scheme_of_1976_find_the_same():
    """At the corners of a box of groups, and within it, over all incidences."""
    beta, zeta2 = np.array([[1, 0.3], [1, 5], [8, 0.3], [8, 5], [2.5, 1.5]]).T[..., None]
    limit = lumped.slip_throughout_limit(beta, zeta2)
    x = np.array([0.1, 0.4, 0.8, 1.05]) * limit
    exact = continuum.rebound(x, beta, zeta2, tolerance=1e-5)
    scheme = annuli.rebound(x, beta, zeta2, circles=40, steps=2000)
    error = np.abs(scheme.velocity - exact.velocity)
    assert (error <= 3e-4 * np.maximum(1, limit / 6)).all()
    np.testing.assert_allclose(scheme.peak_friction, exact.peak_friction, atol=1e-3)
    np.testing.assert_array_equal(scheme.regime, exact.regime)
    np.testing.assert_array_equal(scheme.reversals, exact.reversals)


# ---- limits ----


@pytest.fixture(scope="module")
def elastic():
    """Incidences, their velocities to 1e-8, and the elastic continuum at them."""
    x = np.array([0.3, 1.2, 1.3, 2.0, 3.4, 4.5])
    return x, continuum.fixed_steps(x, steps=2048, extrapolate=True), solved(x, loss=None)


@pytest.mark.parametrize("loss", LOSSES)
def test_without_loss_it_is_the_elastic_continuum(loss, elastic):
    x, velocity, elastic = elastic
    groups = np.full((3, x.size), [[BETA], [ZETA2], [1 - 1e-9]])
    coarse, fine = (
        inelastic.path(x, *groups, inelastic.MOTIONS[loss], steps).velocity[-1]
        for steps in (512, 1024)
    )
    np.testing.assert_allclose(fine + (fine - coarse) / 3, velocity, atol=1e-6)
    near = solved(x, e=1 - 1e-9, loss=loss)
    np.testing.assert_allclose(near.peak_friction, elastic.peak_friction, atol=1e-4)
    np.testing.assert_allclose(near.dissipation, elastic.dissipation, atol=3e-4)
    np.testing.assert_array_equal(near.regime, elastic.regime)
    mixed = continuum.rebound(x, restitution=[1, 1, 1, 0.8, 0.8, 1], loss=loss, tolerance=1e-4)
    np.testing.assert_array_equal(mixed.velocity[[0, 1, 2, 5]], elastic.velocity[[0, 1, 2, 5]])


@pytest.mark.parametrize("loss", EVERY)
@pytest.mark.parametrize(
    ("beta", "zeta2", "e"), [(3.5, 1.21, 0.6), (3.5, 1.21, 0.4), (8, 0.8, 0.3), (1.2, 2.0, 0.7)]
)
def test_slip_throughout_begins_where_the_derivation_says(loss, beta, zeta2, e):
    e = e if loss else 1.0
    limit = float(continuum.slip_throughout_limit(beta, zeta2, e, loss=loss))
    alike = float(sliding.limit_alike(beta, zeta2, e))
    # Where much has yielded, the middle sticks for a while though the body outruns all springs.
    assert (limit > alike) == (loss == "plastic" and (e < 0.5 or beta < zeta2))
    over = solved(np.array([limit, limit + 3]), beta, zeta2, e, loss)
    np.testing.assert_array_equal(over.velocity, np.array([limit, limit + 3]) - (1 + e) * beta)
    assert (over.peak_friction == 1).all() and (over.regime == Regime.SLIP_THROUGHOUT).all()
    under = solved(limit - 1e-6, beta, zeta2, e, loss, 1e-5)
    assert under.velocity == pytest.approx(limit - (1 + e) * beta, abs=2e-5)
    assert under.regime != Regime.SLIP_THROUGHOUT


@pytest.mark.parametrize("loss", LOSSES)
def test_the_contact_starts_in_stick_up_to_zeta2(loss):
    for x, sticks in ((ZETA2 * 0.98, True), (ZETA2 * 1.02, False)):
        contact = continuum.history(x, restitution=0.6, loss=loss, tolerance=1e-3)
        early = slice(1, 4)
        share = contact.friction[early] / contact.normal[early]
        assert (share < 0.999).all() if sticks else (share > 1 - 1e-12).all()


def test_the_regimes_of_maw_and_others_begin_where_they_say():
    """Gross slip at the start from psi1 = 1 on, throughout from psi1 = 4 chi - 1 on."""
    zeta2 = np.array([17 / 14, 1.5, 0.4])
    for at, below, above in (
        (1.0, Regime.STICK_SLIP, Regime.SLIP_STICK_SLIP),
        (7 / zeta2 - 1, Regime.SLIP_STICK_SLIP, Regime.SLIP_THROUGHOUT),
    ):
        near = zeta2 * at * (1 + 1e-6 * np.array([[-1], [1]]))
        found = continuum.rebound(near, 3.5, zeta2, tolerance=1e-5)
        assert (found.regime == [[below], [above]]).all()
    assert (continuum.rebound([3.5, 4.5, 5.5], tolerance=1e-4).peak_friction == 1).all()


def elastic_no_slip(ratio):
    """The same of elastic spheres (Lyashenko & Popov 2015), spring by spring.

    A spring that comes into contact has no deflection; one that leaves takes its own away.
    """
    to_maximum = 1.4716375921623508

    def motion(t, state, entered=None):
        depth, approach, travel, w, force = state
        radius = np.sqrt(max(depth, 0.0))
        rate = radius * w
        if entered is not None and radius > 0:
            lost = travel - entered(2 * to_maximum - t)[2]
            rate += approach / (2 * radius) * lost
        return [approach, -1.25 * radius**3, w, -ratio * 1.25 * force, 1.5 * rate]

    exact = {"rtol": 1e-10, "atol": 1e-12, "max_step": 0.01}
    half = solve_ivp(motion, (0, to_maximum), [0, 1, 0, 1, 0], dense_output=True, **exact)
    end = 2 * to_maximum - 1e-6
    rest = solve_ivp(motion, (to_maximum, end), half.y[:, -1], args=(half.sol,), **exact)
    return rest.y[3, -1]


@pytest.mark.parametrize("ratio", [0.5, 3.5 / 1.21, 8.0])
def test_with_endless_friction_only_mass_over_stiffness_ratio_matters(ratio):
    zeta2 = np.array([0.2, 1.2, 5.0])
    zeta2 = zeta2[ratio * zeta2 >= 1]
    found = continuum.rebound(1e-5, ratio * zeta2, zeta2, tolerance=1e-10).velocity / 1e-5
    np.testing.assert_allclose(found, elastic_no_slip(ratio), atol=2e-5)


# ---- conservation ----

# These stick first, so that every step is booked; one column for each restitution.
BOOKED = np.tile([0.3, 0.8, 1.1], 3)
GROUPS = np.array([np.full(9, BETA), np.full(9, ZETA2), np.repeat([0.95, 0.6, 0.35], 3)])


@pytest.mark.parametrize("loss", ["plastic", ELASTIC_SHEAR])
def test_friction_and_flow_in_shear_take_what_the_body_loses(loss, monkeypatch):
    """Spring by spring: slip times its limit, and the flow times the density. Neither gives any."""
    friction, flow = [], []

    class Booked(PlasticSprings):
        def move(self, k, step, start, end):
            self.last = k, step, (start[1] + end[1]) / 2
            return super().move(k, step, start, end)

        def settle(self, k):
            _, step, pace = self.last
            (_, density), motion = self._tried, self._motion
            count = min(len(density), len(self._density))
            before, after, width = self._density[:count], density[:count], motion.width[:count]
            mean = (before + after) / 2
            flowed = np.diff(motion.flowed(motion.approach[k - 1 : k + 1]), axis=0)[0]
            flowed = mean * (flowed if k < len(motion.radius) else 0.0)
            slid = np.where(self._slips[:count], step * pace - flowed - after + before, 0.0)
            friction.append(2 * np.sum(width * mean * slid, axis=0))
            flow.append(2 * np.sum(width * mean * flowed, axis=0))
            return super().settle(k)

    monkeypatch.setattr(plastic_springs, "PlasticSprings", Booked)
    off = []
    for steps in (256, 512, 1024):
        friction.clear()
        flow.clear()
        found = inelastic.path(BOOKED, *GROUPS, inelastic.MOTIONS[loss], steps)
        assert np.min(friction) > -1e-6 and np.min(flow) >= 0
        assert (np.sum(flow) > 0) == (loss == "plastic")
        off.append(ZETA2 * (np.sum(friction, axis=0) + np.sum(flow, axis=0)) - found.work)
    assert np.abs(off[-1]).max() < 0.3 * np.abs(off[0]).max() + 1e-6
    np.testing.assert_allclose(off[-1], 0, atol=2e-4)


def test_viscous_springs_share_the_energy_with_friction(monkeypatch):
    """Friction, the dashpots, the strain left in springs that fall off: all that the body loses."""
    losses = []

    class Booked(ViscousSprings):
        spent = 0.0

        def move(self, k, step, start, end):
            self.last = step, start, end
            return super().move(k, step, start, end)

        def settle(self, k):
            step, start, end = self.last
            tau = self._motion.tau
            count = min(len(self._memory), len(self._next))
            width = self._motion.width
            # (density - q)/tau is the rate of q; the dashpot takes tau times its square.
            flows = [
                (density[:count] - memory[:count] - u) ** 2 / tau
                for density, memory, (u, _) in (
                    (self._density, self._memory, start),
                    (self._tried[1], self._next, end),
                )
            ]
            mean = (flows[0] + flows[1]) / 2
            left = self._memory[count:] + start[0]  # the spring that falls off in this step
            self.spent += 2 * np.sum(width[:count] * mean, axis=0) * step
            self.spent += np.sum(width[count : len(self._memory)] * left**2, axis=0)
            work = super().settle(k)
            losses.append(self.spent)
            return work

    monkeypatch.setattr(viscous_springs, "ViscousSprings", Booked)
    off = []
    for steps in (256, 512, 1024):
        losses.clear()
        found = inelastic.path(BOOKED, *GROUPS, inelastic.MOTIONS["viscous"], steps)
        lost = (BOOKED**2 - found.velocity[-1] ** 2) / (2 * BETA)
        off.append(found.work + ZETA2 * losses[-1] - lost)
    # The bookkeeping at the edge has an error of first order, the steps one of second order.
    second = [b + (b - a) / 3 for a, b in zip(off, off[1:], strict=False)]
    np.testing.assert_allclose(2 * second[1] - second[0], 0, atol=1e-6)
