"""Styles and labels of five models of an impact that loses energy.

A colour stands for the cause of the loss: black for the normal element of the paper, vermillion for
plastic flow, blue for viscosity.
"""

from typing import NamedTuple

from stronge1994.figures.shared.drawing import house_style
from stronge1994.figures.shared.drawing.house_style import Dashes, Style


class Model(NamedTuple):
    """Style and label of a model."""

    label: str
    colour: str
    dashes: Dashes
    marker: str

    @property
    def line(self) -> Style:
        """Its line."""
        return {"color": self.colour, "linestyle": self.dashes, "linewidth": 1.1}


MODELS = {
    name: Model(label, colour, dashes, marker)
    for (name, label, colour, marker), dashes in house_style.patterned(
        (
            ("lumped.hysteretic", "lumped, as in the paper", house_style.BLACK, "o"),
            ("lumped.unloading-stiffness", r"lumped, $e^2\zeta^2$", house_style.VERMILLION, "D"),
            ("lumped.viscous", "lumped, Kelvin–Voigt", house_style.BLUE, "s"),
            ("continuum.plastic", "continuum, plastic", house_style.VERMILLION, "^"),
            ("continuum.viscous", "continuum, viscous", house_style.BLUE, "v"),
        )
    )
}
