"""The largest friction of a contact, between the instants too."""

import numpy as np

from planarimpact.ground.arrays import Array, Integers

# Places at which a polynomial through a few instants is evaluated.
SAMPLES = 49


def largest(time: Array, friction: Array, onset: Integers, peak: Array, searched: int) -> Array:
    """Largest friction of each contact, shape (n,), from columns of shape (steps + 1, n).

    Gross slip from the start ends at the instant `onset`. `peak` is the largest friction up to
    `searched` instants after that.
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
    largest_friction = np.maximum(peak, np.where(smooth, _highest(late), size[top, column]))
    if searched:
        return largest_friction
    early = [(time[first + k, column], size[first + k, column]) for k in range(3)]
    return np.maximum(largest_friction, _highest(early))


def highest(times: Array, forces: Array) -> Array:
    """Largest force between many instants, (instants, m), by a parabola through three of them."""
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
