"""Solve one scene. Which model took how many impacts, and why, goes to the log."""

from stronge1994 import logs

logs.to(snakemake.log[0])

from planarimpact import scene

report = scene.solve_file(snakemake.input.table, snakemake.output[0], snakemake.params.tolerance)
print(report.explain())
