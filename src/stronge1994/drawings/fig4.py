"""Fig. 4: as Fig. 3, for a contact that slips first."""

from stronge1994.drawings.histories import draw

__all__ = ["draw"]
