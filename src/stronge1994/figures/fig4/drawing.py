"""Fig. 4: as Fig. 3, for a contact that slips first."""

from stronge1994.figures.shared.drawing.histories import AXIS_MEANS, LEGEND_MEANS, draw, shown

__all__ = ["AXIS_MEANS", "LEGEND_MEANS", "draw", "shown"]
