"""Laws of discrete-element codes, fitted to the continuum.

Codes that step through each contact have laws of their own: springs, dashpots and a slider. `fit`
finds the tangential spring and dashpot with which such a law comes nearest to the continuum of
`planarimpact.spheres` or `planarimpact.continuum`, and says which error remains. `lines` writes
them as the code wants to read them. The normal spring and dashpot follow from restitution.

A fit is valid for one restitution, so for one speed where restitution depends on it, for one pair
of materials, for its range of incidence, and for small overlaps: `lines` says what the overlap of
an impact costs.

`models.timestep` steps through a contact, `codes` knows the codes, `overlaps` what larger overlaps
cost.
"""

from __future__ import annotations

import numpy as np

from planarimpact import continuum, spheres
from planarimpact.common import checks
from planarimpact.common.arrays import Array, ArrayLike
from planarimpact.common.losses import SpheresLoss
from planarimpact.fit.codes import CODES, Code, Error, Fit, lines
from planarimpact.fit.overlaps import overlap
from planarimpact.models import timestep

__all__ = ["CODES", "Code", "Error", "Fit", "fit", "lines", "overlap"]

# Incidences at which errors are measured.
SAMPLES = 101
# Below, some laws cannot lose so much: a dashpot that cannot pull leaves 0.14 at least.
LEAST_RESTITUTION = 0.3
# Stiffnesses over the elastic one, 1/zeta^2, and dampings at which the search starts.
STIFFNESSES = np.linspace(0.3, 1.8, 16)
DAMPINGS = np.linspace(0.0, 1.5, 13)
# Parts of the first step that may be over when a contact begins. Velocities jump where the last one
# tends to 1.
BEGINS = (*(part / 32 for part in range(32)), 1 - 1e-9)
# Steps in a contact on the grid.
COARSE_STEPS = 100
# Tolerance of the continuum where the table of spheres has no answer.
TOLERANCE = 1e-3


@checks.default_errors
def fit(
    law: str,
    mass_ratio: ArrayLike = 3.5,
    stiffness_ratio: ArrayLike = 1.21,
    restitution: ArrayLike = 1.0,
    *,
    loss: SpheresLoss | None = None,
    incidence_max: float | None = None,
) -> Fit:
    """The law of a code with the tangential spring and dashpot that come nearest to the continuum.

    Nearest is the least root mean square of the difference in v1(tf)/(mu v2(0)), over incidences
    that are evenly spread from 0 to `incidence_max`.

    Parameters
    ----------
    law : str
        A key of `CODES`: "lammps-hertz-mindlin", "lammps-hooke", "mercurydpm" or "yade".
    mass_ratio, stiffness_ratio, restitution : array_like
        As in `planarimpact.continuum.rebound`, one number each: 1 to 8, 0.5 to 4, and 0.3 to 1.
    loss : str, optional
        What takes the energy below restitution 1, where it is needed: "viscous" or "plastic".
    incidence_max : float, optional
        The largest incidence v1(0)/(mu v2(0)), above 0 up to 100. If it is left out, that from
        which the continuum slides throughout.

    Notes
    -----
    An elastic contact lasts `timestep.DASHPOT_STEPS` steps. For the search, by Nelder and Mead from
    the best point of a grid, it begins with a step; the errors are the worst of all its begins in a
    step. Of the tangential laws of a code the nearest is taken. The overlap is taken to vanish.

    For beads of steel (e = 0.8), glass (0.97) and polyurethane (0.6) a begin within a step moves
    velocities by up to 0.003 mu v2(0) with "lammps-hertz-mindlin", 0.03 with "lammps-hooke" and
    "mercurydpm", 0.05 with "yade"; 50 steps in place of 200 move them by up to 0.04, and 0.10 with
    "yade". Beyond the range of the fit the last two do not slide as they should, see
    `Fit.beyond`.

    Examples
    --------
    >>> found = fit("lammps-hooke", 3.5, 1.5, 0.6, loss="viscous")
    >>> round(found.error_before.rms, 2), round(found.error.rms, 2)
    (0.26, 0.01)
    >>> round(found.stiffness, 1), round(found.damping, 1)
    (0.6, 0.2)
    """
    code = CODES[checks.word("law", law, CODES)]
    allowed = f"numbers from {LEAST_RESTITUTION} to 1"
    e = checks.number("restitution", restitution, allowed, LEAST_RESTITUTION, 1)
    beta = checks.number("mass_ratio", mass_ratio, "numbers from 1 to 8", 1, 8)
    zeta2 = checks.number("stiffness_ratio", stiffness_ratio, "numbers from 0.5 to 4", 0.5, 4)
    end = incidence_max
    if end is not None:
        end = checks.number("incidence_max", end, "numbers above 0 up to 100", 0, 100, True)
    slides = float(continuum.slip_throughout_limit(beta, zeta2, e, loss=loss))
    end = slides if end is None else end
    x = np.linspace(0.0, end, SAMPLES)
    far = np.append(x, 2 * end)  # one place more, beyond the range
    exact = _continuum(far, beta, zeta2, e, loss)
    fitted = [
        (*_nearest(exact[:-1], contact, x, beta, zeta2, e, code.by_normal and e == 1), style)
        for style, contact in code.styles.items()
    ]
    _, stiffness, damping, style = min(fitted, key=lambda found: found[0])
    contact = code.styles[style]
    input_restitution = timestep.input_restitution_for(contact, e)
    usual = 1 / zeta2 if code.usual_stiffness is None else code.usual_stiffness
    usual_damping = code.usual_damping * timestep.normal_damping(contact.hertzian, e)

    def stepped(own: timestep.Law, k: float, c: float, given: float) -> Array:
        each = [timestep.with_dashpots(own, far, beta, k, c, given, begins=b) for b in BEGINS]
        return np.stack(each)

    before = stepped(contact._replace(limited=code.limited), usual, usual_damping, e)
    after = stepped(contact, stiffness, damping, input_restitution)
    off = after - exact
    numbers = law, style, stiffness, damping, input_restitution, beta, zeta2, e, loss
    curves = x, exact[:-1], before[0, :-1], after[0, :-1]
    errors = _error(before[:, :-1] - exact[:-1], x), _error(off[:, :-1], x)
    return Fit(*numbers, *curves, *errors, float(np.abs(off[:, -1]).max()))


def _error(off: Array, x: Array) -> Error:
    """Error of a contact that begins where it is worst; a row of `off` for each of `BEGINS`."""
    row, place = np.unravel_index(np.abs(off).argmax(), off.shape)
    rms = np.sqrt(np.mean(off**2, axis=-1)).max()
    return Error(float(rms), float(np.abs(off[row, place])), float(x[place]))


def _continuum(x: Array, beta: float, zeta2: float, e: float, loss: SpheresLoss | None) -> Array:
    """Velocity of the continuum, from the table of spheres where that has it."""
    if spheres.covers(beta, zeta2, e, loss=loss):
        return spheres.rebound(x, beta, zeta2, e, loss=loss).velocity
    return continuum.rebound(x, beta, zeta2, e, loss=loss, tolerance=TOLERANCE).velocity


def _nearest(
    exact: Array, law: timestep.Law, x: Array, beta: float, zeta2: float, e: float, undamped: bool
) -> tuple[float, float, float]:
    """Mean square of the error of a law, its stiffness and damping."""
    from scipy import optimize  # here, as it takes longer to import than this package

    input_restitution = timestep.input_restitution_for(law, e)

    def velocity(stiffness: Array, damping: Array, steps: int = timestep.DASHPOT_STEPS) -> Array:
        return timestep.with_dashpots(
            law, x, beta, stiffness[..., None], damping[..., None], input_restitution, steps
        )

    def mean_square(place: Array) -> float:
        if place.min() < 0:
            return np.inf
        stiffness, damping = np.append(place, 0.0)[:2]
        off = velocity(np.array(stiffness / zeta2), np.array(damping)) - exact
        return float(np.mean(off**2))

    dampings = DAMPINGS[:1] if undamped else DAMPINGS
    places = np.stack(np.meshgrid(STIFFNESSES, dampings, indexing="ij"), axis=-1).reshape(-1, 2)
    coarse = velocity(places[:, 0] / zeta2, places[:, 1], COARSE_STEPS) - exact
    start = places[np.argmin(np.mean(coarse**2, axis=-1))][: 1 if undamped else 2]
    simplex = start + 0.1 * np.eye(start.size + 1, start.size, -1)
    found = optimize.minimize(
        mean_square,
        start,
        method="Nelder-Mead",
        options={"initial_simplex": simplex, "xatol": 1e-4, "fatol": 1e-9},
    )
    stiffness, damping = np.append(found.x, 0.0)[:2] / [zeta2, 1.0]
    return float(found.fun), float(stiffness), float(damping)
