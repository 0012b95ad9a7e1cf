"""Error against time: how long a model takes, and which one is chosen for a tolerance."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from planarimpact import continuum, lumped, spheres
from stronge1994 import tables
from stronge1994.pages import which_model
from stronge1994.studies.trade import curves as trade

STEPS = np.linspace(-0.01, 0.01, 11)  # of incidence
EVENLY, MAX = "max_velocity [mu v2(0)]", "max_velocity_with_kinks [mu v2(0)]"


def test_a_time_is_the_median_of_interleaved_rounds_beside_their_scatter():
    """All solvers are slowed down in the second round, by a program that uses the caches."""
    order = []

    def watch(name):
        seconds = iter([1.0, 1.5, 1.1])
        return lambda x: order.append(name) or next(seconds)

    found = trade.times([watch("a"), watch("b")], (0, 8), [1000], 10.0)
    assert "".join(order) == "ababab"
    assert found == [{"time_1000 [s]": 1.1e-3, "scatter_1000 [1]": pytest.approx(0.5 / 1.1)}] * 2


def test_calls_far_below_the_step_of_the_clock_are_timed(monkeypatch):
    worked = []  # a call takes 1e-4 s, and the clock goes on in steps of 1/64 s
    clock = SimpleNamespace(process_time=lambda: math.floor(len(worked) * 1e-4 * 64) / 64)
    monkeypatch.setattr(trade, "time", clock)
    (found,) = trade.times([trade.stopwatch(worked.append)], (0, 8), [1000], 10.0)
    assert found["time_1000 [s]"] == pytest.approx(1e-7, rel=max(found["scatter_1000 [1]"], 0.05))


def test_a_batch_that_would_take_too_long_is_left_out_for_its_model_alone():
    watches = [lambda x: 1e-2 * x.size, lambda x: 1e-4 * x.size]
    for budget, batches in ((4.0, [{1, 300}, {1, 300, 1000}]), (0.0, [{1}, {1}])):
        found = trade.times(watches, (0, 8), [1, 300, 1000], budget)
        for columns, timed in zip(found, batches, strict=True):
            words = [words for b in timed for words in (f"time_{b} [s]", f"scatter_{b} [1]")]
            assert set(columns) == set(words)


def test_the_largest_error_stands_in_the_table_if_it_is_beside_a_kink_too():
    """As that of the table of spheres is, where slip throughout begins."""
    inelastic = {"tolerance": 1e-3, "tolerances": []}
    table = trade.curves(3.5, 1.21, [0, 8], 81, [1.0], 2e-6, [], [], inelastic, [1], 1e-9)
    groups = {"mass_ratio": 3.5, "stiffness_ratio": 1.21, "restitution": 1.0}
    x = np.unique(np.add.outer(trade.at_kinks(groups, (0, 8)), STEPS))
    exact = continuum.rebound(x, 3.5, 1.21, tolerance=2e-6).velocity
    table = table.set_index("model")
    for name, model in {"spheres": spheres, "lumped": lumped}.items():
        gap = np.abs(model.rebound(x, 3.5, 1.21).velocity - exact).max()
        assert gap <= 1.1 * table[MAX][name]
    assert table[MAX]["spheres"] > 2 * table[EVENLY]["spheres"]


def row(model, error, e=1.0, loss="", build=None, times=(None, None), scatter=0.02, **settings):
    columns = {
        "input_spread [mu v2(0)]": 0.41,
        "input_spread_stick [mu v2(0)]": 0.02,
        MAX: error,
        "reference_error [mu v2(0)]": 1e-7,
        "scatter_10 [1]": scatter,
        "scatter_1000 [1]": scatter,
    }
    for name, value in zip(("build_time", "time_10", "time_1000"), (build, *times), strict=True):
        columns |= {} if value is None else {f"{name} [s]": value}
    columns = {name: [value] for name, value in columns.items()}
    return tables.curve(columns, model, **settings, e=e, loss=loss)


ROWS = tables.join(
    [
        row("rough", 0.2, times=(1e-5, 1e-6)),
        row("fine", 0.001, times=(1e-3, 1e-4), steps=8),
        row("spline", 1e-5, build=0.05, times=(1e-6, 1e-8)),
        row("slow", 9.5e-7, times=(1.0, None)),
        row("rough", 0.1, 0.5, "plastic", times=(1e-5, 1e-6)),
        row("continuum.viscous", 0.29, 0.5, "plastic", times=(1.0, 1.0)),
    ]
)


def models_of(rows, tolerances, batch):
    """Models by tolerance, and the rest of their rows."""
    found = which_model.answers(rows, tolerances)
    return found[found["batch"] == batch].reset_index(drop=True)


def test_which_model_is_the_cheapest_with_the_time_to_make_it():
    tolerances = [0.3, 0.01, 1e-6, 1e-9]
    alone, together = (models_of(ROWS, tolerances, batch) for batch in (10, 1000))
    assert alone["model"].tolist() == [
        *("rough", "fine, steps = 8", "none", "none"),
        *("rough", "none", "none", "none"),
    ]
    assert together["model"][:4].tolist() == ["rough", "spline", "none", "none"]
    assert float(together["whole_time [s]"][1]) == pytest.approx(5e-5, rel=0.01)
    assert alone[MAX][2] == alone["whole_time [s]"][2] == ""
    # 9.5e-7 against a reference that is known to 1e-7 does not show that 1e-6 is met.
    assert models_of(ROWS, [1.1e-6], 10)["model"][0] == "slow"


def test_the_report_joins_tolerances_that_have_the_same_answers():
    elastic, lossy = which_model.cases(which_model.answers(ROWS, [0.3, 0.25, 0.01]), ROWS)
    assert [(row["largest"], row["least"]) for row in elastic["rows"]] == [
        (0.3, 0.25),
        (0.01, 0.01),
    ]
    assert elastic["rows"][0]["answers"][0][:3] == [10, "rough", "0.2"]
    assert (elastic["other_loss"], lossy["other_loss"]) == ("", "0.29")
    assert (elastic["spread"], elastic["spread_stick"]) == ("0.41", "0.02")


@pytest.mark.parametrize(
    ("rivals", "chosen"),
    [
        # As fast as times of two runs agree: the nearer one.
        ({"timestep.linear": (0.232, 0.70), "lumped": (0.215, 0.76)}, "lumped"),
        # Faster by more than times scatter, and more: the faster one.
        ({"timestep.linear": (0.232, 0.70), "lumped": (0.215, 0.79)}, "timestep"),
        # The scatter of either counts.
        ({"timestep.linear": (0.232, 0.70, 0.4), "lumped": (0.215, 0.9)}, "lumped"),
        ({"timestep.linear": (0.232, 0.70), "lumped": (0.215, 0.9, 0.4)}, "lumped"),
        # Of those that meet the tolerance only.
        ({"rigid": (1.8, 0.05), "lumped": (0.215, 0.9)}, "lumped"),
    ],
)
def test_of_models_that_are_as_fast_the_nearer_is_named(rivals, chosen):
    rows = tables.join(
        row(name, error, times=(1e6, time), scatter=(*scatter, 0.02)[0])
        for name, (error, time, *scatter) in rivals.items()
    )
    found = models_of(rows, [0.3], 1000).iloc[0]
    assert found["model"].startswith(chosen)
    assert float(found["whole_time [s]"]) == rivals[found["model"]][1]


def test_the_time_to_make_a_spline_may_be_off_as_a_time_of_another_run_is():
    rows = tables.join(
        [
            row("spline of lumped", 0.215, build=1e-3, times=(1e-9, 1e-9)),
            row("spheres", 1e-5, times=(1.05e-4, 1.2e-6)),
        ]
    )
    found = [models_of(rows, [0.3], batch)["model"][0] for batch in (10, 1000)]
    assert found == ["spheres", "spline of lumped"]
