"""The largest friction of a contact, between the instants too."""

import numpy as np

from planarimpact.common.arrays import Array, Booleans, Integers

# Places at which a polynomial through a few instants is evaluated.
SAMPLES = 49


def largest(
    instants: tuple[Array, ...],
    size: Array,
    gross: Booleans,
    onset: Integers,
    peak: Array,
    searched: int,
) -> Array:
    """Largest friction of each contact, shape (n,), from columns of shape (steps + 1, n).

    `instants` are time, normal velocity and normal force, `size` is the friction without its sign,
    and `gross` says where it is at its limit. Gross slip from the start ends at the instant
    `onset`. `peak` is the largest friction up to `searched` instants after that.
    """
    time = instants[0]
    column = np.arange(onset.size)
    first = np.clip(onset, 0, len(size) - 3)
    top = np.clip(np.argmax(size, axis=0), 2, len(size) - 3)
    lower = size[top - 1, column] > size[top + 1, column]
    around = top + np.arange(-1, 3)[:, None] - lower
    # A polynomial must not reach over the kink where gross slip ends.
    smooth = around[0] > first + np.where(onset > 0, searched // 2, 0)
    late = [(time[k, column], size[k, column]) for k in around]
    highest_late = np.where(smooth, _highest(late), size[top, column])
    # The last instant before gross slip sets in beside the top, if it does.
    last = top + 2
    for _ in range(3):
        last = last - gross[last, column]
    inside = (last > first + 1) & (last < np.minimum(top + 2, len(size) - 2))
    sets_in = np.flatnonzero(inside & ~gross[last, column])
    if sets_in.size:
        beside = tuple(a[:, sets_in] for a in instants)
        highest_late[sets_in] = _highest_at_onset(beside, size[:, sets_in], last[sets_in])
    largest_friction = np.maximum(peak, np.maximum(highest_late, size[top, column]))
    if searched:
        return largest_friction
    early = [(time[first + k, column], size[first + k, column]) for k in range(3)]
    return np.maximum(largest_friction, _highest(early))


def highest(times: Array, forces: Array) -> Array:
    """Largest force between many instants, (instants, m), by a parabola through three of them."""
    top = np.clip(np.argmax(forces, axis=0), 1, len(forces) - 2)
    column = np.arange(top.size)
    return _highest([(times[k, column], forces[k, column]) for k in (top - 1, top, top + 1)])


def _highest_at_onset(instants: tuple[Array, ...], size: Array, last: Integers) -> Array:
    """Largest friction as gross slip sets in after the instant `last`, shape (m,).

    What friction lacks at its limit vanishes there with the power 3/2 of the time that is left. So
    its power 2/3 is a parabola, through three instants before gross slip. Between two instants the
    normal force, minus the rate of the normal velocity, is another.
    """
    time, velocity, normal = instants
    column = np.arange(last.size)
    t, lacks = (a[last + np.arange(-2, 1)[:, None], column] for a in (time, normal - size))
    roots = np.maximum(lacks, 0.0) ** (2 / 3)
    slopes = np.diff(roots, axis=0) / np.diff(t, axis=0)
    bend = (slopes[1] - slopes[0]) / (t[2] - t[0])
    share = np.linspace(0.0, 1.0, SAMPLES // 3)[:, None]
    forces = []
    for k in last + np.arange(-2, 2)[:, None]:
        start, pace, force = (a[k, column] for a in (time, velocity, normal))
        step, slowing = time[k + 1, column] - start, pace - velocity[k + 1, column]
        growth = normal[k + 1, column] - force
        bulge = 6 * (slowing / step - force - growth / 2)
        at = start + share * step
        root = roots[2] + (at - t[2]) * (slopes[1] + (at - t[1]) * bend)
        limit = force + share * (growth + (1 - share) * bulge)
        forces.append(limit - np.maximum(root, 0.0) ** 1.5)
    return np.concatenate(forces).max(axis=0)


def _highest(points: list[tuple[Array, Array]]) -> Array:
    """Largest value between the first and the last point of a polynomial through all of them."""
    times = [time for time, _ in points]
    grid = times[0] + np.linspace(0.0, 1.0, SAMPLES)[:, None] * (times[-1] - times[0])
    value = np.zeros_like(grid)
    for time, height in points:
        factors = [(grid - other) / (time - other) for other in times if other is not time]
        value += height * np.prod(factors, axis=0)
    return value.max(axis=0)
