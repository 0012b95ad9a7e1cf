"""The continuum below e = 1 against limits, closed forms, other integrations, conservation laws."""

import warnings

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp
from scipy.optimize import brentq

from planarimpact import InputError, Regime, continuum
from planarimpact.collision import rungs
from planarimpact.continuum import inelastic
from planarimpact.continuum.inelastic import plastic as plastic_springs
from planarimpact.continuum.inelastic import viscous as viscous_springs
from planarimpact.continuum.inelastic.plastic import PlasticSprings
from planarimpact.continuum.inelastic.viscous import ViscousSprings
from planarimpact.ground import sliding
from planarimpact.normal_impact import kelvin_voigt, yielding

LOSSES = list(continuum.LOSSES)
ELASTIC_SHEAR = "plastic-elastic-shear"
EXACT = {"rtol": 1e-11, "atol": 1e-13}
BETA, ZETA2 = 3.5, 1.21


def solved(x, beta=BETA, zeta2=ZETA2, e=0.6, loss="viscous", tolerance=1e-4):
    return continuum.rebound(x, beta, zeta2, e, loss=loss, tolerance=tolerance)


def spray(rng, n):
    """Groups and incidences near every threshold: zeta^2, beta and slip throughout."""
    beta, zeta2 = rng.uniform(1, 8, n), rng.uniform(0.8, 2.0, n)
    e = np.where(rng.random(n) < 0.2, 1 - 10 ** rng.uniform(-9, -2, n), rng.uniform(0.3, 1, n))
    limit = sliding.limit_alike(beta, zeta2, e)
    flowing = continuum.slip_throughout_limit(beta, zeta2, e, loss="plastic")
    places = [zeta2, beta, limit, limit * rng.random(n), flowing]
    near = np.choose(rng.integers(0, 5, n), places)
    x = near * (1 + 10 ** rng.uniform(-12, -1, n) * rng.choice([-1, 1], n))
    return x, beta, zeta2, e


# ---- the normal motion ----


@pytest.mark.parametrize("tau", [1e-4, 0.05, 0.3, 1.0, 3.0])
def test_restitution_of_viscous_spheres_by_integration_in_time(tau):
    """Kuwabara & Kono in loading, F = (4/3) D^(3/2) in unloading, by SciPy and in plain time."""

    def force(d, v):
        if v > 0:
            return 4 / 3 * (max(d, 0) ** 1.5 + 1.5 * tau * max(d, 0) ** 0.5 * v)
        return 4 / 3 * max(d + tau * v, 0.0) ** 1.5

    def stop(event):
        event.terminal, event.direction = True, -1
        return event

    def slopes(_, y):
        return [y[1], -force(*y)]

    # The first instants by a series: F is not differentiable at d = 0.
    early = 1e-7
    start = [early - 2 * tau * (4 / 15) * early**2.5, 1 - 2 * tau * (2 / 3) * early**1.5]
    ends = stop(lambda _, y: y[1]), stop(lambda _, y: y[0] + tau * y[1])
    loading = solve_ivp(slopes, (0, 50), start, events=ends[0], method="DOP853", **EXACT)
    after = [loading.y[0, -1], 0.0]
    unloading = solve_ivp(slopes, (0, 500), after, events=ends[1], method="DOP853", **EXACT)
    found = kelvin_voigt.restitution(np.array([tau]))
    assert found == pytest.approx(-unloading.y[1, -1], abs=1e-8)
    back = kelvin_voigt.relaxation_time(found)
    assert back == pytest.approx(tau, rel=1e-9)


@pytest.mark.parametrize("loss", LOSSES)
def test_the_normal_motion_obeys_newton_and_the_springs_carry_its_force(loss):
    e = np.array([0.999999, 0.9, 0.6, 0.3, 0.1])
    motion = inelastic.MOTIONS[loss](e)
    motion.put_springs(np.linspace(0, 1, 2049)[:, None])
    np.testing.assert_allclose(motion.velocity[-1], -e, atol=1e-11)
    np.testing.assert_allclose(np.trapezoid(motion.force, motion.time, axis=0), 1 + e, atol=1e-6)
    np.testing.assert_allclose(
        np.cumsum(
            (motion.velocity[1:] + motion.velocity[:-1]) / 2 * np.diff(motion.time, axis=0), 0
        ),
        motion.approach[1:],
        atol=2e-6 * motion.approach.max(),
    )
    assert (np.diff(motion.time, axis=0) > 0).all()
    for k in (100, 1500, 2048, 3000, 4000):
        count = motion.edge(k) + 1
        width = motion.width[:count].copy()
        width[-1] = motion.edge_width[count - 1]
        np.testing.assert_allclose(
            2 * np.sum(width * motion.density(k), axis=0), motion.force[k], rtol=1e-4
        )
        place = motion.place(motion.velocity[k])
        np.testing.assert_allclose(place, motion.edge(k) / 2048, atol=1e-8)


@pytest.mark.parametrize("yield_velocity", [0.001, 0.05, 0.4, 0.99])
def test_restitution_of_elastic_plastic_spheres_is_the_work_of_their_forces(yield_velocity):
    """Thornton's closed form against the energies of loading and unloading, by quadrature."""
    d_yield = (15 / 16 * yield_velocity**2) ** 0.4

    def loading(d):
        if d <= d_yield:
            return 4 / 3 * d**1.5
        # pi p_y with p_y = (2/pi) sqrt(d_y), the largest pressure of Hertz at d_y.
        return 4 / 3 * d_yield**1.5 + 2 * np.sqrt(d_yield) * (d - d_yield)

    def work(d):
        return quad(loading, 0, d, points=[min(d_yield, d)], epsabs=1e-13, limit=200)[0]

    largest = brentq(lambda d: work(d) - 0.5, 1e-3, 1e3, xtol=1e-13)
    radius = 4 / 3 * largest**1.5 / loading(largest)  # R_p
    back = quad(lambda z: 4 / 3 * np.sqrt(radius) * z**1.5, 0, largest / radius, epsabs=1e-13)[0]
    found = yielding.restitution(np.array([yield_velocity]))
    assert found == pytest.approx(np.sqrt(2 * back), abs=1e-9)
    assert yielding.yield_velocity(found) == pytest.approx(yield_velocity, rel=1e-9)


# ---- limits ----


@pytest.fixture(scope="module")
def elastic():
    """Incidences, and the elastic continuum at them to a tenth of what is asked for below."""
    x = np.array([0.3, 1.2, 1.3, 2.0, 3.4, 4.5])
    return x, continuum.rebound(x, tolerance=1e-7)


@pytest.mark.parametrize("loss", LOSSES)
def test_without_loss_it_is_the_elastic_continuum(loss, elastic):
    x, elastic = elastic
    groups = np.full((3, x.size), [[BETA], [ZETA2], [1 - 1e-9]])
    coarse, fine = (
        inelastic.path(x, *groups, inelastic.MOTIONS[loss], steps).velocity[-1]
        for steps in (512, 1024)
    )
    np.testing.assert_allclose(fine + (fine - coarse) / 3, elastic.velocity, atol=1e-6)
    near = solved(x, e=1 - 1e-9, loss=loss, tolerance=1e-4)
    np.testing.assert_allclose(near.peak_friction, elastic.peak_friction, atol=1e-4)
    np.testing.assert_allclose(near.dissipation, elastic.dissipation, atol=3e-4)
    np.testing.assert_array_equal(near.regime, elastic.regime)
    mixed = continuum.rebound(x, restitution=[1, 1, 1, 0.8, 0.8, 1], loss=loss)
    np.testing.assert_allclose(
        mixed.velocity[[0, 1, 2, 5]], elastic.velocity[[0, 1, 2, 5]], atol=1e-4
    )


@pytest.mark.parametrize("loss", [*LOSSES, ELASTIC_SHEAR])
@pytest.mark.parametrize(
    ("beta", "zeta2", "e"), [(3.5, 1.21, 0.6), (3.5, 1.21, 0.4), (8, 0.8, 0.3), (1.2, 2.0, 0.7)]
)
def test_slip_throughout_begins_where_the_derivation_says(loss, beta, zeta2, e):
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


def no_slip_ratio(beta, zeta2, motion):
    """w(tf)/x where friction never limits: every spring follows the body from its first touch.

    The displacement at first touch, integrated over the radius, replaces the springs. While metal
    yields every deflection decays alike: without the factor by which it does, less, it does not.
    """
    tau = float(motion.tau[0]) if motion.dashpots else 0.0
    time, radius = motion.time[:, 0], np.concatenate([motion.radius, motion.radius[-2::-1]])[:, 0]
    middle = len(motion.radius) - 1
    less = np.ones(len(time))
    if not motion.dashpots:
        flowed = motion.flowed(motion.approach)[: middle + 1, 0]
        less[: middle + 1] = np.exp(flowed - flowed[-1])

    def slopes(t, y, memory):
        w, u, kept = y
        a = np.interp(t, time, radius)
        if memory is not None:
            kept = np.interp(a, *memory)
        factor = np.interp(t, time, less)
        force = 2 * (a * (u + tau * w / zeta2) - kept) / zeta2 / factor
        grows = np.interp(t, time[: middle + 1], rate)
        return [-beta * zeta2 * force, w / zeta2 * factor, u * grows]

    rate = np.gradient(radius[: middle + 1], time[: middle + 1])
    loading = solve_ivp(
        slopes,
        (0, time[middle]),
        [1.0, 0.0, 0.0],
        args=(None,),
        t_eval=time[: middle + 1],
        rtol=1e-8,
    )
    memory = radius[: middle + 1], loading.y[2]
    start = [*loading.y[:2, -1], 0.0]
    return solve_ivp(slopes, (time[middle], time[-1]), start, args=(memory,), rtol=1e-8).y[0, -1]


@pytest.mark.parametrize("loss", LOSSES)
@pytest.mark.parametrize(("beta", "zeta2", "e"), [(3.5, 1.21, 0.7), (6.0, 0.9, 0.4)])
def test_with_endless_friction_the_response_is_linear(loss, beta, zeta2, e):
    motion = inelastic.MOTIONS[loss](np.array([e]))
    motion.put_springs(np.linspace(0, 1, 4001)[:, None])
    x = 1e-5
    found = solved(x, beta, zeta2, e, loss, 1e-8 * 100).velocity / x
    assert found == pytest.approx(no_slip_ratio(beta, zeta2, motion), abs=3e-3)


# ---- conservation ----


@pytest.mark.parametrize("loss", ["plastic", ELASTIC_SHEAR])
@pytest.mark.parametrize("e", [0.95, 0.6, 0.4])
def test_friction_and_flow_in_shear_take_what_the_body_loses(e, loss, monkeypatch):
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
    x = np.array([0.3, 0.8, 1.1])  # these stick first, so that every step is booked
    groups = np.full((3, x.size), [[BETA], [ZETA2], [e]])
    off = []
    for steps in (512, 1024, 2048):
        friction.clear()
        flow.clear()
        found = inelastic.path(x, *groups, inelastic.MOTIONS[loss], steps)
        assert np.min(friction) > -1e-6 and np.min(flow) >= 0
        assert (np.sum(flow) > 0) == (loss == "plastic")
        off.append(ZETA2 * (np.sum(friction, axis=0) + np.sum(flow, axis=0)) - found.work)
    assert np.abs(off[-1]).max() < 0.3 * np.abs(off[0]).max() + 1e-6
    np.testing.assert_allclose(off[-1], 0, atol=2e-4)


@pytest.mark.parametrize("e", [0.9, 0.6, 0.35])
def test_viscous_springs_share_the_energy_with_friction(e, monkeypatch):
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
    x = np.array([0.3, 0.8, 1.1])  # these stick first, so that every step is booked
    groups = np.full((3, x.size), [[BETA], [ZETA2], [e]])
    off = []
    for steps in (512, 1024, 2048):
        losses.clear()
        found = inelastic.path(x, *groups, inelastic.MOTIONS["viscous"], steps)
        lost = (x**2 - found.velocity[-1] ** 2) / (2 * BETA)
        off.append(found.work + ZETA2 * losses[-1] - lost)
    # The bookkeeping at the edge has an error of first order, the steps one of second order.
    second = [b + (b - a) / 3 for a, b in zip(off, off[1:], strict=False)]
    np.testing.assert_allclose(2 * second[1] - second[0], 0, atol=1e-6)


@pytest.mark.parametrize("loss", LOSSES)
def test_no_impact_of_a_spray_around_the_thresholds_gains_energy_or_fails(loss):
    x, beta, zeta2, e = spray(np.random.default_rng(11), 300)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = solved(x, beta, zeta2, e, loss, 1e-3)
    assert np.isfinite(found.velocity).all()
    lost = (x**2 - found.velocity**2) / (2 * beta)
    assert (found.dissipation <= lost + 1e-3 * (1 + x)).all()
    assert (found.dissipation >= -1e-3).all()
    assert ((found.peak_friction >= 0) & (found.peak_friction <= 1)).all()
    # Velocity is continuous: on both sides of each threshold it is the same.
    beside = solved(x * (1 + 1e-9), beta, zeta2, e, loss, 1e-3)
    np.testing.assert_allclose(beside.velocity, found.velocity, atol=2e-3)
    np.testing.assert_allclose(beside.peak_friction, found.peak_friction, atol=2e-3)


# ---- input ----


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"restitution": 0.9}, "restitution = 0.9: .* unless loss says .*: viscous, plastic"),
        ({"restitution": 0.9, "loss": "magic"}, "loss = 'magic': allowed are viscous, plastic"),
        ({"restitution": 1.0, "loss": ["viscous"]}, "loss = .*: allowed are viscous, plastic"),
        ({"restitution": 0.05, "loss": "viscous"}, "restitution = 0.05: .* from 0.1 to 1"),
        ({"restitution": [0.5, 0.0], "loss": "plastic"}, r"restitution\[1\] = 0.0: .* from 0.1"),
        ({"restitution": 0.5, "loss": "plastic", "tolerance": 0}, "tolerance = 0"),
    ],
)
def test_bad_input_is_named(arguments, words):
    for solve in (continuum.rebound, continuum.history):
        if np.ndim(arguments["restitution"]) and solve is continuum.history:
            continue
        with pytest.raises(InputError, match=words):
            solve(2.0, **arguments)


@pytest.mark.parametrize("loss", LOSSES)
@pytest.mark.parametrize("x", [0.0, 0.8, -2.0, 4.6, 4.7, 9.0])
def test_a_history_ends_where_the_rebound_does(loss, x):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        contact = continuum.history(x, restitution=0.5, loss=loss, tolerance=1e-3)
    after = solved(x, e=0.5, loss=loss, tolerance=1e-3)
    assert contact.velocity[-1] == pytest.approx(after.velocity, abs=2e-3)
    assert np.abs(contact.friction).max() == pytest.approx(after.peak_friction, abs=5e-3)
    assert (np.abs(contact.friction) <= contact.normal + 1e-12).all()
    assert (np.diff(contact.time) > 0).all() and (
        contact.stick_radius <= contact.contact_radius
    ).all()


@pytest.mark.parametrize("loss", LOSSES)
def test_the_error_falls_smoothly_with_the_square_of_the_steps(loss):
    """What blurs events within a step converges all the same, but does not extrapolate."""
    x = np.linspace(0.2, 4.2, 41)
    groups = np.full((3, x.size), [[BETA], [ZETA2], [0.6]])
    w = [
        inelastic.path(x, *groups, inelastic.MOTIONS[loss], steps).velocity[-1]
        for steps in (128, 256, 512)
    ]
    better = [b + (b - a) / 3 for a, b in zip(w, w[1:], strict=False)]
    # Found 2e-5. An edge with its whole width has 9e-5, slip that ends unseen within steps 1.4e-4.
    assert np.abs(better[1] - better[0]).max() < 4e-5


# ---- the end of slip ----

# Incidence, mass ratio, stiffness ratio, restitution of plastic spheres, tolerance, and the
# velocity that a referee's own solver found. Slip ends just before maximum compression.
LATE_GRIP = [
    (3.43922148, 3.5, 0.053648809, 0.103192658, 1e-4, 0.00458),
    (72.494158, 73.765622, 1.14467462, 0.10953687, 1e-2, 0.1427),
    (10.6521005, 10.8368247, 1.2575419, 0.1280049, 1e-4, 0.16070),
]


@pytest.mark.parametrize(("x", "beta", "zeta2", "e", "tolerance", "right"), LATE_GRIP)
def test_slip_that_ends_late_in_compression(x, beta, zeta2, e, tolerance, right):
    found = solved(x, beta, zeta2, e, ELASTIC_SHEAR, tolerance).velocity
    assert found == pytest.approx(right, abs=tolerance + 5e-5)


# ---- the tolerance ----

# Incidence, mass ratio, stiffness ratio, restitution. In the first three the flow of compression
# ends within its last step, in the others gross slip sets in beside the largest friction.
HARD = [
    (3.6755495479, 3.4062881, 2.203826399, 0.109680571135),
    (6.01693874226, 8.15365246998, 3.10736947386, 0.104485843079),
    (2.60768686052, 1.38866407735, 2.41862201730, 0.130957713876),
    (4.5451606304, 4.457477048, 1.288841751, 0.463385369377),
    (3.60251381602, 3.87451274314, 3.75638451167, 0.286510256363),
    (2.13931079311, 1.45774069894, 2.70959694626, 0.115797158563),
]


def fine(x, beta, zeta2, e, loss):
    """Velocity and peak friction with many steps, extrapolated, and how far that moved last."""
    values = []
    for steps in (256, 512, 1024):
        found = inelastic.path(x, beta, zeta2, e, inelastic.MOTIONS[loss], steps)
        values.append(np.stack([found.velocity[-1], found.peak]))
    before, better = (b + (b - a) / 3 for a, b in zip(values, values[1:], strict=False))
    return better, np.abs(better - before)


def started(rng, n, least):
    """Impacts near a threshold, or whose slip ends beside maximum compression."""
    beta, zeta2 = rng.uniform(1, 9, n), 10 ** rng.uniform(-0.5, 0.6, n)
    e = least * (0.6 / least) ** rng.random(n)
    limit = sliding.limit_alike(beta, zeta2, e)
    x = np.choose(rng.integers(0, 4, n), [zeta2, beta, limit, limit * rng.random(n)])
    return np.stack(
        [x * (1 + 10 ** rng.uniform(-5, -1, n) * rng.choice([-1, 1], n)), beta, zeta2, e]
    )


@pytest.mark.parametrize(
    ("loss", "tolerance", "least"),
    [
        ("plastic", 5e-3, 0.1),
        ("plastic", 1e-4, 0.3),
        ("viscous", 5e-3, 0.1),
        ("viscous", 1e-4, 0.1),
    ],
)
def test_no_search_finds_an_error_above_the_tolerance(loss, tolerance, least):
    """It climbs from the largest errors of velocity and peak friction to larger ones."""
    rng = np.random.default_rng(49)
    hard = np.array([impact for impact in HARD if impact[3] >= least]).T
    groups = np.concatenate([hard, started(rng, 24, least)], axis=1)
    for spread in (0.1, 0.01, 0.001):
        right, unsure = fine(*groups, loss)
        found = solved(*groups, loss, tolerance)
        off = np.abs([found.velocity, found.peak_friction] - right) - unsure
        slides = found.regime == Regime.SLIP_THROUGHOUT
        shares = np.where(slides, 0.0, off) / tolerance
        assert np.max(shares) <= 1, groups[:, np.argmax(shares.max(axis=0))]
        worst = np.unique(np.argsort(shares)[:, -4:])
        groups = np.repeat(groups[:, worst], 3, axis=1)
        groups *= np.exp(spread * rng.normal(size=groups.shape))
        groups[1], groups[3] = np.maximum(groups[1], 1), np.clip(groups[3], least, 0.99)


@pytest.mark.parametrize("tolerance", [1e-3, 3e-4, 1e-4])
def test_peak_friction_as_gross_slip_sets_in_between_two_instants(tolerance):
    """Against the largest friction at an instant of 8192 steps, with digits to spare."""
    right = [0.999969, 0.985976, 0.956572]
    losses = "plastic", "plastic", "viscous"
    for impact, loss, peak in zip(HARD[3:], losses, right, strict=True):
        found = solved(*impact, loss, tolerance).peak_friction
        assert found == pytest.approx(peak, abs=tolerance)


@pytest.mark.parametrize(
    ("loss", "tolerance", "impact"),
    [
        ("plastic", 5e-3, (113.94826, 449.24353, 0.38289, 0.83988)),
        ("plastic", 5e-3, (156.28146, 67.86213, 2.45478, 0.10157)),
        ("plastic", 1e-5, HARD[3]),
        ("viscous", 5e-3, (5.14695, 277.96261, 0.48473, 0.67353)),
    ],
)
def test_impacts_that_take_many_steps_are_solved(loss, tolerance, impact):
    """Many oscillations, a flow that few steps do not resolve, and dashpots that are stiff."""
    last = []
    for steps in (2048, 4096):
        found = inelastic.path(*np.array(impact)[:, None], inelastic.MOTIONS[loss], steps)
        last.append(found.velocity[-1, 0])
    right, unsure = last[1] + (last[1] - last[0]) / 3, abs(last[1] - last[0]) / 2
    assert solved(*impact, loss, tolerance).velocity == pytest.approx(right, abs=tolerance + unsure)


@pytest.mark.parametrize("loss", [None, *LOSSES])
def test_a_tolerance_may_be_a_share_of_any_incidence(loss):
    """As friction becomes large, x vanishes, and the velocity vanishes in proportion to it."""
    rng, n, tolerance = np.random.default_rng(50), 24, 5e-3
    x = 10.0 ** np.concatenate([[-300.0, -100.0, -12.0], rng.uniform(-9, 0, n - 3)])
    beta, zeta2 = 10 ** rng.uniform(0, 1.6, n), 10 ** rng.uniform(-0.5, 0.6, n)
    e = rng.uniform(0.1, 0.97, n) if loss else np.ones(n)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found, _, messages = rungs.solved(loss, x, (beta, zeta2, e), tolerance * x)
    assert not messages
    near = np.maximum(x, 1e-7)  # it is linear below
    if loss:
        law = inelastic.MOTIONS[loss]
        coarse, fine = (
            inelastic.path(near, beta, zeta2, e, law, steps).velocity[-1] for steps in (1024, 2048)
        )
        right = fine + (fine - coarse)  # as slip becomes narrow the error falls with the step
    else:
        right = continuum.fixed_steps(near, beta, zeta2, 2048)
    np.testing.assert_allclose(found.velocity / x, right / near, rtol=0, atol=tolerance)


def test_an_unresolved_oscillation_refuses_nothing_that_more_steps_can_solve():
    """Before 880 steps the peak of friction comes out above 1, which says nothing of the rest."""
    found = solved(0.0131, 3.5, 0.0535, 0.1032, ELASTIC_SHEAR, 1e-3)
    assert found.velocity == pytest.approx(0.00178, abs=1e-4)
    assert found.peak_friction == pytest.approx(0.08355, abs=1e-4)
