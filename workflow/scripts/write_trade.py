"""Write error against time as two tables: every way sorted, and which model for which tolerance."""

import csv_tables
import job
import trade_table


def write(curves, table, cheapest):
    """Read the `curves` of the figure, write both tables; what a crash left goes into both."""
    rows = csv_tables.read_rows(curves)
    if "error" in rows[0]:
        for path in (table, cheapest):
            csv_tables.write_rows(path, ["error"], [[rows[0]["error"]]])
        return
    every = [{"name": row.pop("curve"), **row} for row in trade_table.ordered(map(dict, rows))]
    for path, found in ((table, every), (cheapest, trade_table.which_model(rows))):
        csv_tables.write_rows(path, list(found[0]), [list(row.values()) for row in found])


if "snakemake" in globals():
    with job.recorded(snakemake):  # noqa: F821
        write(
            snakemake.input.curves,  # noqa: F821
            snakemake.output.table,  # noqa: F821
            snakemake.output.answers,  # noqa: F821
        )
