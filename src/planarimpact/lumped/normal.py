"""Normal motion: compression and restitution of the linear normal element (Table 1).

Both halves have one angle `eta` from 0 to pi/2, which vanishes with the force. In compression eta =
Omega t grows from 0; in restitution eta = Omega (tf - t)/e falls to 0. So the force is sin(eta) in
both, and no digits are lost near separation, where both contact forces vanish. Units: force m2
Omega |v2(0)|, impulse m2 |v2(0)|, time t_c.
"""

import numpy as np

from planarimpact.common.arrays import Array, Numbers


def force(eta: Numbers) -> Array:
    """Normal force F2 at `eta` (Table 1), in m2 Omega |v2(0)|."""
    return np.sin(eta)


def impulse(eta: Numbers) -> Array:
    """Impulse from contact to `eta` in compression; times e from `eta` to separation (Table 1)."""
    return 2 * np.sin(eta / 2) ** 2


def force_and_impulse(eta: Numbers) -> tuple[Array, Array]:
    """`force` and `impulse` from one tangent, which NumPy computes faster than a sine.

    Examples
    --------
    >>> [round(float(value), 12) for value in force_and_impulse(np.pi / 3)]
    [0.866025403784, 0.5]
    """
    tangent = np.tan(eta / 2)
    sine = 2 * tangent / (1 + tangent * tangent)
    return sine, tangent * sine


def time(eta: Numbers, restitution: float, in_restitution: bool) -> Array:
    """Time t/t_c at `eta`: 0 at contact, 1 at maximum compression, 1 + e at separation."""
    share = np.asarray(eta) / (np.pi / 2)
    return 1 + restitution * (1 - share) if in_restitution else share
