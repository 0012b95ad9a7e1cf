"""Collisions by the table of spheres, in C and JavaScript.

Both evaluate as `planarimpact.spheres` does: the same operations in the same order. Restitution by
speed is written with roots alone, as the last digit of other powers differs between languages.
Numbers are stored as in the shipped file: whole numbers, each times a power of 1/2.
"""

import base64
import re
from collections.abc import Mapping
from importlib import resources
from typing import NamedTuple

import numpy as np

from planarimpact import __version__, spheres
from planarimpact.export import languages, presets
from planarimpact.ground import checks
from planarimpact.ground.arrays import Array, Integers
from planarimpact.ground.results import Regime
from planarimpact.normal_impact import LEAST_RESTITUTION, LOSSES, kelvin_voigt
from planarimpact.spheres import table as tables
from planarimpact.spheres.table import LEFT, ORDER, PACKED, RIGHT, ROOTS, Table

# Largest errors of the shipped tables by loss, and the tables by the larger of them.
BOUNDS = {"fine": spheres.ERROR_BOUND, "coarse": {"viscous": 3e-3, "plastic": 4e-2}}
TABLES: dict[float, str] = {max(bounds.values()): name for name, bounds in BOUNDS.items()}


class _Layout(NamedTuple):
    """The table as the code has it: fields of panels, rows of patches, and edges and splines."""

    panels: list[list[int]]
    patches: Integers
    values: list[Integers]


def text(table: Table, bounds: Mapping[str, float], file: str, name: str, language: str) -> str:
    """The file of a table with its largest errors by loss; for names see `pair.text`."""
    layout = _laid_out(table)
    blocks: dict[str, languages.Block] = {
        "version": [f"Written by planarimpact {__version__}. Do not edit it: write it anew."],
        "about": _about(name, language),
        "public": _public(bounds),
        "private": _private(table),
        "limits": table.limits,
        "panels": layout.panels,
        "patches": layout.patches,
        "series": _series(),
        "presets": presets.code(name, language),
    }
    if language == "js":
        blocks["shapes"] = [list(part.shape) for part in layout.values]
        blocks["packed"] = _packed(layout.values)
    else:
        blocks["values"] = np.concatenate([part.ravel() for part in layout.values])
    return languages.filled("spheres", blocks, file, name, language)


def _laid_out(table: Table) -> _Layout:
    """Panels one after the other."""
    panels: list[list[int]] = []
    patches: list[tuple[int, int, int]] = []
    values: list[Integers] = []
    for name, panel in table.panels.items():
        over_t, over_u = panel.velocity.shape[1:]
        varying, rows, columns = panel.edges.shape
        row = [len(patches), len(ROOTS[name]), varying, rows - 1, columns - 1, over_t, over_u]
        for field in PACKED:
            part = tables.whole(getattr(panel, field), table.exponent)
            row.append(sum(map(np.size, values)) if part.size else -1)
            values += [part] if part.size else []
        panels.append(row)
        first = np.cumsum([0, *panel.intervals + ORDER - 1])
        patches += zip(ROOTS[name], panel.intervals.tolist(), first.tolist(), strict=False)
    return _Layout(panels, np.array(patches, np.int32), values)


def _public(bounds: Mapping[str, float]) -> dict[str, float]:
    """Public constants: losses, range, errors and the codes of regimes."""
    return {
        # 0 is none of them, so that a loss which nobody states is not taken for one.
        **{loss.upper(): code for code, loss in enumerate(LOSSES, 1)},
        "INCIDENCE_MAX": checks.LARGEST,
        "RESTITUTION_MIN": spheres.LEAST_RESTITUTION,
        "STIFFNESS_MAX": spheres.LARGEST_STIFFNESS,
        "RATIO_MIN": spheres.LEAST_RATIO,
        "RATIO_MAX": spheres.LARGEST_RATIO,
        **{f"ERROR_{loss.upper()}": bound for loss, bound in bounds.items()},
        **{regime.name: regime.value for regime in Regime},
    }


def _private(table: Table) -> dict[str, float]:
    """Constants that the functions use."""
    return {
        "B_LEAST": tables.B_LEAST,
        "B_SPAN": tables.B_MOST - tables.B_LEAST,
        "E_LEAST": tables.E_LEAST,
        "E_SPAN": 1 - tables.E_LEAST,
        "UNIT": 2.0**-table.exponent,
        "INCIDENCE_LEAST": checks.LEAST_INCIDENCE,
        "MASS_RATIO_MOST": checks.LARGEST,
        "STIFFNESS_MOST": spheres.LARGEST_STIFFNESS * (1 + spheres.ROUNDING),
        "RATIO_LEAST": spheres.LEAST_RATIO * (1 - spheres.ROUNDING),
        "RATIO_MOST": spheres.LARGEST_RATIO * (1 + spheres.ROUNDING),
        "NEARLY": tables.NEARLY,
        "LEFT": LEFT,
        "RIGHT": RIGHT,
        "INTERVALS": table.limits.shape[1] - 1,
        "LEAST": LEAST_RESTITUTION,
        "LONGEST": float(kelvin_voigt.relaxation_time(np.array(LEAST_RESTITUTION))),
        "SERIES": len(_series()),
        "SPAN": float(kelvin_voigt.series().domain[1]),
        "LENGTH_ERROR": checks.LENGTH_ERROR,
    }


def _series() -> Array:
    """Viscous restitution over the root of the relaxation time, from 0 to SPAN."""
    return np.asarray(kelvin_voigt.series().trim(kelvin_voigt.SMALL_TERM).coef, float)


def _about(name: str, language: str) -> list[str]:
    """What the head of every file says; @ stands before names."""
    text = resources.files(__package__).joinpath("templates/spheres.txt").read_text("utf-8")
    prefix = f"{name}_" if languages.LANGUAGES[language].named else ""

    def named(match: re.Match[str]) -> str:
        return (prefix.upper() if match[1].isupper() else prefix) + match[1]

    return re.sub(r"@(\w+)", named, text).splitlines()


def _packed(values: list[Integers]) -> str:
    """The values for JavaScript, as `unfolded` reads them: small differences take one byte."""
    steps = np.concatenate([tables.steps(part).ravel() for part in values]).astype(np.int64)
    bits = np.where(steps < 0, -2 * steps - 1, 2 * steps)[:, None] >> 7 * np.arange(5)
    goes_on = bits[:, 1:] > 0
    digits = bits % 128
    digits[:, :-1] += 128 * goes_on
    used = np.pad(goes_on, ((0, 0), (1, 0)), constant_values=True)
    return base64.b64encode(digits[used].astype(np.uint8).tobytes()).decode()
