"""Scenes below e = 1: what takes the energy, what the other loss would change, and in what words.

Also `planarimpact models --restitution`, which measures every model against the same continua.
"""

import csv
import functools
import io
import sys

import numpy as np
import pandas as pd
import pytest

from planarimpact import InputError, bodies, continuum, lumped, models, scene, spheres
from planarimpact.__main__ import main
from planarimpact.collision import model_form
from planarimpact.ground import sliding

FORM = "model_form [m/s]"
AFTER = "velocity_tangential_after [m/s]"
PAIR = {
    "radius [m]": 0.01,
    "density [kg/m^3]": 7800.0,
    "young_modulus [Pa]": 207e9,
    "poisson_ratio": 0.3,
    "friction": 0.2,
}
GROUPS = 3.5, bodies.stiffness_ratio(bodies.Material(207e9, 0.3))
# Incidences for a normal velocity of 1 m/s: head-on, three that stick, one that slides throughout.
STICKING = 1, 2, 3
INCIDENCES = np.array([0.0, 0.5, 2.0, 3.0, 10.0])
UNIT = 0.2  # mu v2(0) [m/s]


def table(incidence=INCIDENCES, **more):
    state = {
        "velocity_tangential [m/s]": UNIT * np.asarray(incidence, dtype=float),
        "velocity_normal [m/s]": 1.0,
        "spin [rad/s]": 0.0,
    }
    return pd.DataFrame(state).assign(**PAIR, **more)


@pytest.fixture
def no_table(monkeypatch):
    """Solve all impacts that stick."""
    monkeypatch.setattr(spheres, "covers", lambda beta, *_: np.zeros(beta.shape, dtype=bool))


def contact_velocity(after):
    """Velocity at separation, mu v2(0)."""
    return ((after[AFTER] + 0.01 * after["spin_after [rad/s]"]) / UNIT).to_numpy()


@pytest.mark.parametrize("loss", continuum.LOSSES)
def test_the_loss_is_an_option_or_a_column(loss):
    option = scene.solve(table(restitution=0.6), loss=loss)
    column = scene.solve(table(restitution=0.6, loss=loss))
    pd.testing.assert_frame_equal(
        option, column[option.columns], check_dtype=False, check_categorical=False
    )
    found = continuum.rebound(INCIDENCES, *GROUPS, 0.6, loss=loss, tolerance=1e-4)
    atol = max(spheres.ERROR_BOUND.values()) + 1e-4
    np.testing.assert_allclose(contact_velocity(option), found.velocity, rtol=0, atol=atol)
    continuous = f"continuum.{loss}"
    assert option["model"].tolist() == ["head-on", *[continuous] * 3, "slip throughout"]


MATERIALS = [
    ("relaxation_time [s]", 2e-6, "viscous", bodies.viscous_restitution),
    ("yield_pressure [Pa]", 3e9, "plastic", bodies.plastic_restitution),
]


@pytest.mark.parametrize(("header", "value", "loss", "law"), MATERIALS)
def test_a_material_says_restitution_at_the_speed_of_each_impact_and_loss(header, value, loss, law):
    speed = np.array([0.7, 0.8, 1.0, 2.0, 5.0])
    moves = {"velocity_normal [m/s]": speed}
    after = scene.solve(table(**{header: value}).assign(**moves))
    mass = bodies.solid_sphere(0.01, 7800.0).mass
    modulus = bodies.effective_modulus(bodies.Material(207e9, 0.3))
    e = law(speed, value, mass, modulus, 0.01)
    assert (np.diff(e) < 0).all() and 0.3 < e[-1] < 0.95
    np.testing.assert_allclose(after["restitution"], e, rtol=1e-12)
    assert set(after["loss"]) == {loss}
    by_hand = scene.solve(table(restitution=e, loss=loss).assign(**moves))
    for name in by_hand.columns.difference(["restitution", "loss", "regime", "model"]):
        np.testing.assert_allclose(after[name], by_hand[name], rtol=1e-6, err_msg=name)


@pytest.mark.parametrize(
    ("more", "name"),
    [
        ({"restitution": 0.6, "loss": "plastic"}, "loss"),
        ({"relaxation_time [s]": 2e-6}, r"relaxation_time \[s\]"),
        ({"yield_pressure [Pa]": 3e9}, r"yield_pressure \[Pa\]"),
    ],
)
def test_a_loss_is_given_once(more, name):
    words = (
        f"loss = 'plastic': it does not apply, as the column '{name}' says what takes the energy"
    )
    with pytest.raises(InputError, match=words):
        scene.solve(table(**more), loss="plastic")


@pytest.mark.parametrize("loss", ["hysteretic", "Viscous", "", 1, ["viscous"]])
def test_a_wrong_loss_is_refused(loss):
    with pytest.raises(InputError, match="loss = .*: allowed are viscous, plastic"):
        scene.solve(table(restitution=0.6), loss=loss)


def test_columns_say_what_the_table_does_not():
    """Restitution and loss are there once: as they were given, or before the model."""
    plain = scene.solve(table(restitution=[0.6, 0.6, 1.0, 0.6, 0.6]), loss="viscous")
    assert plain.columns.get_loc("loss") < plain.columns.get_loc("model")
    assert plain["loss"].tolist()[:2] == ["viscous"] * 2 and plain["loss"].isna()[2]
    own = scene.solve(table(restitution=0.6, loss=" plastic "))
    assert own["loss"].tolist() == [" plastic "] * 5
    for found in (plain, own):
        assert list(found.columns).count("loss") == list(found.columns).count("restitution") == 1
        assert found.columns.get_loc(FORM) == found.columns.get_loc("error_bound [m/s]") + 1


@pytest.mark.parametrize("loss", continuum.LOSSES)
def test_elastic_rows_do_not_know_the_loss(loss):
    rows = table(restitution=1.0)
    plain = scene.Solver()
    wanted = plain.solve(rows)
    pd.testing.assert_frame_equal(scene.solve(rows, loss=loss), wanted)
    own = scene.solve(rows.assign(loss=loss))
    without = own.drop(columns="loss"), wanted.drop(columns="loss")
    pd.testing.assert_frame_equal(*without)
    mixed = pd.concat([rows, rows.assign(restitution=0.6)], ignore_index=True)
    pd.testing.assert_frame_equal(scene.solve(mixed, loss=loss).iloc[:5], wanted)
    assert (wanted[FORM] == 0).all()
    assert "loss" not in plain.explain()


# Model form.


def distance(incidence, e, mass_ratio=GROUPS[0], zeta2=GROUPS[1], tolerance=1e-4):
    """Distance of the two continua in velocity, mu v2(0)."""
    groups = incidence, mass_ratio, zeta2, e
    velocities = [
        continuum.rebound(*groups, loss=loss, tolerance=tolerance).velocity
        for loss in continuum.LOSSES
    ]
    return np.abs(velocities[1] - velocities[0])


@functools.cache
def distances(e):
    """Incidences of all regimes, and the distance at each."""
    x = np.linspace(0.0, 1.1 * float(sliding.limit_alike(*map(np.asarray, GROUPS), e)), 64)
    return x, distance(x, e)


@pytest.mark.parametrize("loss", continuum.LOSSES)
@pytest.mark.parametrize("e", [pytest.param(0.95, marks=pytest.mark.long), 0.8, 0.4])
def test_model_form_is_the_distance_of_the_two_continua(e, loss, no_table):
    """To 0.01 mu v2(0), and 0.001 for the tolerance of the answer itself."""
    x, wanted = distances(e)
    assert wanted.max() > 0.02  # there is something to see
    form = scene.solve(table(x[::4], restitution=e), loss=loss)[FORM] / UNIT
    assert np.abs(form - wanted[::4]).max() <= 0.011


@pytest.mark.parametrize("loss", continuum.LOSSES)
def test_model_form_of_a_solved_impact_is_by_the_table_where_it_can_be(loss):
    x, wanted = distances(0.4)
    found = scene.Solver(1e-4, loss)
    form = found.solve(table(x[::4], restitution=0.4))[FORM] / UNIT
    # Below x = 1 the table is nearer, and answers some of them.
    assert f"continuum.{loss}, solved" in found.explain()
    errors = max(spheres.ERROR_BOUND.values()) + 2e-4
    sticks = form != 0
    assert np.abs(form - wanted[::4])[sticks].max() <= errors


@pytest.mark.parametrize("e", [0.95, 0.8, 0.4])
def test_model_form_by_the_table(e):
    """It is wrong by two errors of the table at most."""
    x, wanted = distances(e)
    form = scene.solve(table(x, restitution=e), loss="viscous")[FORM] / UNIT
    assert np.abs(form - wanted).max() <= 2 * (max(spheres.ERROR_BOUND.values()) + 1e-4)


def test_where_both_losses_agree_there_is_no_model_form():
    """Sliding throughout, head-on, and without friction."""
    x = np.array([0.0, 10.0])
    for more in ({}, {"friction": 0.0}):
        after = scene.solve(table(x, restitution=0.5).assign(**more), loss="viscous")
        assert (after[FORM] == 0).all()


def test_model_form_without_an_answer_of_the_other_loss():
    """Plastic spheres of m2/m1 = 10^4 have none: they swing too often during the impact."""
    ratio, x = np.array([33.0, 1e4]), np.array([5.0, 9969.0])
    groups = {"mass [kg]": 0.03, "gyration [m]": 0.01 / (ratio - 1) ** 0.5, "poisson_ratio": 0.0}
    rows = table(x, restitution=0.1).drop(columns="density [kg/m^3]").assign(**groups)
    with pytest.raises(continuum.Unsolved):
        continuum.rebound(x[1], 1e4, 1.0, 0.1, loss="plastic", tolerance=model_form.TOLERANCE)
    found = scene.Solver(0.1, "viscous")
    after = found.solve(rows)
    assert after[FORM].isna().tolist() == [False, True]
    assert np.isfinite(after[AFTER]).all()
    assert found.explain().endswith("at most: 2 impacts, not known for 1")
    wanted = distance(x[0], 0.1, 33.0, 1.0, tolerance=0.01)
    assert after[FORM][0] / UNIT == pytest.approx(wanted, abs=0.1 + 2 * 0.01)


@pytest.mark.parametrize("count", [1, 3])
def test_all_of_it_may_be_unknown(count, monkeypatch, no_table):
    monkeypatch.setattr(model_form, "TOLERANCE", 1e-12)
    found = scene.Solver(loss="viscous")
    after = found.solve(table([2.0] * count, restitution=0.5))
    assert after[FORM].isna().all() and after[AFTER].notna().all()
    assert found.explain().endswith(f"{count} impacts, not known for {count}")


# Words.


def test_explain_says_what_the_loss_may_cost():
    found = scene.Solver(loss="viscous")
    form = found.solve(table(restitution=0.6))[FORM].to_numpy() / UNIT
    *rungs, coupled, cost = found.explain().splitlines()[1:]
    assert coupled.startswith("the bodies spread differently under pressure")
    typical = np.sqrt(np.mean(form[[*STICKING]] ** 2))
    assert cost == (
        f"with the other loss the velocity would differ by {typical:.2g} mu v2(0) (root mean "
        f"square), {form.max():.2g} at most: 3 impacts"
    )
    assert sorted(line.split()[0] for line in rungs) == ["1", "1", "3"]


# Head-on.


@pytest.mark.parametrize("loss", continuum.LOSSES)
def test_head_on_any_restitution_has_an_answer(loss):
    e = np.array([0.0, 1e-12, 0.05, 0.5, 1.0])
    after = scene.solve(table([0.0] * e.size, restitution=e), loss=loss)
    assert set(after["model"]) == {"head-on"} and set(after["regime"]) == {"STICK"}
    assert (after[[AFTER, "spin_after [rad/s]", "error_bound [m/s]", FORM]] == 0).all(axis=None)
    np.testing.assert_allclose(after["velocity_normal_after [m/s]"], -e, atol=1e-15)
    np.testing.assert_allclose(after["energy_lost [J]"] / after["energy_lost [J]"][0], 1 - e**2)


def test_head_on_stands_beside_others():
    """A little tangential velocity sticks, and then e below 0.1 has no answer."""
    rows = table([0.0, 1e-9], restitution=0.05, loss="viscous")
    words = "row 2: restitution = 0.05: allowed are numbers from 0.1 where the contact sticks"
    with pytest.raises(InputError, match=words):
        scene.solve(rows)
    after = scene.solve(rows.assign(restitution=0.5))
    assert after["model"].tolist() == ["head-on", "continuum.viscous"]


# The command line.


@pytest.mark.parametrize("loss", continuum.LOSSES)
def test_a_scene_on_the_command_line_has_a_loss(tmp_path, loss, capsys):
    source, out = tmp_path / "in.csv", tmp_path / "out.csv"
    table(restitution=0.6).to_csv(source, index=False)
    assert main(["scene", str(source), str(out), "--loss", loss]) == 0
    assert capsys.readouterr().err == ""
    found = pd.read_csv(out)
    assert set(found["loss"]) == {loss}
    wanted = scene.solve(pd.read_csv(source), loss=loss)
    pd.testing.assert_series_equal(found[AFTER], wanted[AFTER])


@pytest.fixture
def fewer(monkeypatch):
    """How many incidences the errors are taken at, fewer than users have: it saves seconds."""
    monkeypatch.setattr(sys.modules[main.__module__], "INCIDENCES", 9)
    return 9


RMS, LARGEST, SEEN = "rms [mu v2(0)]", "max [mu v2(0)]", "seen [1]"


def listed(capsys, *options):
    """Rows that `planarimpact models` prints, by model."""
    assert main(["models", *options]) == 0
    said = capsys.readouterr()
    assert "for mass_ratio 3.5, stiffness_ratio 1.21, restitution " in said.err
    rows = csv.DictReader(io.StringIO(said.out))
    return {row["model"]: row for row in rows}


def test_models_are_measured_against_the_continuum_of_a_loss(capsys, fewer):
    rows = listed(capsys, "--restitution", "0.8", "--loss", "plastic")
    assert list(rows) == list(models.MODELS)
    numbers = {name: [float(row[c]) for c in (RMS, LARGEST, SEEN)] for name, row in rows.items()}
    for name in ("lumped", "continuum", "annuli"):  # elastic alone
        assert np.isnan(numbers.pop(name)).all()
    for rms, largest, seen in numbers.values():
        assert 0 < rms <= largest and 0 <= seen <= 1
    rms, largest, seen = numbers["continuum.plastic"]
    assert largest <= 1e-4 and seen == 0
    x = np.linspace(0.0, float(sliding.limit_alike(np.array(3.5), np.array(1.21), 0.8)), fewer)
    wanted = distance(x, 0.8, 3.5, 1.21)
    assert numbers["continuum.viscous"][:2] == pytest.approx(
        [np.sqrt(np.mean(wanted**2)), wanted.max()], rel=0.06
    )
    other = listed(capsys, "--restitution", "0.8", "--loss", "viscous")
    assert float(other["continuum.viscous"][LARGEST]) <= 1e-4
    assert float(other["continuum.plastic"][RMS]) == numbers["continuum.viscous"][0]


def test_models_at_e_1_have_the_elastic_continuum(capsys, fewer):
    rows = listed(capsys, "--restitution", "1")
    numbers = {name: float(row[RMS]) for name, row in rows.items()}
    assert all(value > 0 for value in numbers.values())
    assert numbers["continuum"] <= 1e-6 and numbers["continuum.viscous"] <= 1e-4
    x = np.linspace(0.0, float(sliding.limit_alike(np.array(3.5), np.array(1.21), 1.0)), fewer)
    error = lumped.rebound(x).velocity - continuum.rebound(x).velocity
    assert numbers["lumped"] == pytest.approx(np.sqrt(np.mean(error**2)), rel=0.06)


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["--restitution", "0.8"], "unless loss says what takes the energy: viscous, plastic"),
        (["--restitution", "1.5"], "restitution = 1.5: allowed are numbers from 0 to 1"),
        (["--loss", "plastic"], "--loss: it does not apply, without --restitution"),
        (["--mass-ratio", "3"], "--mass-ratio: it does not apply, without --restitution"),
    ],
)
def test_models_refuse_in_one_line(options, words, capsys):
    assert main(["models", *options]) == 2
    said = capsys.readouterr()
    assert words in said.err and len(said.err.splitlines()) == 1 and not said.out


def test_bodies_that_spread_differently_under_pressure_are_told():
    """No model has the coupling: it is said where it may matter, once for all rows of a table."""
    rigid = scene.Solver(loss="plastic")
    rigid.solve(table(restitution=0.8))
    *_, words, _ = rigid.explain().splitlines()
    assert "3 impacts may be off by more than 0.1 mu v2(0)" in words
    assert "up to 1.4" in words  # 0.286 over 0.2
    alike = table(restitution=0.8).assign(
        **{"other_young_modulus [Pa]": 207e9, "other_poisson_ratio": 0.3}
    )
    other = scene.Solver(loss="plastic")
    other.solve(alike)
    assert "spread" not in other.explain()
    other.solve(table(restitution=0.8))
    assert "3 impacts may" in other.explain()
