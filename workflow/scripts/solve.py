"""Solve the curves of one figure. A crash becomes a table that says so: a failed verdict."""

from stronge1994 import job, one_thread  # noqa: F401  (one thread: before numpy)
from stronge1994.curves import solving

with job.recorded(snakemake):
    wanted = snakemake.params
    solving.solve(snakemake.wildcards.figure, wanted.settings, wanted.nodes, snakemake.output[0])
