"""Tables of curves: what is written is read again; tests/refusals has what is none."""

import numpy as np
import pandas as pd

from stronge1994 import tables


def test_a_table_is_read_as_it_was_written_to_the_last_bit(tmp_path):
    bits = np.random.default_rng(1).integers(0, 2**64, 20_000, dtype=np.uint64).view(float)
    numbers = np.concatenate([[-0.0, 5e-324, 2.0**53, 1e22, 0.1], bits[np.isfinite(bits)]])
    first = {"x [1]": numbers, "event": np.where(numbers > 0, "NA", "")}
    table = tables.join(
        [
            tables.curve(first, "lumped", "007", e=0.1 + 0.2),
            tables.curve({"x [1]": [1.0], "own [N]": [2.0]}, "continuum", nu=0.3),
        ]
    )
    tables.write(tmp_path / "a.csv", table)
    again = tables.read(tmp_path / "a.csv")
    pd.testing.assert_frame_equal(again, table, check_exact=True, check_like=True)
    found = again["x [1]"].to_numpy()[: len(numbers)]
    assert np.array_equal(found.view(np.uint64), numbers.view(np.uint64))  # also the sign of 0
