"""The order of stick and slip of contacts, and the history of one, from the steps of `follow`."""

from collections.abc import Callable, Iterable
from itertools import chain, groupby
from typing import Any, NamedTuple

import numpy as np

from planarimpact.common.arrays import Array, Booleans, Integers
from planarimpact.common.results import Regime
from planarimpact.phases import TERMS, Step

# A phase of less time or normal impulse is one of rounding: two events are at one instant.
SHORT, LEAST_IMPULSE = 1e-13, 1e-15
# Share of a contact's time within which an instant counts as that of an event.
BESIDE = 1e-12


class Run(NamedTuple):
    """Steps of one phase: instants (k,) from its first to its last, and states (d, k) there."""

    phase: Any
    time: Array
    z: Array


def runs(steps: list[Step], shares: Array, scale: Callable[[Any], float]) -> list[Run]:
    """The phases of a contact, in order, at these shares, 0 to 1, of its time.

    Both ends of each phase come on top, so an event is there twice, before and after it. `scale` is
    the unit of time of a phase. Phases that take no time are left out.
    """
    phases = _phases(chain(*(own for _, own in _phases(steps) if _spans(own)[-1] > SHORT)))
    spans = [_spans(own) for _, own in phases]
    ends = np.cumsum(
        [scale(phase) * span[-1] for (phase, _), span in zip(phases, spans, strict=True)]
    )
    grid, beside, start, found = shares * ends[-1], BESIDE * ends[-1], 0.0, []
    for (phase, own), span, end in zip(phases, spans, ends, strict=True):
        # An instant of the grid that rounding puts beside an event is that of the event.
        inside = grid[(grid > start + beside) & (grid < end - beside)]
        # In its own unit of time a phase keeps the digits of a short one.
        elapsed = np.concatenate([[0.0], (inside - start) / scale(phase), span[-1:]])
        which = np.minimum(np.searchsorted(span, elapsed), span.size - 1)
        begin, length = np.append(0.0, span)[which], np.array([step.length for step in own])[which]
        series = np.array([step.series for step in own])[which]
        powers = ((elapsed - begin) / length)[:, None] ** np.arange(TERMS)
        states = np.einsum("nk,nkd->dn", powers, series)
        found.append(Run(phase, np.concatenate([[start], inside, [end]]), states))
        start = end
    return found


def _phases(steps: Iterable[Step]) -> list[tuple[Any, list[Step]]]:
    """Steps by the phase that they are in, which may come again."""
    return [(phase, list(own)) for phase, own in groupby(steps, lambda step: step.phase)]


def _spans(steps: list[Step]) -> Array:
    """Time from the first of some steps to the end of each."""
    return np.cumsum([step.length * step.share for step in steps])


class Order:
    """The order of stick and slip of n contacts so far, of phases with an impulse."""

    def __init__(self, n: int) -> None:
        """Before the first phase."""
        self.sticks = np.zeros(n, int)
        self.begun, self.starts_in_slip, self.ends_in_slip = np.zeros((3, n), bool)

    def add(self, who: Integers, slips: Booleans, impulse: Array) -> None:
        """Add a phase of some of them, with its normal impulse."""
        lasts, last = impulse > LEAST_IMPULSE, self.ends_in_slip[who]
        self.sticks[who] += lasts & ~slips & (last | ~self.begun[who])
        self.starts_in_slip[who] |= lasts & slips & ~self.begun[who]
        self.ends_in_slip[who] = np.where(lasts, slips, last)
        self.begun[who] |= lasts

    def regimes(self) -> Integers:
        """Codes of `Regime`."""
        return Regime.of_phases(self.sticks, self.starts_in_slip, self.ends_in_slip)
