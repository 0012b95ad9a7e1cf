"""Impacts of bodies in space: velocities and spins before and after, in SI units.

`collide` takes vectors and returns vectors. A `Pair` says what the materials do: friction,
stiffness, and what takes the energy. `scene` solves tables of impacts by the same functions, which
also decide which model answers (`methods`): a formula where it is exact, the table of spheres where
it covers the impact, or the continuum, solved. `mechanics` has the vectors, `pairs`
what materials do, `one_impact` one impact, `facts` what is computed when it is asked for,
`off_centre` bodies that strike off their centre.

Bodies touch at one point, and the line of their centres of mass is the normal there, but for bodies
with an offset. A body whose radius of gyration is not the same about every axis must turn about an
axis across its plane of incidence. All vectors have one set of axes. Spin is the right-handed
vector of angular velocity.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import cached_property, partial

import numpy as np
from numpy.typing import NDArray

from planarimpact import bodies, models
from planarimpact.bodies import Body
from planarimpact.collision import methods, off_centre, one_impact
from planarimpact.collision.facts import Facts, cautions, in_shape, model_forms
from planarimpact.collision.mechanics import (
    Impacts,
    State,
    after,
    energies_lost,
    impacts,
    problems,
    problems_of_normals,
    taken,
)
from planarimpact.collision.methods import TOLERANCE as TOLERANCE
from planarimpact.collision.pairs import RESTITUTION_FROM as RESTITUTION_FROM
from planarimpact.collision.pairs import Pair
from planarimpact.collision.presets import Preset, presets
from planarimpact.common import checks
from planarimpact.common.arrays import Array, ArrayLike, Integers
from planarimpact.common.cautions import Caution
from planarimpact.common.checks import InputError
from planarimpact.common.losses import NAMES
from planarimpact.common.results import Regime
from planarimpact.continuum import Unsolved
from planarimpact.models import Model

__all__ = ["Caution", "Collision", "Pair", "Preset", "collide", "presets"]


@dataclass(eq=False)
class Collision:
    """Bodies after their impacts; made by `collide`. Its arrays have the shape of the arguments.

    Attributes
    ----------
    velocity, other_velocity : ndarray, shape (..., 3)
        Of the centres [m/s].
    spin, other_spin : ndarray, shape (..., 3)
        [rad/s], right-handed.
    impulse : ndarray, shape (..., 3)
        On the body [N s]; the other one has the opposite impulse. 0 where bodies do not approach.
    incidence : ndarray, shape (...)
        v1(0)/(mu v2(0)): 0 where v1(0) = 0, else infinite without friction, and at least 1e-100.
        NaN, like the next two, without an impact.
    restitution : ndarray, shape (...)
        e, at the speed of the impact.
    error_bound : ndarray, shape (...)
        Largest error of the tangential velocity of the contact point after the impact, against the
        continuum [m/s]; less than v1(0). It is measured by searches, not proved. NaN where a model
        was asked for that has no such bound.
    regime : ndarray of int, shape (...), or Regime
        Codes of `Regime`: the order of stick and slip, NO_IMPACT where bodies do not approach.
    loss_code : ndarray of int, shape (...)
        Of the loss, in `planarimpact.common.losses.NAMES`; -1 where e = 1 or without an impact.
        It is that of the model, where one was asked for that has a loss.
    model, model_form, caution, energy_lost
        Computed when they are asked for; their own help says more.
    """

    velocity: Array
    spin: Array
    other_velocity: Array
    other_spin: Array
    impulse: Array
    incidence: Array
    restitution: Array
    error_bound: Array
    regime: Regime | Integers
    loss_code: Integers
    # Gives the rest, when it is asked for; as partial functions can be pickled.
    _facts: Callable[[], Facts] = field(repr=False)

    @property
    def loss(self) -> NDArray[np.str_]:
        """What took the energy, by its name; none where e = 1 or without an impact."""
        return NAMES[self.loss_code]

    @cached_property
    def model(self) -> NDArray[np.str_]:
        """Name of the model that answered, as in `scene`; "no impact" where there is none."""
        facts = self._facts()
        names = *(method.model for method in methods.METHODS), *facts.asked, "no impact"
        return np.array(names)[facts.whole(facts.place, -1)]

    @cached_property
    def model_form(self) -> Array:
        """How far the velocity of the contact point would move with the other loss [m/s].

        Without a sign; no tolerance makes it smaller. It is 0 where e = 1, NaN without an impact or
        where nothing is known, or where the continuum would have to be solved and may not be. It
        takes as long as `collide` with the other loss when it is first asked for.
        """
        facts = self._facts()
        if facts.form is not None:
            return facts.form
        velocity = facts.impacts.v1 + facts.change
        form = model_forms(facts.impacts, facts.place, velocity, facts.solve)
        return facts.whole(form, np.nan)

    @cached_property
    def caution(self) -> Integers | Caution:
        """Why the answer may not hold, as codes of `Caution`; 0 where nothing is known against it.

        `collision.Caution(code).text` has the words. Nothing is known of bodies that are given by a
        stiffness ratio in place of their materials.

        >>> from planarimpact import bodies
        >>> steel = Pair(bodies.Material(2e11, 0.3), friction=0.3, restitution=0.9, loss="plastic")
        >>> ball = bodies.solid_sphere(0.01, density=7800)
        >>> collide(steel, [0, 0, 1], ball, [1.0, 0, -1.0], [0, 0, 0]).caution
        <Caution.FRICTION|DISSIMILAR: 6>
        """
        facts = self._facts()
        codes = cautions(facts.impacts, facts.place, facts.regime, facts.spared)
        codes = facts.whole(codes, 0)
        return codes if codes.ndim else Caution(int(codes))

    @cached_property
    def energy_lost(self) -> Array:
        """Kinetic energy lost by both bodies [J]: along the normal and the surface, shape (..., 2).

        Along the normal the loss takes it. Along the surface friction takes it, and with viscous or
        plastic loss also the material.
        """
        facts = self._facts()
        lost = facts.energies or energies_lost(facts.impacts, facts.change)
        return facts.whole(np.array(lost), 0.0)


def collide(
    pair: Pair,
    normal: ArrayLike,
    body: Body,
    velocity: ArrayLike,
    spin: ArrayLike,
    other: Body = bodies.HALF_SPACE,
    other_velocity: ArrayLike = (0.0, 0.0, 0.0),
    other_spin: ArrayLike = (0.0, 0.0, 0.0),
    *,
    tolerance: float = TOLERANCE,
    model: str | Model | None = None,
    solve: bool = True,
    offset: ArrayLike | None = None,
    other_offset: ArrayLike | None = None,
) -> Collision:
    """Velocities and spins of two bodies after their impact; all arguments broadcast.

    Parameters
    ----------
    pair : Pair
        Materials, friction and restitution: one pair, or an array of pairs.
    normal : array_like, shape (..., 3)
        Unit vector from the other body, or the surface, to the body. An error of its length up to
        1e-6, as in float32, is taken away.
    body, other : Body
        Mass [kg], radius of gyration [m] and radius [m], numbers or arrays. A wall has infinite
        mass and gyration, and radius 0 where it is flat: `bodies.HALF_SPACE`, if left out.
    velocity, other_velocity : array_like, shape (..., 3)
        Of the centres before the impact [m/s]. A wall may move.
    spin, other_spin : array_like, shape (..., 3)
        Before the impact [rad/s], right-handed.
    tolerance : float
        Largest error of the velocity of the contact point, in mu v2(0), against the continuum;
        1e-10 to 1. In v1(0) it is at most the default. Of models that are asked for only those
        beginning with "continuum" have it. The default is that of the table of spheres:
        about a microsecond an impact in an array, some tens of them for one alone, and tens of
        milliseconds for the first one, as the table is read.
        Impacts for which the table is too coarse, or which it does not cover (`spheres.covers`),
        take milliseconds each in a batch of hundreds, alone 0.1 to 0.3 s, and at mass ratios of
        hundreds up to seconds; `continuum.rebound` says what it can meet.
    model : str or Model, optional
        A name of `planarimpact.models.MODELS`, or a Model of your own, that answers in place of the
        cheapest one within the tolerance: "lumped.hysteretic" is the paper's, "rigid" has no
        compliance. The restitution is that of the pair at the speed of the impact; the loss is that
        of the model, and a pair may be of "viscous" or "plastic" materials all the same, unless the
        model has the other one of these two.
    solve : bool
        Whether the continuum may be solved. If not, an impact that needs it is refused.
    offset, other_offset : array_like, shape (..., 3), optional
        Of bodies that strike off their centre: the part along the surface of the way from the
        centre of mass to the point of contact [m]; the radius is the part along the normal. All
        motion must be in the plane of offset and normal. See `collision.off_centre`: the model is
        "rigid" or a lumped one without dashpots; if it is left out, that of the pair's loss, and at
        e = 1 "lumped.hysteretic".

    Returns
    -------
    Collision
        Bodies that do not approach each other (v2 <= 0) are left as they are.

    Raises
    ------
    InputError
        If an argument is not allowed, by its index; also one that the model refuses. Without a
        model e must be 0.1 or more where the contact sticks.
    ConvergenceError
        If the continuum does not reach the tolerance.

    Notes
    -----
    The impulse acts on both bodies at one point, so that momentum and angular momentum stay the
    same to rounding, whatever the answer.

    Examples
    --------
    A rubber ball is thrown down with backspin, and comes back:

    >>> from planarimpact import bodies
    >>> rubber = Pair(bodies.Material(5e6, 0.5), friction=0.8, restitution=0.9, loss="viscous")
    >>> ball = bodies.solid_sphere(radius=0.025, density=1100)
    >>> result = collide(rubber, [0, 0, 1], ball, [2.0, 0, -4.0], [0, -300.0, 0])
    >>> result.velocity.round(2).tolist(), result.spin.round(0).tolist()
    ([-2.12, 0.0, 3.6], [0.0, 112.0, 0.0])
    >>> result.regime.name, str(result.model)
    ('SLIP_STICK_SLIP', 'continuum.viscous')

    By the paper's model it comes back faster:

    >>> arguments = rubber, [0, 0, 1], ball, [2.0, 0, -4.0], [0, -300.0, 0]
    >>> collide(*arguments, model="lumped.hysteretic").velocity.round(2).tolist()
    [-2.47, 0.0, 3.6]
    """
    vectors = normal, velocity, spin, other_velocity, other_spin
    _refuse_types(pair, body, other)
    if type(tolerance) is not float or not 1e-10 <= tolerance <= 1:  # the check takes its time
        tolerance = checks.number("tolerance", tolerance, "numbers from 1e-10 to 1", 1e-10, 1)
    chosen = None if model is None else models.get(model)
    if solve is not True and solve is not False:
        raise InputError(f"solve = {checks.brief(solve)}: allowed are True and False")
    if offset is not None or other_offset is not None:
        zero = (0.0, 0.0, 0.0)
        offsets = zero if offset is None else offset, zero if other_offset is None else other_offset
        return _collide_arrays(pair, body, other, (*vectors, *offsets), tolerance, chosen, solve)
    if not (chosen and chosen not in one_impact.BY_MODEL):
        floats = [one_impact.floats(vector) for vector in vectors]
        fields = one_impact.collide(pair, body, other, floats, tolerance, chosen, solve)
        if fields:
            return Collision(*fields)
    return _collide_arrays(pair, body, other, vectors, tolerance, chosen, solve)


@checks.default_errors
def _collide_arrays(
    pair: Pair,
    body: Body,
    other: Body,
    values: Sequence[ArrayLike],
    tolerance: float,
    model: Model | None,
    solve: bool,
) -> Collision:
    """State after any number of impacts, from arrays; offsets are the last of seven vectors."""
    names = "normal", "velocity", "spin", "other_velocity", "other_spin", "offset", "other_offset"
    vectors = [_vectors(name, value) for name, value in zip(names, values, strict=False)]
    _refuse_models(model, solve, len(vectors) > 5)
    fields = [np.asarray(value, dtype=float) for value in (*body, *other)]
    shape = _common_shape(pair, vectors, fields)
    pair = pair.broadcast(shape)
    fields = [np.broadcast_to(value, shape).reshape(-1) for value in fields]
    body, other = Body(*fields[:3]), Body(*fields[3:])
    vectors = [np.broadcast_to(v, (*shape, 3)).reshape(-1, 3).T.copy() for v in vectors]
    before, other_before, offsets = State(*vectors[1:3]), State(*vectors[3:5]), vectors[5:]
    arguments = pair, vectors[0], body, before, other, other_before
    plane = None
    try:
        if offsets:
            given, plane = off_centre.impacts(*arguments, *offsets)
        else:
            given = impacts(*arguments)
    except bodies.OutOfRange as error:
        raise InputError(f"{_place(min(error.messages), shape)}{error}") from None
    # Also where nothing approaches: a normal of two centres at one place is no number, or zero.
    _refuse(problems_of_normals(given.normal), shape)
    approach = np.flatnonzero(given.v2 > 0)
    met = given if approach.size == given.v2.size else given.take(approach)
    energies = None
    if model:
        loss_code, wrong = methods.lost_by(model, met.loss_code)
        _refuse(wrong, shape, approach)
        met = met._replace(loss_code=loss_code)
    elif not plane:
        _refuse(problems(met), shape, approach)
    if plane:
        plane = taken(plane, approach, given.v2.size)
        answer, impulses, energies = off_centre.answers(met, plane, model)
        state, other_state, impulse = off_centre.after(met, plane, impulses)
    else:
        if model:
            answer = methods.answers_of(model, met, tolerance)
        else:
            answer = methods.answers(met, tolerance, solve=solve)
        state, other_state, impulse = after(met, answer.change)
    _refuse(answer.refused, shape, approach)
    for i, problem in answer.unsolved.items():
        raise Unsolved(f"{_place(approach[i], shape)}{problem}", approach[[i]])
    whole = partial(in_shape, approach, given.v2.size, shape)
    numbers = Impacts._make([None] * 6 + [*met[6:]])  # in less memory, also where it is pickled
    asked = [model] if model else [*off_centre.LUMPED.values()] if plane else []
    facts = partial(
        Facts,
        whole,
        numbers,
        answer.place.astype(np.int8),
        answer.change,
        answer.regime,
        tuple(one.name for one in asked),
        methods.spared(model) if model else Caution.NONE,
        energies,
        solve=solve,
    )
    regime = whole(answer.regime, Regime.NO_IMPACT)
    return Collision(
        velocity=whole(state.velocity, given.before.velocity),
        spin=whole(state.spin, given.before.spin),
        other_velocity=whole(other_state.velocity, given.other_before.velocity),
        other_spin=whole(other_state.spin, given.other_before.spin),
        impulse=whole(impulse, 0.0),
        incidence=whole(met.incidence_of(np.arange(met.v1.size)), np.nan),
        restitution=whole(met.restitution, np.nan),
        error_bound=whole(answer.error, np.nan),
        regime=regime if regime.ndim else Regime(int(regime)),
        loss_code=whole(met.loss_code, -1),
        _facts=facts,
    )


def _refuse_types(pair: Pair, body: Body, other: Body) -> None:
    """Refuse what is no pair or no body."""
    if not isinstance(pair, Pair):
        raise InputError(f"pair = {checks.brief(pair)}: allowed is a planarimpact.Pair")
    for name, value in (("body", body), ("other", other)):
        if not isinstance(value, Body):
            allowed = "a bodies.Body, such as bodies.solid_sphere(radius, density=...)"
            raise InputError(f"{name} = {checks.brief(value)}: allowed is {allowed}")


def _refuse_models(model: Model | None, solve: bool, has_offset: bool) -> None:
    """Refuse a model that does not have such impacts, or may not be solved."""
    if model and has_offset and model not in off_centre.CHOICES:
        names = ", ".join(choice.name for choice in off_centre.CHOICES)
        raise InputError(f"model = '{model.name}': with an offset allowed are {names}")
    if model and not solve and methods.is_solved(model):
        raise InputError(f"solve = False: model = '{model.name}' is solved; allowed are others")


def _vectors(name: str, value: ArrayLike) -> Array:
    """Checked vectors, shape (..., 3)."""
    vectors = checks.finite(name, value)
    if vectors.shape[-1:] != (3,):
        raise InputError(f"{name}, shape {vectors.shape}: allowed are vectors, shape (..., 3)")
    return vectors


def _common_shape(pair: Pair, vectors: list[Array], fields: list[Array]) -> tuple[int, ...]:
    """Shape of all impacts."""
    shapes = [pair.shape, *(v.shape[:-1] for v in vectors), *(f.shape for f in fields)]
    try:
        return np.broadcast_shapes(*shapes)
    except ValueError:
        listed = ", ".join(map(str, dict.fromkeys(shapes)))
        raise InputError(
            f"shapes do not broadcast: {listed}, without the axis of vectors"
        ) from None


def _refuse(messages: dict[int, str], shape: tuple[int, ...], rows: Integers | None = None) -> None:
    """Refuse the first impact that has a message; `rows` are those that messages are about."""
    for i, message in messages.items():
        raise InputError(f"{_place(i if rows is None else rows[i], shape)}{message}")


def _place(index: int, shape: tuple[int, ...]) -> str:
    """Which impact a message is about, by its index in arrays of this shape."""
    where = ", ".join(map(str, np.unravel_index(index, shape)))
    return f"impact [{where}]: " if shape else ""
