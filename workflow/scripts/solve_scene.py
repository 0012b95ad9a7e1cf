"""Solve one scene. Which model took how many impacts, and why, goes to the log."""

from stronge1994.run import record

with record.recorded(snakemake) as tolerance:
    from planarimpact.scene import files

    solver = files.solve(snakemake.input.table, snakemake.output.table, tolerance)
    print(solver.explain())
