"""After maximum compression without restitution: what a contact does in the limit e -> 0.

The line of unloading has the stiffness kappa/e^2, so N follows the motion in a time of the order e,
in which V does not change. A contact that sticks with the friction F has three possible courses:

- C F <= 0, or mu |C| <= 1: N falls to zero, at last in slip. The contact lets go, as one that slips
  does.
- Otherwise friction presses the body in with C F, and N swings about C F, at first with the
  amplitude N - C F. If a swing comes down to |F|/mu, the contact slips in a burst. There
  N'' = (mu |C| - 1) N in the scaled time, so y^2 - (mu |C| - 1) N^2 stays constant. Either N
  reaches zero and the contact lets go, or N turns at a smaller value.
- If it has not let go, the contact is held closed: y = 0, and the mean of N is C F. Its swings
  last: their energy vanishes with e, their amplitude does not. F and V follow in the time of the
  tangential element,

    V' = -(beta - C^2) F,   zeta^2 F' = V.

What ends that course depends on F.

- F grows: the swings may reach at most the peak of N, since reloading beyond it is slow. So the
  amplitude is at most the distance of C F from the peak. When C F reaches the peak, compression
  goes on from there.
- F falls: the swings come down to |F|/mu, and each slips a little. Each slip leaves N at its
  lowest, so friction falls by mu |C| times as much as it would in stick,

    zeta^2 F' = mu |C| V   (creep),

  and the amplitude stays (|C| - 1/mu) |F|. F falls to zero, and N with it: the contact lets go.
"""

from typing import NamedTuple, Self

import numpy as np

from planarimpact.ground.arrays import Array, Booleans, Numbers
from planarimpact.noncollinear.phases import Groups, State

# Compression goes on only if friction pushes N beyond its peak by more than this share of it.
TIE = 1e-14


class Swing(NamedTuple):
    """Stick or creep of contacts that are held closed, from a state on.

    `gain` is 1 in stick, mu |C| in creep.
    """

    state: State
    groups: Groups
    gain: Numbers
    creeps: bool

    def at(self, time: Array) -> State:
        """States at these times, with the mean of N."""
        beta, coupling, zeta2, *_ = self.groups
        stiffness = np.sqrt(self.gain * (beta - coupling * coupling) * zeta2)  # V over F, of a mode
        rate = stiffness / zeta2
        cosine, sine = np.cos(rate * time), np.sin(rate * time)
        friction, velocity = self.state.friction, self.state.velocity
        force = friction * cosine + self.gain / stiffness * velocity * sine
        return State(
            coupling * force,
            np.zeros_like(force),
            force,
            velocity * cosine - stiffness / self.gain * friction * sine,
        )


class Release(NamedTuple):
    """What becomes of contacts that are held closed, arrays of shape (n,).

    Attributes
    ----------
    stick, creep : Swing
        The two phases; there is no creep where compression goes on.
    stick_time, creep_time : ndarray
        How long they last.
    end : State
        At separation, or where compression goes on.
    bursts, reloads : ndarray of bool
        Whether the first swing slips; whether compression goes on.
    work : ndarray
        Of friction.
    peak_friction : ndarray
        Largest |F|.
    """

    stick: Swing
    creep: Swing
    stick_time: Array
    creep_time: Array
    end: State
    bursts: Booleans
    reloads: Booleans
    work: Array
    peak_friction: Array

    @classmethod
    def of(cls, state: State, groups: Groups, lowest: Array) -> Self:
        """From the state at maximum compression and the force that `lowest_force` found."""
        beta, coupling, zeta2, mu, _ = groups
        peak = state.normal
        # From here on signs are those in the direction of friction, so that F > 0 and C > 0.
        side = np.where(state.friction < 0, -1.0, 1.0)
        first, velocity, push = side * state.friction, side * state.velocity, side * coupling
        gain = mu * push
        bursts = np.isfinite(lowest)
        force = np.where(bursts, mu * np.where(bursts, lowest, 0.0), first)
        # Stick held closed is one oscillation of F and V. If F rises, `crest` is its largest value.
        stiffness = np.sqrt((beta - coupling * coupling) * zeta2)
        rises = velocity > 0
        crest = np.where(rises, np.hypot(force, velocity / stiffness), force)
        reloads = push * crest > peak * (1 + TIE)
        # The |F| at which the swings come down to |F|/mu, where slip begins. If F rises first, the
        # swings are at its crest at most as large as the distance of C F from the peak.
        slips = np.where(bursts, force, _slips(peak, force, mu, push))
        slips = np.where(rises, np.minimum(slips, _slips(peak, crest, mu, push)), slips)
        # Stick ends at `last`: where N reaches its peak, or where creep begins. V is `speed` there,
        # and the angle of the oscillation between start and end gives the time.
        last = np.where(reloads, peak / push, np.minimum(slips, crest))
        start = np.where(rises, 0.0, velocity)
        speed = np.sqrt(start * start + stiffness**2 * (crest - last) * (crest + last))
        angle = np.arctan2(velocity, stiffness * force)
        angle += np.where(reloads, -1.0, 1.0) * np.arctan2(speed, stiffness * last)
        # Creep is an oscillation too, from `last` to the zero of F, where the contact lets go.
        creep_stiffness = np.sqrt(gain) * stiffness
        quarter = np.arctan2(creep_stiffness * last, gain * speed)
        falls = np.where(reloads, 0.0, 1.0)
        final = np.hypot(speed, falls * stiffness * last / np.sqrt(gain))

        # The work of friction is the tangential strain energy that the burst and creep take away.
        turned = np.where(reloads, side, -side)
        lost = bursts * (first - force) * (first + force) + falls * last * last * (1 - 1 / gain)
        none = np.zeros_like(peak)
        slid = State(push * last, none, side * last, turned * speed)
        return cls(
            Swing(
                State(push * force, none, side * force, state.velocity), groups, 1.0, creeps=False
            ),
            Swing(slid, groups, gain, creeps=True),
            np.maximum(angle, 0.0) * zeta2 / stiffness,
            falls * quarter * zeta2 / creep_stiffness,
            State(
                np.where(reloads, peak, 0.0),
                none,
                np.where(reloads, slid.friction, 0.0),
                turned * final,
            ),
            bursts,
            reloads,
            zeta2 / 2 * lost,
            np.maximum(first, np.where(reloads, last, crest)),
        )


def lowest_force(state: State, groups: Groups) -> tuple[Booleans, Array]:
    """Which contacts that stick at maximum compression are held closed, and after which burst.

    Returns
    -------
    held : ndarray of bool
    lowest : ndarray
        N at which the slip of the first swing ends, infinite where that does not slip.
    """
    mu, peak = groups.friction, state.normal
    force, push = np.abs(state.friction), np.sign(state.friction) * groups.coupling
    # Friction presses the body in. The first swing of N turns above N = F/mu, where slip begins, or
    # the contact slips from there.
    jam = mu * push - 1
    presses = (force > 0) & (jam > 0)
    slides = force / np.where(presses, mu, 1.0)  # N where slip begins
    swings = 2 * push * force - peak >= slides
    # The square of the scaled y where slip begins. y^2 - jam N^2 stays constant in slip, and y is 0
    # where N turns; `left` is N^2 there, negative if N reaches zero before.
    square = (peak - 2 * push * force + slides) * (peak - slides)
    left = slides * slides - square / np.where(presses, jam, 1.0)
    held = presses & (swings | (left > 0))
    return held, np.where(swings, np.inf, np.sqrt(np.where(held & ~swings, left, 0.0)))


def _slips(peak: Array, force: Array, mu: Array, push: Array) -> Array:
    """|F| at which swings slip whose amplitude is the distance of C F from the peak."""
    return mu * np.maximum(peak - push * force, 0.0) / (mu * push - 1)
