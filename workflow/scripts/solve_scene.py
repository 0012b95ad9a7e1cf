"""Solve one scene. Which model took how many impacts, and why, goes to the log."""

from planarimpact.scene import files
from stronge1994 import job

with job.recorded(snakemake):
    solver = files.solve(snakemake.input.table, snakemake.output[0], snakemake.params.tolerance)
    print(solver.explain())
