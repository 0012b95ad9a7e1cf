"""Fig. 4: as Fig. 3, for an incidence at which the contact slips first."""

from stronge1994.figures.shared.curves.histories import curves as curves
