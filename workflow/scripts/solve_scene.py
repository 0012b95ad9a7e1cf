"""Solve one scene. Which model took how many impacts, and why, goes to the log."""

import sys

sys.stdout = sys.stderr = open(snakemake.log[0], "w", encoding="utf-8")

from planarimpact.scene import files

solver = files.solve(snakemake.input.table, snakemake.output[0], snakemake.params.tolerance)
print(solver.explain())
