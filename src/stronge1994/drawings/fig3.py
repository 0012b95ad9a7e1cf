"""Fig. 3: forces and tangential velocity against time, for a contact that sticks first."""

from stronge1994.drawings.histories import draw

__all__ = ["draw"]
