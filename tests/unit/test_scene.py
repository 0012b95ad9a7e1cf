"""Scenes: columns, plane and space, energy, blocks, and the choice of a rung."""

import itertools
import re
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from planarimpact import ConvergenceError, InputError, bodies, continuum, scene, spheres
from planarimpact.collision import mechanics, rungs
from planarimpact.ground.results import Regime
from planarimpact.scene import columns, solver, states

STEEL = {
    "radius [m]": 0.01,
    "density [kg/m^3]": 7800.0,
    "young_modulus [Pa]": 207e9,
    "poisson_ratio": 0.3,
    "friction": 0.3,
    "restitution": 0.8,
    "loss": "viscous",
}
PLANE = {"velocity_tangential [m/s]": 1.0, "velocity_normal [m/s]": 2.0, "spin [rad/s]": 30.0}
SPACE = {
    **{f"velocity_{axis} [m/s]": v for axis, v in zip("xyz", (0.7, -0.4, -2.0), strict=True)},
    **{f"spin_{axis} [rad/s]": w for axis, w in zip("xyz", (20.0, -60.0, 15.0), strict=True)},
}
OTHER = {
    "other_radius [m]": 0.02,
    "other_mass [kg]": 0.05,
    "other_gyration [m]": 0.013,
    "other_young_modulus [Pa]": 70e9,
    "other_poisson_ratio": 0.2,
}
OTHER_SPACE = {
    **{f"other_velocity_{axis} [m/s]": v for axis, v in zip("xyz", (0.1, 0.2, 0.5), strict=True)},
    **{f"other_spin_{axis} [rad/s]": w for axis, w in zip("xyz", (-9.0, 5.0, 3.0), strict=True)},
}
NORMAL = {"normal_x": 0.6, "normal_y": 0.0, "normal_z": 0.8}


def table(*parts, **columns_):
    return pd.DataFrame([{key: value for part in parts for key, value in part.items()} | columns_])


def without(row, *names):
    return {key: value for key, value in row.items() if key not in names}


@pytest.fixture
def no_table(monkeypatch):
    """Solve all impacts that stick."""
    monkeypatch.setattr(spheres, "covers", lambda beta, *_: np.zeros(beta.shape, dtype=bool))


def vectors(frame, ending="", who=""):
    """Velocity and spin of one row."""
    row = frame.iloc[0]
    return [
        np.array([row[f"{who}{name}_{axis}{ending} [{unit}]"] for axis in "xyz"])
        for name, unit in (("velocity", "m/s"), ("spin", "rad/s"))
    ]


def test_plane_scene_is_the_solver_with_bodies():
    after = scene.solve(table(STEEL, PLANE)).iloc[0]
    ball = bodies.solid_sphere(0.01, 7800.0)
    zeta2 = bodies.stiffness_ratio(bodies.Material(207e9, 0.3))
    motion = bodies.Motion(1.0, 2.0, 30.0)
    x = bodies.incidence(1.0 + 0.01 * 30.0, 2.0, 0.3)
    groups = x, bodies.mass_ratio(ball), zeta2, 0.8
    found = spheres.rebound(*groups, loss="viscous")
    wanted = bodies.rebound_motion(ball, motion, 0.3, found.velocity, 0.8)
    names = ["velocity_tangential_after [m/s]", "velocity_normal_after [m/s]", "spin_after [rad/s]"]
    np.testing.assert_allclose([after[name] for name in names], wanted, rtol=1e-11)
    modulus = bodies.effective_modulus(bodies.Material(207e9, 0.3))
    force = bodies.peak_force(ball.mass, 2.0, modulus, 0.01, 0.8, "viscous")
    assert after["peak_normal_force [N]"] == pytest.approx(force, rel=1e-13)
    share = 0.3 * found.peak_friction
    assert after["peak_friction_force [N]"] == pytest.approx(share * force, rel=1e-11)
    assert after["regime"] == "SLIP_STICK_SLIP" and after["model"] == "continuum.viscous"
    assert after["incidence"] == pytest.approx(x)


def test_a_plane_state_is_one_in_space():
    flat = scene.solve(table(STEEL, PLANE)).iloc[0]
    state = {"velocity_x [m/s]": 1.0, "velocity_y [m/s]": 0.0, "velocity_z [m/s]": -2.0}
    spin = {"spin_x [rad/s]": 0.0, "spin_y [rad/s]": -30.0, "spin_z [rad/s]": 0.0}
    velocity, turning = vectors(scene.solve(table(STEEL, state, spin)), "_after")
    assert velocity[0] == pytest.approx(flat["velocity_tangential_after [m/s]"])
    assert velocity[2] == pytest.approx(-flat["velocity_normal_after [m/s]"])
    assert turning[1] == pytest.approx(-flat["spin_after [rad/s]"])
    assert velocity[1] == turning[0] == turning[2] == 0


@pytest.mark.parametrize(
    ("friction", "restitution"),
    # Only contacts that slide throughout may have e = 0.
    [*itertools.product([0.0, 0.02, 0.3, 2.0], [0.1, 0.6, 1.0]), (0.0, 0.0), (0.3, 0.0)],
)
def test_momentum_and_energy_of_two_bodies(friction, restitution):
    rows = table(
        STEEL, SPACE, OTHER, OTHER_SPACE, NORMAL, friction=friction, restitution=restitution
    )
    after = scene.solve(rows)
    normal = np.array([0.6, 0.0, 0.8])
    first = 4 / 3 * np.pi * 7800 * 0.01**3, 0.01 * np.sqrt(0.4), -0.01
    second = 0.05, 0.013, 0.02
    energy = momentum = angular = 0
    for sign, ending, frame in ((1, "", rows), (-1, "_after", after)):
        for who, (mass, gyration, arm) in (("", first), ("other_", second)):
            velocity, spin = vectors(frame, ending, who)
            energy += sign * mass / 2 * (velocity @ velocity + gyration**2 * spin @ spin)
            momentum += sign * mass * velocity
            about_contact = np.cross(-arm * normal, velocity)
            angular += sign * mass * (gyration**2 * spin + about_contact)
    assert np.abs(momentum).max() < 1e-15 and np.abs(angular).max() < 1e-16
    assert energy == pytest.approx(after["energy_lost [J]"].iloc[0], rel=1e-9)
    assert energy >= 0


def test_without_friction_only_the_normal_velocity_changes():
    after = scene.solve(table(STEEL, PLANE, friction=0.0)).iloc[0]
    assert after["velocity_tangential_after [m/s]"] == 1.0 and after["spin_after [rad/s]"] == 30.0
    assert after["velocity_normal_after [m/s]"] == -1.6 and after["model"] == "slip throughout"


def test_the_result_has_the_table_and_then_what_follows():
    """Columns, their order, types and values, and the index, of rows that are not left out."""
    rows = table(PLANE, STEEL).loc[[0] * 4].set_axis(["a", "b", "b", "c"])
    rows = rows.assign(id=["NA", None, "007", 1e5], friction=["0.3", "0.2", "1e-1", "no"])
    rows = rows.assign(colour=["red", 1, None, ()])  # which no one knows
    rows = rows.astype({"density [kg/m^3]": int, "radius [m]": "float32"})
    before = rows.copy()
    after = solver.Solver().solve(rows, skip_bad=True)
    assert list(after.columns)[: len(rows.columns)] == list(rows.columns)
    pd.testing.assert_frame_equal(after[list(rows.columns)], rows.iloc[:3])
    pd.testing.assert_frame_equal(rows, before)


def test_names_that_the_result_adds_are_known_before():
    other_plane = {f"other_{name}": 0.0 for name in PLANE}
    states_ = (PLANE, other_plane), (SPACE, OTHER_SPACE)
    added = set()
    for body, other in states_:
        rows = table(STEEL, body, OTHER, other)
        added |= {*scene.solve(rows)} - {*rows}
    assert added == columns.ADDED


@pytest.mark.parametrize(
    "given", ["shots.csv", Path("shots.csv"), {"radius [m]": 1}, np.ones((3, 3))]
)
def test_what_is_no_table_is_refused(given):
    with pytest.raises(
        InputError, match="table = .*: allowed is a pandas DataFrame; .* reads files"
    ):
        scene.solve(given)


def test_index_and_id_are_kept_and_blocks_do_not_show(monkeypatch):
    rng = np.random.default_rng(5)
    count = 500
    rows = pd.DataFrame({**STEEL, **PLANE}, index=rng.permutation(count) + 7)
    rows["velocity_tangential [m/s]"] = rng.normal(0, 3, count)
    rows["restitution"] = rng.uniform(0.4, 1.0, count)
    rows["id"] = [f"shot {i}" for i in range(count)]
    whole = scene.solve(rows)
    monkeypatch.setattr(solver, "BLOCK", 64)
    pieces = scene.solve(rows)
    pd.testing.assert_frame_equal(whole, pieces, rtol=1e-9, check_categorical=False)
    assert list(whole.index) == list(rows.index) and list(whole["id"]) == list(rows["id"])


def test_an_empty_table_gives_an_empty_table():
    after = scene.solve(table(STEEL, PLANE).iloc[:0])
    assert len(after) == 0 and "energy_lost [J]" in after


BAD_COLUMNS = [
    (without(STEEL, "radius [m]") | PLANE, r"columns radius \[m\]: missing"),
    (STEEL | {"radius [mm]": 10} | PLANE, r"'radius \[mm\]': the unit of radius is \[m\]"),
    (STEEL | {"friction [m]": 1} | PLANE, "the unit of friction is none"),
    (without(STEEL, "radius [m]") | {"radius": 1} | PLANE, r"the unit of radius is \[m\]"),
    (
        without(STEEL, "friction") | {"mu": 1, "id": 2} | PLANE,
        r"columns friction: missing; unknown is 'mu'$",
    ),
    (STEEL | {"regime": 1} | PLANE, "column 'regime': the result has a column of this name"),
    (STEEL | {"densty [kg/m^3]": 1} | PLANE, r"did you mean 'density \[kg/m\^3\]'"),
    (STEEL | {"mass [kg]": 1.0} | PLANE, "either density"),
    (without(STEEL, "density [kg/m^3]") | {"mass [kg]": 1.0} | PLANE, r"gyration \[m\]: missing"),
    (STEEL, "velocity_tangential .*: missing"),
    (STEEL | PLANE | SPACE, "columns velocity_tangential .* and velocity_x .*: states have two"),
    (STEEL | PLANE | NORMAL, "normal_x, normal_y, normal_z: states have two dimensions or three"),
    (STEEL | PLANE | OTHER_SPACE, "and other_velocity_x .*: states have two dimensions"),
    (STEEL | SPACE | without(NORMAL, "normal_y"), "normal_y: missing"),
    (STEEL | PLANE | {"other_mass [kg]": 1.0}, r"other_radius \[m\]: missing"),
    (STEEL | PLANE | {"other_poisson_ratio": 0.3}, r"other_young_modulus \[Pa\]: missing"),
    (
        without(STEEL, "restitution", "loss") | PLANE,
        r"columns: needed is exactly one of restitution, relaxation_time \[s\], yield_pressure",
    ),
    (
        STEEL | PLANE | {"yield_pressure [Pa]": 1e9},
        r"columns restitution, yield_pressure \[Pa\]: needed is exactly one of",
    ),
    (
        without(STEEL, "restitution", "loss")
        | PLANE
        | {"yield_pressure [Pa]": 1e9, "loss": "plastic"},
        r"column loss: allowed only beside restitution, as yield_pressure \[Pa\] is always plas",
    ),
    (
        without(STEEL, "restitution", "loss")
        | PLANE
        | {"relaxation_time [s]": 0.0, "loss": "viscous"},
        r"column loss: allowed only .* relaxation_time \[s\] is always viscous",
    ),
    (STEEL | PLANE | {"loss [J]": "plastic"}, "the unit of loss is none"),
]


@pytest.mark.parametrize(("row", "words"), BAD_COLUMNS, ids=[words for _, words in BAD_COLUMNS])
def test_bad_columns_are_refused(row, words):
    with pytest.raises(InputError, match=words):
        scene.solve(pd.DataFrame([row]))


BAD_CELLS = [
    ("friction", -0.1, "friction = -0.1: allowed are finite numbers from 0"),
    ("friction", np.nan, "friction = nan"),
    ("restitution", 1.01, "restitution = 1.01: allowed are numbers from 0 to 1"),
    ("radius [m]", 0.0, r"radius \[m\] = 0.0: allowed are finite numbers above 0"),
    ("density [kg/m^3]", np.inf, r"density \[kg/m\^3\] = inf"),
    ("poisson_ratio", 0.6, "poisson_ratio = 0.6"),
    ("velocity_normal [m/s]", -2.0, "approach = -2: the bodies must approach each other"),
    ("velocity_normal [m/s]", 0.0, "approach = "),
    ("radius [m]", True, r"radius \[m\] = True"),
    ("radius [m]", 1 + 2j, "radius"),
    ("radius [m]", 10**400, "radius"),
    ("radius [m]", "1_0", r"radius \[m\] = '1_0'"),
    ("radius [m]", "０.０１", r"radius \[m\] = '０.０１': allowed are"),
    ("velocity_normal [m/s]", "fast", "= 'fast': allowed are finite numbers"),
    ("spin [rad/s]", 1e308, "too large or too small"),
    (
        "restitution",
        0.0999,
        "restitution = 0.0999: allowed are numbers from 0.1 where",
    ),
]


@pytest.mark.parametrize(("name", "value", "words"), BAD_CELLS, ids=[w for *_, w in BAD_CELLS])
def test_a_bad_row_is_named_or_left_out(name, value, words):
    rows = pd.concat([table(STEEL, PLANE)] * 4, ignore_index=True).astype(object)
    rows.loc[2, name] = value
    if name == "spin [rad/s]":
        rows["radius [m]"] = 10.0
    with pytest.raises(InputError, match="row 3: .*" + words):
        scene.solve(rows)
    remembered = scene.Solver()
    after = remembered.solve(rows, skip_bad=True)
    assert list(after.index) == [0, 1, 3]
    assert remembered.rows == 4 and [number for number, _ in remembered.bad] == [3]


def of_material(**material):
    return table(without(STEEL, "restitution", "loss"), PLANE, material)


def inputs(rows):
    """Values and problems of a table, as the solver reads them."""
    return columns.numbers(rows, columns.named(rows.columns))


def test_each_row_has_the_loss_of_its_word():
    words = ["viscous", " plastic ", "plastic"]
    rows = table(STEEL, PLANE).loc[[0] * 3].assign(loss=words, restitution=[0.5, 0.5, 1.0])
    values, problems = inputs(rows)
    assert not problems and values["loss"].tolist() == [word.strip() for word in words]
    found, peak_normal, _ = states.rows(values)
    assert found.plastic.tolist() == [False, True, True]
    assert (peak_normal[:2] / peak_normal[2]).round(3).tolist() == [0.773, 0.551]
    as_category = inputs(rows.astype({"loss": "category"}))[0]
    np.testing.assert_array_equal(as_category["loss"], values["loss"])


@pytest.mark.parametrize("word", ["magic", 1, "Viscous", "viscous, plastic"])
def test_a_wrong_loss_is_named_by_its_row(word):
    rows = table(STEEL, PLANE).loc[[0] * 3].assign(loss=["viscous", word, "plastic"])
    with pytest.raises(InputError, match="row 2: loss = .*: allowed are viscous, plastic"):
        scene.solve(rows)


def test_below_restitution_1_a_row_says_its_loss():
    """At 1 it may be empty."""
    rows = table(STEEL, PLANE).loc[[0] * 3].assign(restitution=[1.0, 1.0, 0.8])
    after = scene.solve(rows.assign(loss=["", None, "plastic"]))
    assert after["model"].tolist()[:2] == ["continuum"] * 2
    words = "row 3: restitution = 0.8: allowed are .* says what takes the energy: viscous, plastic"
    for missing in (rows.assign(loss=""), rows.drop(columns="loss")):
        with pytest.raises(InputError, match=words):
            scene.solve(missing)


def test_a_relaxation_time_beyond_the_law_is_a_bad_row():
    rows = of_material().loc[[0] * 4].assign(**{"relaxation_time [s]": [1e-6, 1.0, 0.0, 1.0]})
    rows["velocity_normal [m/s]"] = [2.0, 2.0, 2.0, -2.0]
    found = scene.Solver()
    after = found.solve(rows, skip_bad=True)
    assert after["velocity_normal_after [m/s]"].iloc[1] == -2.0  # e = 1 without relaxation
    (first, long), (last, away) = found.bad
    assert (first, last) == (2, 4) and "must approach" in away
    assert long.startswith("relaxation_time = 1: allowed are numbers up to ")


@pytest.mark.parametrize("loss", columns.LOSSES)
def test_little_restitution_is_for_contacts_that_slide(loss):
    """Forces are those of the law as far as it goes, and then NaN."""
    e = np.array([0.0, 0.021, 0.022, 0.05, 0.1])
    rows = table(STEEL, PLANE, loss=loss).loc[[0] * e.size].assign(restitution=e)
    low = {"viscous": 0.01, "plastic": 1e-9}[loss]
    sticks, _, _ = states.rows(inputs(rows.assign(friction=0.3))[0])
    slides, peak, _ = states.rows(inputs(rows.assign(friction=low))[0])
    assert slides.restitution.tolist() == sticks.restitution.tolist() == e.tolist()
    assert slides.mass_ratio[0] == pytest.approx(3.5)
    # What gives back nothing flows so fast that it never slides throughout.
    found = [True] * 5 if loss == "viscous" else [False, True, True, True, True]
    assert mechanics.slides_throughout(slides).tolist() == found
    assert not mechanics.slides_throughout(sticks).any()
    assert list(mechanics.problems(slides)) == np.flatnonzero(~np.array(found)).tolist()
    words = "restitution = 0.05: allowed are numbers from 0.1 where the contact sticks at some time"
    problems = mechanics.problems(sticks)
    assert list(problems) == [0, 1, 2, 3] and problems[3] == words
    assert np.isnan(peak).tolist() == [True, True, False, False, False]
    with_loss = {"viscous": [2.676, 1.852, 1.339], "plastic": [0.045, 0.087, 0.152]}[loss]
    elastic = states.rows(inputs(rows.assign(restitution=1.0))[0]).peak_normal[0]
    assert (peak[2:] / elastic).round(3).tolist() == with_loss


EXTREMES = [
    {"friction": 1e-300},
    {"friction": 1e-300, "velocity_tangential [m/s]": 1e100},
    {"friction": 1e-300, "velocity_normal [m/s]": 1e-100},
    {"velocity_tangential [m/s]": 0.0, "spin [rad/s]": 1e-320},
    {"spin [rad/s]": 1e300},
    {"friction": 1e308},
    {"density [kg/m^3]": 1e300, "radius [m]": 1e-100, "spin [rad/s]": 1e150},
]


@pytest.mark.parametrize("extreme", EXTREMES, ids=str)
def test_no_number_makes_a_warning(extreme):
    """Nor depends on how NumPy was told to treat it; what friction cannot hold slides."""
    remembered = scene.Solver()
    with np.errstate(all="raise"):
        after = remembered.solve(table(STEEL, PLANE, extreme), skip_bad=True)
    assert len(after) + len(remembered.bad) == 1
    numbers = after.select_dtypes(float).drop(columns="incidence")
    assert np.isfinite(numbers.to_numpy()).all()
    if extreme.get("friction") == 1e-300:
        assert after["regime"].tolist() == ["SLIP_THROUGHOUT"]
        assert (
            after["velocity_tangential_after [m/s]"].iloc[0]
            == (PLANE | extreme)["velocity_tangential [m/s]"]
        )


def test_a_spin_after_that_is_no_number_is_named():
    needle = without(STEEL, "density [kg/m^3]") | {"mass [kg]": 1.0, "gyration [m]": 1e-308}
    rows = table(needle, PLANE, **{"radius [m]": 1e-308, "velocity_normal [m/s]": 1e10})
    with pytest.raises(InputError, match="row 1: its numbers are too large or too small"):
        scene.solve(rows)


def test_rows_are_numbered_over_all_tables(monkeypatch):
    monkeypatch.setattr(solver, "BLOCK", 3)
    rows = pd.concat([table(STEEL, PLANE)] * 5, ignore_index=True)
    rows.loc[4, "friction"] = -1.0
    remembered = scene.Solver()
    with pytest.raises(InputError, match="row 5:"):
        remembered.solve(rows)


def test_a_normal_has_the_length_one():
    with pytest.raises(InputError, match="row 1: the normal has the length 1.28"):
        scene.solve(table(STEEL, SPACE, NORMAL, normal_y=0.8))
    with pytest.raises(InputError, match="allowed is 1"):
        scene.solve(table(STEEL, SPACE, NORMAL, normal_z=0.80001))


@pytest.mark.parametrize("tolerance", [0.0, 2.0, np.nan, [1e-3, 1e-2], "fine"])
def test_bad_tolerances_are_refused(tolerance):
    with pytest.raises(InputError, match="tolerance"):
        scene.Solver(tolerance)


def test_the_table_of_spheres_takes_what_it_covers():
    """Each impact is its own pair. The other loss comes from the table too."""
    rng, count = np.random.default_rng(2), 60
    rows = pd.DataFrame({**STEEL, **PLANE}, index=range(count))
    rows["velocity_tangential [m/s]"] = rng.uniform(-0.2, 1.0, count)
    nu = rows["poisson_ratio"] = rng.uniform(0.0, 0.5, count)
    e = rows["restitution"] = np.where(np.arange(count) < 20, 1.0, rng.uniform(0.4, 1.0, count))
    remembered, unit = scene.Solver(1e-2), 0.3 * 2.0
    for loss, other in itertools.permutations(columns.LOSSES):
        after = remembered.solve(rows.assign(loss=loss))
        groups = after["incidence"], 3.5, bodies.stiffness_ratio(bodies.Material(1.0, nu)), e
        found = spheres.rebound(*groups, loss=np.where(e < 1, loss, "viscous"))
        w = after["contact_velocity_after [m/s]"] / unit
        np.testing.assert_allclose(w, found.velocity, rtol=1e-11)
        force = 0.3 * found.peak_friction * after["peak_normal_force [N]"]
        np.testing.assert_allclose(after["peak_friction_force [N]"], force, rtol=1e-11)
        assert (after["regime"] == Regime.names(found.regime)).all()
        lossy = np.array(loss == "plastic") & (e < 1)
        bound = spheres.error_bound(np.full(count, 3.5), groups[2], e, lossy)
        bound *= np.minimum(np.abs(after["incidence"]), 1.0)
        np.testing.assert_allclose(after["error_bound [m/s]"] / unit, bound, 1e-6)
        far = np.where(e < 1, spheres.rebound(*groups, loss=other).velocity - found.velocity, 0.0)
        np.testing.assert_allclose(after["model_form [m/s]"] / unit, np.abs(far), atol=1e-11)
    for model in ("continuum", "continuum.viscous", "continuum.plastic"):
        assert f"  {model}, table" in remembered.explain()
    assert "solved" not in remembered.explain()


TABLED, TOO_COARSE, NOT_COVERED = (why for _, why in rungs.CONTINUUM_WAYS)


def explained(table, tolerance=1e-3, loss=None):
    """Counts of impacts by rung, and why, as `explain` says."""
    remembered = scene.Solver(tolerance, loss)
    remembered.solve(table)
    lines = [line for line in remembered.explain().splitlines() if line.startswith("   ")]
    return {tuple(re.split("  +", line.strip())) for line in lines}


def test_each_impact_gets_the_first_rung_that_fits():
    """A formula, the table where it covers an impact and is fine enough, else the continuum."""
    e = [0.8, 0.8, 1.0, 0.2, 0.8]
    speeds = [30.0, -0.3, 0.3, 0.3, 0.3]  # the second one makes it head-on
    rows = table(STEEL, PLANE).loc[[0] * 5].assign(restitution=e)
    rows["velocity_tangential [m/s]"] = speeds
    formulas = {
        ("1", "slip throughout", "they slide from first to last, by Coulomb's law"),
        ("1", "head-on", "they have no tangential motion"),
    }
    assert explained(rows) == formulas | {
        ("1", "continuum, table", TABLED),
        ("1", "continuum.viscous, table", TABLED),
        ("1", "continuum.viscous, solved", NOT_COVERED),
    }
    assert explained(rows, tolerance=spheres.ERROR_BOUND["viscous"]) == formulas | {
        ("1", "continuum, solved", TOO_COARSE),
        ("1", "continuum.viscous, solved", TOO_COARSE),
        ("1", "continuum.viscous, solved", NOT_COVERED),
    }
    plastic = rows.drop(columns="loss")
    assert explained(plastic, tolerance=2e-4, loss="plastic") == formulas | {
        ("1", "continuum, table", TABLED),
        ("1", "continuum.plastic, solved", TOO_COARSE),
        ("1", "continuum.plastic, solved", NOT_COVERED),
    }


def test_impacts_are_solved_by_their_own_groups():
    """Also where they share all but one. The answers of two kinds differ by 0.027 at least."""
    first = (0.006, 0.1, 0.8, "viscous")
    kinds = [first, (0.008, *first[1:])]
    kinds += [(0.006, 0.4, *first[2:]), (0.006, 0.1, 0.9, "viscous"), (*first[:3], "plastic")]
    rows = pd.concat(
        [
            table(without(STEEL, "density [kg/m^3]"), PLANE, loss=loss).assign(
                **{"mass [kg]": 0.1, "gyration [m]": g, "poisson_ratio": nu, "restitution": e}
            )
            for g, nu, e, loss in kinds
        ],
        ignore_index=True,
    )
    after = scene.solve(rows, tolerance=1e-2)
    contact = after["velocity_tangential_after [m/s]"] + 0.01 * after["spin_after [rad/s]"]
    for (gyration, nu, e, loss), velocity in zip(kinds, contact / 0.6, strict=True):
        groups = 1 + (0.01 / gyration) ** 2, bodies.stiffness_ratio(bodies.Material(1.0, nu)), e
        w = continuum.rebound(1.3 / 0.6, *groups, loss=loss, tolerance=1e-4).velocity
        assert velocity == pytest.approx(w, abs=0.0101)
    assert after["model"].tolist() == [f"continuum.{loss}" for *_, loss in kinds]


def test_two_bodies_by_hand():
    """Materials and radii of both count, in the groups and in the forces."""
    state = PLANE | {f"other_{name}": 0.0 for name in PLANE}
    after = scene.solve(table(STEEL, state, OTHER)).iloc[0]
    ball, other = bodies.solid_sphere(0.01, 7800.0), bodies.Body(0.05, 0.013, 0.02)
    materials = bodies.Material(207e9, 0.3), bodies.Material(70e9, 0.2)
    m1, m2 = bodies.effective_masses(ball, other)
    x = 1.3 / 0.6
    groups = x, m2 / m1, bodies.stiffness_ratio(*materials), 0.8
    w = spheres.rebound(*groups, loss="viscous").velocity
    impulse = m1 * 0.6 * (w - x)
    assert after["velocity_tangential_after [m/s]"] == pytest.approx(1.0 + impulse / ball.mass)
    assert after["other_velocity_tangential_after [m/s]"] == pytest.approx(-impulse / 0.05)
    assert after["other_spin_after [rad/s]"] == pytest.approx(0.02 * impulse / 0.05 / 0.013**2)
    modulus = bodies.effective_modulus(*materials)
    radius = bodies.effective_radius(0.01, 0.02)
    force = bodies.peak_force(m2, 2.0, modulus, radius, 0.8, "viscous")
    assert after["peak_normal_force [N]"] == pytest.approx(force)


def test_an_endless_radius_needs_a_body_that_stays():
    rows = table(STEEL, PLANE, without(OTHER, "other_radius [m]"), **{"other_radius [m]": np.inf})
    with pytest.raises(InputError, match=r"row 1: other_radius \[m\] = inf: allowed are finite"):
        scene.solve(rows)


@pytest.mark.parametrize("cell", ["1e400", np.longdouble("1e400"), 10**400, "1" + 400 * "0"])
def test_a_number_too_large_is_not_infinite(cell):
    rows = table(STEEL, PLANE, OTHER).assign(**{"other_mass [kg]": np.array([cell])})
    with pytest.raises(InputError, match=r"row 1: other_mass \[kg\] = .*1.*allowed are .* or inf"):
        scene.solve(rows)


@pytest.mark.parametrize("cell", ["inf", "Infinity", np.inf, np.longdouble("inf")])
def test_infinite_is_what_is_called_so(cell):
    other = OTHER | {"other_mass [kg]": cell}
    after = scene.solve(table(STEEL, PLANE, other))
    pd.testing.assert_series_equal(
        after["spin_after [rad/s]"],
        scene.solve(table(STEEL, PLANE, OTHER | {"other_mass [kg]": np.inf}))["spin_after [rad/s]"],
    )


def test_infinite_is_a_rigid_flat_wall():
    wall = {
        "other_radius [m]": np.inf,
        "other_mass [kg]": np.inf,
        "other_gyration [m]": np.inf,
        "other_young_modulus [Pa]": np.inf,
        "other_poisson_ratio": 0.2,
    }
    plain, rigid = scene.solve(table(STEEL, PLANE)), scene.solve(table(STEEL, PLANE, wall))
    pd.testing.assert_frame_equal(plain, rigid[plain.columns], rtol=1e-13)


def test_a_wall_that_moves_needs_its_velocity_alone():
    """It is the same impact as seen from the wall, for a state in a plane and in space."""
    wall = {"other_velocity_tangential [m/s]": 0.4, "other_velocity_normal [m/s]": -0.5}
    after = scene.solve(table(STEEL, PLANE, wall)).iloc[0]
    seen = {"velocity_tangential [m/s]": 0.6, "velocity_normal [m/s]": 2.5}
    relative = scene.solve(table(STEEL, PLANE | seen)).iloc[0]
    name = "velocity_tangential_after [m/s]"
    assert after[name] == pytest.approx(relative[name] + 0.4)
    assert after["velocity_normal_after [m/s]"] == pytest.approx(-0.8 * 2.5 - 0.5)
    assert after["spin_after [rad/s]"] == pytest.approx(relative["spin_after [rad/s]"])
    assert not [name for name in after.index if "other" in name and "_after" in name]
    moves = {f"other_velocity_{axis} [m/s]": v for axis, v in zip("xyz", (0, 0, 0.5), strict=True)}
    spins = {f"other_spin_{axis} [rad/s]": 0.0 for axis in "xyz"}
    found, wanted = (scene.solve(table(STEEL, SPACE, moves, more)) for more in ({}, spins))
    pd.testing.assert_frame_equal(found, wanted[found.columns])
    with pytest.raises(InputError, match=r"columns other_velocity_normal \[m/s\]: missing"):
        scene.solve(table(STEEL, PLANE, {"other_velocity_tangential [m/s]": 0.4}))


def test_a_wall_without_masses_may_be_round_and_turn():
    """It is a body of infinite mass."""
    roll = {"other_radius [m]": 0.05, "other_spin [rad/s]": 20.0}
    heavy = {"other_mass [kg]": np.inf, "other_gyration [m]": np.inf}
    rows = of_material(**{"yield_pressure [Pa]": 2e9}).assign(**roll)
    found, wanted = scene.solve(rows), scene.solve(rows.assign(**heavy))
    assert found["incidence"][0] == pytest.approx((1.3 + 20 * 0.05) / 0.6)
    pd.testing.assert_frame_equal(found, wanted[found.columns])


def test_a_contact_too_stiff_for_the_continuum_is_named_by_its_row():
    needle = without(STEEL, "density [kg/m^3]") | {"mass [kg]": 0.1, "gyration [m]": 1e-7}
    row = table(needle, PLANE, restitution=1.0)
    good = row.assign(**{"gyration [m]": 0.006})
    with pytest.raises(ConvergenceError, match="row 2: .* needs .* steps, .*; 1 more rows"):
        scene.solve(pd.concat([good, row, good, row]))


@pytest.mark.parametrize("count", [1, 3])
def test_a_contact_without_an_answer_may_be_left_out(count):
    """The others have the answers that they have alone."""
    needle = without(STEEL, "density [kg/m^3]") | {"mass [kg]": 0.1, "gyration [m]": 1e-7}
    row = table(needle, PLANE, restitution=1.0)
    good = row.assign(**{"gyration [m]": 0.006})
    sliding = row.assign(friction=1e-12)
    faster = good.assign(**{"velocity_tangential [m/s]": 2.0})
    rows = pd.concat(count * [row, sliding] + [good, faster], ignore_index=True)
    found = solver.Solver()
    after = found.solve(rows, skip_bad=True)
    assert after.index.tolist() == [*range(1, 2 * count, 2), 2 * count, 2 * count + 1]
    assert [number for number, _ in found.bad] == list(range(1, 2 * count, 2))
    assert all("the tangential oscillation needs" in words for _, words in found.bad)
    alone = scene.solve(pd.concat([good, faster], ignore_index=True))
    last = after.iloc[-2:].reset_index(drop=True)
    pd.testing.assert_frame_equal(last, alone, check_categorical=False)
    assert found.explain().startswith(f"{count + 2} impacts")


def test_units_stand_in_every_header():
    for name, column in columns.KNOWN.items():
        assert columns.header(name) == (f"{name} [{column.unit}]" if column.unit else name)


@pytest.mark.parametrize("ulps", [0, 1, 2**11])
def test_elastic_is_restitution_1_alone(ulps, no_table):
    after = scene.solve(table(STEEL, PLANE, restitution=1 - ulps * 2.0**-53))
    assert after["model"].tolist() == ["continuum.viscous" if ulps else "continuum"]
