"""Error against time: known distances between models, the Pareto front, the choice of a model."""

import math
import re
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from planarimpact import InputError, continuum, models, response
from stronge1994 import csv_tables
from stronge1994.figures.convergence import curves as convergence
from stronge1994.figures.shared import drawing as drawings
from stronge1994.figures.shared.curves import watch
from stronge1994.figures.trade import answers as trade_table
from stronge1994.figures.trade import curves as trade
from stronge1994.figures.trade import drawing as draw_trade

REPORT = Path(__file__).parents[2] / "workflow/report"
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
        patch.setattr(trade, "SECONDS_OF_CALLS", 0.01)  # s; no number of these times is looked at
        return trade.curves(**SETTINGS)


@pytest.mark.parametrize(
    ("name", "rms"),
    [
        ("lumped, e = 1", 0.0806),
        ("timestep.mindlin, 64 steps, e = 1", 0.292),
        ("laws.brach, e = 1", 0.184),
        ("response of lumped, tolerance 1e-10, e = 1", 0.0806),
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
        ("response of continuum.plastic, tolerance 0.001, e = 0.8, plastic", 1e-3),
        ("continuum, tolerance 0.01, e = 1", 1e-2),
        ("response of continuum, tolerance 0.01, e = 1", 1e-2),
    ):
        assert 0 < named[name][RMS][0] <= named[name][MAX][0] < tolerance


def test_every_model_is_there_at_every_restitution_that_it_admits(named):
    for e, loss in ((1.0, ""), (0.8, "viscous"), (0.8, "plastic")):
        case = [r for r in named.values() if (r["restitution [1]"][0], r["loss"][0]) == (e, loss)]
        found = {row["model"][0] for row in case}
        admitted = {n for n, m in models.MODELS.items() if m.restitution[0] <= e}
        if e == 1:  # with a loss they are the same
            admitted = {n for n in admitted if not n.startswith(("lumped.", "continuum."))}
        assert {n for n in found if not n.startswith("response")} == admitted
    assert "annuli, 4 circles, 512 steps, e = 1" in named


def test_nothing_is_exact_by_definition(named):
    assert all(row[MAX][0] > 0 for row in named.values())


def test_a_model_is_timed_once_for_both_losses(named):
    for of in ("lumped.hysteretic", "response of continuum.plastic, tolerance 0.01"):
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


def test_laws_of_impulses_have_no_peak_friction_and_others_do(named):
    for row in named.values():
        silent = row["model"][0].startswith("laws.")
        assert any("peak_friction" in column for column in row) is not silent
        assert any("dissipation" in column for column in row)


def test_a_velocity_that_is_no_number_shows():
    exact = models.rebound("lumped", [1.0, 2.0])
    found = trade.errors(exact._replace(velocity=exact.velocity * float("nan")), exact)
    assert found[MAX] != found[MAX]  # NaN: the verdict `trade-solved` then diverges


def test_times_are_there_within_the_budget(named, monkeypatch):
    assert all(row["time_1 [s]"][0] > row["time_100 [s]"][0] > 0 for row in named.values())
    monkeypatch.setattr(trade, "input_spread", lambda x, *_: np.ones_like(x))
    none = trade.curves(**SETTINGS | {"restitution": [1.0], "budget": 0.0})
    assert not any("time_100 [s]" in row for row in none.values())
    assert all("time_1 [s]" in row for row in none.values())


def test_too_few_steps_for_the_bodies_are_refused():
    with pytest.raises(InputError, match="steps = 4"):
        trade.curves(**SETTINGS | {"restitution": [0.5], "steps": [4], "stiffness_ratio": 0.1})


def test_front_leaves_out_what_is_beaten():
    time = [1.0, 2.0, 2.0, 3.0, 4.0]
    error = [0.5, 0.5, 0.1, 0.2, 0.05]
    assert draw_trade.front(time, error) == [0, 2, 4]
    assert draw_trade.front([1.0], [0.0]) == [0]


class Clock:
    """Stands for `time`: wall time passes as told, and the process gets a share of it."""

    def __init__(self, tick=1e-9):
        self.wall = self.cpu = 0.0
        self.tick = tick

    def pass_by(self, seconds, share):
        self.wall += seconds
        self.cpu += share * seconds

    def perf_counter(self):
        return self.wall

    def process_time(self):
        return math.floor(self.cpu / self.tick) * self.tick


@pytest.fixture
def clock(monkeypatch):
    """Of a step to choose."""

    def set_up(tick=1e-9):
        found = Clock(tick)
        for module in (trade, watch):
            monkeypatch.setattr(module, "time", found)
        monkeypatch.setattr(watch, "_tick", lambda: tick)
        return found

    return set_up


@pytest.mark.parametrize(
    ("call", "share", "tick", "busy"),
    [
        (0.01, 1.0, 1e-9, None),
        (0.01, 0.9, 1e-9, None),
        (0.01, 0.8, 1e-9, 1.25),
        (0.01, 0.25, 1e-9, 4.0),
        (1e-5, 0.25, 1e-9, 4.0),
        (1e-4, 1.0, 0.01, None),  # far below the step of the CPU clock
        (0.015, 1.0, 0.01, None),  # shown as 0.01 or 0.02
        (3.0, 1.0, 0.01, None),
        (3.0, 0.5, 0.01, 2.0),
    ],
)
def test_a_time_taken_on_a_busy_machine_says_so(call, share, tick, busy, clock):
    fake = clock(tick)

    def solve(x):
        fake.pass_by(call, share)
        return call

    found = trade.times(solve, (0, 8), [1000], 10.0)
    assert found["time_1000 [s]"] == pytest.approx(call / 1000)
    assert found.get("busy_1000 [1]") == (busy and pytest.approx(busy, rel=0.01))


def test_short_calls_of_which_few_are_interrupted_are_timed_well_beside_any_load(clock):
    fake, calls = clock(), []

    def solve(x):
        calls.append(x.size)
        start = fake.wall
        fake.pass_by(1e-5, 1.0)
        if len(calls) % 5 == 0:
            fake.pass_by(0.004, 0.0)  # another program has its turn
        return fake.wall - start

    found = trade.times(solve, (0, 8), [1000], 10.0)
    assert found == {"time_1000 [s]": pytest.approx(1e-8)}


def test_a_busy_machine_leaves_no_batch_out(clock):
    """The second takes 30 s as the clock on the wall goes, and 3 s of the processor."""
    fake = clock()

    def solve(x):
        fake.pass_by(x.size / 100, 0.1)
        return x.size / 100

    assert set(trade.times(solve, (0, 8), [1000, 3000], 4.0)) == {
        *("time_1000 [s]", "busy_1000 [1]"),
        *("time_3000 [s]", "busy_3000 [1]"),
    }


def test_one_impact_is_solved_more_often_than_a_batch_which_holds_many_incidences(clock):
    fake, calls = clock(), []

    def solve(x):
        calls.append(x.size)
        fake.pass_by(0.01, 1.0)
        return 0.01

    trade.times(solve, (0, 8), [1, 1000], 10.0)
    assert 5 <= calls.count(1000) < calls.count(1) <= trade.MOST_CALLS


@pytest.mark.parametrize(("share", "busy"), [(1.0, None), (0.5, [2.0, 2.0])])
def test_convergence_says_that_the_machine_was_busy(share, busy, clock, monkeypatch):
    fake, fixed_steps = clock(), continuum.fixed_steps

    def slow(*args, **kwargs):
        fake.pass_by(0.24, share)
        return fixed_steps(*args, **kwargs)

    monkeypatch.setattr(continuum, "fixed_steps", slow)
    few = {"samples": 3, "tolerance": 1e-3, "steps": [16, 32], "circles": [4, 8]}
    named = convergence.curves(3.5, [1.21], **few, fixed={"steps": 16, "circles": 4})
    springs, annuli = named["row of springs"], named["annuli, circles"]
    assert springs["time [s]"] == pytest.approx([0.08, 0.08])
    assert springs.get("busy_time [1]") == (busy and pytest.approx(busy))
    assert "busy_time [1]" not in annuli


def test_a_slow_compilation_on_a_busy_machine_says_so(clock, monkeypatch):
    fake, compiled = clock(), response.compile

    def compile_(*args, **kwargs):
        fake.pass_by(3.0, 0.5)
        return compiled(*args, **kwargs)

    monkeypatch.setattr(trade.response, "compile", compile_)
    monkeypatch.setattr(trade, "input_spread", lambda x, *_: np.ones_like(x))
    settings = {"restitution": [1.0], "samples": 5, "steps": [16], "batches": [1]}
    rows = trade.curves(**SETTINGS | settings)
    slow = [
        name for name, columns in rows.items() if any(key.startswith("busy") for key in columns)
    ]
    assert [name.split(",")[0] for name in slow] == ["response of lumped", "response of continuum"]
    assert all(rows[name]["busy_build [1]"] == [pytest.approx(2.0)] for name in slow)


def test_the_step_of_the_cpu_clock_is_measured(monkeypatch):
    """It may state a finer one than it has."""
    reads = iter(range(1000))
    coarse = SimpleNamespace(process_time=lambda: 0.01 * (next(reads) // 100))
    monkeypatch.setattr(watch, "time", coarse)
    assert watch._tick.__wrapped__() == pytest.approx(0.01)


def row(name, error, case=("1.0", ""), reference="1e-7", build="", times=("", "")):
    return {
        "curve": name,
        "model": name.split(",")[0],
        "restitution [1]": case[0],
        "loss": case[1],
        "input_spread [mu v2(0)]": "0.41",
        "input_spread_stick [mu v2(0)]": "0.02",
        MAX: error,
        "reference_error [mu v2(0)]": reference,
        "build_time [s]": build,
        "time_10 [s]": times[0],
        "time_1000 [s]": times[1],
    }


ROWS = [
    row("rough, e = 1", "0.2", times=("1e-5", "1e-6")),
    row("fine, 8 steps, e = 1", "0.001", times=("1e-3", "1e-4")),
    row("compiled, e = 1", "1e-5", build="0.05", times=("1e-6", "1e-8")),
    row("slow, e = 1", "9.5e-7", times=("1.0", "")),
    row("rough, e = 0.5, plastic", "0.1", ("0.5", "plastic"), times=("1e-5", "1e-6")),
    row("continuum.viscous, e = 0.5, plastic", "0.29", ("0.5", "plastic"), times=("1", "1")),
]


def test_which_model_is_the_cheapest_with_its_compilation():
    tolerances = [0.3, 0.01, 1e-6, 1e-9]
    table = trade_table.which_model(ROWS, tolerances)
    assert [entry["model_10"] for entry in table] == [
        *("rough", "fine, 8 steps", "none", "none"),
        *("rough", "none", "none", "none"),
    ]
    assert [entry["other_loss [mu v2(0)]"] for entry in table[3:5]] == ["", "0.29"]
    assert table[0]["input_spread [mu v2(0)]"] == "0.41"
    assert [entry["model_1000"] for entry in table[:4]] == ["rough", "compiled", "none", "none"]
    assert float(table[1]["whole_time_1000 [s]"]) == pytest.approx(5e-5, rel=0.01)
    assert table[2]["max_velocity_10 [mu v2(0)]"] == table[2]["whole_time_10 [s]"] == ""


def test_error_of_the_reference_counts():
    """9.5e-7 against a reference that is known to 1e-7 does not show that 1e-6 is met."""
    assert trade_table.which_model(ROWS, [1e-6])[0]["model_10"] == "none"
    assert trade_table.which_model(ROWS, [1.1e-6])[0]["model_10"] == "slow"


@pytest.mark.parametrize(
    ("busy", "small", "large"),
    [
        # Nearly all of its time is compilation, and that is right.
        ({"compiled": {"busy_1000 [1]": "2"}}, "fine, 8 steps", "compiled"),
        # Too long, and still shorter than all others.
        ({"compiled": {"busy_build [1]": "2"}}, "fine, 8 steps", "compiled"),
        ({"fine": {"busy_10 [1]": "3"}}, "fine, 8 steps", "compiled"),
        ({"compiled": {"busy_build [1]": "50"}}, trade_table.BUSY, "compiled"),
        # On a quiet machine it would still be slower than the other.
        ({"fine": {"busy_1000 [1]": "1.9"}}, "fine, 8 steps", "compiled"),
        ({"fine": {"busy_1000 [1]": "10"}}, "fine, 8 steps", trade_table.BUSY),
    ],
)
def test_a_time_taken_on_a_busy_machine_is_not_chosen(busy, small, large):
    rows = [
        dict.fromkeys(("busy_10 [1]", "busy_1000 [1]", "busy_build [1]"), "")
        | row
        | busy.get(row["curve"].split(",")[0], {})
        for row in ROWS
    ]
    (found,) = trade_table.which_model(rows, [0.01])[:1]
    assert (found["model_10"], found["model_1000"]) == (small, large)
    for batch in (10, 1000):
        name = found[f"model_{batch}"]
        own = [row for row in rows if row["curve"].startswith(name)]
        times = {f"{trade_table.whole_time(row, batch):.2g}" for row in own}
        times |= {f"{trade_table._least_time(row, batch):.2g}" for row in own}
        assert bool(found[f"whole_time_{batch} [s]"]) is (len(times) == 1)
        assert bool(found[f"max_velocity_{batch} [mu v2(0)]"]) is (name != trade_table.BUSY)


def test_table_figure_and_captions_say_that_the_machine_was_busy(named, tmp_path):
    quiet = {
        name: {key: value for key, value in columns.items() if not key.startswith("busy")}
        for name, columns in named.items()
    }
    busy = {name: columns | {"busy_100 [1]": [2.5]} for name, columns in quiet.items()}
    for curves, said in ((quiet, False), (quiet | dict(list(busy.items())[:2]), True)):
        path, *tables = (tmp_path / f"{name}.csv" for name in ("curves", "table", "answers"))
        csv_tables.write(path, curves)
        figure, _ = drawings.drawn(draw_trade, csv_tables.read(path), SETTINGS, {})
        words = r"\nthe machine was busy: 2 of \d+ times are up to 2.5 times too long$"
        assert bool(re.search(words, figure.get_suptitle())) is said
        trade_table.write(path, *tables)
        assert ("busy_100 [1]" in csv_tables.read_rows(tables[0])[0]) is said
    assert f"more than {trade.BUSY}" in (REPORT / "trade.rst").read_text()
    assert trade_table.BUSY in (REPORT / "which_model.rst").read_text()


def test_tables_are_written_and_keep_their_words(named, tmp_path):
    curves, table, answers = (tmp_path / f"{name}.csv" for name in ("curves", "table", "answers"))
    csv_tables.write(curves, named)
    trade_table.write(curves, table, answers)
    written = csv_tables.read_rows(table)
    assert list(written[0])[0] == "name" and {r["name"] for r in written} == set(named)
    assert written[0]["restitution [1]"] == "1.0" and "rigid" in written[0]["name"]
    header = list(csv_tables.read_rows(answers)[0])
    assert all("[" in column for column in header if not column.startswith(("model", "loss")))


def test_a_crash_of_the_solver_leaves_tables_that_say_so(tmp_path):
    curves, table, answers = (tmp_path / f"{name}.csv" for name in ("curves", "table", "answers"))
    csv_tables.write_rows(curves, ["error"], [["ArithmeticError: oh"]])
    trade_table.write(curves, table, answers)
    assert table.read_text() == answers.read_text() == "error\nArithmeticError: oh\n"
