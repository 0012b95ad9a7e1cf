"""Tables of data/ that are computed are what their generators compute."""

import pytest

from tests.reference_solutions import (
    closed_form_tables,
    continuum_tables,
    error_tables,
    exact_tables,
    inelastic_tables,
    printed_tables,
    rod_tables,
    table_files,
)

# How many rows there are to each that is computed anew; what its numbers may differ by.
GENERATORS = {
    "lumped_40_digits": (exact_tables, 4, 0.0),
    "printed_40_digits": (printed_tables, 8, 0.0),
    "closed_forms": (closed_form_tables, 4, 0.0),
    "slender_rod": (rod_tables, 4, 1.1e-10),
    "model_errors": (error_tables, 1, 1.1e-12),
    "inelastic_models": (inelastic_tables, 40, 1.1e-5),
}


# These take long; test_continuum_reference.py and tests/unit/test_trade.py have samples.
LONG = "model_errors", "inelastic_models"


@pytest.mark.slow
@pytest.mark.parametrize(
    "source",
    [pytest.param(name, marks=[pytest.mark.long] * (name in LONG)) for name in GENERATORS],
)
def test_tables_in_data_are_what_their_generator_computes(source):
    generator, *settings = GENERATORS[source]
    tables = generator.tables()
    assert {path.stem for path in (table_files.DATA / source).glob("*.csv")} == set(tables)
    for name, table in tables.items():
        path = table_files.DATA / source / f"{name}.csv"
        assert not table_files.differing(path, table, *settings), name


@pytest.mark.slow
@pytest.mark.long
def test_histories_of_the_continuum_are_what_their_generator_computes():
    """Each day the run's own comparison with them, micro_slip-continuum, would notice a change."""
    path = table_files.DATA / "elastic_continuum/micro_slip_instants.csv"
    table = continuum_tables.tables()["micro_slip_instants"]
    assert not table_files.differing(path, table, 1, 1.1e-6)


def test_a_changed_cell_is_seen(tmp_path):
    """A digit, a sign, a missing row."""
    table = exact_tables.tables()["fig3_events"]
    table_files.write(tmp_path, {"fig3": table})
    path = tmp_path / "fig3.csv"
    text = path.read_text()
    assert not table_files.differing(path, table)
    for changed in (text.replace("0.20978", "0.20979"), text.replace(",-", ",", 1), text[:-90]):
        path.write_text(changed)
        assert table_files.differing(path, table, 1, 1e-6)
