"""Tables of data/ that are computed are what their generators compute."""

from pathlib import Path

import closed_form_tables
import exact_tables
import printed_tables
import pytest
import table_files

ROOT = Path(__file__).parents[2]
GENERATORS = {  # and how many rows there are to each that is computed anew
    "lumped_40_digits": (exact_tables, 1),
    "printed_40_digits": (printed_tables, 8),
    "closed_forms": (closed_form_tables, 1),
}


@pytest.mark.parametrize("source", GENERATORS)
def test_tables_in_data_are_what_their_generator_computes(source):
    generator, every = GENERATORS[source]
    tables = generator.tables()
    assert {path.stem for path in (ROOT / "data" / source).glob("*.csv")} == set(tables)
    for name, table in tables.items():
        path = ROOT / "data" / source / f"{name}.csv"
        assert not table_files.differing(path, table, every), name


def test_a_changed_cell_is_seen(tmp_path):
    """A digit, a sign, a missing row."""
    table = exact_tables.tables()["fig3_events"]
    table_files.write(tmp_path, {"fig3": table})
    path = tmp_path / "fig3.csv"
    text = path.read_text()
    assert not table_files.differing(path, table)
    for changed in (text.replace("0.20978", "0.20979"), text.replace(",-", ",", 1), text[:-90]):
        path.write_text(changed)
        assert table_files.differing(path, table)
