"""Records whose help shows their own names, and not the hundred of tuples, texts and integers."""

from enum import EnumType
from typing import Any, TypeVar

_Record = TypeVar("_Record", bound=tuple[Any, ...])


def _own_names(kind: type) -> list[str]:
    """Public names that this package gave to a class."""
    own = (cls for cls in kind.__mro__ if cls.__module__.startswith("planarimpact"))
    return [name for cls in own for name in vars(cls) if not name.startswith("_")]


class _Fields(type):
    """The type of a record."""

    __dir__ = _own_names


class Members(EnumType):
    """The type of an enumeration, as its `metaclass`."""

    __dir__ = _own_names


def record(named_tuple: type[_Record]) -> type[_Record]:
    """Decorator of a named tuple: `help` and `dir` of the class show its fields and methods alone.

    Examples
    --------
    >>> from planarimpact import Event
    >>> dir(Event)
    ['friction_force', 'kind', 'normal', 'spring', 'time', 'velocity']
    """
    kept = "__module__", "__qualname__", "__doc__"
    names = {"__slots__": (), **{name: getattr(named_tuple, name) for name in kept}}
    names["__orig_bases__"] = getattr(named_tuple, "__orig_bases__", ())  # so generic as it is
    made: Any = _Fields(named_tuple.__name__, (named_tuple,), names)
    return made
