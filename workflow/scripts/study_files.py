"""Files of the parameter study: NumPy's .npz, every array under its name and unit."""

import json

import numpy as np

from planarimpact import Regime, checks, whole_files
from planarimpact.study import OUTPUTS

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


def column(name):
    """Name of an axis or output in a file, unit in brackets."""
    return f"{name} [{UNITS[name]}]"


def write(path, model, settings, axes, outputs, start=0):
    """Write the outputs from the point `start` of a grid on, whole or not at all.

    With them: the axes in the order of the dimensions, the model and its settings, and what the
    codes of the regimes mean.
    """
    named = {column(name): value for name, value in (axes | outputs).items()}
    words = {
        "axes": [column(name) for name in axes],
        "model": model,
        "settings": json.dumps(settings),
        "start": start,
        "regimes": [f"{regime.value} {regime.name}" for regime in Regime],
    }
    with whole_files.written(path) as partial, open(partial, "wb") as file:
        np.savez(file, **words, **named)


def read(path, *names):
    """Axes of a study or of a chunk of it, and its outputs or those of some `names`."""
    with np.load(path) as file:
        axes = {name: file[column(name)] for name in checks.RULES}
        return axes, {name: file[column(name)] for name in names or OUTPUTS}


def origin(path):
    """Number of the first point in a file, the model that solved it, and its settings."""
    with np.load(path) as file:
        return int(file["start"]), str(file["model"]), json.loads(str(file["settings"]))
