"""The largest friction of a contact, between the instants too."""

import numpy as np

from planarimpact.continuum.inelastic.plastic import Thornton, cubic
from planarimpact.ground.arrays import Array, Integers

# Places where a polynomial through a few instants is looked at.
SAMPLES = 49
# Places where friction is worked out soon after gross slip from the start, and for how long: two
# instants and this share of the steps.
PLACES, AFTER = 24, 1 / 48


def instants_after(steps: int) -> int:
    """Instants after gross slip from the start for which `after_slip` works."""
    return 2 + int(steps * AFTER)


def largest(time: Array, friction: Array, onset: Integers, peak: Array, searched: int) -> Array:
    """Largest friction of each contact.

    Parameters
    ----------
    time, friction : ndarray, shape (steps + 1, n)
    onset : ndarray of int, shape (n,)
        The instant when gross slip from the start ends.
    peak : ndarray, shape (n,)
        Largest friction up to then, or as far as it has been sought.
    searched : int
        How many instants after that the search has covered.

    Returns
    -------
    ndarray, shape (n,)
    """
    size = np.abs(friction)
    column = np.arange(onset.size)
    first = np.clip(onset, 0, len(size) - 3)
    top = np.clip(np.argmax(size, axis=0), 2, len(size) - 3)
    lower = size[top - 1, column] > size[top + 1, column]
    around = top + np.arange(-1, 3)[:, None] - lower
    # A polynomial must not reach over the kink where gross slip ends.
    smooth = around[0] > first + np.where(onset > 0, searched // 2, 0)
    late = [(time[k, column], size[k, column]) for k in around]
    found = np.maximum(peak, np.where(smooth, _highest(late), size[top, column]))
    if searched:
        return found
    early = [(time[first + k, column], size[first + k, column]) for k in range(3)]
    return np.maximum(found, _highest(early))


def after_slip(motion: Thornton, knots: Array) -> Array:
    """Largest friction soon after gross slip of elastic springs, by the limits in between.

    Friction grows on, turns and falls within a step, as one spring after the other sticks. Approach
    and displacement are cubics between the `knots`, the instants from the end of slip on: time,
    approach, normal velocity, displacement and its rate, shape (knots, 5, n).
    """
    count = len(motion.radius)
    held, displaced = motion.limit_at(knots[0, 1], knots[0, 2], count), knots[0, 3]
    flowed = motion.flowed(knots[0, 1])
    points = [(knots[0, 0], motion.force_at(knots[0, 1], knots[0, 2]))]
    for left, right in zip(knots, knots[1:], strict=False):
        step = right[0] - left[0]
        for share in np.linspace(0.0, 1.0, 1 + max(2, PLACES // len(knots)))[1:]:
            approach = cubic(share, left[1], right[1], step * left[2], step * right[2])
            velocity = left[2] + share * (right[2] - left[2])
            u = cubic(share, left[3], right[3], step * left[4], step * right[4])
            limit, flow = motion.limit_at(approach, velocity, count), motion.flowed(approach)
            half = np.where(velocity > 0, np.exp((flowed - flow) / 2), 1.0)
            held = np.minimum(limit, (held * half + u - displaced) * half)
            displaced, flowed = u, flow
            whole = np.sum(motion.width * limit, axis=0)
            lack = np.sum(motion.width * (limit - held), axis=0)
            force = motion.force_at(approach, velocity)
            force = force * (1 - lack / np.where(whole > 0, whole, 1.0))
            points.append((left[0] + share * step, force))
    times, forces = (np.array(column) for column in zip(*points, strict=True))
    top = np.clip(np.argmax(forces, axis=0), 1, len(forces) - 2)
    column = np.arange(top.size)
    return _highest([(times[k, column], forces[k, column]) for k in (top - 1, top, top + 1)])


def _highest(points: list[tuple[Array, Array]]) -> Array:
    """Largest value between the first and the last point of a polynomial through all of them."""
    times = [time for time, _ in points]
    grid = times[0] + np.linspace(0.0, 1.0, SAMPLES)[:, None] * (times[-1] - times[0])
    value = np.zeros_like(grid)
    for time, height in points:
        factors = [(grid - other) / (time - other) for other in times if other is not time]
        value += height * np.prod(factors, axis=0)
    return value.max(axis=0)
