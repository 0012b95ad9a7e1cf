"""Solve one chunk of the parameter study."""

import one_thread  # noqa: F401

# isort: split
import job
import study_files

from planarimpact import ladder, study


def solve(chunk, model, settings, grid, path):
    """Solve the points of a `chunk`, `start-stop`, of a grid into a file."""
    start, stop = map(int, chunk.split("-"))
    axes = study.axes_of(grid)
    outputs = study.solve(ladder.get(model).rebound, axes, start, stop, **settings)
    study_files.write(path, model, settings, axes, outputs, start)
    print(f"{stop - start} points of {model}, from {start} on")


if "snakemake" in globals():
    with job.recorded(snakemake):  # noqa: F821
        solve(
            snakemake.wildcards.chunk,  # noqa: F821
            **snakemake.params.settings,  # noqa: F821
            path=snakemake.output[0],  # noqa: F821
        )
