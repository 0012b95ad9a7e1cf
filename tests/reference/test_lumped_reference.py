"""The lumped model against independent answers: tables of 40 digits, and small steps.

The tables hold every threshold, switches of course and the ends of the parameters; a sample of
their rows is computed again. They come with the package's own archive.
"""

import csv
from itertools import product
from pathlib import Path

import numpy as np
import pytest

from planarimpact import Regime, lumped
from tests.reference_solutions import (
    extreme_tables,
    high_precision,
    table_files,
    viscous_precision,
    viscous_tables,
)

DATA = Path(__file__).parents[2] / "data"
TABLES = {"hysteretic": "lumped_extremes", "viscous": "lumped_viscous"}
HEADERS = {"hysteretic": extreme_tables.HEADER, "viscous": viscous_tables.HEADER}
OUTPUTS = ("velocity", "peak_friction", "dissipation")
ULP = 2.0**-52
LONG = [pytest.param(part, marks=pytest.mark.long) for part in range(1, 20)]


def rows(loss):
    with open(DATA / TABLES[loss] / "impacts.csv", newline="", encoding="utf-8") as file:
        header, *found = csv.reader(file)
    assert header == HEADERS[loss]
    return found


@pytest.fixture(scope="module")
def tables():
    return {loss: np.array(rows(loss), float).T for loss in TABLES}


def answers(table, loss):
    return lumped.rebound(*table[:4], loss=loss)


def test_every_impact_at_every_size_has_all_its_digits(tables):
    """At most a hundred times what rounding of the arguments does: their condition."""
    table = tables["hysteretic"]
    found = answers(table, "hysteretic")
    for name, exact, condition in zip(OUTPUTS, table[4:7], table[7:10], strict=True):
        error = np.abs(getattr(found, name) - exact)
        assert (error <= 100 * ULP * (np.abs(exact) + condition)).all(), name


def test_every_viscous_impact_has_12_digits_and_its_energy(tables):
    table = tables["viscous"]
    x, beta, *_ = table
    found = answers(table, "viscous")
    scales = viscous_tables.scales(*table[:4])
    for name, exact, scale in zip(OUTPUTS, table[4:7], scales, strict=True):
        error = np.abs(getattr(found, name) - exact) / scale
        assert error.max() <= viscous_tables.PROMISED, (name, table[:4, error.argmax()])
    lost = (x - found.velocity) * (x + found.velocity) / (2 * beta)
    dashpot, strain = table[7:9]
    assert np.abs(lost - found.dissipation - dashpot - strain).max() <= viscous_tables.PROMISED


@pytest.mark.parametrize("part", [0, *LONG])
def test_rows_are_what_the_references_compute(part):
    """In the order of their phases, so that a part has some of each kind."""
    cheap = sorted((row for row in rows("hysteretic") if int(row[-1]) < 30), key=lambda r: r[-1])
    for row in cheap[9 * part :: 180]:
        assert extreme_tables.row(tuple(map(float, row[:4]))) == row
    for row in rows("viscous")[5 * part :: 100]:
        point = tuple(map(float, row[:4]))
        again = table_files.Table([], [lambda point=point: viscous_tables.row(point)])
        for one, other in zip(again.cells(0), row, strict=True):
            # Where the answer is 0 the reference has a rounding that depends on what ran before.
            assert one == other or max(abs(float(one)), abs(float(other))) < 1e-60


def test_no_condition_is_inflated(tables):
    """A condition too large would let wrong digits pass; these bounds are what the model has."""
    x, beta, zeta2, e, *_, velocity, peak, dissipation, _ = tables["hysteretic"]
    work = np.minimum(x, 2 * (1 + e) * beta) * (x / (2 * beta))  # the most that friction can do
    assert (velocity <= 5 * np.maximum(x, beta)).all()
    assert (peak <= 2).all()
    assert (dissipation <= 7 * (1 + np.sqrt(beta / zeta2)) * work).all()
    assert (np.minimum(np.minimum(velocity, peak), dissipation) >= 0).all()


ORDERS = {
    ("stick",): Regime.STICK,
    ("slip", "stick"): Regime.SLIP_STICK,
    ("stick", "slip"): Regime.STICK_SLIP,
    ("slip", "stick", "slip"): Regime.SLIP_STICK_SLIP,
    ("slip",): Regime.SLIP_THROUGHOUT,
}
# At limits of regimes, and between: zeta^2, beta, and slip throughout at e = 1.
INCIDENCES = (0.0, 0.025, 0.8, 24 * 0.05, 1.225, 3.0, 3.5, 4.0, 5.775, 116 * 0.05, 8.0)


def test_regimes_are_the_order_of_stick_and_slip_in_the_reference():
    for e, zeta2, x in product((0.0, 0.01, 0.15, 0.5, 0.59, 0.9, 1.0), (1.21, 3.0), INCIDENCES):
        events = high_precision.rebound(x, 3.5, zeta2, e).events
        phases = tuple(event.kind for event in events if event.kind in ("stick", "slip"))
        wanted = ORDERS.get(phases, Regime.MULTIPLE) if x else Regime.STICK
        assert lumped.rebound(x, 3.5, zeta2, e).regime == wanted, (x, zeta2, e)


CONTACTS = {
    # With little restitution the last slip runs in the incident direction.
    "hysteretic": [(1.0, 3.5, 1.21, 0.01), (2.5, 3.5, 1.21, 0.5), (2.0, 8.0, 0.05, 1.0)],
    "viscous": [(1.0, 3.5, 1.21, 0.5), (2.5, 3.5, 0.2, 0.9), (5.0, 8.0, 2.0, 0.05)],
}


KINDS = {"compression ends": "maximum compression"}


@pytest.mark.parametrize("loss", CONTACTS)
@pytest.mark.parametrize("which", range(3))
def test_a_history_has_the_events_of_the_reference(loss, which):
    case = CONTACTS[loss][which]
    precision = high_precision if loss == "hysteretic" else viscous_precision
    answer = precision.rebound(*case)
    # The unit of time is half of the contact there.
    unit = answer.duration / 2 if loss == "viscous" else 1
    exact = [event._replace(kind=KINDS.get(event.kind, event.kind)) for event in answer.events]
    known = {event.kind for event in exact}  # with viscosity no contact and no compression
    found = [event for event in lumped.history(*case, loss=loss).events if event.kind in known]
    assert [str(event.kind) for event in found] == [event.kind for event in exact]
    for one, other in zip(exact, found, strict=True):
        assert abs(float(one.time / unit) - other.time) < 1e-11
        for field in set(one._fields) - {"kind", "time"}:
            assert abs(float(getattr(one, field)) - getattr(other, field)) < 1e-11
