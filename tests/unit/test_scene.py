"""Scenes: a row is what `collide` says of it alone; columns, losses, methods, bad rows."""

import re

import numpy as np
import pandas as pd
import pytest

from planarimpact import (
    ConvergenceError,
    InputError,
    Pair,
    bodies,
    collide,
    continuum,
    scene,
    spheres,
)
from planarimpact.collision import methods

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
OTHER_PLANE = {f"other_{name}": value for name, value in zip(PLANE, (0.4, -0.5, 20), strict=True)}
SPACE = {
    **{f"velocity_{axis} [m/s]": v for axis, v in zip("xyz", (0.7, -0.4, -2.0), strict=True)},
    **{f"spin_{axis} [rad/s]": w for axis, w in zip("xyz", (20.0, -60.0, 15.0), strict=True)},
}
OTHER_SPACE = {
    **{f"other_velocity_{axis} [m/s]": v for axis, v in zip("xyz", (0.1, 0.2, 0.5), strict=True)},
    **{f"other_spin_{axis} [rad/s]": w for axis, w in zip("xyz", (-9.0, 5.0, 3.0), strict=True)},
}
NORMAL = {"normal_x": 0.6, "normal_y": 0.0, "normal_z": 0.8}
OTHER = {
    "other_radius [m]": 0.02,
    "other_mass [kg]": 0.05,
    "other_gyration [m]": 0.013,
    "other_young_modulus [Pa]": 70e9,
    "other_poisson_ratio": 0.2,
}
WALL = {name: np.inf for name in OTHER if "poisson" not in name}
RESTITUTION = "restitution", "loss"
LAWS = {
    "relaxation_time [s]": bodies.viscous_restitution,
    "yield_pressure [Pa]": bodies.plastic_restitution,
}
FORM = "model_form [m/s]"


def table(*parts, **columns_):
    return pd.DataFrame([{key: value for part in parts for key, value in part.items()} | columns_])


def without(row, *names):
    return {key: value for key, value in row.items() if key not in names}


def every_kind(law=None):
    """Rows of every kind: methods, losses, a wall; or with another law than a restitution."""
    kinds = [
        {"restitution": 1.0, "loss": ""},
        {},
        {"loss": " plastic"},
        {"restitution": 0.1, "loss": "plastic", "other_gyration [m]": 0.015},
        {"friction": 0.01},
        {"friction": 0.01, "loss": "plastic"},
        {"friction": 0.0},
        {"restitution": 0.0, **dict.fromkeys(SPACE | OTHER_SPACE, 0.0)}
        | {"velocity_x [m/s]": -0.6, "velocity_z [m/s]": -0.8},
        {"loss": "plastic", **WALL},
    ]
    rows = [table(STEEL, SPACE, OTHER, OTHER_SPACE, NORMAL, kind) for kind in kinds]
    rows = pd.concat(rows, ignore_index=True)
    return rows.drop(columns=list(RESTITUTION)).assign(**law) if law else rows


def vector(row, name, unit, ending=""):
    return np.array([row[f"{name}_{axis}{ending} [{unit}]"] for axis in "xyz"])


@pytest.mark.parametrize("law", [None, {"relaxation_time [s]": 2e-6}, {"yield_pressure [Pa]": 3e9}])
def test_a_row_is_what_collide_says_alone(law):
    """By any law of restitution, with what a table says beside: energy, and force by a law."""
    after, steel = scene.solve(every_kind(law)), bodies.Material(207e9, 0.3)
    for (_, given), (_, found) in zip(every_kind(law).iterrows(), after.iterrows(), strict=True):
        said = {name.split()[0]: value for name, value in (law or {}).items()}
        said = said or {"restitution": given["restitution"], "loss": given["loss"].strip()}
        wall = np.isinf(given["other_mass [kg]"])
        materials = (steel,) if wall else (steel, bodies.Material(70e9, 0.2))
        pair = Pair(*materials, friction=given["friction"], **said)
        ball = bodies.solid_sphere(0.01, density=7800.0)
        other = bodies.Body(*(given[f"other_{name}"] for name in ("mass [kg]", "gyration [m]")), 0)
        other = bodies.HALF_SPACE if wall else other._replace(radius=0.02)
        normal = np.array([0.6, 0.0, 0.8])
        names = [("velocity", "m/s"), ("spin", "rad/s")]
        names += [(f"other_{name}", unit) for name, unit in names]
        before = [vector(given, *name) for name in names]
        alone = collide(pair, normal, ball, *before[:2], other, *before[2:])
        then = [vector(found, *name, "_after") for name in names]
        for (name, _), value in zip(names, then, strict=True):
            np.testing.assert_allclose(value, getattr(alone, name), rtol=1e-9, atol=1e-12)
        for name in ("error_bound [m/s]", FORM, "incidence", "restitution"):
            wanted = getattr(alone, name.split()[0])
            np.testing.assert_allclose(found[name], wanted, rtol=1e-8, atol=1e-12, err_msg=name)
        assert found["regime"] == alone.regime.name
        if law and alone.restitution < 1:
            assert found["loss"] == alone.loss
        # What the table says beside.
        energy = 0
        for sign, states in ((1, before), (-1, then)):
            for body, (v, w) in zip((ball, other), (states[:2], states[2:]), strict=True):
                if np.isfinite(body.mass):
                    energy += sign * body.mass / 2 * (v @ v + body.gyration**2 * w @ w)
        if not wall:  # it moves, and does work
            assert found["energy_lost [J]"] == pytest.approx(energy, rel=1e-9)
        if law and alone.restitution > 0:
            radius = 0.01 if wall else bodies.effective_radius(0.01, 0.02)
            contact = bodies.effective_masses(ball, other)[1], radius, pair.effective_modulus
            (name, value), speed = *law.items(), (before[2] - before[0]) @ normal
            by_law = LAWS[name](*contact, speed, value)
            assert found["restitution"] == pytest.approx(float(by_law), rel=1e-12)
            force = bodies.peak_force(*contact, speed, alone.restitution, str(pair.loss))
            assert found["peak_normal_force [N]"] == pytest.approx(float(force), rel=1e-9)


# Powers of m, kg and s.
UNITS = {
    "[m]": (1, 0, 0),
    "[kg]": (0, 1, 0),
    "[Pa]": (-1, 1, -2),
    "[kg/m^3]": (-3, 1, 0),
    "[m/s]": (1, 0, -1),
    "[rad/s]": (0, 0, -1),
    "[J]": (2, 1, -2),
    "[N]": (1, 1, -2),
}


@pytest.mark.parametrize("exponents", [(60, -41, 17), (-7, 3, 11)])
def test_a_scene_has_no_scale(exponents):
    """A unit that is a power of two changes exponents only, but in the power law of a force."""

    def in_units(rows):
        factors = {unit: 2.0 ** float(np.dot(powers, exponents)) for unit, powers in UNITS.items()}
        units = {name: name.partition(" ")[2] for name in rows}
        return rows.assign(**{n: rows[n] * factors[unit] for n, unit in units.items() if unit})

    found, wanted = scene.solve(in_units(every_kind())), in_units(scene.solve(every_kind()))
    for name in found:
        if "force" in name:
            np.testing.assert_allclose(found[name], wanted[name], rtol=1e-13)
        else:
            np.testing.assert_array_equal(found[name], wanted[name], err_msg=name)


def test_the_result_has_the_table_and_then_what_follows():
    """Columns, their order, types and values, and the and the index."""
    rows = table(PLANE, STEEL).loc[[0] * 4].set_axis(["a", "b", "b", "c"])
    rows = rows.assign(id=["NA", None, "007", 1e5], friction=["0.3", "0.2", "1e-1", "0"])
    rows = rows.assign(colour=["red", 1, None, ()])  # which no one knows
    rows = rows.astype({"density [kg/m^3]": int, "radius [m]": "float32"})
    before = rows.copy()
    after = scene.solve(rows)
    assert list(after.columns)[: len(rows.columns)] == list(rows.columns)
    pd.testing.assert_frame_equal(after[list(rows.columns)], rows)
    pd.testing.assert_frame_equal(rows, before)
    empty = scene.solve(rows[:0])
    assert len(empty) == 0 and list(empty) == list(after)


def test_columns_may_be_sparse():
    dense = table(STEEL, PLANE)
    sparse = dense.assign(**{name: pd.arrays.SparseArray(dense[name]) for name in dense})
    assert scene.solve(sparse).iloc[0].tolist() == scene.solve(dense).iloc[0].tolist()


# States in a plane, and walls.


def test_a_plane_state_is_one_in_space():
    flat = scene.solve(table(STEEL, PLANE, OTHER, OTHER_PLANE)).iloc[0]
    state = {}
    for who, given in (("", PLANE), ("other_", OTHER_PLANE)):
        tangential, normal, spin = given.values()
        state |= dict.fromkeys([f"{who}{name}" for name in SPACE], 0.0)
        state |= {f"{who}velocity_x [m/s]": tangential, f"{who}velocity_z [m/s]": -normal}
        state |= {f"{who}spin_y [rad/s]": -spin}
    after = scene.solve(table(STEEL, OTHER, state)).iloc[0]
    contact = 0.0
    for who, sign, radius in (("", 1, 0.01), ("other_", -1, -0.02)):
        along, towards, spin = (flat[f"{who}{n.replace(' ', '_after ')}"] for n in PLANE)
        velocity = vector(after, f"{who}velocity", "m/s", "_after")
        turning = vector(after, f"{who}spin", "rad/s", "_after")
        np.testing.assert_allclose(velocity, [along, 0, -towards], rtol=1e-13)
        np.testing.assert_allclose(turning, [0, -spin, 0], rtol=1e-13)
        contact += sign * (along + radius * spin)
    assert flat["contact_velocity_after [m/s]"] == pytest.approx(contact, rel=1e-12)


WALLS = [
    ({"other_velocity_tangential [m/s]": 0.4, "other_velocity_normal [m/s]": -0.5}, 0.9 / 0.75),
    ({"other_radius [m]": 0.05, "other_spin [rad/s]": 20.0}, 2.3 / 0.6),
]


@pytest.mark.parametrize(("wall", "incidence"), WALLS, ids=["moving", "round and turning"])
def test_a_wall_is_a_body_of_infinite_mass(wall, incidence):
    """It needs no masses, and what it does not say is 0."""
    rows = table(STEEL, PLANE, wall)
    heavy = WALL | {"other_poisson_ratio": 0.2, "other_spin [rad/s]": 0.0} | wall
    moves = {name: 0.0 for name in OTHER_PLANE if "velocity" in name} | wall
    found, wanted = scene.solve(rows), scene.solve(table(STEEL, PLANE, heavy, moves))
    pd.testing.assert_frame_equal(found, wanted[found.columns], rtol=1e-13)
    assert not [name for name in found if "other" in name and "_after" in name]
    assert found["incidence"][0] == pytest.approx(incidence)


# What takes the energy.


@pytest.mark.parametrize("loss", scene.LOSSES)
def test_the_loss_is_an_option_or_a_column(loss):
    """Elastic rows do not know it, and a cell of them may be empty."""
    rows = table(STEEL, PLANE).loc[[0] * 4].assign(restitution=[0.8, 1.0, 1.0, 0.6])
    rows = rows.drop(columns="loss").reset_index(drop=True)
    option = scene.solve(rows, loss=loss)
    for cells in ([f" {loss} ", "", None, loss], pd.Categorical([loss, "", None, loss])):
        column = scene.solve(rows.assign(loss=cells))[option.columns.drop("loss")]
        pd.testing.assert_frame_equal(column, option.drop(columns="loss"), check_categorical=False)
    assert option["loss"].isna().tolist() == [False, True, True, False]
    models = [f"continuum.{loss}", "continuum", "continuum", f"continuum.{loss}"]
    assert option["model"].tolist() == models and (option[FORM][1:3] == 0).all()


@pytest.mark.parametrize("ulps", [0, 1, 2**11])
def test_elastic_is_restitution_1_alone(ulps):
    after = scene.solve(table(STEEL, PLANE, restitution=1 - ulps * 2.0**-53))
    assert after["model"].tolist() == ["continuum.viscous" if ulps else "continuum"]
    row = table(without(STEEL, *RESTITUTION), PLANE, **{"relaxation_time [s]": 0.0})
    assert scene.solve(row)["model"].tolist() == ["continuum"]


def test_forces_of_little_restitution_are_not_known():
    """They are those of the law as far as it goes, and then NaN; friction 0 has none of it."""
    e, friction = np.array([0.0, 0.021, 0.022, 0.05, 0.15, 0.15]), np.array([0.01] * 5 + [0.05])
    rows = table(STEEL, PLANE).loc[[0] * e.size].assign(restitution=e, friction=friction)
    after = scene.solve(rows)
    assert set(after["regime"]) == {"SLIP_THROUGHOUT"}
    peak = after["peak_normal_force [N]"]
    assert peak.isna().tolist() == [True, True, False, False, False, False]
    np.testing.assert_allclose(after["peak_friction_force [N]"], friction * peak, rtol=1e-13)
    # Metal that loses so much may stick, and no table has it; the fastest one slides.
    assert after[FORM].isna().tolist() == [True, True, True, True, False, True]
    smooth = scene.solve(rows.assign(friction=0.0))
    assert (smooth["peak_friction_force [N]"] == 0).all()


UNIT = 0.3 * 2.0  # mu v2(0) of the rows below [m/s]


def by_incidence(x, **more):
    rows = table(STEEL, PLANE | {"spin [rad/s]": 0.0}).loc[[0] * len(x)].drop(columns="loss")
    return rows.assign(**{"velocity_tangential [m/s]": UNIT * np.asarray(x)}, **more)


def test_model_form_is_the_distance_of_the_two_continua():
    """Where it is solved, within 0.01 mu v2(0); the run holds that by the table."""
    rows = by_incidence([2.5], restitution=0.25)
    results = [scene.solve(rows, 1e-3, loss).iloc[0] for loss in scene.LOSSES]
    viscous, plastic = (result["contact_velocity_after [m/s]"] for result in results)
    assert abs(plastic - viscous) > 0.02 * UNIT  # there is something to see
    for result in results:
        assert abs(result[FORM] - abs(plastic - viscous)) <= 0.011 * UNIT
    # One that slides throughout with viscous loss, and sticks at the end with plastic loss.
    rows = by_incidence([4.5], restitution=0.4)
    results = [scene.solve(rows, 5e-3, loss).iloc[0] for loss in scene.LOSSES]
    viscous, plastic = (result["contact_velocity_after [m/s]"] for result in results)
    assert abs(plastic - viscous) > 0.1 * UNIT
    for result in results:
        assert abs(result[FORM] - abs(plastic - viscous)) <= 0.015 * UNIT


# Methods, and what is said of them.

TABLED, TOO_COARSE, NOT_COVERED = (why for _, why in methods.CONTINUUM_WAYS)


def reported(folder, rows, **settings):
    """What `solve_file` says of a table; also the result."""
    rows.to_csv(folder / "in.csv", index=False)
    report = scene.solve_file(folder / "in.csv", folder / "out.csv", **settings)
    return report, pd.read_csv(folder / "out.csv")


def explained(folder, rows, tolerance, loss=None):
    """Counts of impacts by method, and why, as `explain` says."""
    report, _ = reported(folder, rows, tolerance=tolerance, loss=loss)
    lines = [line for line in report.explain().splitlines() if line.startswith("   ")]
    lines = [line for line in lines if "caution" not in line]
    return {tuple(re.split("  +", line.strip())) for line in lines}


def test_each_impact_gets_the_first_method_that_fits(tmp_path):
    """A formula, the table where it covers an impact and is fine enough, else the continuum."""
    e = [0.8, 0.8, 1.0, 0.2, 0.8]
    speeds = [30.0, -0.3, 0.3, 0.3, 0.3]  # the second one makes it head-on
    rows = table(STEEL, PLANE).loc[[0] * 5].assign(restitution=e)
    rows["velocity_tangential [m/s]"] = speeds
    rows["loss"] = np.where(rows["restitution"] == 0.2, "plastic", "viscous")
    formulas = {
        ("1", "slip throughout", "they slide from first to last, by Coulomb's law"),
        ("1", "head-on", "they have no tangential motion"),
    }
    assert explained(tmp_path, rows, 5e-3) == formulas | {
        ("1", "continuum, table", TABLED),
        ("1", "continuum.viscous, table", TABLED),
        ("1", "continuum.plastic, solved", NOT_COVERED),
    }
    assert "above the tolerance" in TOO_COARSE and "does not cover" in NOT_COVERED
    covered = rows.drop(columns="loss")[2::2]
    bound = spheres.ERROR_BOUND["viscous"]
    for tolerance, way, why in ((1.000001 * bound, "table", TABLED), (bound, "solved", TOO_COARSE)):
        models = ("continuum", "continuum.viscous")
        wanted = {("1", f"{model}, {way}", why) for model in models}
        assert explained(tmp_path, covered, tolerance, "viscous") == wanted


def test_explain_says_what_the_loss_and_unlike_bodies_may_cost(tmp_path, monkeypatch):
    """No model has the coupling of unlike bodies."""
    rebound = continuum.rebound

    def gives_up(*groups, loss, tolerance):
        """Off the table the other loss has no answer."""
        if loss == "plastic" and groups[0].size:
            raise ConvergenceError("it needs more steps")
        return rebound(*groups, loss=loss, tolerance=tolerance)

    monkeypatch.setattr(continuum, "rebound", gives_up)
    losses = [0.6] * 5 + [0.2, 1.0]
    rows = by_incidence([0.0, 0.5, 2.0, 3.0, 10.0, 1.0, 1.0], restitution=losses, friction=0.3)
    alike = rows.assign(**{"other_young_modulus [Pa]": 207e9, "other_poisson_ratio": 0.3})
    report, after = reported(tmp_path, alike, loss="viscous")
    form = after[FORM].to_numpy() / UNIT
    first, *_, cost = report.explain().splitlines()
    assert first == "7 impacts, tolerance 0.005" and "spread" not in report.explain()
    typical, most = np.sqrt(np.mean(form[1:4] ** 2)), form[:5].max()
    assert f"by {typical:.2g} mu v2(0) (root mean square), {most:.2g} at most: 4 imp" in cost
    assert np.isnan(form[5]) and form[6] == 0 and cost.endswith("4 impacts, not known for 1")
    for order in (alike, alike[::-1]):  # the largest difference is in another part
        parts, _ = reported(tmp_path, order, loss="viscous", chunk=2)
        assert parts.explain().splitlines()[-1] == cost
    words = reported(tmp_path, rows, loss="viscous")[0].explain()
    # Dundurs' constant is 0.286; one impact slides throughout, and one is head-on.
    assert "5  caution DISSIMILAR: the bodies spread differently under pressure" in words
    monkeypatch.undo()
    found = reported(tmp_path, rows, loss="plastic")[1]["caution"].tolist()
    both = "FRICTION|DISSIMILAR"
    assert found == ["none", both, both, both, "FRICTION", f"RESTITUTION|{both}", "DISSIMILAR"]


# Bad rows, and numbers at the ends of their range.


def test_bad_rows_are_named_or_left_out(tmp_path, monkeypatch):
    """Rows are numbered over all parts; the others have the answers of their own."""
    monkeypatch.setattr(scene, "CHUNK", 3)
    ball = without(STEEL, "density [kg/m^3]") | {"mass [kg]": 0.1, "gyration [m]": 0.006}
    good = table(ball, PLANE, restitution=1.0)
    needle = good.assign(**{"gyration [m]": 1e-7})  # the continuum needs too many steps
    kinds = {
        "good": good,
        "bad cell": good.assign(friction=-0.1),
        "needle": needle,
        "sliding needle": needle.assign(friction=1e-12),
        "parting": good.assign(**{"velocity_normal [m/s]": -2.0}),
        "second needle": needle,
    }
    rows = pd.concat(kinds, names=["kind"]).droplevel(1)
    with pytest.raises(InputError, match=r"row 2: friction = -0\.1: allowed are"):
        scene.solve(rows)
    with pytest.raises(ConvergenceError, match="row 2: .* needs .* steps"):
        scene.solve(rows.drop(["bad cell", "parting"]))
    named = rows.reset_index()
    report, after = reported(tmp_path, named, skip_bad=True, chunk=3)
    assert after["kind"].tolist() == ["good", "sliding needle"] and report.rows == 6
    assert [number for number, _ in report.bad] == [2, 3, 5, 6] and report.own == ["'kind'"]
    words = ["friction = -0.1", "the tangential oscillation needs", "approach = -2"]
    for word, (_, said) in zip([*words, words[1]], report.bad, strict=True):
        assert word in said
    wanted = scene.solve(named.iloc[[0, 3]]).reset_index(drop=True)
    pd.testing.assert_frame_equal(after, wanted, check_dtype=False, check_categorical=False)
    assert report.explain().startswith("2 impacts")
