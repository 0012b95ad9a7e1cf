"""The paper's collinear lumped model, solved to rounding (Stronge 1994, Eqs 4-27).

A linear normal element (stiffness kappa, kappa/e^2 in restitution) and a linear tangential
element (kappa/zeta^2) join the body to a massless particle that sticks to the surface or slips
on it with Coulomb friction. `by_loss` has the solver of each loss of energy, `stick_slip` the
phases in closed form, `slip_onset` where slip starts. Histories, and impacts with
dashpots, are followed by `planarimpact.phases`.

The keyword `loss` names what takes the normal energy where e < 1, one of `LOSSES`: "hysteretic" is
the paper's. `planarimpact.common.losses` says what each one is. At e = 1 all are the same model.

All four functions take arguments of `rebound`, which says what they mean and their ranges:
`incidence`, `mass_ratio`, `stiffness_ratio`, `restitution` and `loss`. `history` is of one contact:
it takes scalars alone. An argument not allowed raises `InputError`.

Errors that these functions state are those of the solution. The model itself is further off. For a
solid sphere of Poisson's ratio 0.3 and e = 1 its velocity differs from the elastic continuum by up
to 0.22 mu v2(0). On the hysteretic loss the evidence is divided: measured pairs of materials
differ from it, and to a measured rubber sphere it is the nearest. At e = 0.8 it differs by up to
0.73 from the viscous continuum and by up to 0.90 from the plastic one.
"""

from __future__ import annotations

import math

import numpy as np

from planarimpact.common import checks
from planarimpact.common.arrays import Array, ArrayLike
from planarimpact.common.losses import LUMPED, LumpedLoss
from planarimpact.common.results import History, Rebound, of_groups
from planarimpact.lumped import by_loss, one_impact
from planarimpact.lumped.stick_slip import Impacts

# Names of the losses that this model has.
LOSSES = tuple(LUMPED)


@of_groups
def rebound(
    incidence: ArrayLike,
    mass_ratio: ArrayLike = 3.5,
    stiffness_ratio: ArrayLike = 1.21,
    restitution: ArrayLike = 1.0,
    *,
    loss: LumpedLoss = "hysteretic",
) -> Rebound:
    """State at separation; all arguments broadcast.

    Parameters
    ----------
    incidence : array_like
        x = v1(0)/(mu v2(0)), tangential over normal speed and friction. Any number to 1e100;
        a negative one gives the mirror image.
    mass_ratio : array_like
        beta = m2/m1, 1 to 1e12 (Eqs 1, 2); 3.5 for a solid sphere on a half-space.
    stiffness_ratio : array_like
        zeta^2, normal over tangential stiffness, to 1e12; (2 - nu)/(2 (1 - nu)) for elastic
        spheres. At least 1e-8 beta: the frequency omega/Omega = (beta/zeta^2)^(1/2) is up to 1e4.
        With the loss "unloading-stiffness" that holds for e^2 zeta^2, so that e = 0 has none. A
        stiffer contact is one without tangential compliance, `planarimpact.rigid`.
    restitution : array_like
        Energetic coefficient e, 0 or 1e-12 to 1 (Eq. 5).
    loss : str
        What takes the normal energy, one of `LOSSES`.

    Returns
    -------
    Rebound
        velocity, peak_friction, dissipation, regime, in the broadcast shape (scalars for
        scalars); velocity has the sign of `incidence` where the direction is kept. With viscous
        loss the peak is in mu times the largest normal force of that very impact, and the
        dissipation is the work of friction alone: what the tangential dashpot takes, and the
        strain left in the tangential spring at separation, are lost besides.

    Raises
    ------
    InputError
        If an argument is not a finite real number in its range, or shapes do not broadcast. With
        viscous loss and e < 1 the range is smaller: restitution from 1e-3 (a viscous element does
        not stop a body for good), mass ratio to 1e6, stiffness ratio from 0.01 to 1e6 times the
        mass ratio.

    Notes
    -----
    The errors of velocity, peak friction and dissipation, as a solution of the model, are at most a
    hundred times the effect of rounding the four arguments. This holds in every regime, and at the
    thresholds. The exception is a dissipation below 1e-16 of the energy, where T and N fall
    together (zeta^2 next to beta, e = 1). The time grows with the number of phases, that is with
    e omega/Omega. Stronge's printed equations differ in two places: the limit of slip throughout
    (see `slip_throughout_limit`) and the direction of the last slip, which at small e is the
    incident one.

    With viscous loss the errors are at most 1e-9: of the velocity relative to max(1, x, beta),
    of the peak to 1, of the dissipation to x^2/(2 beta) or, if that is smaller, (1 + e) x. The
    dissipation of friction that is weaker than rounding of the normal force is known to 1e-15 x.

    Examples
    --------
    >>> from planarimpact import Regime
    >>> result = rebound([0.5, 2.0, 8.0])
    >>> [Regime(code).name for code in result.regime]
    ['STICK_SLIP', 'SLIP_STICK_SLIP', 'SLIP_THROUGHOUT']
    >>> float(result.velocity[2])  # x - (1 + e) beta
    1.0
    >>> for loss in ("hysteretic", "viscous"):
    ...     print(round(float(rebound(2.0, restitution=0.8, loss=loss).velocity), 6))
    -1.068366
    -0.349825
    """
    chosen = LUMPED[checks.loss(loss, LUMPED)]
    x, *groups = checks.impact(incidence, mass_ratio, stiffness_ratio, restitution)
    if not x.ndim:
        signed, beta, zeta2, e = map(float, (x, *groups))
        found = one_impact.rebound(chosen, abs(signed), beta, zeta2, e)
        if found:
            velocity, *others, regime = found
            numbers = map(np.float64, (math.copysign(1.0, signed) * velocity, *others))
            return Rebound._make([*numbers, regime, None])
    return Rebound.shaped(x, *by_loss.solve(chosen, _flat(x, *groups)))


@checks.default_errors
def slip_throughout_limit(
    mass_ratio: ArrayLike = 3.5,
    stiffness_ratio: ArrayLike = 1.21,
    restitution: ArrayLike = 1.0,
    *,
    loss: LumpedLoss = "hysteretic",
) -> Array:
    """Smallest incidence that slides through the whole contact; all arguments broadcast.

    x = beta + max(0, e beta - zeta^2/e), or zeta^2 where that is larger; `common.sliding` derives
    it. The paper prints (1 + e) beta (heading of Eq. 26), but by its own conditions for the end of
    the first slip, Eqs 17 to 20, that slip does not end above the value given here.

    The stiffness ratio of the loss stands for zeta^2: e^2 zeta^2 with "unloading-stiffness". With
    dashpots it is max(zeta^2, beta + e (beta - zeta^2)).

    Arguments and errors: `planarimpact.lumped`. Here omega/Omega has no limit, and with viscous
    loss the ratios and the restitution have none of their own.

    Returns
    -------
    ndarray of float64 or float
        Incidence v1(0)/(mu v2(0)).

    Examples
    --------
    >>> float(slip_throughout_limit(3.5, 1.21, 1.0))
    5.79
    >>> float(slip_throughout_limit(3.5, 5.0, 0.5, loss="unloading-stiffness"))
    3.5
    """
    chosen = LUMPED[checks.loss(loss, LUMPED)]
    _, *groups = checks.impact(0.0, mass_ratio, stiffness_ratio, restitution)
    return by_loss.slides_from(chosen, *groups)[()]


@checks.default_errors
def history(
    incidence: float,
    mass_ratio: float = 3.5,
    stiffness_ratio: float = 1.21,
    restitution: float = 1.0,
    samples: int = 400,
    *,
    loss: LumpedLoss = "hysteretic",
) -> History:
    """Forces and velocity over one contact (Figs 3 and 4).

    Arguments and errors: `planarimpact.lumped`. Besides, `samples`, an integer of at least 2, is
    the number of instants, evenly spread over the contact. Events come on top, so that every one
    is a vertex.

    Returns
    -------
    History
        time in t_c, normal, friction_force, velocity, spring, events; with omega/Omega up to 1e3 to
        1e-13 of the largest force and of max(1, x, beta), beyond that to 1e-12. With viscous loss
        t_c is half of the contact, and both forces jump at contact, as the dashpots act at once.

    Examples
    --------
    >>> contact = history(1.0, restitution=0.5, samples=5)
    >>> [str(event.kind) for event in contact.events]
    ['contact', 'stick', 'maximum compression', 'slip', 'separation']
    >>> float(contact.time[-1])
    1.5
    """
    samples = checks.count("samples", samples, 2)
    chosen = LUMPED[checks.loss(loss, LUMPED)]
    x, *groups = checks.impact(incidence, mass_ratio, stiffness_ratio, restitution)
    if x.ndim:
        raise checks.InputError(f"shape = {x.shape}: one contact takes scalars")
    return by_loss.history(chosen, float(np.copysign(1.0, x)), _flat(x, *groups), samples)


@checks.default_errors
def friction_work(
    incidence: ArrayLike,
    mass_ratio: ArrayLike = 3.5,
    stiffness_ratio: ArrayLike = 1.21,
    restitution: ArrayLike = 1.0,
    *,
    loss: LumpedLoss = "hysteretic",
) -> Array:
    """Work of friction, integrated over the phases of slip: |F1| times the slip velocity.

    This checks `rebound(...).dissipation`, which comes from the balance of energy: the contacts are
    followed by `planarimpact.phases`. The two differ by what the tangential spring loses when
    e = 0. With viscous loss and e < 1 both are the same integral. Arguments and errors:
    `planarimpact.lumped`.

    Returns
    -------
    ndarray of float64 or float
        In mu^2 m2 v2(0)^2.

    Examples
    --------
    >>> balance = rebound(2.0).dissipation
    >>> bool(abs(friction_work(2.0) - balance) < 1e-14)
    True
    """
    chosen = LUMPED[checks.loss(loss, LUMPED)]
    x, *groups = checks.impact(incidence, mass_ratio, stiffness_ratio, restitution)
    return by_loss.friction_work(chosen, _flat(x, *groups)).reshape(x.shape)[()]


def _flat(x: Array, *groups: Array) -> Impacts:
    """Impacts by the size of their incidence, flat."""
    return Impacts(np.abs(x).reshape(-1), *(group.reshape(-1) for group in groups))
