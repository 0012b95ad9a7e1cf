"""Oblique impact of spheres with micro-slip: the continuum, elastic or with a loss of energy.

A Hertz contact slips in an outer annulus and sticks inside, as Maw, Barber & Fawcett (1976)
describe it. The method is that of dimensionality reduction: a row of springs. `elastic` has the
case e = 1, with the normal motion of `normal_impact.hertz`, the springs of `micro_slip` and the
steps of `tangential_motion`. `inelastic` has two ways to lose energy below e = 1. `refinement`
doubles the number of steps until the answer, extrapolated once, meets the tolerance.

Gross slip from the start of contact needs no steps: its closed form is exact. So are impacts that
slide throughout.

Arguments and errors: `rebound` says what its arguments mean, also for the other functions, and what
is refused.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from planarimpact.common import checks, sliding
from planarimpact.common.arrays import SMALLEST, Array, ArrayLike
from planarimpact.common.losses import PLASTIC, SPHERES, VISCOUS, SpheresLoss
from planarimpact.common.records import record
from planarimpact.common.results import Rebound, of_groups
from planarimpact.continuum import elastic, inelastic, refinement
from planarimpact.continuum.inelastic.motion import NormalMotion
from planarimpact.continuum.refinement import Unsolved as Unsolved
from planarimpact.normal_impact import hertz

# Names of the losses that spheres have.
LOSSES = tuple(SPHERES)
LEAST_RESTITUTION = max(VISCOUS.least_restitution, PLASTIC.least_restitution)
# Default tolerances.
ELASTIC_TOLERANCE, LOSSY_TOLERANCE = 1e-6, 1e-4


@record
class ContinuumHistory(NamedTuple):
    """Forces, velocity and the edge of stick over one contact of a continuum.

    Attributes
    ----------
    time : ndarray, shape (n,)
        t/t_c, from 0 to separation, 2 where e = 1; t_c is the time of compression.
    normal : ndarray, shape (n,)
        Normal force F2 over its largest value.
    friction_force : ndarray, shape (n,)
        Tangential force F1 over mu times the largest normal force; positive opposes a positive
        incidence.
    velocity : ndarray, shape (n,)
        w = v1/(mu v2(0)).
    contact_radius : ndarray, shape (n,)
        Radius of contact over its largest value.
    stick_radius : ndarray, shape (n,)
        Radius inside which the contact sticks, in the same unit: the radius of contact while
        nothing slips, 0 in gross slip.
    """

    time: Array
    normal: Array
    friction_force: Array
    velocity: Array
    contact_radius: Array
    stick_radius: Array


@of_groups
def rebound(
    incidence: ArrayLike,
    mass_ratio: ArrayLike = 3.5,
    stiffness_ratio: ArrayLike = 1.21,
    restitution: ArrayLike = 1.0,
    *,
    loss: SpheresLoss | None = None,
    tolerance: ArrayLike | None = None,
) -> Rebound:
    """State at separation; the groups broadcast.

    Parameters
    ----------
    incidence, mass_ratio, stiffness_ratio : array_like
        As in `planarimpact.lumped.rebound`. Impacts that do not slide throughout need a mass ratio
        up to 6.8e6 zeta^2, with viscous loss 4.2e5 zeta^2, with plastic loss that times the force
        of Hertz's law that is left at maximum compression (0.44 of it for e = 0.6, 0.012 for
        e = 0.1): more tangential oscillations are not resolved. In the variables of Maw
        et al. psi1 = x/zeta^2, chi = beta/(2 zeta^2).
    restitution : array_like
        1, the contact is elastic; or from 0.1, with a `loss`.
    loss : str, optional
        What takes the energy where e < 1: "viscous", alike in shear and compression, or "plastic",
        Thornton's sphere, in which shear flows while metal yields.
    tolerance : array_like, optional
        Largest error allowed in velocity (mu v2(0)) and peak friction (mu F2max of this impact), by
        the solver's own estimate; above 0. It broadcasts with the groups. By default 1e-6, with a
        loss 1e-4. For a solid sphere 1e-8 is met if e = 1, 1e-9 not always; 1e-5 if e is 0.4 or
        more (viscous 0.3), 1e-6 not always. With zeta^2 from 0.3 to 4, 5e-3 is met up to a mass
        ratio of 110 with plastic loss (1000 from e = 0.11), with viscous loss 130 zeta^2 (670
        zeta^2 from e = 0.6); beyond that some impacts are refused.

    Returns
    -------
    Rebound
        velocity, peak_friction, dissipation, regime, reversals, in the broadcast shape (scalars
        for scalars).

    Raises
    ------
    InputError
        If an argument is not a finite real number in its range, or shapes do not broadcast.
    ConvergenceError
        If the tolerance is not met with `MOST_STEPS` steps, or is out of their reach. `impacts`
        has the flat indices of all such impacts, the message describes the first.

    Notes
    -----
    The error falls with the square of the number of steps. After extrapolation it falls with the
    power 2.5 on average, as gross slip sets in with a root of time. With a loss it falls with the
    first power while slip is narrower than a step, as x vanishes. The error is estimated, not
    bounded: it is five times, with a loss twice, the largest of three numbers, the last change of
    the extrapolated answer, a quarter of the change before it, and a quarter of what extrapolation
    corrects. All of the correction counts where one gross slip more or less is within reach of the
    error. A reversal of friction shorter than a step, just below slip throughout, is not counted.

    With plastic loss a tangential deflection decays while the contact loads and yields, by
    exp(-0.95 g) when the permanent part of the approach has grown by g times d_y, the approach
    where yield begins (`planarimpact.normal_impact.yielding`). The constant 0.95 was fixed on
    finite elements of two equal solid spheres with nu = 0.3, mu = 0.1 and e = 0.46, 0.55 and 0.63.
    With mu up to 0.1, nu = 0.3 and 0.45, e from 0.45 to 0.97 finite elements differ from this law
    by 0.04 mu v2(0) (root mean square), 0.15 at most; at e = 0.39 by 0.11, 0.21 at most. It does
    not hold for mu above 0.2, where friction exceeds the shear strength of the surface (off by up
    to 0.9 at mu = 0.4), for dissimilar bodies (see `bodies.dundurs`; off by up to 0.5 on a rigid
    plane), for e below 0.4, large strain, or strength that depends on rate. The finite elements
    are in data/finite_elements.

    The law gives the force, and two pressures that do not agree. Here it is that of Hertz at all
    times.

    The dissipation is the work of friction, with plastic loss together with that of the flow in
    shear. With viscous loss the tangential motion also loses energy in the material, and at
    separation some strain is left.

    References
    ----------
    N. Maw, J. R. Barber, J. N. Fawcett, Wear 38 (1976) 101-114. V. L. Popov, M. Hess, Method of
    Dimensionality Reduction in Contact Mechanics and Friction, Springer 2015. V. L. Popov, E.
    Willert, M. Hess, Facta Universitatis, Mech. Eng. 16 (2018) 141-156: viscoelastic bodies. C.
    Thornton, J. Appl. Mech. 64 (1997) 383-386.

    Examples
    --------
    >>> from planarimpact import Regime
    >>> result = rebound([0.5, 2.0, 8.0])
    >>> [Regime(code).name for code in result.regime]
    ['STICK_SLIP', 'SLIP_STICK_SLIP', 'SLIP_THROUGHOUT']
    >>> [round(float(w), 5) for w in result.velocity]
    [0.06343, -0.66592, 1.0]
    >>> viscous = rebound([0.5, 2.0, 8.0], restitution=0.6, loss="viscous", tolerance=1e-4)
    >>> [round(float(w), 3) for w in viscous.velocity]
    [-0.065, -0.363, 2.4]
    """
    if tolerance is None:
        tolerance = ELASTIC_TOLERANCE if loss is None else LOSSY_TOLERANCE
    rule = "finite numbers above 0"  # of a tiny incidence it may be tiny too
    allowed = checks.checked("tolerance", tolerance, rule, SMALLEST)
    groups = incidence, mass_ratio, stiffness_ratio, restitution
    signed, beta, zeta2, e, allowed = checks.impact(*groups, tolerance=allowed)
    kind = _kind_of_motion(restitution, loss)
    x, beta, zeta2, e, allowed = (a.reshape(-1) for a in (np.abs(signed), beta, zeta2, e, allowed))
    velocity, peak, work = (np.empty(x.size) for _ in range(3))
    regime, reversals = (np.empty(x.size, np.int64) for _ in range(2))
    for is_elastic in (True, False):
        rows = np.flatnonzero((e == 1) == is_elastic)
        if not rows.size:
            continue
        own = x[rows], beta[rows], zeta2[rows]
        with refinement.counted_among(rows):
            if is_elastic or kind is None:
                solved = elastic.rebound(*own, allowed[rows])
            else:
                solved = inelastic.rebound(*own, e[rows], kind, allowed[rows])
        velocity[rows], peak[rows], work[rows], regime[rows], reversals[rows] = solved
    return Rebound.shaped(signed, velocity, peak, work, regime.astype(np.uint8), reversals)


@checks.default_errors
def slip_throughout_limit(
    mass_ratio: ArrayLike = 3.5,
    stiffness_ratio: ArrayLike = 1.21,
    restitution: ArrayLike = 1.0,
    *,
    loss: SpheresLoss | None = None,
) -> Array:
    """Incidence from which the contact slides throughout; all arguments broadcast.

    max(zeta^2, beta + e (beta - zeta^2)), where the contact would stick last at separation. With
    plastic loss it may be larger: while metal flows in shear, friction below its limit can hold the
    middle of the contact. Derived in `planarimpact.common.sliding`, and for plastic loss in
    `inelastic.plastic`. Arguments and errors: `planarimpact.continuum`.

    Examples
    --------
    >>> [round(float(slip_throughout_limit(restitution=e, loss="plastic")), 3) for e in (0.8, 0.4)]
    [5.332, 7.856]
    """
    _, beta, zeta2, e = checks.impact(0.0, mass_ratio, stiffness_ratio, restitution)
    kind = _kind_of_motion(restitution, loss)
    incidence = np.array(sliding.limit_alike(beta, zeta2, e))
    lossy = e < 1
    if kind is not None and lossy.any():
        incidence[lossy] = kind(e[lossy]).slides_from(beta[lossy], zeta2[lossy])
    return incidence[()]


@checks.default_errors
def history(
    incidence: float,
    mass_ratio: float = 3.5,
    stiffness_ratio: float = 1.21,
    restitution: float = 1.0,
    *,
    loss: SpheresLoss | None = None,
    tolerance: float = 1e-4,
) -> ContinuumHistory:
    """Forces, velocity and radius of stick over one contact.

    Arguments and errors: `planarimpact.continuum`; it takes scalars alone. Here the tolerance is
    the largest error allowed in friction and velocity at every instant. It also decides how many
    instants there are, at least 128.

    Notes
    -----
    Gross slip from the start is exact. At its threshold, x = zeta^2, every spring is at the limit
    of friction as long as the contact grows, and rounding decides the radius of stick. For e < 1
    the radius of stick is that of one of the springs.

    Examples
    --------
    >>> contact = history(1.0)
    >>> float(contact.time[-1]), float(contact.stick_radius[-1])
    (2.0, 0.0)
    >>> round(float(history(1.0, restitution=0.6, loss="plastic").time[-1]), 3)
    1.689
    """
    signed, beta, zeta2, e = checks.impact(incidence, mass_ratio, stiffness_ratio, restitution)
    rule = "finite numbers above 0"
    allowed = np.full(1, checks.number("tolerance", tolerance, rule, 0, open_low=True))
    kind = _kind_of_motion(restitution, loss)
    if signed.ndim:
        raise checks.InputError(f"shape = {signed.shape}: one contact takes scalars")
    x, beta, zeta2, e = (a.reshape(1) for a in (np.abs(signed), beta, zeta2, e))
    mirror = float(np.copysign(1.0, signed))
    if kind is not None and e[0] < 1:
        time, normal, friction, velocity, radius, stick_radius = inelastic.contact(
            x, beta, zeta2, e, kind, allowed
        )
    else:
        phase, friction, velocity, stick_radius = elastic.contact(x, beta, zeta2, allowed)
        radius = np.sin(phase)
        time, normal = hertz.time(phase), radius**3
    radius[-1] = friction[-1] = normal[-1] = stick_radius[-1] = 0.0
    return ContinuumHistory(
        time, normal, mirror * friction, mirror * velocity, radius, stick_radius
    )


def _kind_of_motion(restitution: ArrayLike, loss: str | None) -> type[NormalMotion] | None:
    """How spheres with this loss move; refuse impacts that lose too much, or do not say how."""
    if loss is None:
        checks.require_loss(restitution, LOSSES)
        return None
    found = inelastic.MOTIONS[SPHERES[checks.loss(loss, SPHERES)]]
    allowed = f"numbers from {LEAST_RESTITUTION} to 1, with a loss"
    checks.checked("restitution", restitution, allowed, LEAST_RESTITUTION, 1)
    return found
