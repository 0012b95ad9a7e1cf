"""Meanings of the labels of a picture: one dictionary for axes, one for legends.

A meaning is a pattern of "curve: column". The checker of drawings looks it up.
"""

import re
from collections.abc import Mapping, Sequence
from types import ModuleType
from typing import NamedTuple

from stronge1994.figures.shared.drawing import house_style

# Endings of the names of columns with the ends of error bars.
BARS = (" - error", " + error")
_INCIDENCE = r": incidence \[(mu v2\(0\)|cell)\]"

# Labels of axes, without the letter of the panel, that several figures have. A drawing has more in
# its AXIS_MEANS. A label that is `of_column` needs no entry.
AXES = {
    "$t/t_c$": r": time \[t_c\]",
    "force": r": (normal_force|friction_force|friction_limit) ",
    house_style.INCIDENCE: _INCIDENCE,
    house_style.REBOUND: r": velocity \[mu v2\(0\)\]",
    r"angle of incidence $\theta$": r": angle \[deg\]",
    "restitution $e$": r": restitution \[(1|cell)\]",
}

# Units in mathematical letters; others are written as they are.
UNITS = {
    "mu v2(0)": r"$\mu v_2(0)$",
    "v2(0)/Omega": r"$v_2(0)/\Omega$",
    "1/Omega": r"$1/\Omega$",
    "t_c": "$t_c$",
    "sigma": r"$\sigma$",
}

# Parts of labels in a legend or at a point, as patterns; a drawing has more in its LEGEND_MEANS.
LEGEND = {
    r"^\$F_2": ": normal_force ",
    r"^\$F_1/": ": friction_(force|over_mu) ",
    "lumped model|lumped, as in the paper|^lumped$": r"^(lumped(\.hysteretic|(?!\.))|e = |mu = )",
    r"lumped, \$e\^2": r"^lumped\.unloading-stiffness",
    "lumped, (Kelvin–Voigt|viscous)": r"^lumped\.viscous",
    "elastic continuum": "^continuum[,:]",
    "continuum, rubber|^continuum$": "^continuum[,:]",
    "continuum, viscous": r"continuum\.viscous",
    "continuum, plastic": r"continuum\.plastic",
    "no tangential compliance": "^no tangential compliance",
    "Eqs .* as printed": "^as printed",
    "no solution as printed": "^no solution as printed",
    r"^normal, ": "normal",
    r"^tangential, ": "mu = |friction",
    r"^as in \(a\)": "^mu = ",
}
# Equations that name a curve, such as e = 0.5.
_EQUATION = re.compile(r"(\\?\b(?:mu|nu|e|x)) = (-?[\d.]+)")


def of_column(column: str) -> str:
    """Name of a column for a reader.

    >>> of_column("rebound_angle [deg]"), of_column("velocity [mu v2(0)]"), of_column("digits [1]")
    ('rebound angle [deg]', 'velocity [$\\\\mu v_2(0)$]', 'digits')
    """
    name, _, unit = column.rstrip("]").partition(" [")
    return name.replace("_", " ") + ("" if unit == "1" else f" [{UNITS.get(unit, unit)}]")


class Meanings(NamedTuple):
    """Meanings of the labels of one picture."""

    axes: Mapping[str, str]
    legend: Mapping[str, str]

    def is_axis(self, label: str, curve: str, column: str) -> bool:
        """Whether a column may be drawn along an axis with a label.

        >>> own = SHARED
        >>> own.is_axis("$t/t_c$", "e = 1", "time [t_c]"), own.is_axis("force", "a", "time [t_c]")
        (True, False)
        """
        if pattern := self.axes.get(label):
            return bool(re.search(pattern, f"{curve}: {column}"))
        less, more = BARS
        return label == of_column(column.removesuffix(less).removesuffix(more))

    def names_a_curve(self, text: str) -> bool:
        """Whether a part of a text has a meaning.

        >>> SHARED.names_a_curve("$e = 0.5$"), SHARED.names_a_curve("maximum compression")
        (True, False)
        """
        return bool(_EQUATION.search(text)) or any(re.search(part, text) for part in self.legend)

    def is_curve(self, text: str, curve: str, columns: Sequence[str]) -> bool:
        """Whether a text may name a curve of which these columns are drawn.

        >>> SHARED.is_curve("$e = 0.5$", "e = 0.5", []), SHARED.is_curve("$e = 0.5$", "e = 1", [])
        (True, False)
        """
        drawn = [f"{curve}: {column} " for column in columns] or [f"{curve}: "]
        asked = [pattern for part, pattern in self.legend.items() if re.search(part, text)]
        stated = {symbol.lstrip("\\"): value for symbol, value in _EQUATION.findall(text)}
        own = dict(_EQUATION.findall(curve))
        if not asked and not stated.keys() & own.keys():
            return text.split(":")[0] == curve.split(":")[0] or text in curve
        return all(own.get(symbol, value) == value for symbol, value in stated.items()) and all(
            any(re.search(pattern, one) for one in drawn) for pattern in asked
        )


SHARED = Meanings(AXES, LEGEND)


def of(*drawings: ModuleType) -> Meanings:
    """Shared meanings, and those of a drawing and of its slide."""
    axes, legend = (
        {
            key: meaning
            for drawing in drawings
            for key, meaning in getattr(drawing, kind, {}).items()
        }
        for kind in ("AXIS_MEANS", "LEGEND_MEANS")
    )
    return more(axes, legend)


def more(axes: Mapping[str, str], legend: Mapping[str, str]) -> Meanings:
    """Shared meanings, and others."""
    return Meanings({**AXES, **axes}, {**LEGEND, **legend})
