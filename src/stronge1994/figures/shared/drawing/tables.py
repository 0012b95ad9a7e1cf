"""Tables whose numbers a picture may show, made of those of the run before anything is drawn."""

from stronge1994.csv_tables import Curves
from stronge1994.figures.shared.drawing.house_style import Points
from stronge1994.figures.shared.drawing.words import BARS

LESS, MORE = BARS


def tables(curves: Curves, points: Points) -> Curves:
    """All tables of which a figure may show numbers: its curves, and series with their errors."""
    named = dict(curves)
    for name, series in points.items():
        if "axes" in series:
            named[name] = {}
            for which, column, sigma in zip("xy", series["axes"], series["sigma"], strict=True):
                values = series[which]
                named[name] |= {column: values, column + LESS: values - sigma}
                named[name][column + MORE] = values + sigma
    return named
