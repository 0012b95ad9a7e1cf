"""Write the tables of data/model_errors: how far off simple models are, computed a second time.

    python -m tests.reference_solutions.error_tables data/model_errors

For e = 1 against the elastic continuum, data/elastic_continuum/rebound_grid.csv; for e = 0.8
against the viscous and against the plastic one, data/inelastic_models/rebound_grid.csv. The models
are written anew from their definitions.
"""

import functools
import sys
from typing import NamedTuple

import numpy as np

from tests.reference_solutions import (
    exact_tables,
    inelastic_tables,
    leapfrog,
    table_files,
    viscous_precision,
)
from tests.reference_solutions.exact_tables import BETA, ZETA2
from tests.reference_solutions.table_files import table

LOSSES = ("viscous", "plastic")
INCIDENCES = np.linspace(0.0, 8.0, 81)
STEPS = (16, 64, 256)
BRACH = 0.40  # tangential restitution: the value that the package documents
FIELDS = {"velocity": "mu v2(0)", "peak_friction": "mu F2max", "dissipation": "mu^2 m2 v2(0)^2"}


class Answer(NamedTuple):
    """Arrays over the incidences; None where the model leaves it open."""

    velocity: np.ndarray
    peak_friction: np.ndarray | None
    dissipation: np.ndarray


def tables():
    """All tables, `{name: Table}`."""
    models = {("rigid", None): rigid, ("laws.smith", None): smith, ("laws.brach", None): brach}
    elastic = models | {("lumped", None): lumped}
    models |= {("lumped.hysteretic", None): lumped}
    steps = {
        (f"timestep.{law}", f"{steps}"): functools.partial(stepped, law, steps)
        for law in leapfrog.LAWS
        for steps in STEPS
    }
    springs = {
        ("lumped.unloading-stiffness", None): lumped_unloading_stiffness,
        ("lumped.viscous", None): lumped_viscous,
    }
    below, wrong, e = [], [], inelastic_tables.GRID_E
    for loss, other in (LOSSES, LOSSES[::-1]):
        exact = lossy(loss)
        below += [
            ([*own, loss], model, e, exact) for own, model in (models | springs | steps).items()
        ]
        wrong.append(
            ([f"continuum.{other}", 1e-3, loss], lambda _, other=other: lossy(other), e, exact)
        )
    of_elastic = [(own, model, 1.0, continuum()) for own, model in (elastic | steps).items()]
    return {
        "elastic": _table(["model", "steps"], of_elastic),
        "inelastic": _table(["model", "steps", "loss"], below),
        "wrong_loss": _table(["model", "tolerance", "loss"], wrong),
    }


def _table(labels, rows):
    columns = [
        f"{kind}_{name} [{unit}]" for name, unit in FIELDS.items() for kind in ("rms", "max")
    ]
    return table([*labels, "e", *columns], _row, rows)


def _row(labels, model, e, exact):
    cells = []
    for found, right in zip(model(e), exact, strict=True):
        if found is None:
            cells += [None, None]
        else:
            gap = np.abs(found - right)
            cells += [round(float(np.sqrt(np.mean(gap**2))), 12), round(float(gap.max()), 12)]
    return [*labels, e, *cells]


# What errors are measured against ------------------------------------------------------------


def continuum():
    """The elastic continuum by annuli, from its table."""
    return _grid("elastic_continuum/rebound_grid")


def lossy(loss):
    """The continuum of a loss by springs stepped through time, from its table."""
    return _grid("inelastic_models/rebound_grid", f"continuum.{loss}")


def _grid(name, model=None):
    rows = [row for row in table_files.read(name) if row.get("model") == model]
    numbers = np.array([list(row.values())[-4:] for row in rows], float)
    if not np.allclose(numbers[:, 0], INCIDENCES, rtol=0, atol=1e-12):
        raise SystemExit(f"{name}: other incidences")
    return Answer(*numbers[:, 1:].T)


# Springs -------------------------------------------------------------------------------------


@functools.cache
def lumped(e, zeta2=ZETA2):
    """The lumped model with 40 digits."""
    return _of_each(lambda x: exact_tables.solve(x, BETA, zeta2, e))


def lumped_unloading_stiffness(e):
    """The lumped model of the elastic unloading: e^2 zeta^2."""
    return lumped(e, e * e * ZETA2)


@functools.cache
def lumped_viscous(e):
    """Two Kelvin-Voigt elements, with 15 digits."""
    return _of_each(lambda x: viscous_precision.rebound(x, BETA, ZETA2, e, 15))


def _of_each(solve):
    found = [solve(float(x)) for x in INCIDENCES]
    fields = ([float(getattr(answer, name)) for answer in found] for name in FIELDS)
    return Answer(*map(np.array, fields))


# Closed forms --------------------------------------------------------------------------------


def _law(velocity, peak=None):
    """All fields from the velocity: what is lost of the tangential energy x^2/(2 beta)."""
    return Answer(velocity, peak, (INCIDENCES**2 - velocity**2) / (2 * BETA))


def rigid(e):
    """Slides until the impulse x/beta, then sticks: friction is sin(arccos(1 - x/beta)) there."""
    angle = np.arccos(1 - np.minimum(INCIDENCES / BETA, 1))
    return _law(np.maximum(INCIDENCES - (1 + e) * BETA, 0), np.sin(angle))


def brach(e):
    """Two lines."""
    return _law(np.maximum(-BRACH * INCIDENCES, INCIDENCES - (1 + e) * BETA))


def smith(e):
    """Impulse (1 + e) (x |x| + w |w|)/(x^2 + w^2), solved for w by bisection.

    x less beta times the impulse for an assumed w is larger than that w for w = -x, and smaller for
    w = 0 unless the contact slides throughout.
    """
    x, change = INCIDENCES[1:], (1 + e) * BETA
    low, high = -x, np.zeros_like(x)
    for _ in range(60):
        middle = (low + high) / 2
        impulse = (x**2 + middle * np.abs(middle)) / (x**2 + middle**2)
        above = x - change * impulse > middle
        low, high = np.where(above, middle, low), np.where(above, high, middle)
    reversed_ = np.append(0.0, (low + high) / 2)
    return _law(np.where(change <= INCIDENCES, INCIDENCES - change, reversed_))


# Steps in time -------------------------------------------------------------------------------


def stepped(law, steps, e):
    """A contact law of a discrete-element code."""
    velocity, peak, _ = leapfrog.rebound(law, INCIDENCES, BETA, ZETA2, e, steps)
    return _law(velocity, peak)


if __name__ == "__main__":
    table_files.write(sys.argv[1], tables())
