"""Coulomb's friction: its limit, and a contact that slides from its first instant to separation.

Units are those of every model: tangential velocity mu |v2(0)|, impulse of friction mu m2 |v2(0)|,
normal velocity |v2(0)|, normal impulse m2 |v2(0)|.

**The limit.** A contact sticks while friction is below mu times the normal force, and slides at
that limit. In the units here friction is in units of mu, so that its limit is the normal force.

**The line.** While a contact slides, friction is mu times the normal force. Over the whole contact
the normal impulse is 1 + e, so the impulse of friction is 1 + e too, and the velocity falls by beta
times that: w(tf) = x - (1 + e) beta. This holds for every normal contact, linear or Hertz, and
with or without tangential compliance.

**Where it begins** with tangential compliance. The contact slides while the body outruns its
tangential spring, w > s'. Friction keeps the deflection of the spring at s = zeta^2 N.

- In compression, at the normal impulse p from 0 to 1, w = x - beta p and s' = zeta^2 (1 - p). The
  difference is linear in p. It stays positive if x > zeta^2 (at p = 0) and x > beta (at p = 1).
- In restitution N = sin(eta), and the angle eta falls from pi/2 to 0. The normal impulse is
  1 + e cos(eta), so w = x - beta - e beta cos(eta), and s' = -zeta^2 cos(eta)/e. The difference is
  x - beta - K cos(eta) with K = e beta - zeta^2/e. For K > 0 it is smallest at separation, so
  x > beta + K is needed. For K <= 0 slip in restitution never ends.

Elastic Hertz contact has the same limit, that of e = 1: there s = zeta^2 d and s' = zeta^2 v with
the approach d and its rate v from 1 to -1, and w = x - beta (1 - v).

**Where both directions lose energy alike** the ratio of stiffnesses is zeta^2 from first to last:
viscous elements with one relaxation time, and an elastic-plastic sphere, which unloads
elastically. There s = zeta^2 d throughout, and v falls from 1 to -e. The difference of w and s' is
x - beta + (beta - zeta^2) v, linear in v. It stays positive if x > zeta^2 (at v = 1) and
x > beta + e (beta - zeta^2) (at v = -e).
"""

import numpy as np

from planarimpact.common.arrays import Array, Number, Numbers


def change(beta: Number, e: float | Number) -> Number:
    """Fall of the tangential velocity, (1 + e) beta.

    Examples
    --------
    >>> change(3.5, 1.0)
    7.0
    """
    return (1 + e) * beta


def velocity(x: Array, beta: Number, e: float | Number) -> Array:
    """Velocity at separation, x - (1 + e) beta.

    Examples
    --------
    >>> float(velocity(np.float64(8.0), 3.5, 1.0))
    1.0
    """
    return x - change(beta, e)


def work(x: Array, beta: Number, e: float | Number) -> Array:
    """Work of friction: its impulse times the mean of the velocities before and after.

    Examples
    --------
    >>> float(work(np.float64(8.0), 3.5, 1.0))
    9.0
    """
    return (1 + e) * (x - change(beta, e) / 2)


def viscous_work(x: Array, beta: Number, zeta2: Number, e: float | Number) -> Array:
    """Work of friction where the springs are viscous: they take a part of what the body loses.

    Friction mu F2 acts on the velocity w - zeta^2 v of the springs, w = x - beta (1 - v), while the
    normal velocity v falls from 1 to -e.

    Examples
    --------
    >>> float(viscous_work(np.float64(8.0), 3.5, 1.21, 1.0))
    9.0
    """
    return (1 + e) * (x - zeta2 - (beta - zeta2) * (1 + e) / 2)


def restick_coefficient(beta: Array, zeta2: Array, e: Numbers) -> Array:
    """K = e beta - zeta^2/e where positive, else 0.

    Examples
    --------
    >>> [float(restick_coefficient(3.5, zeta2, 0.5)) for zeta2 in (0.75, 1.21)]
    [0.25, 0.0]
    """
    excess = e * (e * beta) - zeta2
    return 0.5 * (excess + abs(excess)) / (e + (e == 0))  # for e = 0 the excess is 0


def limit(beta: Array, zeta2: Array, e: Numbers) -> Array:
    """Incidence from which slip never ends: max(zeta^2, beta + K).

    Examples
    --------
    >>> float(limit(3.5, 1.21, 1.0))
    5.79
    """
    return np.maximum(zeta2, beta + restick_coefficient(beta, zeta2, e))


def limit_alike(beta: Numbers, zeta2: Numbers, e: Numbers) -> Array:
    """Incidence from which slip never ends where both directions lose energy alike.

    max(zeta^2, beta + e (beta - zeta^2)), as the head of this module derives it. For e = 1 it is
    `limit`.

    Examples
    --------
    >>> float(limit_alike(3.5, 1.21, 1.0)), round(float(limit_alike(3.5, 1.21, 0.5)), 9)
    (5.79, 4.645)
    """
    return np.maximum(zeta2, beta + e * (beta - zeta2))
