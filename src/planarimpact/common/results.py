"""What every model returns: rebound and history of a contact, its regime and its events."""

from __future__ import annotations

from enum import IntEnum, StrEnum
from typing import TYPE_CHECKING, Generic, NamedTuple, Self, overload

import numpy as np
from numpy.typing import NDArray

from planarimpact.common import checks
from planarimpact.common.arrays import Array, ArrayLike, Booleans, Integers
from planarimpact.common.records import Members, record

if TYPE_CHECKING:  # the oldest Python that we allow knows no defaults of types
    from collections.abc import Callable
    from typing import Concatenate, ParamSpec, Protocol

    from typing_extensions import TypeVar

    Values = TypeVar("Values", covariant=True, default=Array)
    Codes = TypeVar("Codes", covariant=True, default=Integers)
    Counts = TypeVar("Counts", covariant=True, default=Integers)
    Settings = ParamSpec("Settings")
else:
    from typing import TypeVar

    Values, Codes, Counts = map(TypeVar, ("Values", "Codes", "Counts"))


class Regime(IntEnum, metaclass=Members):
    """The order of stick and slip during one contact.

    The paper's three regimes are STICK_SLIP, SLIP_STICK_SLIP and SLIP_THROUGHOUT. Others are a
    contact that ends in stick (e = 0, or no tangential compliance), and MULTIPLE, where the contact
    sticks twice or more. A normal impact, x = 0, is STICK. UNRESOLVED means that the order is not
    known: the model is a law of impulses, or the solver gave up. NO_IMPACT means that the bodies do
    not approach each other.

    Examples
    --------
    >>> Regime(2).name, Regime(2).words
    ('STICK_SLIP', 'stick - slip')
    """

    STICK = 0
    SLIP_STICK = 1
    STICK_SLIP = 2
    SLIP_STICK_SLIP = 3
    SLIP_THROUGHOUT = 4
    MULTIPLE = 5
    UNRESOLVED = 6
    NO_IMPACT = 7

    @property
    def words(self) -> str:
        """The regime in the words of the paper, as pictures show it."""
        if self is Regime.MULTIPLE:
            return "repeated stick"
        if self is Regime.SLIP_THROUGHOUT:
            return "slip throughout"
        return self.name.lower().replace("_", " - ")

    @classmethod
    def names(cls, codes: int | Integers) -> NDArray[np.str_]:
        """Names of a code, or of an array of codes.

        Examples
        --------
        >>> Regime.names(np.array([2, 4])).tolist()
        ['STICK_SLIP', 'SLIP_THROUGHOUT']
        """
        return np.array(list(cls.__members__))[codes]

    @classmethod
    def of_phases(
        cls, sticks: Integers, starts_in_slip: Booleans, ends_in_slip: bool | Booleans
    ) -> Integers:
        """Codes by the number of phases of stick, and by whether the first and last phase slip.

        Examples
        --------
        >>> sticks, starts, ends = np.array([0, 1, 1, 2]), np.array([True, False, True, True]), True
        >>> Regime.names(Regime.of_phases(sticks, starts, ends)).tolist()
        ['SLIP_THROUGHOUT', 'STICK_SLIP', 'SLIP_STICK_SLIP', 'MULTIPLE']
        """
        after_stick = np.where(ends_in_slip, cls.STICK_SLIP, cls.STICK)
        after_slip = np.where(ends_in_slip, cls.SLIP_STICK_SLIP, cls.SLIP_STICK)
        once = np.where(starts_in_slip, after_slip, after_stick)
        once_or_more = np.where(sticks > 1, cls.MULTIPLE, once)
        return np.where(sticks == 0, cls.SLIP_THROUGHOUT, once_or_more)


@record
class Rebound(NamedTuple, Generic[Values, Codes, Counts]):
    """The state at separation, one entry an impact; scalars where all arguments were scalars.

    For a type checker `Rebound` has arrays, and `Rebound[np.float64, Regime, int]` scalars.

    Attributes
    ----------
    velocity : ndarray of float64 or float
        w(tf) = v1(tf)/(mu v2(0)), tangential velocity of the contact point; positive in the
        direction of a positive incidence.
    peak_friction : ndarray of float64 or float
        Largest |F1| over the contact, in mu times the largest normal force (m2 Omega |v2(0)| where
        the normal contact is linear); between 0 and 1. NaN where a law of impulses has none.
    dissipation : ndarray of float64 or float
        Work of friction in mu^2 m2 v2(0)^2, from the balance of tangential energy. For
        e = 0 it includes the tangential strain energy that is lost at separation.
    regime : ndarray of uint8 or Regime
        Codes of `Regime`. In a contact with micro-slip, slip means gross slip, of the whole
        contact, and stick that some of it sticks.
    reversals : ndarray of int64, int or None
        How often the tangential force changes its sign from step to step of the solver; None where
        the model does not count this.
    """

    velocity: Values
    peak_friction: Values
    dissipation: Values
    regime: Codes
    reversals: Counts | None = None

    @classmethod
    def of(
        cls,
        incidence: Array,
        velocity: Array,
        impulse: Array,
        peak_friction: Array,
        regime: Integers,
        reversals: Integers | None = None,
    ) -> Self:
        """The result for `incidence`, from flat arrays of a solver's answers for |x|.

        `impulse` is that of friction, in mu m2 |v2(0)|. The work is impulse times mean velocity:
        Stronge's theorem (the paper's footnote).
        """
        size = np.abs(incidence).reshape(-1)
        work = impulse * (size / 2 + velocity / 2)
        return cls.shaped(incidence, velocity, peak_friction, work, regime, reversals)

    @classmethod
    def shaped(
        cls,
        incidence: Array,
        velocity: Array,
        peak_friction: Array,
        dissipation: Array,
        regime: Integers,
        reversals: Integers | None = None,
    ) -> Self:
        """As `of`, from the dissipation in mu^2 m2 v2(0)^2, where the impulse has fewer digits."""
        velocity = velocity * np.copysign(1.0, incidence.reshape(-1))
        fields = velocity, peak_friction, dissipation, regime
        if incidence.ndim == 0:
            *numbers, code = (field[0] for field in fields)
            count = None if reversals is None else int(reversals[0])
            return cls._make([*numbers, Regime(int(code)), count])
        counts = None if reversals is None else reversals.reshape(incidence.shape)
        return cls._make([*(field.reshape(incidence.shape) for field in fields), counts])


if TYPE_CHECKING:

    class OfGroups(Protocol[Settings]):
        """The two signatures of a `rebound` of the four groups: scalars, and arrays."""

        @overload
        def __call__(  # type: ignore[overload-overlap]  # as ArrayLike has floats, too
            self,
            incidence: float,
            mass_ratio: float = ...,
            stiffness_ratio: float = ...,
            restitution: float = ...,
            *other: Settings.args,
            **settings: Settings.kwargs,
        ) -> Rebound[np.float64, Regime, int]: ...
        @overload
        def __call__(
            self,
            incidence: ArrayLike,
            mass_ratio: ArrayLike = ...,
            stiffness_ratio: ArrayLike = ...,
            restitution: ArrayLike = ...,
            *other: Settings.args,
            **settings: Settings.kwargs,
        ) -> Rebound: ...

    def of_groups(
        solve: Callable[Concatenate[ArrayLike, ArrayLike, ArrayLike, ArrayLike, Settings], Rebound],
    ) -> OfGroups[Settings]:
        """Decorator of a `rebound` of the four groups: `checks.default_errors`."""
else:
    of_groups = checks.default_errors


class EventKind(StrEnum, metaclass=Members):
    """What happens at an event of a contact's history. Each is a string too, such as "stick"."""

    CONTACT = "contact"
    STICK = "stick"
    SLIP = "slip"
    RELOADING = "reloading"
    MAXIMUM_COMPRESSION = "maximum compression"
    SEPARATION = "separation"


@record
class Event(NamedTuple):
    """One event: its kind, its time in t_c, and the state there (units as in `History`)."""

    kind: EventKind
    time: float
    normal: float
    friction_force: float
    velocity: float
    spring: float


@record
class History(NamedTuple):
    """Forces and velocity over one contact; every event is a vertex.

    Attributes
    ----------
    time : ndarray, shape (n,)
        t/t_c, from 0 to 1 + e, with viscous loss to 2; t_c is the time of compression.
    normal : ndarray, shape (n,)
        Normal force F2 in m2 Omega |v2(0)|.
    friction_force : ndarray, shape (n,)
        Tangential force F1 in mu m2 Omega |v2(0)|; positive opposes a positive incidence.
    velocity : ndarray, shape (n,)
        w = v1/(mu v2(0)).
    spring : ndarray, shape (n,)
        Deflection of the tangential element in mu |v2(0)|/Omega: zeta^2 friction_force, with the
        unloading stiffness e^2 zeta^2 friction_force, with viscous loss what the dashpot leaves of
        it.
    events : tuple of Event
        In order of time, from contact to separation; STICK and SLIP mark where a phase starts.
    """

    time: Array
    normal: Array
    friction_force: Array
    velocity: Array
    spring: Array
    events: tuple[Event, ...]

    @classmethod
    def joined(cls, phases: list[Array], events: list[tuple[EventKind, Array]]) -> Self:
        """Of phases, arrays of shape (5, n), and of events, arrays of shape (5,).

        A phase starts where the one before ends. Contact and separation come on top of the events.
        """
        columns = [phase[:, :-1] for phase in phases[:-1]] + phases[-1:]
        time, normal, friction, velocity, spring = np.concatenate(columns, axis=1)
        contact = EventKind.CONTACT, phases[0][:, 0]
        separation = EventKind.SEPARATION, phases[-1][:, -1]
        listed = (Event(kind, *map(float, at)) for kind, at in (contact, *events, separation))
        return cls(time, normal, friction, velocity, spring, tuple(listed))
