"""Bodies, materials and motions in SI units, and the checks of their quantities."""

from collections.abc import Callable, Iterable
from functools import partial, wraps
from typing import Any, NamedTuple, TypeAlias, TypeVar

import numpy as np

from planarimpact.ground import checks
from planarimpact.ground.arrays import Array, ArrayLike, Booleans, Numbers
from planarimpact.ground.checks import InputError, checked, finite, not_negative, positive


class OutOfRange(InputError):
    """A result beyond the range of numbers or of a law; `where` says which of an array."""

    def __init__(self, message: str, where: Booleans) -> None:
        super().__init__(message)
        self.where = where

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle it by its arguments, so that another process can raise it again."""
        return type(self), (str(self), self.where)


positive_or_infinite = partial(
    checked, allowed="numbers above 0, or inf", low=0, open_low=True, infinite=True
)
_poisson = partial(checked, allowed="numbers above -1, up to 0.5", low=-1, high=0.5, open_low=True)

_Rule: TypeAlias = Callable[[str, Any], Array]
_Tuple = TypeVar("_Tuple", bound=tuple[Any, ...])
_RULES: dict[type, dict[str, _Rule]] = {}


def _made_of(**rules: _Rule) -> Callable[[type[_Tuple]], type[_Tuple]]:
    """Give every field of a named tuple a rule, which is asked wherever one is made.

    Fields stay as they are given: numbers, or arrays that broadcast later.
    """

    def with_rules(kind: type[_Tuple]) -> type[_Tuple]:
        plain: Callable[..., _Tuple] = kind.__new__

        @wraps(plain)
        def new(cls: type[_Tuple], *given: Any, **named: Any) -> _Tuple:
            made = plain(cls, *given, **named)
            for (name, rule), value in zip(rules.items(), made, strict=True):
                rule(name, value)
            return made

        def make(cls: type[_Tuple], values: Iterable[Any]) -> _Tuple:  # `_replace` calls it too
            return cls(*values)

        _RULES[kind] = rules
        # A named tuple may not define these itself. Any, as mypy refuses to replace methods.
        replaced: Any = kind
        replaced.__new__, replaced._make = staticmethod(new), classmethod(make)
        return kind

    return with_rules


@_made_of(young_modulus=positive, poisson_ratio=_poisson)
class Material(NamedTuple):
    """An isotropic elastic material: Young's modulus [Pa] and Poisson's ratio (-1 < nu <= 0.5)."""

    young_modulus: Numbers
    poisson_ratio: Numbers


@_made_of(mass=positive_or_infinite, gyration=positive_or_infinite, radius=not_negative)
class Body(NamedTuple):
    """A rigid body: mass [kg], radius of gyration [m], distance centre to contact point [m].

    A body of infinite mass does not move, and one of infinite gyration does not turn.
    """

    mass: Numbers
    gyration: Numbers
    radius: Numbers


@_made_of(tangential=finite, normal=finite, spin=finite)
class Motion(NamedTuple):
    """Velocity of the centre of mass [m/s] and spin [rad/s]; signs as in `planarimpact.bodies`."""

    tangential: Numbers
    normal: Numbers
    spin: Numbers


# It cannot turn, so its radius has no effect. Its curvature is the default of effective_radius.
HALF_SPACE = Body(mass=np.inf, gyration=np.inf, radius=0.0)

# `in_range` refuses bad results, so NumPy need not warn, whatever the caller has set.
quietly = np.errstate(over="ignore", invalid="ignore", divide="ignore", under="ignore")


def in_range(name: str, values: Array, above: float = 0.0) -> Array:
    """Return values as they are, if all are finite and larger than `above` in size."""
    lost = np.atleast_1d(~(np.isfinite(values) & (np.abs(values) > above)))
    if lost.any():
        first = np.atleast_1d(values)[lost][0]
        raise OutOfRange(f"{name} = {first:g}: it is beyond the range of numbers", lost)
    return values


def all_positive(**arguments: ArrayLike) -> tuple[Array, ...]:
    """Check finite numbers above 0, and broadcast them."""
    return checks.broadcast(**{name: positive(name, v) for name, v in arguments.items()})


def fields(
    name: str, value: Body | Material | Motion, kind: type[Body | Material | Motion]
) -> dict[str, Array]:
    """Checked fields of a `kind`, keyed by the names that a refusal shows."""
    if not isinstance(value, kind):
        form = f"{kind.__name__}({', '.join(kind._fields)})"
        raise InputError(f"{name} = {value!r}: allowed are {form} tuples")
    named = zip(_RULES[kind].items(), value, strict=True)
    return {f"{name}.{field}": rule(f"{name}.{field}", v) for (field, rule), v in named}
