"""Files of the parameter study: NumPy's .npz, every array under its name and unit."""

import json
import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np

from planarimpact import Regime, models, study
from planarimpact.ground import checks
from planarimpact.ground.arrays import Array
from planarimpact.study import OUTPUTS
from stronge1994.csv_tables import Column

Axes: TypeAlias = dict[str, Array]
Settings: TypeAlias = dict[str, Any]  # of a model
Grid: TypeAlias = Mapping[str, Any]  # the part of the config that says where the points lie

UNITS = {
    "incidence": "mu v2(0)",
    "mass_ratio": "1",
    "stiffness_ratio": "1",
    "restitution": "1",
    "velocity": "mu v2(0)",
    "peak_friction": "mu F2max",
    "dissipation": "mu^2 m2 v2(0)^2",
    "regime": "code",
}


def column(name: str) -> str:
    """Name of an axis or output in a file, unit in brackets."""
    return f"{name} [{UNITS[name]}]"


def write(
    path: str,
    model: str,
    settings: Settings,
    axes: Axes,
    outputs: Mapping[str, Column],
    start: int = 0,
) -> None:
    """Write the outputs of a grid, or of the part of it that begins at the point `start`.

    With them: the axes in the order of the dimensions, the model and its settings, and what the
    codes of the regimes mean.
    """
    named: dict[str, Any] = {column(name): value for name, value in {**axes, **outputs}.items()}
    words: dict[str, Any] = {
        "axes": [column(name) for name in axes],
        "model": model,
        "settings": json.dumps(settings),
        "start": start,
        "regimes": [f"{regime.value} {regime.name}" for regime in Regime],
    }
    with open(path, "wb") as file:
        np.savez(file, **words, **named)


def read(path: str, *names: str) -> tuple[Axes, dict[str, Column]]:
    """Axes of a study or of a part of it, and its outputs: all, or those named."""
    with np.load(path) as file:
        axes = {name: file[column(name)] for name in checks.RULES}
        return axes, {name: file[column(name)] for name in names or OUTPUTS}


def origin(path: str) -> tuple[int, str, Settings]:
    """Number of the first point of a file, the model that solved it, and the model's settings."""
    with np.load(path) as file:
        return int(file["start"]), str(file["model"]), json.loads(str(file["settings"]))


def span(points: int, chunk: str) -> tuple[int, int]:
    """First point of a chunk, and the point after its last.

    The whole grid has so many `points`. Chunks have the names that Snakemake's scattergather gives
    them, and sizes as equal as can be.

    >>> span(10, "1-of-3"), span(10, "3-of-3")
    ((0, 3), (6, 10))
    """
    number, of = map(int, chunk.split("-of-"))
    return points * (number - 1) // of, points * number // of


def solve(chunk: str, model: str, settings: Settings, grid: Grid, path: str) -> None:
    """Solve the points of a `chunk` of a grid, such as `2-of-4`, into a file."""
    axes = study.axes_of(grid)
    start, stop = span(math.prod(map(len, axes.values())), chunk)
    outputs = study.solve(models.get(model).rebound, axes, start, stop, **settings)
    write(path, model, settings, axes, outputs, start)
    print(f"{stop - start} points of {model}, from {start} on")


def gather(chunks: Sequence[str], model: str, settings: Settings, grid: Grid, path: str) -> None:
    """Join the chunks of a grid, given in order, in one file. Chunks of another study are refused.

    Chunks of an earlier grid in the same folder are removed: nothing will read them again.
    """
    axes = study.axes_of(grid)
    outputs = study.gather(axes, (_part(chunk, model, settings, axes) for chunk in chunks))
    write(path, model, settings, axes, outputs)
    print(f"{outputs['velocity'].size} points of {model}")
    current = {Path(chunk) for chunk in chunks}
    for old in {old for chunk in current for old in chunk.parent.glob("*-of-*.npz")} - current:
        old.unlink()


def _part(path: str, model: str, settings: Settings, axes: Axes) -> tuple[int, dict[str, Column]]:
    start, *solver = origin(path)
    found, outputs = read(path)
    if not all(np.array_equal(found[name], axes[name]) for name in axes):
        raise checks.InputError(f"{path}: it belongs to another grid")
    if solver != [model, settings]:
        raise checks.InputError(
            f"{path}: solved by {solver[0]} {solver[1]}; allowed is {model} {settings}"
        )
    return start, outputs
