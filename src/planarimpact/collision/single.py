"""One impact in Python's own floats, for event-driven codes: some 20 microseconds.

The physics is that of `mechanics` and `rungs`, in numbers instead of arrays; a test compares them.
Whatever is not plain (a bad argument, no approach, no friction, numbers beyond `PLAIN_MOST`, an
impact that the table of spheres does not answer within the tolerance) is left to them: then the
answer here is None.
"""

from collections.abc import Sequence
from functools import cache, lru_cache
from math import hypot, inf, sqrt
from typing import Any, NamedTuple

import numpy as np

from planarimpact import spheres
from planarimpact.bodies import Body
from planarimpact.collision.pairs import PLAIN_LEAST, PLAIN_MOST
from planarimpact.collision.rungs import ROUNDING
from planarimpact.ground import checks
from planarimpact.ground.results import Regime
from planarimpact.normal_impact import hertz, kelvin_voigt
from planarimpact.spheres import single as table_of_spheres

_PLAIN, _FLOAT = frozenset({float, int}), np.dtype(float)
# The table has the incidence from which plastic impacts slide throughout with an error below 1 %.
# Within it the functions of arrays know better.
UNSURE = 0.01


class Answer(NamedTuple):
    """Bodies after one impact."""

    # Velocity and spin of the body and of the other one, and the impulse: [m/s], [rad/s], [N s].
    states: tuple[float, ...]
    numbers: tuple[float, float, float]  # incidence, restitution, error bound
    regime: Regime
    given: list[float]  # the vectors of the question: the caller may change its own


def collide(
    pair: tuple[float, ...],
    plastic: bool,
    body: Body,
    other: Body,
    vectors: tuple[Any, ...],
    tolerance: float,
) -> Answer | None:
    """The answer to one impact, or None where the functions of arrays must see it.

    `pair` has the fields of a Pair, in order, and `vectors` are those of `collide`.
    """
    try:
        radius, inverse, mobility, turn = _inertia(body)
        other_radius, other_inverse, other_mobility, other_turn = _inertia(other)
        numbers = [number for vector in vectors for number in _floats(vector)]
        nx, ny, nz, vx, vy, vz, wx, wy, wz, ox, oy, oz, sx, sy, sz = numbers
    except (TypeError, ValueError, OverflowError):  # not plainly one body, or three numbers
        return None
    if not (min(numbers) >= -PLAIN_MOST and max(numbers) <= PLAIN_MOST):
        return None
    length = sqrt(nx * nx + ny * ny + nz * nz)
    if not abs(length - 1) <= checks.LENGTH_ERROR:
        return None
    nx, ny, nz = nx / length, ny / length, nz / length
    # Velocity of the contact point of the body, relative to that of the other.
    ux, uy, uz = radius * wx + other_radius * sx, radius * wy + other_radius * sy, radius * wz
    uz += other_radius * sz
    rx = vx - ox - (uy * nz - uz * ny)
    ry = vy - oy - (uz * nx - ux * nz)
    rz = vz - oz - (ux * ny - uy * nx)
    v2 = -(rx * nx + ry * ny + rz * nz)
    tx, ty, tz = rx + v2 * nx, ry + v2 * ny, rz + v2 * nz
    v1 = sqrt(tx * tx + ty * ty + tz * tz)
    mu, zeta2, modulus, e, relaxation_time, yield_pressure = pair
    if not (PLAIN_LEAST <= v2 <= PLAIN_MOST and PLAIN_LEAST <= v1 <= PLAIN_MOST and mu):
        return None
    if inverse + other_inverse == 0:
        return None
    m2 = 1 / (inverse + other_inverse)
    beta = m2 * (mobility + other_mobility)
    if e != e:
        curvature = (1 / radius if radius else 0.0) + (1 / other_radius if other_radius else 0.0)
        if not curvature:
            return None
        law, quantity = (_plastic, yield_pressure) if plastic else (_viscous, relaxation_time)
        e = law(quantity, v2, m2, modulus, curvature)
    b, unit = beta / zeta2, mu * v2
    x = v1 / unit
    y = x / zeta2
    covered = spheres.LEAST_RATIO <= b <= spheres.LARGEST_RATIO and beta >= 1
    if not (covered and zeta2 <= spheres.LARGEST_STIFFNESS and spheres.LEAST_RESTITUTION <= e <= 1):
        return None
    yields = plastic and e < 1
    share, slides_from = table_of_spheres.velocity(y, b, e, yields)
    if yields and abs(y / slides_from - 1) < UNSURE:
        return None
    if y >= slides_from:
        change, error, regime = -(1 + e) * beta * unit, 0.0, Regime.SLIP_THROUGHOUT
    else:
        error = (_table_error(b, e, yields) + ROUNDING * beta) * min(x, 1.0)
        if error > tolerance:
            return None
        w = min(max(share * zeta2, -x, x - (1 + e) * beta), x) * unit
        change = w - v1
        regime = Regime.SLIP_STICK_SLIP if x > zeta2 else Regime.STICK_SLIP
    push, drag = (1 + e) * v2 * m2, change / beta / v1 * m2
    px, py, pz = push * nx + drag * tx, push * ny + drag * ty, push * nz + drag * tz
    mx, my, mz = ny * pz - nz * py, nz * px - nx * pz, nx * py - ny * px
    states = (
        *(vx + px * inverse, vy + py * inverse, vz + pz * inverse),
        *(wx - turn * mx, wy - turn * my, wz - turn * mz),
        *(ox - px * other_inverse, oy - py * other_inverse, oz - pz * other_inverse),
        *(sx - other_turn * mx, sy - other_turn * my, sz - other_turn * mz),
        *(px, py, pz),
    )
    return Answer(states, (x, e, error * unit), regime, numbers)


@lru_cache(maxsize=4096)
def _inertia(body: Body) -> tuple[float, ...]:
    """Radius, 1/M, (1 + (r/k)^2)/M and r/(M k^2) of a body of plain numbers, else an error."""
    mass, gyration, radius = map(float, body)  # an array is a TypeError
    for number in (mass, gyration, radius or inf):
        if not (PLAIN_LEAST <= number <= PLAIN_MOST or number == inf):
            raise ValueError
    arm = radius / gyration
    return radius, 1 / mass, (1 + arm * arm) / mass, arm / gyration / mass


def _floats(vector: Any) -> Sequence[float]:
    """The components of a vector that is plainly three numbers; () of anything else."""
    if type(vector) is np.ndarray:
        return vector.tolist() if vector.dtype is _FLOAT and vector.shape == (3,) else ()
    plain = type(vector) in (list, tuple) and len(vector) == 3
    return vector if plain and _PLAIN.issuperset(map(type, vector)) else ()


def _table_error(b: float, e: float, yields: bool) -> float:
    """Largest error of the table of spheres, mu v2(0)."""
    if not yields:
        return spheres.ERROR_BOUND["viscous"]
    little = table_of_spheres.loses_little(b, e)
    return spheres.LITTLE_BOUND if little else spheres.ERROR_BOUND["plastic"]


def _viscous(tau: float, v2: float, m2: float, modulus: float, curvature: float) -> float:
    """As `bodies.viscous_restitution`; 0, which no table covers, where that refuses."""
    root = sqrt(tau / (m2**0.4 / modulus**0.4 * curvature**0.2 / v2**0.2))
    terms, longest = _series()
    if root >= longest:
        return 0.0
    # Clenshaw's recurrence for a series of Chebyshev's polynomials.
    at, one, two = 4 * root / longest - 2, 0.0, 0.0
    for term in terms:
        one, two = term + at * one - two, one
    return min(one - at / 2 * two, 1.0)


@cache
def _series() -> tuple[list[float], float]:
    """Terms of viscous restitution, the last one first, and the largest argument."""
    series = kelvin_voigt.series().trim(kelvin_voigt.SMALL_TERM)
    return series.coef[::-1].tolist(), float(series.domain[1])


def _plastic(pressure: float, v2: float, m2: float, modulus: float, curvature: float) -> float:
    """As `bodies.plastic_restitution`."""
    radius_share = np.pi / 2 * (pressure / modulus)
    yield_speed = sqrt(16 / 15 * modulus / m2 / curvature) / curvature * radius_share**2.5
    if yield_speed >= v2:
        return 1.0
    # The law of `normal_impact.yielding`: approach where yield begins, and at the end of loading.
    ratio = yield_speed / v2
    yields = (ratio / sqrt(2 * hertz.ENERGY)) ** 0.8
    square = 2 * sqrt(yields)
    reach = hypot(2 / 3 * yields, sqrt((1 - ratio) * (1 + ratio) / square))
    force, approach = square * reach, yields / 3 + reach
    # Twice the energy that springs back is 0.8 F d F/F_e, with Hertz' force F_e = 4/3 d^(3/2).
    return min(force * sqrt(0.6 / sqrt(approach)), 1.0)
