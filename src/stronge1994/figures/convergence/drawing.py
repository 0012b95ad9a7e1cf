"""Beyond the paper: error of two methods for the continuum against resolution and time."""

from matplotlib.figure import Figure

from stronge1994.csv_tables import Curves
from stronge1994.figures.shared.drawing import house_style
from stronge1994.figures.shared.drawing.house_style import Points, Settings

ERROR, ORDER, TIME = "error [mu v2(0)]", "observed_order [1]", "time [ms]"
# A colour for each method.
SPRINGS, ANNULI = house_style.BLACK, house_style.GREEN
CURVES = {
    "row of springs": ("steps [1]", SPRINGS, "o"),
    "row of springs, extrapolated": ("steps [1]", SPRINGS, "s"),
    "annuli, circles": ("circles [1]", ANNULI, "^"),
    "annuli, steps": ("steps [1]", ANNULI, "v"),
}
# Meanings of labels, see `shared.drawing.words`.
AXIS_MEANS = {
    "steps or circles": r": (steps|circles) \[1\]",
    "time of an impact (ms)": r": time \[ms\]",
    r"error of $v_1(t_f)/\mu v_2(0)$": r": error \[mu v2\(0\)\]",
}


def drawn_curves(curves: Curves, settings: Settings, points: Points) -> Curves:
    """Times in milliseconds."""
    return {
        name: curve | ({TIME: 1e3 * curve["time [s]"]} if "time [s]" in curve else {})
        for name, curve in curves.items()
    }


def draw(curves: Curves, settings: Settings, points: Points) -> Figure:
    """Draw the error (a) against the number that is varied, (b) against the time of an impact."""
    figure = house_style.new(3.6)
    by_number, by_time = figure.subplots(1, 2, sharey=True)
    entries = []
    for (name, (number, colour, marker)), dashes in house_style.patterned(CURVES.items()):
        curve = curves[name]
        style = {"color": colour, "linestyle": dashes, "marker": marker, "markerfacecolor": "white"}
        label = f"{name}: order {curve[ORDER][0]:.1f}"
        entries += by_number.loglog(curve[number], curve[ERROR], label=label, **style)
        by_time.loglog(curve[TIME], curve[ERROR], **style)
    by_number.set(xlabel="(a) steps or circles", ylabel=r"error of $v_1(t_f)/\mu v_2(0)$")
    by_time.set_xlabel("(b) time of an impact (ms)")
    fixed = settings["fixed"]
    kept = f"{fixed['circles']} circles where steps vary, {fixed['steps']} steps where circles do"
    figure.suptitle(f"annuli: {kept}", fontsize=house_style.NOTE)
    groups = entries[:2], entries[2:]
    titles = "method of dimensionality reduction", "concentric annuli"
    house_style.legend_below(figure, *groups, titles=titles)
    return figure
