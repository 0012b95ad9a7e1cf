"""Bodies, materials and motions in SI units, and the checks of their quantities."""

from collections.abc import Callable, Iterable
from functools import partial, wraps
from typing import Any, NamedTuple, TypeAlias, TypeVar

import numpy as np

from planarimpact.common import checks
from planarimpact.common.arrays import Array, ArrayLike, Numbers
from planarimpact.common.checks import InputError, checked, finite, not_negative, positive

positive_or_infinite = partial(
    checked, allowed="numbers above 0, or inf", low=0, open_low=True, infinite=True
)
_poisson = partial(checked, allowed="numbers above -1, up to 0.5", low=-1, high=0.5, open_low=True)

_Rule: TypeAlias = Callable[[str, Any], Array]
_Tuple = TypeVar("_Tuple", bound=tuple[Any, ...])
_RULES: dict[type, dict[str, _Rule]] = {}


def _check_fields(**rules: _Rule) -> Callable[[type[_Tuple]], type[_Tuple]]:
    """Decorator of a named tuple: every new tuple's fields are checked by these rules."""

    def decorate(tuple_type: type[_Tuple]) -> type[_Tuple]:
        unchecked: Callable[..., _Tuple] = tuple_type.__new__

        @wraps(unchecked)
        def new(cls: type[_Tuple], *values: Any, **named_values: Any) -> _Tuple:
            instance = unchecked(cls, *values, **named_values)
            # The fields stay what the caller passed: numbers, or arrays that broadcast later.
            for (name, rule), value in zip(rules.items(), instance, strict=True):
                rule(name, value)
            return instance

        def make(cls: type[_Tuple], values: Iterable[Any]) -> _Tuple:  # `_replace` calls it too
            return cls(*values)

        _RULES[tuple_type] = rules
        # A named tuple may not define these itself. Any, as mypy refuses to replace methods.
        untyped: Any = tuple_type
        untyped.__new__, untyped._make = staticmethod(new), classmethod(make)
        return tuple_type

    return decorate


@_check_fields(young_modulus=positive, poisson_ratio=_poisson)
class Material(NamedTuple):
    """An isotropic elastic material: Young's modulus [Pa] and Poisson's ratio (-1 < nu <= 0.5)."""

    young_modulus: Numbers
    poisson_ratio: Numbers


@_check_fields(mass=positive_or_infinite, gyration=positive_or_infinite, radius=not_negative)
class Body(NamedTuple):
    """A rigid body: mass [kg], radius of gyration [m], distance centre to contact point [m].

    A body of infinite mass does not move, and one of infinite gyration does not turn.
    """

    mass: Numbers
    gyration: Numbers
    radius: Numbers


@_check_fields(tangential=finite, normal=finite, spin=finite)
class Motion(NamedTuple):
    """Velocity of the centre of mass [m/s] and spin [rad/s]; signs as in `planarimpact.bodies`."""

    tangential: Numbers
    normal: Numbers
    spin: Numbers


# A body that cannot turn, so its radius has no effect.
HALF_SPACE = Body(mass=np.inf, gyration=np.inf, radius=0.0)

# NumPy does not warn, whatever the caller has set: `checks.in_range` refuses bad results.
quietly = np.errstate(over="ignore", invalid="ignore", divide="ignore", under="ignore")


def all_positive(**arguments: ArrayLike) -> tuple[Array, ...]:
    """Check finite numbers above 0, and broadcast them."""
    return checks.broadcast(**{name: positive(name, v) for name, v in arguments.items()})


def fields(
    name: str, value: Body | Material | Motion, kind: type[Body | Material | Motion]
) -> dict[str, Array]:
    """Checked fields of a `kind`, keyed by the names that a refusal shows."""
    if not isinstance(value, kind):
        signature = f"{kind.__name__}({', '.join(kind._fields)})"
        raise InputError(f"{name} = {checks.brief(value)}: allowed are {signature} tuples")
    named = zip(_RULES[kind].items(), value, strict=True)
    return {f"{name}.{field}": rule(f"{name}.{field}", v) for (field, rule), v in named}
