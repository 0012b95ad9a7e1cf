"""Error and time of LAMMPS and pooltool, and of our models beside them, as rows of the trade."""

import functools
import time
from collections.abc import Callable, Iterator, Sequence
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from planarimpact import models
from planarimpact.ground.arrays import Array
from planarimpact.ground.results import Rebound
from stronge1994.curves import trade
from stronge1994.trade import peers

# Velocities, seconds, and seconds of set-up.
Answer: TypeAlias = tuple[Array, float, float]
_Row: TypeAlias = dict[str, Any]

STEPS = (64, 256)
BATCHES = (1, 1000)
# Seconds that a batch may take.
BUDGET = 10.0
# Mass ratio of the solid spheres that LAMMPS throws.
SOLID_SPHERE = 3.5


class Contender(NamedTuple):
    """A code with its settings; `solve` returns velocities, seconds, and seconds of set-up."""

    model: str
    settings: dict[str, Any]
    solve: Callable[[Array], Answer]


def measure(
    mass_ratio: float,
    stiffness_ratio: float,
    incidence: Sequence[float],
    samples: int,
    restitution: Sequence[float],
    tolerance: float,
) -> tuple[dict[str, dict[str, list[Any]]], list[str]]:
    """Rows of both codes, each after the model of ours with which it is compared.

    Parameters
    ----------
    mass_ratio, stiffness_ratio, incidence, samples, restitution, tolerance
        As in `stronge1994.curves.trade.curves`.

    Returns
    -------
    dict
        `{name: {column: [one cell]}}` with the columns of `stronge1994.curves.trade.curves` for
        velocity and time (`build_time` is the set-up of LAMMPS, once a batch), and `installed`;
        `refused [1]`, impacts that raised an error and are left out of the errors;
        `time_over_ours [1]`, in the largest batch.
    list of str
        A sentence for each code that is not installed, or does not take these bodies.
    """
    x = np.linspace(incidence[0], incidence[1], samples)
    rows, notes = {}, []
    for code, contenders in (("lammps", _lammps), ("pooltool", _pooltool)):
        if names := peers.missing(code):
            notes.append(f"{code} is not installed ({', '.join(names)})")
            rows[code] = {"model": code, "installed": "no"}
            continue
        for e in restitution:
            groups = {
                "mass_ratio": mass_ratio,
                "stiffness_ratio": stiffness_ratio,
                "restitution": e,
            }
            exact, accuracy = trade.reference(x, groups, tolerance)
            try:
                for ours, *theirs in contenders(**groups):
                    beside = None
                    for contender in (ours, *theirs):
                        row = _row(contender, x, exact.velocity, incidence)
                        row |= {"restitution [1]": e, "reference_error [mu v2(0)]": accuracy}
                        beside = beside or row
                        row["time_over_ours [1]"] = _largest(row) / _largest(beside)
                        rows[_name(contender, e)] = row
            except ValueError as error:
                notes.append(f"{code}: {error}")
    return {name: {key: [cell] for key, cell in row.items()} for name, row in rows.items()}, notes


def _lammps(
    mass_ratio: float, stiffness_ratio: float, restitution: float
) -> Iterator[tuple[Contender, ...]]:
    """Our time-stepped contact with each number of steps, and LAMMPS' laws with as many."""
    if restitution != 1:  # below, its normal contact is another law
        return
    if mass_ratio != SOLID_SPHERE:
        raise ValueError(f"mass_ratio = {mass_ratio:g}: it has solid spheres, {SOLID_SPHERE:g}")
    nu = peers.poisson_ratio_of(stiffness_ratio)
    for steps in STEPS:
        contenders = [_ours("timestep.mindlin", mass_ratio, stiffness_ratio, 1.0, steps=steps)]
        for law in peers.LAWS:
            solve = functools.partial(_thrown, law=law, steps=steps, poisson_ratio=nu)
            contenders.append(Contender(f"LAMMPS {law}", {"steps": steps}, solve))
        yield tuple(contenders)


def _pooltool(
    mass_ratio: float, stiffness_ratio: float, restitution: float
) -> Iterator[tuple[Contender, ...]]:
    groups = {"mass_ratio": mass_ratio, "stiffness_ratio": stiffness_ratio}

    def solve(x: Array) -> Answer:
        return *peers.pooltool_impacts(x, restitution, **groups), 0.0

    ours = _ours("lumped", mass_ratio, stiffness_ratio, restitution)
    yield ours, Contender("pooltool", {}, solve)


def _thrown(x: Array, **settings: Any) -> Answer:
    velocity, run, whole = peers.lammps_impacts(x, **settings)
    return velocity, run, whole - run


def _ours(model: str, *groups: float, **settings: Any) -> Contender:
    def solve(x: Array) -> Answer:
        start = time.perf_counter()
        found = models.rebound(model, x, *groups, **settings)
        return found.velocity, time.perf_counter() - start, 0.0

    return Contender(model, settings, solve)


def _row(contender: Contender, x: Array, exact: Array, incidence: Sequence[float]) -> _Row:
    velocity, *_ = contender.solve(x)
    answered = np.isfinite(velocity)
    row = {
        "model": contender.model,
        "installed": "yes",
        "refused [1]": int(np.sum(~answered)),
        **{trade.SETTINGS[key]: value for key, value in contender.settings.items()},
    }
    if answered.any():
        row |= trade.errors(_velocities(velocity[answered]), _velocities(exact[answered]))
    row |= trade.times(lambda some: contender.solve(some)[1], incidence, BATCHES, BUDGET)
    *_, set_up = contender.solve(x)
    return row | ({"build_time [s]": set_up} if set_up else {})


def _velocities(w: Array) -> Rebound:
    """A rebound of which only the velocity is known."""
    unknown = np.full_like(w, np.nan)
    return Rebound(w, unknown, unknown, unknown)


def _largest(row: _Row) -> float:
    """Time of an impact in the largest batch that was solved."""
    return [row[f"time_{n} [s]"] for n in BATCHES if f"time_{n} [s]" in row][-1]


def _name(contender: Contender, e: float) -> str:
    settings = [f"{value} {key}" for key, value in contender.settings.items()]
    return ", ".join([contender.model, *settings, f"e = {e:g}"])
