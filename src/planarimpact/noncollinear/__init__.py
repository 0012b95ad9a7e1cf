"""Impact of a body whose centre is not on the contact normal (Stronge 1994, Eqs 1-5, 8, 9).

The paper derives the coupled equations and then solves the collinear case only. Here the coupled
equations are solved, with the contact of `planarimpact.lumped`: linear normal and tangential
elements, Coulomb friction, energetic restitution. Normal and tangential motion are coupled. So
compression may end and begin again. And friction may press the body into the surface faster than
the normal force slows it (jam), until the contact point sticks.

`inverse_mass` makes the argument of `rebound` and `history` from a body, and `combined` from two.
`rigid` solves the same impact without compliance. `planarimpact.phases` follows the contact:
`off_centre` is its motion, `closed` the limit e -> 0. Axes and signs: `configuration`.

Arguments and errors: `rebound` says what its arguments mean, also for the other functions that take
them. `InputError` says which argument is no finite real number in its range, or which shapes do not
broadcast.

Symbols: v1, v2 tangential and normal velocity of the contact point; mu friction, e restitution,
kappa stiffness, zeta^2 stiffness ratio; 1/m1, c and 1/m2 the inverse mass; V = v1/v2, C = m2 c and
beta = m2/m1 in the solver's units.
"""

from __future__ import annotations

import warnings
from typing import Any, NamedTuple

import numpy as np

from planarimpact.common import checks
from planarimpact.common.arrays import Array, ArrayLike, Booleans, Integers
from planarimpact.common.checks import (
    LARGEST_RATIO,
    LEAST_RATIO,
    ConvergenceError,
    InputError,
    finite,
    positive,
)
from planarimpact.common.losses import NONCOLLINEAR, NoncollinearLoss
from planarimpact.common.records import record
from planarimpact.common.results import Regime
from planarimpact.noncollinear import rigid
from planarimpact.noncollinear.configuration import (
    InverseMass,
    checked_impact,
    combined,
    fields_of,
    inverse_mass,
)
from planarimpact.noncollinear.configuration import of_arrays as of_arrays
from planarimpact.noncollinear.timeline import NoncollinearHistory, timeline
from planarimpact.phases import Step
from planarimpact.phases.closed import solve
from planarimpact.phases.off_centre import OffCentre, Q, Y

__all__ = [
    "InverseMass",
    "NoncollinearHistory",
    "NoncollinearRebound",
    "combined",
    "history",
    "inverse_mass",
    "kinetic_energy",
    "rebound",
    "rigid",
]

# Least restitution but 0 where friction can hold a contact closed.
LEAST_RESTITUTION = 1e-3
# What `OffCentre` takes, as messages name it.
GROUPS = "tangential", "mass_ratio", "coupling", "stiffness_ratio", "friction", "restitution"


@record
class NoncollinearRebound(NamedTuple):
    """The state at separation, one entry an impact; scalars where all arguments were scalars.

    Attributes
    ----------
    tangential, normal : ndarray of float64 or float
        Velocity of the contact point [m/s]; normal is negative or 0, the body leaves.
    tangential_impulse, normal_impulse : ndarray of float64 or float
        Of friction and normal force [N s], positive where they oppose positive velocities.
    peak_friction, peak_normal : ndarray of float64 or float
        Largest |F1| and F2 [N].
    friction_work : ndarray of float64 or float
        Energy that friction dissipates [J]; for e = 0 with the tangential strain energy that is
        lost where the contact separates at maximum compression.
    hysteresis : ndarray of float64 or float
        Energy lost in the normal element [J].
    duration : ndarray of float64 or float
        Of the contact [s].
    regime : ndarray of uint8 or Regime
        Codes of `Regime`; UNRESOLVED where the solver gave up.
    jams : ndarray of bool or bool
        Whether the contact slips, for a time, while friction presses the body into the surface
        more than the normal force pushes it off. For e = 0 the last slip before separation takes no
        time: it counts neither here nor in `regime`.
    """

    tangential: Array
    normal: Array
    tangential_impulse: Array
    normal_impulse: Array
    peak_friction: Array
    peak_normal: Array
    friction_work: Array
    hysteresis: Array
    duration: Array
    regime: Integers | Regime
    jams: Booleans


@checks.default_errors
def rebound(
    tangential: ArrayLike,
    normal: ArrayLike,
    inverse_mass: InverseMass,
    friction: ArrayLike,
    restitution: ArrayLike = 1.0,
    stiffness_ratio: ArrayLike = 1.21,
    stiffness: ArrayLike = 1.0,
    *,
    loss: NoncollinearLoss | None = None,
) -> NoncollinearRebound:
    """State at separation; all arguments broadcast.

    Parameters
    ----------
    tangential, normal : array_like
        Velocity of the contact point before the impact [m/s]; normal > 0 is approach.
    inverse_mass : InverseMass
        Of one body or, combined, of two [1/kg].
    friction : array_like
        Coulomb's mu, from 0.
    restitution : array_like
        Energetic coefficient e, 0 to 1: the normal element has the stiffness kappa in
        compression and kappa/e^2 below its largest compression. e = 0 is the limit e -> 0: the
        contact separates at a maximum of compression, unless it sticks there and friction holds it
        closed (mu |c| m2 > 1). Then it separates when friction has fallen to zero.
    stiffness_ratio : array_like
        zeta^2 > 0, normal over tangential stiffness.
    stiffness : array_like
        kappa [N/m] of the normal element; it scales forces and duration, nothing else.
    loss : str, optional
        What takes the energy, as in `planarimpact.lumped`; needed where e < 1. With
        "unloading-stiffness" e is above 0. There is no loss with dashpots: a normal one would pull
        at the end of contact, and a coupled contact that separates and closes again under such a
        force is not solved.

    Raises
    ------
    InputError
        Also if arguments are out of reach of the solver: mu above 1e12; frequencies omega/Omega =
        sqrt(m2/(m1 zeta^2)) above 1e4; with mu |c| m2 > 1, where friction can hold the contact
        closed, a restitution below 1e-3 that is not 0: N rattles some 1/e times.
    ConvergenceError
        If the arguments are scalars and the solver gives up, as below.

    Warns
    -----
    RuntimeWarning
        If the solver gives up some impacts of an array: their numbers are NaN, the others are
        solved. The warning names the flat indices; they are `numpy.isnan(result.tangential)`. The
        solver gives up after 40 000 steps. A contact needs some 15 000, which take seconds, where
        omega/Omega is 1e4 or c^2 m1 m2 is 1e-7 from 1, and 8 000 where friction holds it closed
        with e = 1e-3. Nearer to 1 some are given up.

    Notes
    -----
    Each step is a Taylor series, to rounding. Impulses are sums over the phases, and keep
    |p1| <= mu p2 to 1e-11 however near c^2 m1 m2 is to 1. Times the mean of the velocities before
    and after they are the energy that is lost, to 1e-12 of the kinetic energy. With c = 0 it is
    `planarimpact.lumped.rebound` in other units, to 1e-12.

    The state at separation is continuous in all arguments, with one exception. Where
    mu |c| m2 >= 1 the contact may come to N = 0 with no normal velocity. Then it either separates,
    or friction presses it in for another compression.

    Examples
    --------
    A metre of slender rod falls on its tip, tilted by 45 degrees:

    >>> rod = inverse_mass(1.0, 12**-0.5, offset=0.125**0.5, depth=0.125**0.5)
    >>> result = rebound(0.0, 1.0, rod, friction=0.5, restitution=0.5, loss="hysteretic")
    >>> [round(float(v), 3) for v in (result.tangential, result.normal)]
    [0.618, -0.433]
    >>> lost = kinetic_energy(0.0, 1.0, rod) - kinetic_energy(*result[:2], rod)
    >>> bool(abs(lost - result.friction_work - result.hysteresis) < 1e-15)
    True
    """
    result, given_up = solved(
        tangential, normal, inverse_mass, friction, restitution, stiffness_ratio, stiffness, loss
    )
    if given_up:
        if not np.ndim(result.tangential):
            raise ConvergenceError(given_up)
        # As NumPy does where a function of an array has no value for an entry.
        warnings.warn(given_up, RuntimeWarning, stacklevel=3)
    return result


def solved(*arguments: Any) -> tuple[NoncollinearRebound, str]:
    """As `rebound`, and what is said of impacts that are given up, whose numbers are NaN."""
    checked = _checked(*arguments)
    v2, m2, kappa, groups = _groups(checked)
    contacts = OffCentre(*groups)
    unsolved = solve(contacts)
    force_unit = np.sqrt(m2) * np.sqrt(kappa) * v2
    lost = 1 - groups[-1] ** 2
    fields = [
        contacts.z[Q] * v2,
        contacts.z[Y] * v2,
        *(contacts.impulses * v2 * m2),
        contacts.peak_friction * force_unit,
        contacts.peak * force_unit,
        contacts.work * v2 * (m2 * v2),
        lost * contacts.peak**2 / 2 * v2 * (m2 * v2),
        contacts.duration * np.sqrt(m2) / np.sqrt(kappa),
    ]
    regime, jams = contacts.order.regimes().astype(np.uint8), contacts.jams
    shape = checked[0].shape
    if unsolved.size:
        for field in fields:
            field[unsolved] = np.nan
        regime[unsolved], jams[unsolved] = Regime.UNRESOLVED, False
    columns: list[Any] = [column.reshape(shape)[()] for column in (*fields, regime, jams)]
    if not shape:
        columns[-2:] = Regime(int(regime[0])), bool(jams[0])
    said = _given_up(groups, unsolved) if unsolved.size else ""
    return NoncollinearRebound._make(columns), said


@checks.default_errors
def history(
    tangential: float,
    normal: float,
    inverse_mass: InverseMass,
    friction: float,
    restitution: float = 1.0,
    stiffness_ratio: float = 1.21,
    stiffness: float = 1.0,
    samples: int = 400,
    *,
    loss: NoncollinearLoss | None = None,
) -> NoncollinearHistory:
    """Forces and velocities over one contact.

    `samples`, an integer of at least 2, is the number of instants, evenly spread over the contact.
    Those of the events are added. Other arguments, all scalars, and errors: as of `rebound`.

    Examples
    --------
    A tilted rod slides into the surface and jams: slip grows the forces until it stops.

    >>> rod = inverse_mass(1.0, 12**-0.5, offset=0.2, depth=0.4)
    >>> contact = history(2.0, 1.0, rod, friction=1.6, restitution=0.5, loss="hysteretic")
    >>> [str(event.kind) for event in contact.events]
    ['contact', 'slip', 'stick', 'maximum compression', 'slip', 'separation']
    """
    samples = checks.count("samples", samples, 2)
    arguments = _checked(
        tangential, normal, inverse_mass, friction, restitution, stiffness_ratio, stiffness, loss
    )
    if arguments[0].ndim:
        raise InputError(f"shape = {arguments[0].shape}: one contact takes scalars")
    v2, m2, kappa, groups = _groups(arguments)
    steps: list[Step] = []
    if solve(OffCentre(*groups), steps).size:
        raise ConvergenceError(_given_up(groups, np.zeros(1, int)))
    units = (float(a[0]) for a in (v2, np.sqrt(m2) * np.sqrt(kappa), np.sqrt(m2) / np.sqrt(kappa)))
    _, _, coupling, zeta2, _, e = (float(group[0]) for group in groups)
    return timeline(steps, coupling, zeta2, e, samples, *units)


@checks.default_errors
def kinetic_energy(tangential: ArrayLike, normal: ArrayLike, inverse_mass: InverseMass) -> Array:
    """Kinetic energy that a contact can change; arguments broadcast.

    It is the energy of the motion of the contact point [J]. An impact does not change the motion of
    a body about its contact point. The velocities may have any sign. Arguments and errors:
    `planarimpact.noncollinear`.

    Examples
    --------
    >>> float(kinetic_energy(3.0, 2.0, InverseMass(0.5, 0.0, 1.0)))
    11.0
    """
    mass = fields_of(inverse_mass)
    v1, v2, inverse_m1, c, inverse_m2 = checks.broadcast(
        tangential=finite("tangential", tangential),
        normal=finite("normal", normal),
        **mass,
    )
    ratio = c / inverse_m1
    return (v1 * v1 / inverse_m1 + (v2 + v1 * ratio) ** 2 / (inverse_m2 - c * ratio)) / 2


def _checked(
    tangential: ArrayLike,
    normal: ArrayLike,
    inverse_mass: InverseMass,
    friction: ArrayLike,
    restitution: ArrayLike,
    stiffness_ratio: ArrayLike,
    stiffness: ArrayLike,
    loss: str | None,
) -> tuple[Array, ...]:
    """Checked arguments of one shape, with the stiffness ratio of this loss."""
    v1, v2, mu, e, zeta2, *others = checked_impact(
        tangential,
        normal,
        inverse_mass,
        friction,
        restitution,
        stiffness_ratio=checks.stiffness_ratio(stiffness_ratio),
        stiffness=positive("stiffness", stiffness),
    )
    of_loss = zeta2
    if loss is None:
        checks.require_loss(restitution, NONCOLLINEAR)
    else:
        of_loss = NONCOLLINEAR[checks.loss(loss, NONCOLLINEAR)].stiffness_ratio(zeta2, e)
    inverse_m1, c, inverse_m2 = others[-3:]
    checks.in_range("tangential/normal", v1 / v2, 0.0)
    ratio = inverse_m1 / inverse_m2
    checks.in_range("inverse_mass.tangential/normal", ratio, LEAST_RATIO, LARGEST_RATIO)
    checks.in_range("friction", mu, 0.0, LARGEST_RATIO)
    checks.tangential_frequency(ratio, zeta2, e, of_loss)
    rattles = (e > 0) & (e < LEAST_RESTITUTION) & (mu * np.abs(c) > inverse_m2)
    if rattles.any():
        raise InputError(
            f"restitution = {float(e[rattles][0])}: allowed are 0 and numbers from "
            f"{LEAST_RESTITUTION:g} where friction can hold the contact closed (mu |c| m2 > 1)"
        )
    return v1, v2, mu, e, of_loss, *others


def _groups(arguments: tuple[Array, ...]) -> tuple[Array, Array, Array, tuple[Array, ...]]:
    """Flat arrays: v2, m2, kappa, and what `OffCentre` takes."""
    v1, v2, mu, e, zeta2, kappa, inverse_m1, c, inverse_m2 = (a.reshape(-1) for a in arguments)
    groups = v1 / v2, inverse_m1 / inverse_m2, c / inverse_m2, zeta2, mu, e
    return v2, 1 / inverse_m2, kappa, groups


def _given_up(groups: tuple[Array, ...], unsolved: Integers) -> str:
    """The message for impacts that have too many steps, by their flat indices."""
    first = {name: float(group[unsolved[0]]) for name, group in zip(GROUPS, groups, strict=True)}
    which = f"impact {unsolved[0]}"
    if unsolved.size > 1:
        which = f"impacts {checks.brief(unsolved.tolist())}"
    return (
        f"{unsolved.size} of {groups[0].size} impacts given up, with too many steps: {which}, "
        f"counted from 0 in the flattened arguments. In units of v2 and m2 the first has {first}"
    )
