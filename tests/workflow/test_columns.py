"""Every column that a run judges is held by something independent: none can be scaled or flipped.

Also what the table of gates says of the smallest changes.
"""

from pathlib import Path

import compare
import csv_tables
import judged_tables
import pytest
import reference_data
import run_plan
import sensitivity

ROOT = Path(__file__).parents[2]
SCHEMAS = ROOT / "workflow/schemas"
CONFIG = reference_data.load_yaml(ROOT / "workflow/config.yaml")
INVENTORY = reference_data.load_all(
    ROOT / "data", reference_data.load_yaml(SCHEMAS / "source.schema.yaml")
)
# Columns that nothing holds, and why.
NOT_HELD = {
    "time [s]": "measured on this machine",
}


def _judged(name, path, series):
    """Rows of what is judged under a name."""
    return compare.compare(
        name,
        run_plan.comparisons(CONFIG, name),
        run_plan.references(CONFIG, INVENTORY, name),
        path,
        series,
        CONFIG["significance"],
    )


@pytest.fixture(scope="module")
def tables(first_run):
    """Folder of a finished run, and where its series are."""
    folder = first_run[0].folder
    return folder, {name: folder / f"results/series/{name}.csv" for name in INVENTORY}


def _columns(name, curves):
    """What can be wrong: curves and columns of numbers that are not all 0."""
    for curve, columns in curves.items():
        for column, values in columns.items():
            held = column not in NOT_HELD and values.dtype.kind == "f" and values.any()
            if held and "1 sigma" not in curve:  # that only says how uncertain another curve is
                yield curve, column


@pytest.mark.parametrize("name", run_plan.judged(CONFIG))
@pytest.mark.parametrize("factor", [1.3, -1.0])
def test_no_column_can_be_scaled_or_flipped(name, factor, tables, monkeypatch):
    folder, series = tables
    path = folder / run_plan.table_of(name)
    curves, missed = judged_tables.read(path), []
    for curve, column in _columns(name, curves):
        wrong = curves | {curve: curves[curve] | {column: factor * curves[curve][column]}}
        monkeypatch.setattr(judged_tables, "read", lambda _, wrong=wrong: wrong)
        if all(row["verdict"] != "diverges" for row in _judged(name, path, series)):
            missed.append((curve, column))
    assert missed == []
