"""What the example scenes must come to, by mechanics in 50 digits and a second code.

The run judges every row of its scenes against these tables.
"""

import csv
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from stronge1994 import reference_data
from tests.reference_solutions import solved_tables

ROOT = Path(__file__).parents[2]
SERIES = reference_data.load_yaml(ROOT / "data/scenes_solved/source.yaml")["series"]


@pytest.mark.parametrize(
    ("name", "step"),
    [
        ("billiard_cushion", 45),
        *(pytest.param(name, 1, marks=pytest.mark.long) for name in solved_tables.SCENES),
    ],
)
def test_the_table_is_what_the_mechanics_gives(name, step):
    series = SERIES[name]
    with open(ROOT / f"data/scenes_solved/{name}.csv", newline="", encoding="utf-8") as file:
        table = pd.DataFrame(csv.DictReader(file))
    header, rows = solved_tables.scene_table(name, step)
    assert header == [*table] and series["points"] == len(table)
    anew, table = pd.DataFrame(rows, columns=header), table.iloc[::step].reset_index(drop=True)
    labels = [*series["labels"], header[len(series["labels"])]]
    assert anew[labels].equals(table[labels])
    for column, axis in zip(header[len(labels) :], series["y"], strict=True):
        assert axis["column"] == column.split(" [")[0]
        # The second code computes in floating point, which may round otherwise elsewhere.
        numbers = (frame[column].astype(float) for frame in (anew, table))
        np.testing.assert_allclose(*numbers, rtol=0, atol=axis["sigma"] / 100, err_msg=column)
