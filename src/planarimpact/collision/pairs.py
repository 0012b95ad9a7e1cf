"""A pair of materials, or a table of pairs: friction, stiffness, and what takes the energy."""

from typing import Any

import numpy as np

from planarimpact import bodies, normal_impact
from planarimpact.bodies import Material
from planarimpact.common import checks
from planarimpact.common.arrays import Array, ArrayLike, Booleans
from planarimpact.common.checks import InputError
from planarimpact.normal_impact import LOSSES, PLASTIC, VISCOUS

# What gives the restitution, and the loss that comes with it: the restitution itself, or a property
# of the materials that gives it at the speed of each impact.
RESTITUTION_FROM: dict[str, str | None] = {"restitution": None}
RESTITUTION_FROM |= {law.property: loss for loss, law in normal_impact.LAWS.items()}
_FIELDS = ("friction", "stiffness_ratio", "effective_modulus", *RESTITUTION_FROM)
_ARRAYS = (*_FIELDS, "plastic")


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
        "plastic" (metals that yield). An empty text, None or NaN in an array means none.
    stiffness_ratio : array_like, optional
        zeta^2, normal over tangential stiffness, where there are no materials.
    effective_modulus : array_like, optional
        E* [Pa], where there are no materials; a relaxation time or a yield pressure needs it.

    Attributes
    ----------
    friction, stiffness_ratio, effective_modulus, restitution, relaxation_time, yield_pressure
        As above, arrays of one shape; NaN where the pair does not have it.
    plastic : ndarray of bool
        Whether the loss is plastic, else viscous; without a meaning where e = 1.
    shape : tuple of int

    Raises
    ------
    InputError
        If an argument is not a number in its range, the loss is missing where it is needed, a pair
        has its restitution in two ways or in none, or shapes do not broadcast.

    Notes
    -----
    In a table some pairs may have a restitution, and others a relaxation time or a yield pressure:
    what a pair does not have is NaN. `table[i, j]` is a pair or an array of pairs.

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
    >>> Pair(steel, friction=0.1, restitution=0.8)
    Traceback (most recent call last):
    ...
    planarimpact.InputError: restitution = 0.8: below 1 it needs a loss: choose viscous, plastic
    """

    friction: Array
    stiffness_ratio: Array
    effective_modulus: Array
    restitution: Array
    relaxation_time: Array
    yield_pressure: Array
    plastic: Booleans
    floats: tuple[float, ...]  # the fields but `plastic`, if they are plain numbers of one pair
    __slots__ = (*_ARRAYS, "floats")

    def __init__(
        self,
        *materials: Material,
        friction: ArrayLike,
        restitution: ArrayLike | None = None,
        relaxation_time: ArrayLike | None = None,
        yield_pressure: ArrayLike | None = None,
        loss: str | ArrayLike | None = None,
        stiffness_ratio: ArrayLike | None = None,
        effective_modulus: ArrayLike | None = None,
    ) -> None:
        laws = {
            "restitution": checks.restitution(_given(restitution), missing=True),
            "relaxation_time": checks.not_negative(
                "relaxation_time", _given(relaxation_time), missing=True
            ),
            "yield_pressure": checks.positive(
                "yield_pressure", _given(yield_pressure), missing=True
            ),
        }
        stiffness = _stiffness(materials, stiffness_ratio, effective_modulus)
        mu = checks.not_negative("friction", friction)
        named = {"friction": mu, **stiffness, **laws, "loss": checks.losses(loss, LOSSES)}
        arrays = dict(zip(named, checks.broadcast(**named), strict=True))
        codes = arrays.pop("loss")
        _refuse_other_laws(arrays)
        _refuse_loss(arrays, codes)
        yields = ~np.isnan(arrays["yield_pressure"])
        by_law = ~np.isnan(arrays["relaxation_time"]) | yields
        if (by_law & np.isnan(arrays["effective_modulus"])).any():
            raise InputError(
                "effective_modulus: missing; a relaxation time or a yield pressure needs it, or "
                "the materials"
            )
        plastic = (codes == LOSSES.index(PLASTIC)) | yields
        # Copies: what the caller does with its arrays later does not change the pair.
        _fill(self, *(np.array(arrays[name]) for name in _FIELDS), plastic)

    def __setattr__(self, name: str, value: Any) -> None:
        raise AttributeError(f"a Pair cannot be changed: make a new one with another {name}")

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle and copy it by its fields."""
        return _made, tuple(getattr(self, name) for name in _ARRAYS)

    @property
    def shape(self) -> tuple[int, ...]:
        """Shape of the array of pairs; () of a single one."""
        return self.plastic.shape

    def __getitem__(self, index: Any) -> "Pair":
        """Some pairs of a table, by an index as of its arrays."""
        return _made(*(getattr(self, name)[index] for name in _ARRAYS))

    def broadcast(self, shape: tuple[int, ...]) -> "Pair":
        """Pairs in one row, for impacts of a shape that this table broadcasts to."""
        fields = (getattr(self, name) for name in _ARRAYS)
        return _made(*(np.broadcast_to(field, shape).reshape(-1) for field in fields))

    def __repr__(self) -> str:
        if self.shape:
            return f"<Pair: table of shape {self.shape}>"
        numbers = {name: float(getattr(self, name)) for name in _FIELDS}
        del numbers["effective_modulus"]
        shown = [f"{k} = {v:.4g}" for k, v in numbers.items() if not np.isnan(v)]
        loss = [] if numbers["restitution"] == 1 else [PLASTIC if self.plastic else VISCOUS]
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


def _given(value: ArrayLike | None) -> ArrayLike:
    """Numbers of one law, NaN where a pair does not have it."""
    return np.nan if value is None else value


def _stiffness(
    materials: tuple[Material, ...], ratio: ArrayLike | None, modulus: ArrayLike | None
) -> dict[str, Array]:
    """Stiffness ratio and effective modulus, from the materials or as they are given."""
    if bool(materials) == (ratio is not None):
        raise InputError("materials, stiffness_ratio: needed is one of the two")
    if materials:
        if modulus is not None:
            raise InputError("effective_modulus: it does not apply, the materials have it")
        if len(materials) > 2:
            raise InputError(f"{len(materials)} materials: allowed are one or two")
        return {
            "stiffness_ratio": bodies.stiffness_ratio(*materials),
            "effective_modulus": bodies.effective_modulus(*materials),
        }
    known = np.nan if modulus is None else checks.positive("effective_modulus", modulus)
    return {
        "stiffness_ratio": checks.stiffness_ratio(ratio if ratio is not None else np.nan),
        "effective_modulus": np.asarray(known),
    }


def _refuse_other_laws(arrays: dict[str, Array]) -> None:
    """Refuse pairs that give the restitution in two ways, or in none."""
    said = np.sum([~np.isnan(arrays[name]) for name in RESTITUTION_FROM], axis=0)
    if (said != 1).any():
        count = int(np.atleast_1d(said)[np.atleast_1d(said) != 1][0])
        names = ", ".join(RESTITUTION_FROM)
        raise InputError(f"{names}: {count} of them given, needed is exactly one a pair")


def _refuse_loss(arrays: dict[str, Array], codes: Array) -> None:
    """Refuse a loss that is missing below e = 1, or another one than that of the law."""
    restitution = arrays["restitution"]
    missing = (restitution < 1) & (codes < 0)
    if missing.any():
        checks.require_loss(np.where(missing, restitution, 1.0), LOSSES)
    for name, loss in RESTITUTION_FROM.items():
        if loss and (~np.isnan(arrays[name]) & (codes >= 0) & (codes != LOSSES.index(loss))).any():
            (other,) = set(LOSSES) - {loss}
            raise InputError(f"loss = '{other}': allowed with {name} is {loss}; it may be left out")
