"""Solve one table of a scene in many tables. Which model took how many impacts goes to the log."""

from stronge1994 import job, one_thread, scene_parts  # noqa: F401  (one thread: before numpy)

with job.recorded(snakemake):
    scene_parts.solve(
        snakemake.input.table,
        snakemake.output.table,
        snakemake.output.account,
        **snakemake.params.settings,
    )
