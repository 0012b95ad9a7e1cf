"""The grid of a parameter study: its points, its parts, its files, its checks and its picture."""

import copy
import math
import pickle
import re
from pathlib import Path

import numpy as np
import pytest

from planarimpact import Regime, continuum, lumped, models, study
from planarimpact.ground import checks
from planarimpact.ground.results import Rebound
from stronge1994 import reference_data
from stronge1994.figures.shared.drawing import house_style
from stronge1994.figures.study import drawing as draw_study
from stronge1994.figures.study import files as study_files
from stronge1994.figures.study import grid as study_plan
from stronge1994.plan import config as configuration

GRID = {
    "incidence": {"from": -1, "to": 8, "points": 7},
    "mass_ratio": [3.5],
    "stiffness_ratio": [0.5, 1.21],
    "restitution": {"from": 0, "to": 1, "points": 5},
}
COUNT = 70
WORKFLOW = Path(__file__).parents[2] / "workflow"
CONFIG = configuration.load(WORKFLOW.parent)
SCHEMA = configuration.schema()


@pytest.fixture
def axes():
    return study.axes_of(GRID)


def parts(axes, *ends):
    for start, stop in zip(ends, ends[1:], strict=False):
        yield start, study.solve(lumped.rebound, axes, start, stop)


def test_every_point_of_the_gathered_grid_is_that_impact(axes):
    """Solved alone, by its coordinates: no axis is swapped, no point is shifted."""
    found = study.gather(axes, parts(axes, 0, 1, 30, 31, COUNT))
    assert found["velocity"].shape == (7, 1, 2, 5)
    for place in np.ndindex(found["velocity"].shape):
        groups = {name: axes[name][i] for name, i in zip(axes, place, strict=True)}
        alone = lumped.rebound(**groups)
        for name in ("velocity", "peak_friction", "dissipation"):
            assert math.isclose(found[name][place], getattr(alone, name), abs_tol=1e-14)
        assert found["regime"][place] == alone.regime


def test_a_solver_that_mixes_up_points_would_be_seen(axes):
    def shifted(**groups):
        return Rebound(*(np.roll(field, 1) for field in lumped.rebound(**groups)[:4]))

    wrong = study.gather(axes, [(0, study.solve(shifted, axes, 0, COUNT))])
    right = study.gather(axes, parts(axes, 0, COUNT))
    assert not np.allclose(wrong["velocity"], right["velocity"])


def test_blocks_hide_from_the_outcome_and_bound_what_is_solved_at_once(axes, monkeypatch):
    whole = study.solve(lumped.rebound, axes, 0, COUNT)
    monkeypatch.setattr(study, "BLOCK", 8)
    sizes = []

    def counted(**groups):
        sizes.append(groups["incidence"].size)
        return lumped.rebound(**groups)

    some = study.solve(counted, axes, 5, 45)
    assert sizes == [8, 8, 8, 8, 8]
    for name, field in some.items():
        np.testing.assert_allclose(field, whole[name][5:45], rtol=1e-13, atol=1e-14)


def test_an_impact_that_cannot_be_solved_is_named_by_its_part(axes):
    def failing(**groups):
        raise checks.ConvergenceError("impact 3 went wrong")

    with pytest.raises(checks.ConvergenceError, match="points 5 to 9 of the grid: impact 3"):
        study.solve(failing, axes, 5, 9)
    with pytest.raises(checks.InputError, match=r"of the grid: restitution\[0\] = 0.0.*equal to 1"):
        study.solve(models.get("continuum").rebound, axes, 0, 9)


def test_an_unsolved_impact_of_the_continuum_keeps_its_kind_and_is_a_point_of_the_grid():
    axes = study.axes_of(GRID | {"incidence": [1, 2, 3], "restitution": 1})
    rebound = models.get("continuum").rebound
    with pytest.raises(continuum.Unsolved, match="points 4 to 6 of the grid: tolerance") as refusal:
        study.solve(rebound, axes, 4, 6, tolerance=1e-15)
    again = pickle.loads(pickle.dumps(refusal.value))
    for error in (refusal.value, again):
        assert error.impacts.tolist() == [4, 5] and str(error) == str(refusal.value)


def test_an_unsolved_impact_is_a_point_of_the_grid_in_a_later_block_too(monkeypatch):
    axes = study.axes_of(GRID | {"incidence": [1, 2, 3], "restitution": 1})
    monkeypatch.setattr(study, "BLOCK", 2)

    def rebound(incidence, *groups, **settings):
        if (incidence == 3).any():
            raise continuum.Unsolved("incidence = 3: no", np.flatnonzero(incidence == 3))
        return lumped.rebound(incidence, *groups, **settings)

    with pytest.raises(continuum.Unsolved, match="points 3 to 5 of the grid") as refusal:
        study.solve(rebound, axes, 1, 6)
    assert refusal.value.impacts.tolist() == [4]


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"restitution": [0.5, 1.5]}, r"restitution\[1\] = 1.5: allowed are numbers from 0 to 1"),
        ({"restitution": []}, r"restitution = \[\]: allowed are ascending"),
        ({"incidence": [2, 1]}, r"incidence = \[2, 1\]: allowed are ascending"),
        ({"incidence": [1, 1]}, r"incidence = \[1, 1\]: allowed are ascending"),
        ({"incidence": [[1], [2]]}, "incidence = .*: allowed are ascending"),
        ({"incidence": {"from": 8, "to": 0, "points": 3}}, "incidence = .*: allowed are ascending"),
        ({"incidence": {"from": 0, "to": 8, "points": 1}}, "incidence.points = 1: allowed are"),
        ({"incidence": {"from": 0, "to": np.nan, "points": 3}}, r"incidence\[1\] = nan"),
        ({"incidence": {"from": True, "to": 8, "points": 3}}, r"incidence = \[True, 8\]: allowed"),
        ({"stiffness_ratio": 0}, "stiffness_ratio = 0.0: allowed are finite numbers above 0"),
        ({"friction": [0.1]}, "axes = .*friction: allowed are incidence"),
        ({"incidence": {"from": 0, "to": 8}}, "incidence has .*: allowed are from, to, points"),
        (
            {"incidence": {"from": 0, "to": 8, "points": 3, "scale": "log"}},
            "incidence has .*'scale'.*: allowed are from, to, points",
        ),
        ({"incidence": {"from": 0, "to": 8, "points": 10**9}}, "points = 1000000000: allowed are"),
        ({1: [0.1]}, "axes = .*1: allowed are incidence"),
    ],
)
def test_bad_axes_are_refused(change, words):
    with pytest.raises(checks.InputError, match=words):
        study.axes_of(GRID | change)


@pytest.mark.parametrize("grid", [None, [1], "incidence", list(GRID)])
def test_what_is_no_grid_is_refused(grid):
    with pytest.raises(checks.InputError, match="axes = .*: allowed are incidence.* in a dict"):
        study.axes_of(grid)


@pytest.mark.parametrize("span", [(-1, 3), (3, 3), (3, 1), (0, COUNT + 1), (0.0, 2), (True, 2)])
def test_points_outside_the_grid_are_refused(axes, span):
    with pytest.raises(checks.InputError, match=f"points .* allowed are some of 0 to {COUNT}"):
        study.points(axes, *span)
    with pytest.raises(checks.InputError, match=f"points .* allowed are some of 0 to {COUNT}"):
        study.solve(lumped.rebound, axes, *span)


def test_parts_that_do_not_make_the_grid_are_refused(axes):
    first, second = parts(axes, 0, 30, COUNT)
    short = {name: field[:-1] for name, field in second[1].items()}
    long = {name: np.append(field, field[-1]) for name, field in second[1].items()}
    flat = second[1] | {"regime": second[1]["regime"].astype(float)}
    uneven = second[1] | {"velocity": second[1]["velocity"][1:]}
    for wrong, words in (
        ([first], "end at point 30: allowed is 70"),
        ([second, first], "starts at point 30: allowed is 0"),
        ([first, first], "starts at point 0: allowed is 30"),
        ([first, (30, short)], "end at point 69"),
        ([first, (30, long)], "the part from point 30 has .* up to 40 points"),
        ([first, (30, flat)], "the part from point 30 has .*regime .* float64"),
        ([first, (30, uneven)], "the part from point 30 has velocity"),
        ([first, second, (70, first[1])], "the part from point 70 has .* up to 0 points"),
        ([first, (30, {"velocity": np.zeros(40)})], "the part from point 30 has .*velocity"),
        ([(0, {})], r"the part from point 0 has \[\]: allowed are velocity"),
        ([(0, None)], "the part from point 0 has None: allowed are velocity"),
    ):
        with pytest.raises(checks.InputError, match=words):
            study.gather(axes, wrong)


def test_files_say_what_is_in_them(axes, tmp_path):
    chunks = [tmp_path / name for name in ("1-of-2.npz", "2-of-2.npz")]
    for chunk in chunks:
        study_files.solve(chunk.stem, "lumped", {}, GRID, chunk)
    study_files.gather(chunks, "lumped", {}, GRID, tmp_path / "study.npz")
    with np.load(tmp_path / "study.npz") as file:
        assert str(file["model"]) == "lumped"
        assert file["velocity [mu v2(0)]"].shape == tuple(len(file[name]) for name in file["axes"])
        assert list(file["axes"])[0] == "incidence [mu v2(0)]"
        assert "4 SLIP_THROUGHOUT" in file["regimes"]
    found, outputs = study_files.read(tmp_path / "study.npz")
    expected = study.gather(axes, parts(axes, 0, COUNT // 2, COUNT))
    assert all(np.array_equal(outputs[name], expected[name]) for name in expected)
    assert all(np.array_equal(found[name], axes[name]) for name in axes)
    assert sorted(path.name for path in tmp_path.iterdir()) == [
        "1-of-2.npz",
        "2-of-2.npz",
        "study.npz",
    ]


def test_a_chunk_is_solved_by_the_model_and_settings_asked_for(axes, tmp_path):
    chunk = tmp_path / "1-of-1.npz"
    study_files.solve("1-of-1", "timestep.linear", {"steps": 32}, GRID, chunk)
    _, outputs = study_files.read(chunk, "velocity")
    expected = models.rebound("timestep.linear", **study.points(axes, 0, COUNT), steps=32)
    assert np.array_equal(outputs["velocity"], expected.velocity)


@pytest.mark.parametrize(
    ("model", "settings", "grid", "words"),
    [
        ("laws.brach", {}, {"mass_ratio": [3.0]}, "it belongs to another grid"),
        ("rigid", {}, {}, "solved by rigid {}; allowed is laws.brach {}"),
        ("laws.brach", {"tangential_restitution": 0.1}, {}, "solved by laws.brach {'tangential"),
    ],
)
def test_a_chunk_of_another_study_is_refused(model, settings, grid, words, tmp_path):
    """Snakemake knows it by its parameters, unless the files came without its records."""
    chunk = tmp_path / "1-of-1.npz"
    study_files.solve("1-of-1", model, settings, GRID | grid, chunk)
    with pytest.raises(checks.InputError, match=f"1-of-1.npz: {words}"):
        study_files.gather([chunk], "laws.brach", {}, GRID, tmp_path / "study.npz")
    assert not (tmp_path / "study.npz").exists()


def changed(**study):
    config = copy.deepcopy(CONFIG)
    config["study"]["grid"] |= study.pop("grid", {})
    config["study"] |= study
    return config


def check(config):
    try:
        reference_data.refuse_invalid(config, SCHEMA, "config")
    except reference_data.SourceError as error:
        raise configuration.ConfigError(str(error)) from None
    study_plan.check(config)


@pytest.mark.parametrize(
    ("study", "words"),
    [
        ({"model": "magic"}, "study.model: 'magic' is not one of"),
        (
            {"model": "continuum"},
            r"study.grid.restitution = .*continuum is elastic; allowed is \[1",
        ),
        ({"settings": {"steps": 64}}, "study.settings.steps = 64: lumped has no settings"),
        ({"settings": {"speed": 1}}, "study.settings: .*'speed' was unexpected"),
        ({"chunks": 0}, "study.chunks: 0 is less than the minimum of 1"),
        ({"chunks": 2.0}, "study.chunks: 2.0 is not of type 'integer'"),
        ({"chunks": True}, "study.chunks: True is not of type 'integer'"),
        ({"model": "annuli", "settings": {"steps": 64.0}}, "study.settings.steps: 64.0 is not of"),
        (
            {"chunks": 3, "grid": {"incidence": [1], "restitution": [1]}},
            "study.chunks = 3: allowed are up to 2, one a point",
        ),
        ({"grid": {"friction": [0.1]}}, "study.grid: .*'friction' was unexpected"),
        ({"grid": {"incidence": {"from": 0, "to": 8, "points": 1}}}, "points: 1 is less than"),
        ({"grid": {"incidence": {"from": 0, "to": 8, "points": 1e2}}}, "points: 100.0 is not of"),
        ({"grid": {"incidence": {"from": 0, "to": 8}}}, "incidence: 'points' is a required"),
        ({"grid": {"incidence": {"from": 8, "to": 8, "points": 3}}}, "the numbers must ascend"),
        ({"grid": {"incidence": [1, 1]}}, r"study.grid.incidence = \[1, 1\]: the numbers must"),
        ({"grid": {"incidence": []}}, "study.grid.incidence: .* should be non-empty"),
        ({"grid": {"incidence": 1}}, "study.grid.incidence: 1 is not of type 'object', 'array'"),
        ({"grid": {"incidence": [math.nan]}}, "study.grid.incidence.0: nan is not a finite"),
        ({"grid": {"restitution": [0, 1.5]}}, "study.grid.restitution.1: 1.5 is greater"),
        ({"grid": {"stiffness_ratio": [0]}}, "study.grid.stiffness_ratio.0: 0 is less"),
        ({"grid": {"mass_ratio": [0.5]}}, "study.grid.mass_ratio.0: 0.5 is less"),
        (
            {"grid": {"incidence": {"from": 0, "to": 8, "points": 10**6}}},
            "study.grid: 402000000 points; allowed are up to 100000000",
        ),
    ],
)
def test_a_bad_study_is_refused(study, words):
    with pytest.raises(configuration.ConfigError, match=words):
        check(changed(**study))


def test_what_the_config_may_name_is_what_there_is():
    known = SCHEMA["properties"]["study"]["properties"]
    assert known["model"]["enum"] == list(models.MODELS)
    settings = {name for model in models.MODELS.values() for name in model.settings}
    assert set(known["settings"]["properties"]) == settings
    elastic = [name for name, model in models.MODELS.items() if model.restitution == (1.0, 1.0)]
    assert list(study_plan.ELASTIC) == elastic
    assert set(known["grid"]["properties"]) == set(checks.RULES)


def test_chunks_cover_the_grid_once_and_axes_left_out_are_shared():
    points = study_plan.count(changed())
    assert points == 321 * 201 * 2
    for chunks in (1, 3, 4, 97):
        spans = [study_files.span(points, f"{i}-of-{chunks}") for i in range(1, chunks + 1)]
        assert [start for start, _ in spans] == [0] + [stop for _, stop in spans[:-1]]
        assert spans[-1][1] == points
    assert study_plan.settings(changed())["grid"]["mass_ratio"] == [CONFIG["mass_ratio"]]
    check(changed(model="continuum", settings={"tolerance": 1e-3}, grid={"restitution": [1]}))


@pytest.mark.parametrize(
    ("grid", "maps"),
    [
        ({}, 2),
        ({"incidence": [8.0, 9.0]}, 2),
        ({"mass_ratio": [1.0, 2, 3, 4]}, 6),
        ({"restitution": [1.0], "stiffness_ratio": [1.0]}, 1),
        ({"incidence": [1.0], "restitution": [1.0], "stiffness_ratio": [1.0]}, 1),
    ],
)
def test_a_map_is_drawn_for_every_slice_up_to_six(grid, maps):
    axes = study.axes_of(GRID | grid)
    count = math.prod(map(len, axes.values()))
    found = study.gather(axes, [(0, study.solve(lumped.rebound, axes, 0, count))])
    figure, _ = draw_study.draw(axes, found["velocity"], found["regime"])
    figure.draw_without_rendering()
    titled = [panel for panel in figure.axes if panel.get_title()]
    assert len(titled) == maps
    ends = [[f"{axes[name][i]:g}" for name in ("mass_ratio", "stiffness_ratio")] for i in (0, -1)]
    for panel, values in zip((titled[0], titled[-1]), ends, strict=True):
        assert re.findall(r" = (\S+?)(?:,|$)", panel.get_title())[:2] == values


def map_of(velocity, regime):
    """The panel of a map over incidence and restitution."""
    grid = {name: np.array([1.0]) for name in checks.RULES}
    columns, rows = velocity.shape
    grid |= {"incidence": np.arange(float(columns)), "restitution": np.linspace(0, 1, rows)}
    shape = (columns, 1, 1, rows)
    return draw_study.draw(grid, velocity.reshape(shape), regime.reshape(shape))[0].axes[0]


def test_a_map_shows_where_velocity_is_negative_without_colours():
    velocity = np.linspace(-1, 1, 20)[:, None] * np.ones(20)
    regime = np.full((20, 20), Regime.STICK_SLIP)
    (hatched,) = map_of(velocity, regime).findobj(_is_hatched)
    (area,) = hatched.get_paths()
    assert area.get_extents().intervalx.tolist() == [0, 9.5]
    assert not map_of(velocity + 2, regime).findobj(_is_hatched)


def test_a_study_along_one_axis_is_a_curve():
    grid = {name: np.array([1.0]) for name in checks.RULES} | {"stiffness_ratio": np.arange(3.0)}
    velocity = np.array([1.0, -1, 2])
    shape = (1, 1, 3, 1)
    panel = draw_study.draw(grid, velocity.reshape(shape), np.zeros(shape))[0].axes[0]
    assert panel.get_lines()[-1].get_xydata().tolist() == [[0, 1], [1, -1], [2, 2]]
    assert panel.get_xlabel() == draw_study.LABELS["stiffness_ratio"]


def _is_hatched(artist):
    return any(getattr(artist, "hatches", None) or [])


def test_a_map_names_a_regime_where_there_is_room_and_draws_a_boundary_once():
    regime = np.full((40, 40), Regime.SLIP_THROUGHOUT)
    regime[:20] = Regime.STICK_SLIP
    regime[20:22] = Regime.SLIP_STICK_SLIP  # a line, but no room for a name
    regime[:1] = Regime.STICK  # the edge of the grid: neither
    panel = map_of(np.ones((40, 40)), regime)
    assert (panel.get_xlabel(), panel.get_ylabel()) == (house_style.INCIDENCE, "restitution $e$")
    assert [text.get_text() for text in panel.texts] == ["stick-\nslip", "slip\nthroughout"]
    paths = [path for lines in panel.collections[1:] for path in lines.get_paths()]
    assert [sorted(set(path.vertices[:, 0])) for path in paths] == [[19.5], [21.5]]
