"""One impact on the paper's springs in Python's own floats: the bits of arrays in less time."""

from planarimpact.common import floats, sliding
from planarimpact.common.checks import LARGEST_FREQUENCY, ConvergenceError
from planarimpact.common.floats import HALF_PI
from planarimpact.common.losses import Loss
from planarimpact.common.results import Regime
from planarimpact.lumped import slip_onset, stick_slip
from planarimpact.lumped.stick_slip import Impacts

Answer = tuple[float, float, float, Regime]


def rebound(loss: Loss, x: float, beta: float, zeta2: float, e: float) -> Answer | None:
    """Velocity, peak friction, dissipation and regime of an impact x >= 0 with checked groups.

    None where the functions of arrays must answer it, with dashpots and e < 1, or refuse it, as the
    tangential element is too stiff.
    """
    impact = Impacts(x, beta, loss.stiffness_ratio(zeta2, e), e)
    if (loss.dashpots and e < 1) or beta > LARGEST_FREQUENCY**2 * impact.zeta2:
        return None
    velocity, peak, work, regime = _solve(impact)
    # Rounding must not create energy.
    return min(max(velocity, -x), x), peak, max(work, 0.0), regime


def _solve(impact: Impacts) -> Answer:
    """As `stick_slip.solve`, of floats."""
    x, beta, zeta2, e = impact
    if x >= sliding.limit(beta, zeta2, e):
        line = float(sliding.velocity(x, beta, e)), 1.0, float(sliding.work(x, beta, e))
        return *line, Regime.SLIP_THROUGHOUT
    start, regime = stick_slip.STARTS[0 if x <= zeta2 else 1 if x <= beta else 2]
    amplitude, theta, eta, work = start(impact, floats)
    omega, side, peak = floats.sqrt(beta / zeta2), 1.0, 1.0
    if omega < 1 < amplitude and amplitude * floats.sin(theta) > 1:
        velocity, work = stick_slip.slip_from_compression(impact, floats)
        return velocity, peak, work, regime
    if e == 0 or x == 0:
        ending = stick_slip.stick_to_separation(amplitude, theta, impact, floats)
        velocity, peak, strain = ending
        return velocity, peak, work + strain, Regime.SLIP_STICK if x > zeta2 else Regime.STICK
    rate = e * omega
    for count in range(stick_slip.most_sticks(rate)):
        sticks_at_peak = count == 0 and eta == HALF_PI
        eta, rho, wave = slip_onset.in_restitution(eta, theta, amplitude, rate, floats)
        side = -side if wave % 2 else side
        slip = stick_slip.slip_to_separation(eta, rho, amplitude, omega, impact, floats)
        force, velocity, slip_work, *ends = slip
        if sticks_at_peak:
            peak = force if wave == 0 and rho < HALF_PI else amplitude
        if rate <= 1 or ends[1] >= 0:
            return side * velocity, peak, work + slip_work, regime
        amplitude, theta, eta, slip_work = stick_slip.stick_again(ends[0], ends[1], impact, floats)
        work, regime = work + slip_work, Regime.MULTIPLE
    raise ConvergenceError("1 impacts stick more often than they can")
