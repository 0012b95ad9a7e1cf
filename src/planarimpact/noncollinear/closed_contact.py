"""Contacts without restitution that friction holds closed after maximum compression.

This is what a contact does in the limit e -> 0. The line of unloading has the stiffness kappa/e^2,
so N follows the motion in a time of the order e, in which V does not change. A contact that sticks
with the friction F has three possible courses:

- C F <= 0, or mu |C| <= 1: N falls to zero, with slip in the end. The contact separates, as one
  that slips does.
- Otherwise friction presses the body in with C F, and N oscillates about C F, at first with the
  amplitude N - C F. If it comes down to |F|/mu, the contact slips at once. There
  N'' = (mu |C| - 1) N in the scaled time, so y^2 - (mu |C| - 1) N^2 stays constant. Either N
  reaches zero and the contact separates, or N turns at a smaller value.
- If it has not separated, the contact is held closed: y = 0, and the mean of N is C F. The
  oscillation lasts: its energy vanishes with e, its amplitude does not. F and V follow in the time
  of the tangential element,

    V' = -(beta - C^2) F,   zeta^2 F' = V.

The end of the last course depends on F.

- F grows: N may at most reach its earlier peak, since the compression beyond it is slow. So the
  amplitude is at most the difference of C F and the peak. When C F reaches the peak, compression
  goes on from there.
- F falls: in each oscillation N comes down to |F|/mu, and the contact slips a little. Each slip
  leaves N at its lowest value, so friction falls by mu |C| times as much as it would in stick,

    zeta^2 F' = mu |C| V   (creep),

  and the amplitude stays (|C| - 1/mu) |F|. F falls to zero, and N with it: the contact separates.

Symbols as in `phases`.
"""

from typing import NamedTuple, Self

import numpy as np

from planarimpact.common.arrays import Array, Booleans, Numbers
from planarimpact.noncollinear.phases import TIE, Groups, Mode, State


class ClosedPhase(NamedTuple):
    """Stick or creep of contacts that are held closed, where F is a sinusoid.

    `compliance` is V over the rate of F.
    """

    friction: Mode
    coupling: Array
    compliance: Array
    creeps: bool

    @classmethod
    def start(
        cls, friction: Array, velocity: Array, groups: Groups, factor: Numbers, creeps: bool
    ) -> Self:
        """From F and V on; `factor` is that of friction's rate: 1 in stick, mu |C| in creep."""
        beta, coupling, zeta2, *_ = groups
        compliance = zeta2 / factor
        rate = np.sqrt((beta - coupling * coupling) / compliance)
        sinusoid = Mode(rate, friction, velocity / compliance / rate)
        return cls(sinusoid, coupling, compliance, creeps)

    def at(self, time: Array) -> State:
        """States at these times, with the mean of N."""
        friction, rise = self.friction.at(time)
        zero = np.zeros_like(friction)
        return State(self.coupling * friction, zero, friction, self.compliance * rise)

    def impulses(self, time: Array) -> tuple[Array, Array]:
        """Impulses of F and of the mean of N up to a time."""
        friction = self.friction.integral(time)
        return friction, self.coupling * friction


class ClosedCourse(NamedTuple):
    """The course of contacts that are held closed, arrays of shape (n,).

    Attributes
    ----------
    stick, creep : ClosedPhase
        The two phases; there is no creep where compression goes on.
    stick_time, creep_time : ndarray
        Their durations.
    end : State
        At separation, or where compression goes on.
    slips_first, reloads : ndarray of bool
        Whether the first oscillation slips; whether compression goes on.
    work : ndarray
        Of friction.
    peak_friction : ndarray
        Largest |F|.
    """

    stick: ClosedPhase
    creep: ClosedPhase
    stick_time: Array
    creep_time: Array
    end: State
    slips_first: Booleans
    reloads: Booleans
    work: Array
    peak_friction: Array

    @classmethod
    def of(cls, state: State, groups: Groups, lowest: Array) -> Self:
        """From the state at maximum compression, and `lowest` of `held_closed`."""
        beta, coupling, zeta2, mu, _ = groups
        peak, zero = state.normal, np.zeros_like(state.normal)
        # From here on signs are those in the direction of friction, so that F > 0 and C > 0.
        side = np.where(state.friction < 0, -1.0, 1.0)
        first_force, velocity = side * state.friction, side * state.velocity
        coupling = side * coupling
        creep_factor = mu * coupling
        slips_first = np.isfinite(lowest)
        # F at the start of stick, after a slip in the first oscillation.
        stick_force = np.where(slips_first, mu * lowest, first_force)
        # Stick is a sinusoid of F and V. If F rises, `largest_force` is its crest.
        amplitude_ratio = np.sqrt((beta - coupling * coupling) * zeta2)
        largest_force = np.hypot(stick_force, np.maximum(velocity, 0.0) / amplitude_ratio)
        reloads = coupling * largest_force > peak * (1 + TIE)
        # The F at which N comes down to F/mu, where creep begins: at once after a slip. If F rises
        # first, the amplitude of N at its crest is at most the difference of C F and the peak.
        creep_force = np.minimum(
            np.where(slips_first, stick_force, _creep_force(peak, stick_force, mu, coupling)),
            _creep_force(peak, largest_force, mu, coupling),
        )
        # Stick ends where N reaches its peak, or where creep begins. The angle of the sinusoid
        # between start and end gives the time.
        end_force = np.where(reloads, peak / coupling, np.minimum(creep_force, largest_force))
        start_speed = np.minimum(velocity, 0.0)
        end_speed = np.sqrt(
            start_speed * start_speed
            + amplitude_ratio**2 * (largest_force - end_force) * (largest_force + end_force)
        )
        angle = np.arctan2(velocity, amplitude_ratio * stick_force)
        angle += np.where(reloads, -1.0, 1.0) * np.arctan2(end_speed, amplitude_ratio * end_force)
        # Creep is a sinusoid too, from the end of stick to the zero of F, where the contact
        # separates.
        creep_ratio = np.sqrt(creep_factor) * amplitude_ratio
        creep_angle = np.arctan2(creep_ratio * end_force, creep_factor * end_speed)
        creeps = np.where(reloads, 0.0, 1.0)
        final_speed = np.hypot(
            end_speed, creeps * amplitude_ratio * end_force / np.sqrt(creep_factor)
        )
        # The work of friction is the tangential strain energy that slip and creep take away.
        energy_lost = slips_first * (first_force - stick_force) * (
            first_force + stick_force
        ) + creeps * end_force * end_force * (1 - 1 / creep_factor)
        velocity_sign = np.where(reloads, side, -side)
        start_of_stick = side * stick_force, state.velocity
        start_of_creep = side * end_force, velocity_sign * end_speed
        return cls(
            ClosedPhase.start(*start_of_stick, groups, 1.0, creeps=False),
            ClosedPhase.start(*start_of_creep, groups, creep_factor, creeps=True),
            np.maximum(angle, 0.0) * zeta2 / amplitude_ratio,
            creeps * creep_angle * zeta2 / creep_ratio,
            State(
                np.where(reloads, peak, 0.0),
                zero,
                np.where(reloads, side * end_force, 0.0),
                velocity_sign * final_speed,
            ),
            slips_first,
            reloads,
            zeta2 / 2 * energy_lost,
            np.maximum(first_force, np.where(reloads, end_force, largest_force)),
        )


def held_closed(state: State, groups: Groups) -> tuple[Booleans, Array]:
    """Which contacts in stick at maximum compression are held closed, and their lowest N.

    That is N where the slip of the first oscillation ends, or infinity where it does not slip.
    """
    mu, peak = groups.friction, state.normal
    force, coupling = np.abs(state.friction), np.sign(state.friction) * groups.coupling
    # Where friction presses the body in, the first oscillation of N turns above N = F/mu, or the
    # contact slips from there.
    excess = mu * coupling - 1
    presses_in = (force > 0) & (excess > 0)
    slip_normal = force / np.where(presses_in, mu, 1.0)  # N where slip begins
    sticks = 2 * coupling * force - peak >= slip_normal
    # The scaled y^2 where slip begins. y^2 - excess N^2 stays constant in slip, and y is 0 where N
    # turns. `turning_square` is N^2 there, negative if N reaches zero before.
    approach_square = (peak - 2 * coupling * force + slip_normal) * (peak - slip_normal)
    turning_square = slip_normal * slip_normal - approach_square / np.where(presses_in, excess, 1.0)
    held = presses_in & (sticks | (turning_square > 0))
    slips = held & ~sticks
    return held, np.where(sticks, np.inf, np.sqrt(np.where(slips, turning_square, 0.0)))


def _creep_force(peak: Array, force: Array, mu: Array, coupling: Array) -> Array:
    """F at which N comes down to F/mu, if its amplitude is peak - C `force`."""
    return mu * np.maximum(peak - coupling * force, 0.0) / (mu * coupling - 1)
