"""Solve one table of a scene in many tables. Which model took how many impacts goes to the log."""

from stronge1994 import one_thread, scene_parts  # noqa: F401  (one thread: before numpy)
from stronge1994.run import record

with record.recorded(snakemake) as settings:
    scene_parts.solve(
        snakemake.input.table,
        snakemake.output.table,
        snakemake.output.account,
        **settings,
    )
