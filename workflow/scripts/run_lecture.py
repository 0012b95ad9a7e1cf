"""Run one notebook; keep it executed, as a page, as slides and as a sheet of answers."""

from stronge1994.run import record

with record.recorded(snakemake):
    from stronge1994 import (
        csv_tables,
        one_thread,  # noqa: F401  (one thread: before numpy)
    )
    from stronge1994.pages import lectures

    given = snakemake.input
    for table in given.tables:
        csv_tables.read_rows(table)  # the job that failed to make it has told the fault
    lectures.run(given.notebook, {"page": given.page, "slides": given.slides}, snakemake.output)
