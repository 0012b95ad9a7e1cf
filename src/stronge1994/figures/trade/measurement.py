"""Error and time of LAMMPS and pooltool, and of our models beside them, as rows of the trade."""

import functools
import time
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple, Protocol, TypeAlias

import numpy as np

from planarimpact import models
from planarimpact.ground.arrays import Array
from planarimpact.ground.results import Rebound
from stronge1994.figures.trade import curves as trade
from stronge1994.figures.trade import peers

# Velocities, seconds, and seconds of set-up.
Answer: TypeAlias = tuple[Array, float, float]
_Row: TypeAlias = dict[str, Any]

# The continuum for each cause of loss, and that of elastic bodies.
LOSSES = {"viscous": "continuum.viscous", "plastic": "continuum.plastic"}
ELASTIC = {"": "continuum"}
# Restitutions of the comparison. Below e = 1 the codes err by 0.05 mu v2(0) and more, and their
# errors are known to a few thousandths.
RESTITUTIONS = (1.0, 0.9, 0.7, 0.5)
LOSSY_TOLERANCE = 1e-4
STEPS = (64, 256)
BATCHES = (1, 1000)
# Longest time of a batch, in seconds.
BUDGET = 10.0
# Tolerance of our own continua: far below the errors of both codes.
OWN_TOLERANCE = 1e-3
# The rooms of ours whose models are measured beside the codes.
ROOMS = ("lumped", "continuum", "spheres")
# Mass ratio of the solid spheres that LAMMPS throws.
SOLID_SPHERE = 3.5

# What users of LAMMPS choose below e = 1: law, steps, and arguments of `peers.damping_for`. The
# first four differ by the law alone, the others are mindlin/force with another damping or more
# steps. The last is an example of LAMMPS' manual.
_FORCE = "mindlin/force"
DAMPED: tuple[tuple[str, int, dict[str, Any]], ...] = (
    *((law, 64, {"style": peers.DEFAULT}) for law in peers.LAWS),
    (_FORCE, 256, {"style": peers.DEFAULT}),
    (_FORCE, 64, {"style": "coeff_restitution"}),
    (_FORCE, 64, {"style": peers.DEFAULT, "tangential": 0.5}),
    (_FORCE, 64, {"style": peers.DEFAULT, "tangential": 1.0}),
    (_FORCE, 64, {"style": peers.DEFAULT, "tangential": 0.5, "limited": True}),
    ("mindlin_rescale", 64, {"style": "tsuji", "tangential": 1.0}),
)


class _Solve(Protocol):
    def __call__(self, x: Array, /) -> Answer: ...


class Contender(NamedTuple):
    """A code with its settings; `solve` returns velocities, seconds, and seconds of set-up."""

    model: str
    settings: dict[str, Any]
    solve: _Solve
    columns: dict[str, Any] = {}


class _Reference(NamedTuple):
    velocity: Array
    error: float


def measure(
    mass_ratio: float,
    stiffness_ratio: float,
    incidence: Sequence[float],
    samples: int,
    tolerance: float,
    restitution: Sequence[float] = RESTITUTIONS,
    lossy_tolerance: float = LOSSY_TOLERANCE,
) -> tuple[dict[str, dict[str, list[Any]]], list[str]]:
    """Rows of both codes and of models of ours, all in this process and on the same incidences.

    Each velocity is compared with the elastic continuum for e = 1, and for e < 1 with both continua
    that lose energy, a row for each `loss`. `build_time` is the set-up of LAMMPS, once a batch.
    `refused` counts impacts that raised an error and are left
    out of the errors. `time_over_ours`, in the largest batch, is over the time-stepped contact
    (LAMMPS) or the lumped model (pooltool). `restitution_delivered` is the normal speed after over
    that before the impact; `max_from_lumped` is pooltool's largest distance from the model it
    solves. The list has a sentence for each code that is not installed, or does not take these
    bodies.
    """
    x = np.linspace(incidence[0], incidence[1], samples)

    @functools.cache
    def references(e: float) -> dict[str, _Reference]:
        by_loss = {}
        for loss, name in (ELASTIC if e == 1 else LOSSES).items():
            error = tolerance if e == 1 else lossy_tolerance
            exact = models.rebound(name, x, mass_ratio, stiffness_ratio, e, tolerance=error)
            by_loss[loss] = _Reference(exact.velocity, error)
        return by_loss

    rows: dict[str, _Row] = {}
    notes = []
    entrants = [("lammps", _lammps), ("pooltool", _pooltool)]
    for code, _ in entrants:
        if names := peers.missing(code):
            notes.append(f"{code} is not installed ({', '.join(names)})")
            rows[code] = {"model": code, "installed": "no"}
    present = [entrant for entrant in entrants if entrant[0] not in rows]
    for code, contenders in [*present, ("ours", _alone)] if present else []:
        try:
            for e in restitution:
                for rivals in contenders(x, mass_ratio, stiffness_ratio, e):
                    for name, row in _rows_of(rivals, x, e, references(e), incidence).items():
                        rows.setdefault(name, row)
        except ValueError as error:
            notes.append(f"{code}: {error}")
    return {name: {key: [cell] for key, cell in row.items()} for name, row in rows.items()}, notes


def _lammps(
    x: Array, mass_ratio: float, stiffness_ratio: float, restitution: float
) -> Iterator[tuple[Contender, ...]]:
    """Our time-stepped contact with each number of steps, and LAMMPS' laws with as many."""
    if mass_ratio != SOLID_SPHERE:
        raise ValueError(f"mass_ratio = {mass_ratio:g}: it has solid spheres, {SOLID_SPHERE:g}")
    nu = peers.poisson_ratio_of(stiffness_ratio)
    for steps in STEPS:
        settings = {"steps": steps}
        contenders = [_ours("timestep.mindlin", mass_ratio, stiffness_ratio, restitution, settings)]
        if restitution == 1:
            for law in peers.LAWS:
                solve = functools.partial(_thrown, law=law, steps=steps, poisson_ratio=nu)
                contenders.append(Contender(f"LAMMPS {law}", settings, solve))
        else:
            for law, own_steps, damping_arguments in DAMPED:
                if own_steps == steps:
                    contenders.append(_damped(law, steps, nu, restitution, damping_arguments))
        yield tuple(contenders)


def _damped(
    law: str, steps: int, nu: float, restitution: float, damping_arguments: _Row
) -> Contender:
    damping = peers.damping_for(restitution, steps=steps, **damping_arguments)
    along_normal = peers.lammps_impacts(0.0, law, steps, poisson_ratio=nu, damping=damping)
    columns = {
        "damping": damping.style,
        "tangential_damping [1]": damping.tangential,
        "limit_damping": "yes" if damping.limited else "no",
        "restitution_delivered [1]": along_normal.restitution,
    }
    solve = functools.partial(_thrown, law=law, steps=steps, poisson_ratio=nu, damping=damping)
    return Contender(f"LAMMPS {law}, {damping.label()}", {"steps": steps}, solve, columns)


def _pooltool(
    x: Array, mass_ratio: float, stiffness_ratio: float, restitution: float
) -> Iterator[tuple[Contender, ...]]:
    groups = {"mass_ratio": mass_ratio, "stiffness_ratio": stiffness_ratio}

    def solve(x: Array) -> Answer:
        return *peers.pooltool_impacts(x, restitution, **groups), 0.0

    name = "lumped" if restitution == 1 else "lumped.hysteretic"
    ours = _ours(name, mass_ratio, stiffness_ratio, restitution)
    apart = np.abs(solve(x)[0] - ours.solve(x)[0])
    columns = {"max_from_lumped [mu v2(0)]": np.nanmax(apart)} if np.isfinite(apart).any() else {}
    yield ours, Contender("pooltool", {}, solve, columns)


def _alone(
    x: Array, mass_ratio: float, stiffness_ratio: float, restitution: float
) -> Iterator[tuple[Contender, ...]]:
    """Models of ours. The lumped model has its row already if pooltool is installed."""
    for name in _own_names(restitution):
        settings = {"tolerance": OWN_TOLERANCE} if "tolerance" in models.get(name).settings else {}
        ours = _ours(name, mass_ratio, stiffness_ratio, restitution, settings)
        yield (ours._replace(model=name.partition(".")[0]) if restitution == 1 else ours,)


def _own_names(restitution: float) -> list[str]:
    """Models of `ROOMS` that admit a restitution; at e = 1 without repeats of another loss."""
    names = []
    for name, model in models.MODELS.items():
        low, high = model.restitution
        stem, _, loss = name.rpartition(".")
        double = restitution == 1 and (stem in models.MODELS or loss == "plastic")
        if name.startswith(ROOMS) and low <= restitution <= high and not double:
            names.append(name)
    return names


def _thrown(x: Array, **settings: Any) -> Answer:
    impacts = peers.lammps_impacts(x, **settings)
    return impacts.velocity, impacts.run_seconds, impacts.total_seconds - impacts.run_seconds


def _ours(
    model: str,
    mass_ratio: float,
    stiffness_ratio: float,
    restitution: float,
    settings: Mapping[str, Any] = {},
) -> Contender:
    def solve(x: Array) -> Answer:
        start = time.process_time()
        rebound = models.rebound(model, x, mass_ratio, stiffness_ratio, restitution, **settings)
        return rebound.velocity, time.process_time() - start, 0.0

    return Contender(model, dict(settings), solve)


def _rows_of(
    rivals: Sequence[Contender],
    x: Array,
    e: float,
    references: Mapping[str, _Reference],
    incidence: Sequence[float],
) -> dict[str, _Row]:
    """Rows of contenders, for each reference; the first contender is ours."""
    rows: dict[str, _Row] = {}
    first = None
    for contender in rivals:
        velocity, *_ = contender.solve(x)
        times = _times(contender, x, incidence)
        first = first or _largest(times)
        answered = np.isfinite(velocity)
        for loss, reference in references.items():
            row = {
                "model": contender.model,
                "installed": "yes",
                "restitution [1]": e,
                "loss": loss,
                "refused [1]": int(np.sum(~answered)),
                **contender.columns,
                **{trade.SETTINGS[key]: value for key, value in contender.settings.items()},
            }
            if answered.any():
                computed, exact = velocity[answered], reference.velocity[answered]
                row |= trade.errors(_velocities(computed), _velocities(exact))
            row |= {"reference_error [mu v2(0)]": reference.error, **times}
            row["time_over_ours [1]"] = _largest(times) / first
            rows[_name(contender, e, loss)] = row
    return rows


def _times(contender: Contender, x: Array, incidence: Sequence[float]) -> dict[str, float]:
    (times,) = trade.times(
        [lambda incidences: contender.solve(incidences)[1]], incidence, BATCHES, BUDGET
    )
    *_, set_up = contender.solve(x)
    return times | ({"build_time [s]": set_up} if set_up else {})


def _velocities(w: Array) -> Rebound:
    """A rebound of which only the velocity is known."""
    unknown = np.full_like(w, np.nan)
    return Rebound(w, unknown, unknown, unknown)


def _largest(times: Mapping[str, float]) -> float:
    """Time of an impact in the largest batch that was solved."""
    return [times[f"time_{n} [s]"] for n in BATCHES if f"time_{n} [s]" in times][-1]


def _name(contender: Contender, e: float, loss: str) -> str:
    settings = [f"{value} {key}" for key, value in contender.settings.items()]
    against = [f"against {loss}"] if loss else []
    return ", ".join([contender.model, *settings, f"e = {e:g}", *against])
