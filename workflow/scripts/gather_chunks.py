"""Put the chunks of the parameter study together."""

import job
import numpy as np
import study_files

from planarimpact import checks, study


def gather(chunks, model, grid, path):
    """Read chunks of a grid, in order, into one file; a chunk of another grid is refused."""
    axes = study.axes_of(grid)
    outputs = study.gather(axes, (_part(chunk, axes) for chunk in chunks))
    study_files.write(path, model, axes, outputs)
    print(f"{outputs['velocity'].size} points of {model}")


def _part(path, axes):
    found, outputs = study_files.read(path)
    if not all(np.array_equal(found[name], axes[name]) for name in axes):
        raise checks.InputError(f"{path}: it belongs to another grid")
    return study_files.first_point(path), outputs


if "snakemake" in globals():
    with job.log_to(snakemake.log[0]):  # noqa: F821
        gather(
            snakemake.input.chunks,  # noqa: F821
            snakemake.params.settings["model"],  # noqa: F821
            snakemake.params.settings["grid"],  # noqa: F821
            snakemake.output[0],  # noqa: F821
        )
