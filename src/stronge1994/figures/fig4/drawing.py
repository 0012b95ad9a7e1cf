"""Fig. 4: as Fig. 3, for a contact that slips first."""

from stronge1994.figures.shared.drawing.histories import (
    AXIS_MEANS,
    LEGEND_MEANS,
    draw,
    drawn_curves,
)

__all__ = ["AXIS_MEANS", "LEGEND_MEANS", "draw", "drawn_curves"]
