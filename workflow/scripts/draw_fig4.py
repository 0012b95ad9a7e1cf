"""Fig. 4: as Fig. 3, for a contact that slips first."""

from draw_fig3 import draw

__all__ = ["draw"]
