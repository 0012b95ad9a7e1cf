"""LAMMPS and pooltool: an optional target that says what is missing, and rows like the trade's."""

import numpy as np
import pytest

from planarimpact import lumped
from planarimpact.models import timestep
from stronge1994 import csv_tables
from stronge1994.curves import trade
from stronge1994.drawings import peers as draw_peers
from stronge1994.trade import measurement, peers

SETTINGS = {
    "mass_ratio": 3.5,
    "stiffness_ratio": 1.21,
    "incidence": [0.0, 8.0],
    "samples": 9,
    "restitution": [1.0, 0.5],
    "tolerance": 1e-3,
}
TRIED = {"steps": [16, 64], "circles": [4], "tolerances": [1e-2], "batches": [1, 1000]}


@pytest.fixture
def pretended(monkeypatch):
    """Both codes, as if installed: our own models under their names; pooltool refuses x = 0."""

    def thrown(x, law, steps, poisson_ratio):
        zeta2 = (2 - poisson_ratio) / (2 * (1 - poisson_ratio))
        return timestep.mindlin(x, 3.5, zeta2, steps=steps).velocity, 2e-3, 5e-3

    def resolved(x, restitution, mass_ratio, stiffness_ratio):
        found = lumped.rebound(x, mass_ratio, stiffness_ratio, restitution).velocity
        return np.where(np.asarray(x) > 0, found, np.nan), 1e-3

    monkeypatch.setattr(peers, "missing", lambda code: [])
    monkeypatch.setattr(peers, "lammps_impacts", thrown)
    monkeypatch.setattr(peers, "pooltool_impacts", resolved)
    monkeypatch.setattr(trade, "ENOUGH", 0.01)


def test_without_them_the_target_succeeds_and_says_so(finished):
    if not (peers.missing("lammps") and peers.missing("pooltool")):
        pytest.skip("they are installed here")
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
    assert (finished / "figures/trade_with_peers.svg").stat().st_size > 1000


def test_rows_have_errors_times_and_what_was_refused(pretended):
    rows, notes = measurement.measure(**SETTINGS)
    assert not notes
    ours = rows["timestep.mindlin, 64 steps, e = 1"]
    theirs = rows["LAMMPS mindlin/force, 64 steps, e = 1"]
    assert theirs["rms_velocity [mu v2(0)]"][0] == pytest.approx(ours["rms_velocity [mu v2(0)]"][0])
    assert theirs["time_1000 [s]"][0] == pytest.approx(2e-6)
    assert theirs["build_time [s]"][0] == pytest.approx(3e-3)
    assert theirs["time_over_ours [1]"][0] == pytest.approx(2e-6 / ours["time_1000 [s]"][0])
    for e in ("1", "0.5"):
        row = rows[f"pooltool, e = {e}"]
        assert row["refused [1]"] == [1]
        assert row["max_velocity [mu v2(0)]"][0] == pytest.approx(
            rows[f"lumped, e = {e}"]["max_velocity [mu v2(0)]"][0]
        )
    known = {"model", "installed"}
    assert all("[" in key for row in rows.values() for key in row if key not in known)


def test_bodies_that_lammps_does_not_have_are_named(pretended):
    for change, words in (
        ({"mass_ratio": 2.0}, "mass_ratio = 2: it has solid spheres"),
        ({"stiffness_ratio": 2.5}, "stiffness_ratio = 2.5: no material"),
    ):
        rows, notes = measurement.measure(**SETTINGS | change)
        assert len(notes) == 1 and notes[0].startswith("lammps: ") and words in notes[0]
        assert "pooltool, e = 0.5" in rows


def test_figure_has_their_points_and_names_what_is_missing(pretended, tmp_path):
    settings = {**SETTINGS, **TRIED, "budget": 10.0}
    tables = {
        "curves": trade.curves(**settings),
        "peers": measurement.measure(**SETTINGS)[0],
        "none": {"pooltool": {"model": ["pooltool"], "installed": ["no"]}},
    }
    for name, named in tables.items():
        csv_tables.write(tmp_path / f"{name}.csv", named)
    read = {path.stem: csv_tables.read(path) for path in tmp_path.glob("*.csv")}
    figure = draw_peers.draw(read["curves"], read["peers"], settings)
    assert "not installed" not in figure.get_suptitle()
    legends = [axes.get_legend() for axes in figure.axes if axes.get_legend()]
    labels = {text.get_text() for legend in legends for text in legend.get_texts()}
    assert {"LAMMPS, in (c)", "pooltool", "mindlin/force"} <= labels
    figure = draw_peers.draw(read["curves"], read["none"], settings)
    assert "not installed: pooltool" in figure.get_suptitle()


def test_poisson_ratio_is_that_of_the_stiffness_ratio():
    for nu in (0.0, 0.3, 0.5):
        assert peers.poisson_ratio_of((2 - nu) / (2 * (1 - nu))) == pytest.approx(nu)
    for ratio in (0.7, 1.51):
        with pytest.raises(ValueError, match="no material"):
            peers.poisson_ratio_of(ratio)
