"""LAMMPS and pooltool in data/other_codes: the table, the picture, the script."""

import csv
import importlib.util
from pathlib import Path

import numpy as np
import pytest

from stronge1994.figures.trade import drawing

ROOT = Path(__file__).parents[2]
with open(ROOT / "data/other_codes/impacts.csv", newline="", encoding="utf-8") as _file:
    ROWS = list(csv.DictReader(_file))
RMS = "rms_velocity [mu v2(0)]"
CODES, LABELS = ("lammps", "numba", "pooltool"), ("LAMMPS", "pooltool")


def errors_of(code, e, loss):
    same = [row for row in ROWS if (row["restitution [1]"], row["loss"]) == (e, loss)]
    return [float(row[RMS]) for row in same if row["curve"].startswith(code)]


def test_a_ratio_is_a_time_over_that_of_the_table_of_spheres():
    for row in ROWS:
        ratio = float(row["time [us]"]) / float(row["table_time [us]"])
        assert float(row["times_table [1]"]) == pytest.approx(ratio, rel=0.01)


@pytest.mark.parametrize("loss", ["viscous", "plastic"])
def test_codes_are_as_far_off_as_workflow_readme_says(loss):
    lammps, (pooltool,) = (errors_of(code, "0.9", loss) for code in ("LAMMPS", "pooltool"))
    assert min(lammps) < pooltool < max(lammps) and len(lammps) == 10
    for e in ("0.7", "0.5"):
        assert max(errors_of("LAMMPS", e, loss)) < errors_of("pooltool", e, loss)[0]
    assert min(errors_of("LAMMPS", "1", "")) > errors_of("pooltool", "1", "")[0]


def test_the_picture_has_every_row_at_its_ratio_times_the_time_of_our_table():
    table = {drawing.MODEL: "spheres.viscous", drawing.E: 0.8, "loss": "viscous"}
    table |= {RMS: 1e-5, "time_100 [s]": 3e-6, "scatter_100 [1]": 0.1}
    table |= {drawing.SPREAD: 0.2, drawing.SPREAD_STICK: 0.02}
    curves = {"spheres.viscous, e = 0.8, viscous": {k: np.array([v]) for k, v in table.items()}}
    columns = {key: np.array([row[key] for row in ROWS]) for key in ROWS[0]}
    columns |= {key: columns[key].astype(float) for key in (drawing.E, RMS)}
    settings = {"restitution": [0.8], "batches": [1, 100, 10000]}
    axes = drawing.draw(curves, settings, {drawing.OTHERS: {"columns": columns}}).axes[0]
    shown = np.vstack([line.get_xydata() for line in axes.lines if line.get_label() in LABELS])
    wanted = [
        (3e-6 * float(row["times_table [1]"]), float(row[RMS]))
        for row in ROWS
        if (row["restitution [1]"], row["loss"]) == ("0.8", "viscous")
    ]
    assert shown == pytest.approx(np.array(wanted)) and len(wanted) == 11


@pytest.mark.skipif(not all(map(importlib.util.find_spec, CODES)), reason="needs both codes")
def test_both_codes_answer_so_again(monkeypatch):
    spec = importlib.util.spec_from_file_location("codes", ROOT / "data/other_codes/measure.py")
    measure = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(measure)
    times = [{f"time_{measure.BATCH} [s]": 1.0}]
    monkeypatch.setattr(measure.trade, "times", lambda watches, *_, **__: times * len(watches))
    for stored, now in zip(ROWS, measure.rows(), strict=True):
        found = dict(zip(measure.HEADER, now, strict=True))
        same = ("curve", "loss", "refused [1]", "restitution [1]")
        assert all(stored[key] == found[key] for key in same)
        assert float(stored[RMS]) == pytest.approx(float(found[RMS]), abs=1e-4)
