"""Fig. 6: tangential velocity at separation against incidence, for several restitutions."""

import math

import drawing

X, Y = "incidence [mu v2(0)]", "velocity [mu v2(0)]"


def draw(curves, settings, points):
    """One curve a restitution, named where it leaves the axes, and what the print has instead."""
    figure = drawing.new(3.8)
    axes = figure.subplots()
    axes.axhline(0, **drawing.GUIDE)
    ends = []
    exact = {name: curve for name, curve in curves.items() if name.startswith("e = ")}
    for index, (name, curve) in enumerate(exact.items()):
        colour, dashes = drawing.CYCLE[index % len(drawing.CYCLE)]
        axes.plot(curve[X], curve[Y], color=colour, linestyle=dashes)
        ends.append((curve[Y][-1], drawing.symbols(name), colour))
    axes.set(xlim=settings["incidence"], xlabel=drawing.INCIDENCE, ylabel=drawing.REBOUND)
    _label_ends(axes, ends)
    added = drawing.as_printed(axes, curves, X, Y, "Eqs 15, 25")
    if added:
        drawing.legend_below(figure, added, titles=("added here",))
    return figure


def _label_ends(axes, ends):
    """Names to the right of the axes, at the heights of the curves but kept apart."""
    low, high = axes.get_ylim()
    apart, last = 0.05 * (high - low), -math.inf
    for y, text, colour in sorted(ends):
        last = max(y, last + apart)
        axes.text(1.01, last, text, transform=axes.get_yaxis_transform(), va="center", color=colour)
