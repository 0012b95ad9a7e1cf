"""Fig. 3: forces and tangential velocity against time, for a contact that sticks first."""

from stronge1994.figures.shared.drawing.histories import draw as draw
