"""One impact in Python's own floats, for event-driven codes: some tens of microseconds.

The physics is that of `mechanics` and `methods`, in numbers in place of arrays; a test compares.
They answer what is left to them here: a bad argument, velocities beyond the rule of sizes, and an
impact that the table of spheres does not answer within the tolerance.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache, partial
from math import inf, nan, sqrt
from typing import Any

import numpy as np

from planarimpact import bodies, models, spheres
from planarimpact.bodies import Body
from planarimpact.collision.facts import Facts, in_shape
from planarimpact.collision.mechanics import Impacts, cross, dot
from planarimpact.collision.methods import ASKED, HEAD_ON, METHODS, SLIDING, table_error
from planarimpact.collision.pairs import Pair
from planarimpact.common import checks, losses
from planarimpact.common.arrays import Integers
from planarimpact.common.cautions import Caution
from planarimpact.common.checks import LARGEST, LARGEST_RATIO, LEAST, LEAST_RATIO
from planarimpact.common.losses import CODE_OF, NONE
from planarimpact.common.results import Regime
from planarimpact.lumped import one_impact
from planarimpact.models import Model
from planarimpact.normal_impact import kelvin_voigt, yielding
from planarimpact.spheres import table

# The table has the incidence from which plastic impacts slide throughout with an error below 1 %.
# Within it the functions of arrays know better.
UNSURE = 0.01
PLAIN = frozenset((float, int))  # types of plain numbers
PLASTIC = losses.CODES[losses.PLASTIC]
# Places of the table of spheres by the code of the loss.
TABLED = [
    next(i for i, method in enumerate(METHODS) if method.way == "table" and method.loss is loss)
    for loss in (*losses.SPHERES.values(), None)
]
# Models with a way of their own here.
RIGID = models.MODELS["rigid"]
LUMPED = [models.MODELS[f"lumped.{name}"] for name in losses.NONCOLLINEAR]  # all in floats
BY_MODEL = [RIGID, *LUMPED]


def facts(
    pair: Pair,
    asked: tuple[str, ...],
    place: int,
    v1: float,
    v2: float,
    m2: float,
    mass_ratio: float,
    restitution: float,
    loss_code: Integers,
    change: float,
    regime: Regime,
    solve: bool,
) -> Facts:
    """Facts of one impact; the other loss is answered like this one."""
    numbers = np.array([[v1], [v2], [restitution], [m2], [mass_ratio]])
    mu, zeta2, dundurs = pair.friction[None], pair.stiffness_ratio[None], pair.dundurs[None]
    given = [*numbers[:2], mu, numbers[2], loss_code[None], *numbers[3:], zeta2, dundurs]
    impacts = Impacts._make([None] * 6 + given)
    form = None
    if restitution < 1 and place not in (ASKED, SLIDING, HEAD_ON):
        groups = mass_ratio, float(pair.stiffness_ratio), restitution
        other = _answer(v1, float(pair.friction) * v2, *groups, loss_code != PLASTIC, inf)
        form = np.array(abs(other[0] - change)) if other else None
    answer = np.array([place]), np.array([change]), np.array([regime])
    approach = np.arange(0 if regime == Regime.NO_IMPACT else 1)
    whole = partial(in_shape, approach, 1, ())
    spared = Caution.RESTITUTION if asked == (RIGID.name,) else Caution.NONE
    return Facts(whole, impacts, *answer, asked, spared, form=form, solve=solve)


def collide(
    pair: Pair,
    body: Body,
    other: Body,
    vectors: list[list[float]],
    tolerance: float,
    model: Model | None = None,
    solve: bool = True,
) -> list[Any]:
    """Fields of the Collision of one impact, or [] where the functions of arrays must see it.

    `vectors` are those of `planarimpact.collide` by `floats`, and so are the other arguments.
    """
    if not (pair.floats and all(vectors)):
        return []
    try:
        radius, inverse, mobility, turn = _inertia(body)
        other_radius, other_inverse, other_mobility, other_turn = _inertia(other)
    except (TypeError, ValueError, OverflowError):  # not plainly one body
        return []
    normal, velocity, spin, other_velocity, other_spin = vectors
    length = sqrt(dot(normal, normal))
    if not abs(length - 1) <= checks.LENGTH_ERROR or inverse + other_inverse == 0:
        return []
    normal = [component / length for component in normal]
    # Velocity of the contact point of the body, relative to that of the other.
    turning = _sum([radius * component for component in spin], other_radius, other_spin)
    relative = _sum(_sum(velocity, -1.0, other_velocity), -1.0, cross(turning, normal))
    v2 = -dot(relative, normal)
    tangential = _sum(relative, v2, normal)
    v1 = sqrt(dot(tangential, tangential))
    mu, zeta2, modulus, e, relaxation_time, yield_pressure = pair.floats
    meets = LEAST <= v2 <= LARGEST
    if not (meets or -LARGEST <= v2 <= 0) or not (LEAST <= v1 <= LARGEST or v1 == 0):
        return []
    m2 = 1 / (inverse + other_inverse)
    beta = m2 * (mobility + other_mobility)
    if not beta <= LARGEST_RATIO:
        return []
    known: tuple[Any, ...]
    if not meets:
        known = pair, (), HEAD_ON, v1, v2, m2, beta, 1.0, NONE, 0.0, Regime.NO_IMPACT, solve
        after = velocity, spin, other_velocity, other_spin, [0.0] * 3
        nothing = np.full(3, nan)
        return [*np.array(after), *nothing, Regime.NO_IMPACT, NONE, partial(facts, *known)]
    code = int(pair.loss_code)
    plastic = code == PLASTIC
    if e != e:
        curvature = (1 / radius if radius else 0.0) + (1 / other_radius if other_radius else 0.0)
        if not curvature:
            return []
        quantities = m2, 1 / curvature, modulus
        if plastic:
            e = _plastic_restitution(*quantities, v2, yield_pressure)
        else:
            e = _viscous_restitution(*quantities, v2, relaxation_time)
    unit = mu * v2
    if code > PLASTIC and not model:  # the continuum has no such loss
        return []
    loss_code, asked = NONE, (model.name,) if model else ()
    if e < 1:
        loss_code = CODE_OF.get(model.loss, pair.loss_code) if model else pair.loss_code
    if not (v1 and mu):
        regime = Regime.SLIP_THROUGHOUT if v1 else Regime.STICK
        answer = (0.0, 0.0, regime) if 0 <= e <= 1 else None
        place = SLIDING if v1 else HEAD_ON
    elif model:
        answer, place = _by_model(model, v1, unit, beta, zeta2, e), ASKED
    else:
        answer = _answer(v1, unit, beta, zeta2, e, plastic and e < 1, tolerance)
        place = TABLED[code if e < 1 else -1] if answer and answer[1] else SLIDING
    if not answer:
        return []
    change, error, regime = answer
    push = [(1 + e) * v2 * m2 * component for component in normal]
    impulse = _sum(push, change / beta / v1 * m2 if change else 0.0, tangential)
    moment = cross(normal, impulse)
    after = (
        _sum(velocity, inverse, impulse),
        _sum(spin, -turn, moment),
        _sum(other_velocity, -other_inverse, impulse),
        _sum(other_spin, -other_turn, moment),
        impulse,
    )
    known = pair, asked, place, v1, v2, m2, beta, e, loss_code, change, regime, solve
    incidence = v1 / unit if unit else inf if v1 else 0.0
    numbers = np.array((incidence, e, error * unit))
    return [*np.array(after), *numbers, regime, loss_code, partial(facts, *known)]


def _plastic_restitution(
    m2: float, radius: float, modulus: float, v2: float, yield_pressure: float
) -> float:
    """Restitution at this speed; NaN beyond the rule of sizes."""
    if yield_pressure > LARGEST_RATIO * modulus:
        return nan
    share = bodies.unchecked_yield_speed(m2, radius, modulus, yield_pressure) / v2
    if share < LEAST_RATIO:
        return nan
    return min(float(yielding.restitution(np.array(min(share, 1.0)))), 1.0)


def _viscous_restitution(
    m2: float, radius: float, modulus: float, v2: float, relaxation_time: float
) -> float:
    """Restitution at this speed."""
    tau = relaxation_time / bodies.time_unit(m2, radius, modulus, v2)
    # Beyond the law its slowest contact, whose restitution the table does not cover.
    return min(float(kelvin_voigt.restitution(np.array(min(tau, kelvin_voigt.SLOWEST)))), 1.0)


def _answer(
    v1: float, unit: float, beta: float, zeta2: float, e: float, yields: bool, tolerance: float
) -> tuple[float, float, Regime] | None:
    """Change of the tangential velocity, its error over `unit`, and regime; None for arrays.

    The functions of arrays must see what the table does not answer within the tolerance. `unit` is
    mu v2(0).
    """
    x = v1 / unit
    b, y, loss = beta / zeta2, x / zeta2, "plastic" if yields else "viscous"
    covered = spheres.LEAST_RATIO <= b <= spheres.LARGEST_RATIO and beta >= 1
    covered = covered and x >= LEAST and zeta2 <= spheres.LARGEST_STIFFNESS
    if not (covered and spheres.LEAST_RESTITUTION[loss] <= e <= 1):
        return None
    panel, slides_from, share = table.of_one(table.shipped(), y, b, e, yields)
    if yields and abs(y / slides_from - 1) < UNSURE:
        return None
    if y >= slides_from:
        return -(1 + e) * beta * unit, 0.0, Regime.SLIP_THROUGHOUT
    growth = max(zeta2 / spheres.STATED_STIFFNESS, 1.0)
    error = float(table_error(spheres.PANEL_BOUND[panel] * growth, beta, x))
    if error > tolerance:
        return None
    w = min(max(share * zeta2, -x, x - (1 + e) * beta), x) * unit
    return w - v1, error, Regime.SLIP_STICK_SLIP if x > zeta2 else Regime.STICK_SLIP


def _by_model(
    model: Model, v1: float, unit: float, beta: float, zeta2: float, e: float
) -> tuple[float, float, Regime] | None:
    """As `_answer`, by a model that was asked for; the error is not known."""
    x = v1 / unit
    if x > LARGEST or not model.restitution[0] <= e:
        return None
    if model is RIGID:
        if x / beta >= 1 + e:
            return -(1 + e) * beta * unit, nan, Regime.SLIP_THROUGHOUT
        return -v1, nan, Regime.SLIP_STICK
    if model in LUMPED:
        found = one_impact.rebound(losses.LUMPED[model.loss], x, beta, zeta2, e)
        if found:
            slides = found[3] is Regime.SLIP_THROUGHOUT
            change = -(1 + e) * beta * unit if slides else found[0] * unit - v1
            return change, nan, found[3]
    return None


@lru_cache(maxsize=4096)
def _inertia(body: Body) -> tuple[float, ...]:
    """Radius, 1/M, (1 + (r/k)^2)/M and r/(M k^2) of a body of plain numbers, else an error."""
    mass, gyration, radius = map(float, body)  # an array is a TypeError
    for number in (mass, gyration, radius or inf):
        if not (LEAST <= number <= LARGEST or number == inf):
            raise ValueError
    arm = radius / gyration
    return radius, 1 / mass, (1 + arm * arm) / mass, arm / gyration / mass


def floats(vector: Any) -> list[float]:
    """The components of a vector that is plainly three numbers; [] of anything else."""
    if type(vector) is np.ndarray:
        return vector.tolist() if vector.dtype == float and vector.shape == (3,) else []
    if not (type(vector) in (list, tuple) and len(vector) == 3):
        return []
    if not PLAIN.issuperset(map(type, vector)):
        if not {*PLAIN, np.float64}.issuperset(map(type, vector)):
            return []
        vector = [*map(float, vector)]  # NumPy's own arithmetic of one number is slow
    return [*vector] if max(map(abs, vector)) <= LARGEST else []


def _sum(a: Sequence[float], factor: float, b: Sequence[float]) -> list[float]:
    """a + factor b of two vectors."""
    return [a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]]
