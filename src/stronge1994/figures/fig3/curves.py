"""Fig. 3: forces and tangential velocity against time, for a contact that sticks first."""

from stronge1994.figures.shared.curves.histories import curves as curves
