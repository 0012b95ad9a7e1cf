"""Fig. 3: forces and tangential velocity against time, for a contact that sticks first."""

from stronge1994.figures.shared.drawing.histories import (
    AXIS_MEANS,
    LEGEND_MEANS,
    draw,
    drawn_curves,
)

__all__ = ["AXIS_MEANS", "LEGEND_MEANS", "draw", "drawn_curves"]
