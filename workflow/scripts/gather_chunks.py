"""Put the chunks of the parameter study together."""

from pathlib import Path

import job
import numpy as np
import study_files

from planarimpact import checks, study


def gather(chunks, model, settings, grid, path):
    """Read chunks of a grid, in order, into one file; a chunk of another study is refused.

    Chunks of an earlier grid, which lie beside them, are removed: nothing will read them again.
    """
    axes = study.axes_of(grid)
    outputs = study.gather(axes, (_part(chunk, model, settings, axes) for chunk in chunks))
    study_files.write(path, model, settings, axes, outputs)
    print(f"{outputs['velocity'].size} points of {model}")
    current = {Path(chunk) for chunk in chunks}
    for path in {path for chunk in current for path in chunk.parent.glob("[0-9]*-*.npz")} - current:
        path.unlink()


def _part(path, model, settings, axes):
    start, *solver = study_files.origin(path)
    found, outputs = study_files.read(path)
    if not all(np.array_equal(found[name], axes[name]) for name in axes):
        raise checks.InputError(f"{path}: it belongs to another grid")
    if solver != [model, settings]:
        raise checks.InputError(
            f"{path}: solved by {solver[0]} {solver[1]}; allowed is {model} {settings}"
        )
    return start, outputs


if "snakemake" in globals():
    with job.recorded(snakemake):  # noqa: F821
        gather(
            snakemake.input.chunks,  # noqa: F821
            **snakemake.params.settings,  # noqa: F821
            path=snakemake.output[0],  # noqa: F821
        )
