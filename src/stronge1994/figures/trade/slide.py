"""Slide of trade: a table of solved spheres beside the contact solved anew."""

from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator

from stronge1994.csv_tables import Columns, Curves
from stronge1994.figures.shared.drawing import slide
from stronge1994.figures.shared.drawing.house_style import Points, Settings
from stronge1994.figures.trade.drawing import ERROR, MODEL, RESTITUTION, shown_batch, time_column

DURATION = "time of an impact, microseconds"
DISTANCE = r"error of $v_1(t_f)/\mu v_2(0)$ against the elastic continuum, rms"
TABLE, CONTINUUM = "spheres", "continuum"
# Models that are drawn: text, colour, marker, offset of the text.
SHOWN = {
    "rigid": ("rigid", "quiet", "D", (30, 0)),
    "lumped": ("lumped model", "ink", "o", (30, -10)),
    "timestep.mindlin": ("Mindlin's law, in steps", "ink", "^", (30, 10)),
    "spline of continuum": ("spline of the continuum, one pair of bodies", "green", "*", (20, 24)),
    TABLE: ("table of solved spheres", "vermillion", "X", (24, -10)),
    CONTINUUM: ("continuum, solved", "blue", "s", (0, -24)),
}


def draw(curves: Curves, settings: Settings, points: Points, ground: slide.Ground) -> Figure:
    """Draw error against time for the first restitution and setting of some models."""
    column = time_column(batch := shown_batch(settings))
    shown: dict[str, Columns] = {}
    for row in curves.values():
        if column in row and MODEL in row and row[RESTITUTION][0] == settings["restitution"][0]:
            shown.setdefault(str(row[MODEL][0]), row)
    title = "Error and time of models of an impact"
    if {TABLE, CONTINUUM} <= set(shown):
        ratio = float(shown[CONTINUUM][column][0] / shown[TABLE][column][0])
        if shown[TABLE][ERROR][0] <= shown[CONTINUUM][ERROR][0] and ratio > 1:
            title = (
                f"A table of solved spheres is about {float(f'{ratio:.1g}'):.0f} times faster than "
                "solving the contact, and no less exact"
            )
    data = f"solved and timed here, {batch} impacts together"
    figure, axes = slide.new(title, data, ground)
    for model, (text, colour_name, marker, offset) in SHOWN.items():
        if model in shown:
            time, error = shown[model][column], shown[model][ERROR]
            colour = getattr(ground, colour_name)
            axes.plot(time, error, marker, color=colour, markersize=1.4 * slide.MARK)
            place = float(time[0]), offset, (colour, ground.paper)
            slide.name_curve(axes, text, time, error, *place)
    axes.set(xscale="log", yscale="log")
    axes.margins(0.12, 0.15)
    axes.xaxis.set_major_formatter(lambda value, _: f"{value:g}")
    axes.yaxis.set_major_locator(LogLocator(numticks=6))
    slide.name_axes(axes, DURATION, DISTANCE, ground)
    return figure
