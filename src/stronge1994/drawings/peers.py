"""The figure of error against time with points of LAMMPS and pooltool."""

from collections.abc import Mapping

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from stronge1994 import csv_tables
from stronge1994.csv_tables import Curves
from stronge1994.drawings import house_style
from stronge1994.drawings import trade as draw_trade
from stronge1994.drawings.house_style import Settings

CODES = {"lammps": "LAMMPS", "pooltool": "pooltool"}
OTHER = draw_trade.Family("", "X", 5, house_style.BLACK, False, draw_trade.ABOVE)
# The laws of LAMMPS lie together in panel (a). Panel (c) shows them apart, beside our models.
LAWS = {
    "LAMMPS mindlin": OTHER._replace(marker="<", label="mindlin", place=draw_trade.RIGHT),
    "LAMMPS mindlin/force": OTHER._replace(marker="^", label="mindlin/force"),
    "LAMMPS mindlin_rescale": OTHER._replace(marker=">", label="mindlin_rescale"),
    "LAMMPS mindlin_rescale/force": OTHER._replace(marker="v", label="mindlin_rescale/force"),
}
OURS = ("timestep.mindlin", "timestep.mindlin_rescaled")
TOGETHER = OTHER._replace(marker="+", label="LAMMPS, in (c)", place=None)
POOLTOOL = OTHER._replace(label="pooltool", place=draw_trade.LEFT)


def draw(curves: Curves, peers: Curves, settings: Settings) -> Figure:
    """Draw figure `trade` with the other codes; its title names those that are not installed.

    Parameters
    ----------
    curves : dict
        Of results/curves/trade.csv.
    peers : dict
        Of results/peers.csv.
    settings : dict
        Of the figure `trade`.
    """
    codes = dict.fromkeys(LAWS, TOGETHER) | {"pooltool": POOLTOOL}
    theirs = {
        name: row
        for name, row in peers.items()
        if row["model"][0] in codes and draw_trade.ERROR in row
    }
    figure = draw_trade.draw(curves | theirs, settings, {}, draw_trade.FAMILIES | codes)
    models = {row["model"][0] for row in theirs.values()}
    _add_legend(figure.axes[1], {codes[model].label: codes[model] for model in sorted(models)})
    if models & set(LAWS):
        axes = figure.axes[-1]
        axes.clear()
        _draw_laws(axes, _elastic(curves | theirs), draw_trade.shown_batch(settings))
    missing = [label for code, label in CODES.items() if code in peers]
    if missing:
        words = f"not installed: {', '.join(missing)}\n{figure.get_suptitle()}"
        figure.suptitle(words, fontsize=house_style.NOTE)
    return figure


def _add_legend(axes: Axes, families: Mapping[str, draw_trade.Family]) -> None:
    """Write the legend of the other codes into the empty middle of panel (a)."""
    keys = [
        house_style.key(label, linestyle="none", **family.style())
        for label, family in families.items()
    ]
    if keys:
        axes.legend(handles=keys, loc="center", bbox_to_anchor=(0.42, 0.48), handlelength=1)


def _elastic(curves: Curves) -> Curves:
    return {name: row for name, row in curves.items() if row[draw_trade.RESTITUTION][0] == 1}


def _draw_laws(axes: Axes, curves: Curves, batch: int) -> None:
    """Draw errors of LAMMPS' laws and of ours against time, on a linear scale of error."""
    families = LAWS | {model: draw_trade.FAMILIES[model] for model in OURS}
    for curve in curves.values():
        row = {key: value[0] for key, value in curve.items()}
        time = row.get(f"time_{batch} [s]")
        if row[draw_trade.MODEL] in families and time is not None:
            family = families[row[draw_trade.MODEL]]
            at = draw_trade.MICROSECONDS * time, row[draw_trade.ERROR]
            axes.semilogx(*at, linestyle="none", **family.style())
            draw_trade.label(axes, at, draw_trade.words_of(row), family.place)
    keys = [
        house_style.key(family.label, linestyle="none", **family.style())
        for family in LAWS.values()
    ]
    axes.legend(handles=keys, title="LAMMPS", loc="upper left", handlelength=1)
    axes.margins(x=0.22, y=0.15)
    low, high = axes.get_ylim()
    axes.set(
        ylim=(low, low + 1.7 * (high - low)), xlabel=draw_trade.TIME_WORDS, ylabel="error, rms"
    )
    axes.set_title("(c) part of (a), with LAMMPS")


def write(curves: str, peers: str, settings: Settings, svg: str, png: str) -> None:
    """Draw the tables `curves` and `peers`; a solver that failed becomes a picture that says so."""
    try:
        figure = draw(csv_tables.read(curves), csv_tables.read(peers), settings)
    except csv_tables.Failed as error:
        figure = house_style.failure(f"trade: the solver failed: {error}")
    house_style.save(figure, svg, png)
