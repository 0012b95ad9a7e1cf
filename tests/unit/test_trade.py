"""Error against time: known distances between models, the choice of a model."""

import math
import time

import numpy as np
import pytest

from planarimpact import InputError, models
from stronge1994 import csv_tables
from stronge1994.figures.trade import answers as trade_table
from stronge1994.figures.trade import curves as trade

RMS, MAX = "rms_velocity [mu v2(0)]", "max_velocity [mu v2(0)]"
SETTINGS = {
    "mass_ratio": 3.5,
    "stiffness_ratio": 1.21,
    "incidence": [0.0, 8.0],
    "samples": 81,
    "restitution": [1.0, 0.8],
    "tolerance": 1e-4,
    "steps": [16, 64],
    "circles": [4],
    "tolerances": [1e-2],
    "inelastic": {"tolerance": 3e-4, "tolerances": [1e-3, 1e-2]},
    "batches": [1, 100],
    "budget": 10.0,
}


@pytest.fixture(scope="module")
def named():
    with pytest.MonkeyPatch.context() as patch:
        # No number of these times is looked at.
        patch.setattr(trade, "ROUND_SECONDS", 1e-3)
        patch.setattr(trade, "ROUNDS", 1)
        return trade.curves(**SETTINGS)


@pytest.mark.parametrize(
    ("name", "rms"),
    [
        ("lumped, e = 1", 0.0806),
        ("timestep.mindlin, 64 steps, e = 1", 0.292),
        ("laws.brach, e = 1", 0.184),
        ("lumped.hysteretic, e = 0.8, viscous", 0.40),
        ("lumped.viscous, e = 0.8, viscous", 0.087),
        ("continuum.plastic, tolerance 0.01, e = 0.8, viscous", 0.141),
        ("continuum.viscous, tolerance 0.01, e = 0.8, plastic", 0.141),
    ],
)
def test_errors_are_the_known_distances(named, name, rms):
    """Numbers of the continuum without this module: tests of the models, and by hand."""
    assert named[name][RMS][0] == pytest.approx(rms, rel=0.005)


def test_exact_models_are_as_near_as_they_promise(named):
    for name, tolerance in (
        ("continuum.viscous, tolerance 0.001, e = 0.8, viscous", 1e-3),
        ("continuum.plastic, tolerance 0.001, e = 0.8, plastic", 1e-3),
        ("continuum, tolerance 0.01, e = 1", 1e-2),
        ("spline of continuum, 2000 knots, e = 1", 1e-4 + 1e-5),
    ):
        assert 0 < named[name][RMS][0] <= named[name][MAX][0] < tolerance


def test_every_model_is_there_at_every_restitution_that_it_admits(named):
    for e, loss in ((1.0, ""), (0.8, "viscous"), (0.8, "plastic")):
        case = [r for r in named.values() if (r["restitution [1]"][0], r["loss"][0]) == (e, loss)]
        found = {row["model"][0] for row in case}
        admitted = {n for n, m in models.MODELS.items() if m.restitution[0] <= e}
        if e == 1:  # with a loss they are the same, and have its name no more
            lossy = ("lumped.", "continuum.", "spheres.")
            admitted = {n for n in admitted if not n.startswith(lossy)} | {"spheres"}
        assert found - {"spline of continuum"} == admitted
    assert "annuli, 4 circles, 512 steps, e = 1" in named


def test_nothing_is_exact_by_definition(named):
    assert all(row[MAX][0] > 0 for row in named.values())


def test_a_model_is_timed_once_for_both_losses(named):
    for of in ("lumped.hysteretic", "continuum.plastic, tolerance 0.01"):
        viscous, plastic = (named[f"{of}, e = 0.8, {loss}"] for loss in ("viscous", "plastic"))
        assert viscous["time_1 [s]"] == plastic["time_1 [s]"] and viscous[MAX] != plastic[MAX]


def test_what_uncertain_inputs_hide_is_not_seen(named):
    """By hand in slip throughout, w = x - (1 + e) beta: 10 % of 6.3 and 0.02 times 3.5."""
    groups = {"mass_ratio": 3.5, "stiffness_ratio": 1.21, "restitution": 0.8}
    (spread,) = trade.input_spread(np.array([30.0]), groups, "plastic")
    assert spread == pytest.approx(math.hypot(0.1 * 1.8 * 3.5, 0.02 * 3.5), rel=0.01)
    seen = {name: row["seen [1]"][0] for name, row in named.items()}
    assert seen["continuum.plastic, tolerance 0.001, e = 0.8, plastic"] == 0
    assert seen["rigid, e = 0.8, plastic"] > seen["lumped.hysteretic, e = 0.8, plastic"] > 0.4


def test_laws_of_impulses_have_no_peak_friction_and_a_spline_the_velocity_alone(named):
    for row in named.values():
        silent = row["model"][0].startswith(("laws.", "spline"))
        assert any("peak_friction" in column for column in row) is not silent
        has_work = not row["model"][0].startswith("spline")
        assert any("dissipation" in column for column in row) is has_work


def test_a_velocity_that_is_no_number_shows():
    exact = models.rebound("lumped", [1.0, 2.0])
    found = trade.errors(exact._replace(velocity=exact.velocity * float("nan")), exact)
    assert found[MAX] != found[MAX]  # NaN: the verdict `trade-solved` is then wrong


def test_times_are_there_within_the_budget(named, monkeypatch):
    assert all(row["time_1 [s]"][0] > row["time_100 [s]"][0] > 0 for row in named.values())
    monkeypatch.setattr(trade, "input_spread", lambda x, *_: np.ones_like(x))
    none = trade.curves(**SETTINGS | {"restitution": [1.0], "budget": 0.0})
    assert not any("time_100 [s]" in row for row in none.values())
    assert all("time_1 [s]" in row for row in none.values())


def test_too_few_steps_for_the_bodies_are_refused():
    with pytest.raises(InputError, match="steps = 4"):
        trade.curves(**SETTINGS | {"restitution": [0.5], "steps": [4], "stiffness_ratio": 0.1})


class Clock:
    """Stands for `time`: the seconds that the processor worked, which it shows in steps."""

    def __init__(self, tick=1e-9):
        self.worked, self.tick = 0.0, tick

    def process_time(self):
        return math.floor(self.worked / self.tick) * self.tick


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
    clock = Clock(tick=1 / 64)
    monkeypatch.setattr(trade, "time", clock)

    def rebound(x):
        clock.worked += 1e-4

    (found,) = trade.times([trade.stopwatch(rebound)], (0, 8), [1000], 10.0)
    assert found["time_1000 [s]"] == pytest.approx(1e-7, rel=max(found["scatter_1000 [1]"], 0.05))


def test_waiting_is_not_measured(monkeypatch):
    monkeypatch.setattr(trade, "ROUND_SECONDS", 1e-5)
    (found,) = trade.times([trade.stopwatch(lambda x: time.sleep(0.05))], (0, 8), [1], 1.0)
    assert found["time_1 [s]"] < 0.01


def test_one_impact_is_solved_at_several_incidences_the_same_in_each_round():
    calls = []

    def seconds(x):
        calls.append(x)
        return 1.0

    trade.times([seconds], (0, 8), [1], 10.0)
    assert len(calls) == trade.ROUNDS * trade.ROUND_IMPACTS
    assert len({float(x[0]) for x in calls}) == trade.ROUND_IMPACTS


def test_a_batch_that_would_take_too_long_is_left_out_for_its_model_alone():
    slow, fast = trade.times(
        [lambda x: 1e-2 * x.size, lambda x: 1e-6 * x.size], (0, 8), [1, 300, 1000], 4.0
    )
    assert set(slow) == {f"{key}_{b} {unit}" for key, unit in KEYS for b in (1, 300)}
    assert set(fast) == {f"{key}_{b} {unit}" for key, unit in KEYS for b in (1, 300, 1000)}


KEYS = ("time", "[s]"), ("scatter", "[1]")


def row(name, error, case=("1.0", ""), build="", times=("", ""), scatter="0.02"):
    return {
        "curve": name,
        "model": name.split(",")[0],
        "restitution [1]": case[0],
        "loss": case[1],
        "input_spread [mu v2(0)]": "0.41",
        "input_spread_stick [mu v2(0)]": "0.02",
        MAX: error,
        "reference_error [mu v2(0)]": "1e-7",
        "build_time [s]": build,
        "time_10 [s]": times[0],
        "time_1000 [s]": times[1],
        "scatter_10 [1]": scatter,
        "scatter_1000 [1]": scatter,
    }


ROWS = [
    row("rough, e = 1", "0.2", times=("1e-5", "1e-6")),
    row("fine, 8 steps, e = 1", "0.001", times=("1e-3", "1e-4")),
    row("spline, e = 1", "1e-5", build="0.05", times=("1e-6", "1e-8")),
    row("slow, e = 1", "9.5e-7", times=("1.0", "")),
    row("rough, e = 0.5, plastic", "0.1", ("0.5", "plastic"), times=("1e-5", "1e-6")),
    row("continuum.viscous, e = 0.5, plastic", "0.29", ("0.5", "plastic"), times=("1", "1")),
]


def test_which_model_is_the_cheapest_with_the_time_to_make_it():
    tolerances = [0.3, 0.01, 1e-6, 1e-9]
    table = trade_table.which_model(ROWS, tolerances)
    assert [entry["model_10"] for entry in table] == [
        *("rough", "fine, 8 steps", "none", "none"),
        *("rough", "none", "none", "none"),
    ]
    assert [entry["other_loss [mu v2(0)]"] for entry in table[3:5]] == ["", "0.29"]
    assert table[0]["input_spread [mu v2(0)]"] == "0.41"
    assert [entry["model_1000"] for entry in table[:4]] == ["rough", "spline", "none", "none"]
    assert float(table[1]["whole_time_1000 [s]"]) == pytest.approx(5e-5, rel=0.01)
    assert table[2]["max_velocity_10 [mu v2(0)]"] == table[2]["whole_time_10 [s]"] == ""


def test_error_of_the_reference_counts():
    """9.5e-7 against a reference that is known to 1e-7 does not show that 1e-6 is met."""
    assert trade_table.which_model(ROWS, [1e-6])[0]["model_10"] == "none"
    assert trade_table.which_model(ROWS, [1.1e-6])[0]["model_10"] == "slow"


@pytest.mark.parametrize(
    ("rivals", "chosen"),
    [
        # As fast as times of two runs agree: the nearer one.
        ({"timestep.linear, 16 steps": (0.232, 0.70), "lumped": (0.215, 0.76)}, "lumped"),
        ({"lumped": (0.215, 0.70), "timestep.linear, 16 steps": (0.232, 0.76)}, "lumped"),
        ({"spheres": (1e-5, 0.76), "lumped": (0.215, 0.70)}, "spheres"),
        # Faster by more than times scatter, and more: the faster one.
        ({"timestep.linear, 16 steps": (0.232, 0.70), "lumped": (0.215, 0.79)}, "timestep"),
        ({"laws.brach": (0.29, 0.1), "continuum": (1e-6, 100.0)}, "laws.brach"),
        # The scatter of either counts.
        ({"timestep.linear": (0.232, 0.70, 0.4), "lumped": (0.215, 0.9)}, "lumped"),
        ({"timestep.linear": (0.232, 0.70), "lumped": (0.215, 0.9, 0.4)}, "lumped"),
        # Of those that meet the tolerance only.
        ({"rigid": (1.8, 0.05), "lumped": (0.215, 0.9)}, "lumped"),
    ],
)
def test_of_models_that_are_as_fast_the_nearer_is_named(rivals, chosen):
    for batch, build in ((1000, ""), (10, "7e-12")):
        rows = []
        for name, (error, time_of, *scatter) in rivals.items():
            times = ("1e6", time_of * 1e-6) if batch == 1000 else (time_of * 1e-6, "1e6")
            more = {"scatter": f"{scatter[0]}"} if scatter else {}
            rows.append(row(f"{name}, e = 1", f"{error}", build=build, times=times, **more))
        (found,) = trade_table.which_model(rows, [0.3])
        assert found[f"model_{batch}"].startswith(chosen)
        times_of = {name: f"{values[1] * 1e-6:.2g}" for name, values in rivals.items()}
        assert found[f"whole_time_{batch} [s]"] == times_of[found[f"model_{batch}"]]


def test_the_time_to_make_a_spline_may_be_off_as_a_time_of_another_run_is():
    rows = [
        row("spline of lumped, e = 1", "0.215", build="1e-3", times=("1e-9", "1e-9")),
        row("spheres, e = 1", "1e-5", times=("1.05e-4", "1.2e-6")),
    ]
    (found,) = trade_table.which_model(rows, [0.3])
    assert (found["model_10"], found["model_1000"]) == ("spheres", "spline of lumped")


def test_tables_are_written_and_keep_their_words(named, tmp_path):
    curves, table, answers = (tmp_path / f"{name}.csv" for name in ("curves", "table", "answers"))
    csv_tables.write(curves, named)
    trade_table.write(curves, table, answers)
    written = csv_tables.read_rows(table)
    assert list(written[0])[0] == "name" and {r["name"] for r in written} == set(named)
    assert written[0]["restitution [1]"] == "1.0" and "rigid" in written[0]["name"]
    header = list(csv_tables.read_rows(answers)[0])
    assert all("[" in column for column in header if not column.startswith(("model", "loss")))
