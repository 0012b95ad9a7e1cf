"""Beyond the paper: how far off each model is, and what it costs on this machine."""

import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from scipy.interpolate import PchipInterpolator

from planarimpact import InputError, continuum, lumped, models, spheres
from planarimpact.common import losses
from planarimpact.common.arrays import Array
from planarimpact.common.results import Rebound
from stronge1994 import tables
from stronge1994.tables import Table

FIELDS = {"velocity": "mu v2(0)", "peak_friction": "mu F2max", "dissipation": "mu^2 m2 v2(0)^2"}
# The spline of the continuum: evenly spaced incidences, and the tolerance of the continuum there.
SPLINE_KNOTS, SPLINE_TOLERANCE = 2000, 1e-5
# How far beside a kink the velocity is solved too. A spline rounds a kink off, and a table of
# solved continua has it at a slightly other place, so that their errors are largest there.
BESIDE_KINK = (0.0003, 0.001, 0.003, 0.01)
# Tolerance of the spread where the continuum is solved for it.
SPREAD_TOLERANCE = 1e-3

SEED = 1994
# A time is the median of some rounds. Each goes on for at least so many seconds, and impacts, as
# their time depends on incidence.
ROUNDS, ROUND_SECONDS, ROUND_IMPACTS = 3, 0.01, 3
# Up to about this many impacts together take as long as one, because of the overhead of arrays.
LARGE_BATCH = 300


def curves(
    mass_ratio: float,
    stiffness_ratio: float,
    incidence: Sequence[float],
    samples: int,
    restitution: Sequence[float],
    tolerance: float,
    steps: Sequence[int],
    tolerances: Sequence[float],
    inelastic: Mapping[str, Any],
    batches: Sequence[int],
    budget: float,
) -> Table:
    """Errors and times of every model that admits a restitution, a curve of one point each.

    The parameters of a curve are the settings of its model (the number of `steps` or `knots`, or
    the `tolerance` in mu v2(0)), the restitution, and the `loss` of the reference. For e = 1 the
    errors are those against the elastic continuum. For e < 1 every model is measured twice, against
    the viscous and against the plastic continuum. So the error of the other continuum is what the
    wrong loss costs. `rms_...` and `max_...` are over `samples` evenly spaced
    incidences, and `max_velocity_with_kinks` is over those of `at_kinks` besides. `seen` is the
    share of incidences where the error of the model is larger than the spread of the reference
    under uncertain inputs, see `input_spread`; `input_spread_stick` is over those incidences that
    stick at first. "spline of continuum" is made once, in `build_time`, and then evaluated; it is
    for one pair of bodies, and measured for e = 1 alone. Times are as in `times`.

    >>> inelastic = {"tolerance": 1e-2, "tolerances": [1e-2]}
    >>> table = curves(3.5, 1.21, [0, 8], 9, [0.8], 1, [16], [1], inelastic, [1], 1.0)
    >>> table["curve"].tolist()[2:4]
    ['laws.brach, e = 0.8, viscous', 'lumped.hysteretic, e = 0.8, viscous']
    >>> wrong = tables.select(table, model="continuum.plastic", loss="viscous")
    >>> float(wrong["max_velocity [mu v2(0)]"].round(1)[0])
    0.3
    """
    evenly = np.linspace(incidence[0], incidence[1], samples)
    parts = []
    for e in restitution:
        groups = {"mass_ratio": mass_ratio, "stiffness_ratio": stiffness_ratio, "restitution": e}
        x = np.append(evenly, at_kinks(groups, incidence))
        accuracy, wanted = tolerance, tolerances
        if e < 1:
            accuracy, wanted = inelastic["tolerance"], inelastic["tolerances"]
        tried = {"steps": steps, "tolerance": wanted}
        contenders = list(_contenders(groups, tried, incidence[1]))
        found = [contender.rebound(x) for contender in contenders]
        seconds = times([stopwatch(c.rebound) for c in contenders], incidence, batches, budget)
        for loss in continuum.LOSSES if e < 1 else ("",):
            exact = reference(x, groups, accuracy, loss)
            spread = input_spread(evenly, groups, loss)
            for contender, rebound, taken in zip(contenders, found, seconds, strict=True):
                gap = np.abs(rebound.velocity - exact.velocity)
                row = {
                    **errors(_first(rebound, samples), _first(exact, samples)),
                    "max_velocity_with_kinks [mu v2(0)]": np.max(gap),
                    "seen [1]": float(np.mean(gap[:samples] > spread)),
                    "reference_error [mu v2(0)]": accuracy,
                    "input_spread [mu v2(0)]": root_mean_square(spread),
                    "input_spread_stick [mu v2(0)]": root_mean_square(
                        spread[evenly <= stiffness_ratio]
                    ),
                    **contender.build_time,
                    **taken,
                }
                columns = {key: [value] for key, value in row.items()}
                settings: dict[str, Any] = {**contender.settings}
                parts.append(tables.curve(columns, contender.model, **settings, e=e, loss=loss))
    return tables.join(parts)


def at_kinks(groups: Mapping[str, float], incidence: Sequence[float]) -> Array:
    """Incidences at the kinks of the velocity, and beside them, within the range of `incidence`.

    The velocity has a kink where the contact no longer sticks at first and where it begins to slide
    throughout. All models have the same incidences, those of the kinks of each loss.

    >>> groups = {"mass_ratio": 3.5, "stiffness_ratio": 1.21, "restitution": 1.0}
    >>> at_kinks(groups, [0, 8]).round(4)[::4].tolist()
    [1.2, 1.21, 1.22, 5.7897, 5.793, 6.999, 7.001]
    """
    beta, zeta2, e = (groups[name] for name in ("mass_ratio", "stiffness_ratio", "restitution"))
    kinks = {zeta2, (1 + e) * beta}
    kinks |= {float(loss.stiffness_ratio(zeta2, e)) for loss in losses.LUMPED.values()}
    for model in (lumped, continuum):
        limits = (model.slip_throughout_limit(beta, zeta2, e, loss=loss) for loss in model.LOSSES)
        kinks |= set(map(float, limits))
    steps = np.array([0.0, *BESIDE_KINK])
    places = np.unique(np.add.outer(sorted(kinks), [*-steps, *steps]).round(12))
    return places[(places >= incidence[0]) & (places <= incidence[1])]


def _first(rebound: Rebound, samples: int) -> Rebound:
    """The first impacts of some."""
    return rebound._replace(**{name: getattr(rebound, name)[:samples] for name in FIELDS})


_Solver: TypeAlias = Callable[[Array], Rebound]


class _Contender(NamedTuple):
    """One model with its settings, as a function of the incidence alone."""

    model: str
    settings: dict[str, float]
    rebound: _Solver
    build_time: dict[str, float] = {}


def _contenders(
    groups: dict[str, Any], tried: dict[str, Sequence[float]], incidence_max: float
) -> Iterator[_Contender]:
    """Every model that admits the restitution, with each setting tried; for e = 1 the spline."""
    elastic = groups["restitution"] == 1
    names = set()
    for model in models.MODELS.values():
        stem = model.name.partition(".")[0]
        # For e = 1 a model with a loss is the same as the model without.
        double = elastic and (stem in models.MODELS or model.name == f"{stem}.{model.loss}")
        name = stem if double else model.name
        if name in names or not _answers(model, groups):
            continue
        names.add(name)
        # The first setting that is tried is varied, others keep their defaults.
        known = {key: value for key, value in model.settings.items() if key in tried}
        varied = next(iter(known), "")
        for settings in [known | {varied: value} for value in tried[varied]] if varied else [{}]:
            yield _Contender(name, settings, partial(model.rebound, **groups, **settings))
    if elastic:
        start = time.process_time()
        spline = _spline_of_continuum(groups, incidence_max)
        build_time = {"build_time [s]": time.process_time() - start}
        yield _Contender("spline of continuum", {"knots": SPLINE_KNOTS}, spline, build_time)


def _answers(model: models.Model, groups: Mapping[str, Any]) -> bool:
    """Whether a model takes these groups."""
    low, high = model.restitution
    try:
        models.rebound(model, 0.0, **groups)
    except InputError:
        return False
    return bool(low <= groups["restitution"] <= high)


def _spline_of_continuum(groups: Mapping[str, Any], incidence_max: float) -> _Solver:
    """The velocity of the elastic continuum for one pair of bodies, from incidence 0 on.

    The cubic polynomials between the knots do not leave the range of the two values at their ends,
    also where the velocity has a kink.
    """
    knots = np.linspace(0.0, incidence_max, SPLINE_KNOTS)
    solved = continuum.rebound(knots, **groups, tolerance=SPLINE_TOLERANCE)
    spline = PchipInterpolator(knots, solved.velocity)

    def rebound(x: Array) -> Rebound[Any, Any, Any]:
        unknown = np.full_like(x, np.nan)
        return Rebound(spline(x), unknown, unknown, unknown)

    return rebound


def reference(x: Array, groups: Mapping[str, float], tolerance: float, loss: Any) -> Rebound:
    """What errors are measured against. The `loss`, viscous or plastic, has no meaning for e = 1.

    >>> groups = {"mass_ratio": 3.5, "stiffness_ratio": 1.21, "restitution": 0.5}
    >>> float(reference(np.array([8.0]), groups, 1e-3, "plastic").velocity[0])
    2.75
    """
    return continuum.rebound(x, **groups, loss=loss or None, tolerance=tolerance)


def input_spread(x: Array, groups: dict[str, float], loss: str) -> Array:
    """Root mean square change of the velocity if e is known to 0.02 and mu to 10 %.

    It is in mu v2(0), at each incidence. For e = 1 lower values of e are those of the viscous
    continuum. The answers are those of the table of spheres where it has them, as two digits
    matter; else the continuum is solved.

    >>> groups = {"mass_ratio": 3.5, "stiffness_ratio": 1.21, "restitution": 1.0}
    >>> input_spread(np.array([8.0]), groups, "").round(2)
    array([0.7])
    """
    loss = loss or losses.VISCOUS.name
    lowest = groups | {"restitution": groups["restitution"] - 2 * models.RESTITUTION_ERROR}
    order = "mass_ratio", "stiffness_ratio", "restitution"
    if spheres.covers(*(lowest[name] for name in order)):
        return models.input_spread(f"spheres.{loss}", x, **groups)
    return models.input_spread(f"continuum.{loss}", x, **groups, tolerance=SPREAD_TOLERANCE)


def root_mean_square(values: Array) -> float:
    """Root mean square; NaN of none.

    >>> root_mean_square(np.array([3.0, -3.0]))
    3.0
    """
    return float(np.sqrt(np.mean(np.square(values)))) if values.size else float("nan")


def errors(rebound: Rebound, exact: Rebound) -> dict[str, float]:
    """Root mean square and largest error of each field that a model has.

    A field that `rebound` leaves NaN has no columns, other than velocity.

    >>> from planarimpact import rigid
    >>> from planarimpact.models import laws
    >>> x = np.array([1.0, 8.0])
    >>> list(errors(laws.brach(x), rigid.rebound(x)))[:2]
    ['rms_velocity [mu v2(0)]', 'max_velocity [mu v2(0)]']
    """
    columns = {}
    for field, unit in FIELDS.items():
        gap = np.abs(getattr(rebound, field) - getattr(exact, field))
        # A velocity that is not a number is a fault, and must appear in the table.
        if field == "velocity" or np.isfinite(gap).all():
            columns[f"rms_{field} [{unit}]"] = root_mean_square(gap)
            columns[f"max_{field} [{unit}]"] = np.max(gap)
    return columns


def times(
    watches: Sequence[Callable[[Array], float]],
    incidence: Sequence[float],
    batches: Sequence[int],
    budget: float,
) -> list[dict[str, float]]:
    """Time of an impact in each batch, for each of some solvers, as far as the budget goes.

    Each of `watches` solves incidences and returns the seconds that the processor worked; it has
    solved some before, since the first call of all pays for what is kept. The incidences are
    random, the same ones in every round and run. A batch is left out, and all larger ones, if it
    would take more seconds than the budget, as the smaller one before it predicts. `time_...` is
    the median of the rounds. `scatter_...` is the difference of the largest and the smallest over
    it: other programs slow the processor down for a while, as they use its caches. So that this
    shows, a round is over all solvers before the next begins.

    >>> times([lambda x: 0.5 * x.size], (0, 8), [1, 2, 10000], budget=10.0)
    [{'time_1 [s]': 0.5, 'scatter_1 [1]': 0.0, 'time_2 [s]': 0.5, 'scatter_2 [1]': 0.0}]
    """
    columns: list[dict[str, float]] = [{} for _ in watches]
    before, alone = 1, np.zeros(len(watches))
    for batch in sorted(batches):
        within = np.flatnonzero(alone * batch / max(before, LARGE_BATCH) <= budget).tolist()
        alone[:] = np.inf
        rounds = [[_seconds(watches[i], incidence, batch) for i in within] for _ in range(ROUNDS)]
        for i, taken in zip(within, np.transpose(rounds), strict=True):
            alone[i] = median = np.median(taken)
            columns[i] |= {
                f"time_{batch} [s]": float(median / batch),
                f"scatter_{batch} [1]": float(np.ptp(taken) / median),
            }
        before = batch
    return columns


def _seconds(watch: Callable[[Array], float], incidence: Sequence[float], batch: int) -> float:
    """Seconds of a batch, the mean of one round."""
    random = np.random.default_rng(SEED)
    taken: list[float] = []
    while sum(taken) < ROUND_SECONDS or len(taken) * batch < ROUND_IMPACTS:
        taken.append(watch(random.uniform(incidence[0], incidence[1], batch)))
    return float(np.mean(taken))


def stopwatch(rebound: _Solver) -> Callable[[Array], float]:
    """The seconds that the processor works for a solver."""

    def seconds(x: Array) -> float:
        start = time.process_time()
        rebound(x)
        return time.process_time() - start

    return seconds
