"""A pair of materials, or a table of pairs: friction, stiffness, and what takes the energy."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import lru_cache, partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from planarimpact import bodies
from planarimpact.bodies import Material
from planarimpact.common import checks
from planarimpact.common.arrays import Array, ArrayLike, Integers
from planarimpact.common.checks import InputError
from planarimpact.common.losses import (
    BY_NAME,
    CODES,
    NAMES,
    SPHERES,
    LumpedLoss,
    SpheresLosses,
)

# What gives the restitution, and the loss that comes with it: the restitution itself, or a property
# of the materials that gives it at the speed of each impact.
RESTITUTION_FROM = {"restitution": ""} | {loss.material: name for name, loss in SPHERES.items()}
_FIELDS = ("friction", "stiffness_ratio", "effective_modulus", *RESTITUTION_FROM)
_ARRAYS = (*_FIELDS, "dundurs", "loss_code")
_OF_MATERIALS = "stiffness_ratio", "effective_modulus", "dundurs"
_NAN = np.array(np.nan)


class Pair:
    """Two materials that touch, or an array of such pairs: all arguments broadcast.

    Parameters
    ----------
    *materials : Material
        Of both bodies; one alone touches a rigid body. Their fields may be arrays. They give the
        stiffness ratio and the effective modulus, which may be given in their place.
    friction : array_like
        Coefficient of friction mu, from 0.
    restitution : array_like, optional
        Energetic coefficient e at every speed, 0 to 1; or else one of the next two.
    relaxation_time : array_like, optional
        [s], of viscous materials, see `bodies.viscous_restitution`: e follows from the speed.
    yield_pressure : array_like, optional
        [Pa], of materials that yield, see `bodies.plastic_restitution`: e follows from the speed.
    loss : str or array_like of str, optional
        What takes the energy where `restitution` is below 1: "viscous" (polymers, rubber) or
        "plastic" (metals that yield); or one of `lumped.LOSSES`, for `collide` with such a model.
        An empty text, None or NaN in an array means none.
    stiffness_ratio : array_like, optional
        zeta^2, normal over tangential stiffness, where there are no materials.
    effective_modulus : array_like, optional
        E* [Pa], where there are no materials; a relaxation time or a yield pressure needs it.

    Attributes
    ----------
    friction, stiffness_ratio, effective_modulus, restitution, relaxation_time, yield_pressure
        As above, arrays of one shape; NaN where the pair does not have it.
    dundurs : ndarray
        Size of Dundurs' constant, see `bodies.dundurs`; NaN where there are no materials.
    loss, loss_code : ndarray of str, ndarray of int
        Name of the loss, and its place in `planarimpact.common.losses.NAMES`; "none" and -1 where
        none is said.
    shape : tuple of int

    Raises
    ------
    InputError
        Also if the loss is missing where it is needed, or a pair has its restitution in two ways or
        in none.

    Notes
    -----
    In a table some pairs may have a restitution, and others a relaxation time or a yield pressure.
    `table[i, j]` is a pair or an array of pairs.

    Examples
    --------
    >>> from planarimpact.bodies import Material
    >>> steel, glass = Material(207e9, 0.3), Material(70e9, 0.22)
    >>> Pair(steel, glass, friction=0.15, restitution=0.9, loss="plastic")
    <Pair: friction = 0.15, stiffness_ratio = 1.159, restitution = 0.9, plastic>
    >>> table = Pair(
    ...     stiffness_ratio=1.2, friction=[[0.1, 0.3], [0.3, 0.4]], restitution=0.8, loss="viscous"
    ... )
    >>> table[[0, 1], [1, 1]].friction.tolist()
    [0.3, 0.4]
    >>> Pair(steel, friction=0.1, restitution=0.8)  # doctest: +ELLIPSIS
    Traceback (most recent call last):
    ...
    planarimpact.InputError: restitution = 0.8: below 1 it needs a loss: choose viscous...
    """

    friction: Array
    stiffness_ratio: Array
    effective_modulus: Array
    restitution: Array
    relaxation_time: Array
    yield_pressure: Array
    dundurs: Array
    loss_code: Integers
    floats: tuple[float, ...]  # the fields but `loss_code`, if they are plain numbers of one pair
    __slots__ = (*_ARRAYS, "floats")

    def __init__(
        self,
        *materials: Material,
        friction: ArrayLike,
        restitution: ArrayLike | None = None,
        relaxation_time: ArrayLike | None = None,
        yield_pressure: ArrayLike | None = None,
        loss: SpheresLosses | LumpedLoss | None = None,
        stiffness_ratio: ArrayLike | None = None,
        effective_modulus: ArrayLike | None = None,
    ) -> None:
        laws = {"relaxation_time": relaxation_time, "yield_pressure": yield_pressure}
        fields = _checked(friction=friction, restitution=restitution, loss=loss, **laws)
        _fill(self, *_together(fields | _stiffness(materials, stiffness_ratio, effective_modulus)))

    def replace(self, **changes: Any) -> Pair:
        """A pair with other values of these arguments of `Pair`; all else stays, unchecked.

        There are no materials here, and None stands for no value. A new value may be an array: it
        broadcasts with the fields that stay. It is refused where `Pair` refuses it.

        Examples
        --------
        >>> steel = Pair(stiffness_ratio=1.2, friction=0.1, restitution=0.8, loss="plastic")
        >>> steel.replace(friction=0.3, restitution=0.5)
        <Pair: friction = 0.3, stiffness_ratio = 1.2, restitution = 0.5, plastic>
        """
        for name in changes:
            checks.word("argument", name, _CHECKS)
        fields = {name: getattr(self, name) for name in _ARRAYS}
        if "stiffness_ratio" in changes:  # of materials that are not known
            fields["dundurs"] = _NAN
        if not changes.keys().isdisjoint(RESTITUTION_FROM) and "loss" not in changes:
            # The loss of a law goes with it.
            by_law = np.isnan(self.restitution)
            fields["loss_code"] = np.where(by_law, np.int8(-1), self.loss_code)
        return _made(*_together(fields | _checked(**changes)))

    def __setattr__(self, name: str, value: Any) -> None:
        raise AttributeError(f"a Pair cannot be changed: make a new one with another {name}")

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle and copy it by its fields."""
        return _made, tuple(getattr(self, name) for name in _ARRAYS)

    @property
    def loss(self) -> NDArray[np.str_]:
        """What takes the energy below e = 1, by its name; "none" where none is said."""
        return NAMES[self.loss_code]

    @property
    def shape(self) -> tuple[int, ...]:
        """Shape of the array of pairs; () of a single one."""
        return self.loss_code.shape

    def __getitem__(self, index: Any) -> Pair:
        """Some pairs of a table, by an index as of its arrays."""
        return _made(*(getattr(self, name)[index] for name in _ARRAYS))

    def broadcast(self, shape: tuple[int, ...]) -> Pair:
        """Pairs in one row, for impacts of a shape that this table broadcasts to."""
        fields = (getattr(self, name) for name in _ARRAYS)
        return _made(*(np.broadcast_to(field, shape).reshape(-1) for field in fields))

    def __repr__(self) -> str:
        if self.shape:
            return f"<Pair: table of shape {self.shape}>"
        numbers = {name: float(getattr(self, name)) for name in _FIELDS}
        del numbers["effective_modulus"]
        shown = [f"{k} = {v:.4g}" for k, v in numbers.items() if not np.isnan(v)]
        loss = [] if numbers["restitution"] == 1 else [str(self.loss)]
        return f"<Pair: {', '.join(shown + loss)}>"


def _made(*fields: Array) -> Pair:
    """A pair of fields that are checked already, in the order of `_ARRAYS`."""
    pair = object.__new__(Pair)
    _fill(pair, *fields)
    return pair


def _fill(pair: Pair, *fields: Array) -> None:
    """Give a new pair its fields, in the order of `_ARRAYS`; from then on nobody can write them."""
    for name, values in zip(_ARRAYS, map(np.asarray, fields), strict=True):
        values.setflags(write=False)
        object.__setattr__(pair, name, values.view())  # NumPy lets an array be written again
    numbers = () if pair.shape else tuple(float(getattr(pair, name)) for name in _FIELDS)
    plain = all(not n or n != n or n >= checks.LEAST for n in numbers)
    object.__setattr__(pair, "floats", numbers if plain else ())


# The checks of arguments; those of `_FIELDS[2:]` may be None.
_CHECKS: dict[str, Callable[[Any], Any]] = {
    "friction": partial(checks.not_negative, "friction"),
    "stiffness_ratio": checks.stiffness_ratio,
    "effective_modulus": partial(checks.positive, "effective_modulus"),
    "restitution": partial(checks.restitution, missing=True),
    "relaxation_time": partial(checks.not_negative, "relaxation_time", missing=True),
    "yield_pressure": partial(checks.positive, "yield_pressure", missing=True),
    "loss": partial(checks.losses, allowed=BY_NAME),
}


def _checked(**arguments: Any) -> dict[str, Any]:
    """Checked fields by their arguments, NaN where a pair does not have one."""
    fields = {}
    for name, value in arguments.items():
        missing = value is None and name in _FIELDS[2:]
        fields[name] = _NAN if missing else _CHECKS[name](value)
    if "loss" in fields:
        fields["loss_code"] = fields.pop("loss")
    return fields


def _stiffness(
    materials: tuple[Material, ...], ratio: ArrayLike | None, modulus: ArrayLike | None
) -> dict[str, Any]:
    """Stiffness ratio and effective modulus, from the materials or as they are given."""
    if bool(materials) == (ratio is not None):
        raise InputError("materials, stiffness_ratio: needed is one of the two")
    if materials:
        if modulus is not None:
            raise InputError("effective_modulus: it does not apply, the materials have it")
        if len(materials) > 2:
            raise InputError(f"{len(materials)} materials: allowed are one or two")
        try:
            values = _of_materials(*materials)
        except TypeError:  # arrays
            values = _of_materials.__wrapped__(*materials)
        return dict(zip(_OF_MATERIALS, values, strict=True))
    return {"dundurs": _NAN} | _checked(stiffness_ratio=ratio, effective_modulus=modulus)


@lru_cache(maxsize=4096, typed=True)
def _of_materials(*materials: Material) -> tuple[Array, ...]:
    """The fields that materials give, in their order."""
    dundurs = np.abs(bodies.dundurs(*materials))
    return bodies.stiffness_ratio(*materials), bodies.effective_modulus(*materials), dundurs


def _together(fields: dict[str, Any]) -> list[Array]:
    """Copies of checked fields in the order of `_ARRAYS`; refuse what may not be together.

    What the caller does with its arrays later does not change the pair.
    """
    arrays: dict[str, Any] = dict(zip(fields, checks.broadcast(**fields), strict=True))
    e, *laws = (arrays[name] for name in RESTITUTION_FROM)
    # A single pair with a restitution, and a loss where it needs one, takes most time below.
    sound = not e.ndim and (e == 1 or (e < 1 and arrays["loss_code"] >= 0))
    if not (sound and all(map(math.isnan, laws))):
        _refuse_other_laws(arrays)
        arrays["loss_code"] = _of_law(arrays)
        if (np.isnan(e) & np.isnan(arrays["effective_modulus"])).any():
            raise InputError(
                "effective_modulus: missing; a relaxation time or a yield pressure needs it, or "
                "the materials"
            )
    return [np.array(arrays[name]) for name in _ARRAYS]


def _refuse_other_laws(arrays: dict[str, Array]) -> None:
    """Refuse pairs that give the restitution in two ways, or in none."""
    said = np.sum([~np.isnan(arrays[name]) for name in RESTITUTION_FROM], axis=0)
    if (said != 1).any():
        count = int(np.atleast_1d(said)[np.atleast_1d(said) != 1][0])
        names = ", ".join(RESTITUTION_FROM)
        raise InputError(f"{names}: {count} of them given, needed is exactly one a pair")


def _of_law(arrays: dict[str, Any]) -> Integers:
    """Codes of the losses, those of laws too; refuse another one, or none below e = 1."""
    restitution, codes = arrays["restitution"], arrays["loss_code"]
    missing = (restitution < 1) & (codes < 0)
    checks.require_loss(np.where(missing, restitution, 1.0), SPHERES)
    for loss in SPHERES.values():
        has = ~np.isnan(arrays[loss.material])
        others = NAMES[codes[has & (codes >= 0) & (codes != CODES[loss])]]
        if others.size:
            allowed = f"allowed with {loss.material} is {loss.name}; it may be left out"
            raise InputError(f"loss = '{others[0]}': {allowed}")
        codes = np.where(has, CODES[loss], codes)
    return codes
