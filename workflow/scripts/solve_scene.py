"""Solve one scene; which model took how many impacts, and why, goes to the log."""

import job

from planarimpact.scene import files

if "snakemake" in globals():
    with job.recorded(snakemake):  # noqa: F821
        solver = files.solve(
            snakemake.input.table,  # noqa: F821
            snakemake.output[0],  # noqa: F821
            snakemake.params.tolerance,  # noqa: F821
        )
        print(solver.explain())
