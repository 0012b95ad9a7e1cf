"""The parameter study: maps of the rebound over its two longest axes, slices of the others."""

import itertools

import drawing
import job
import numpy as np
import study_files
from matplotlib.colors import Normalize

from planarimpact import Regime

LABELS = {
    "incidence": drawing.INCIDENCE,
    "mass_ratio": "$m_2/m_1$",
    "stiffness_ratio": r"$\zeta^2$",
    "restitution": "restitution $e$",
}
SLICES = 6  # that are drawn
POINTS = 400  # along an axis: more cannot be seen
COLOURS = "RdBu_r"
ZERO = {"colors": drawing.BLACK, "linewidths": 1.4}
BOUNDARY = {"colors": drawing.BLACK, "linewidths": 0.7, "linestyles": [(0, (4, 2))]}
LEAST = 0.02  # share of a map that a regime must take to be shown: not the edge of the grid
PLATE = {"facecolor": "white", "alpha": 0.75, "edgecolor": "none", "pad": 1.0}


def draw(axes, velocity, regime):
    """Velocity at separation in colours, where it is zero, and where regimes meet.

    Parameters
    ----------
    axes : dict of ndarray
        The four groups, one dimension each.
    velocity, regime : ndarray
        Outputs over the grid, with a dimension for each axis.
    """
    names = list(axes)
    across, upright = sorted(sorted(names, key=lambda name: -len(axes[name]))[:2], key=names.index)
    if min(len(axes[across]), len(axes[upright])) < 2:
        return drawing.failure("study: a map needs two axes of two points or more")
    others = [name for name in names if name not in (across, upright)]
    slices = list(itertools.product(*(range(len(axes[name])) for name in others)))
    shown = [slices[i] for i in _thinned(len(slices), SLICES)]
    columns = min(len(shown), 2)
    rows = -(-len(shown) // columns)
    figure = drawing.new(0.9 + 2.3 * rows)
    panels = figure.subplots(rows, columns, sharex=True, sharey=True, squeeze=False).ravel()
    limit = np.abs(velocity).max() or 1.0
    for panel, places in zip(panels, shown, strict=False):
        cut = dict(zip(others, places, strict=True))
        cut |= {name: _thinned(len(axes[name]), POINTS) for name in (across, upright)}
        grid = axes[across][cut[across]], axes[upright][cut[upright]]
        where = np.ix_(*(np.atleast_1d(cut[name]) for name in names))
        shape = len(grid[0]), len(grid[1])
        values, codes = (field[where].reshape(shape).T for field in (velocity, regime))
        colours = {"cmap": COLOURS, "norm": Normalize(-limit, limit)}
        # As a picture inside the SVG: a hundred thousand cells are no drawing.
        mesh = panel.pcolormesh(*grid, values, shading="nearest", rasterized=True, **colours)
        if values.min() < 0 < values.max():
            panel.contour(*grid, values, [0.0], **ZERO)
        _draw_regimes(panel, grid, codes)
        words = (f"{LABELS[name]} = {axes[name][cut[name]]:g}" for name in others)
        panel.set_title(", ".join(words))
        panel.set(xlim=grid[0][[0, -1]], ylim=grid[1][[0, -1]])
        panel.set(xlabel=LABELS[across], ylabel=LABELS[upright])
        panel.label_outer()
    for panel in panels[len(shown) :]:
        panel.remove()
    bar = figure.colorbar(mesh, ax=panels[: len(shown)], aspect=30, pad=0.02)
    bar.set_label(drawing.REBOUND)
    left = f", {len(shown)} of {len(slices)} slices" if len(shown) < len(slices) else ""
    entries = [
        drawing.key(f"zero; blue: turned round{left}", color=drawing.BLACK, linewidth=1.4),
        drawing.key("regimes meet", color=drawing.BLACK, linewidth=0.7, linestyle=(0, (4, 2))),
    ]
    figure.legend(handles=entries, loc="outside lower center", ncols=2)
    return figure


def _thinned(count, most):
    """Up to `most` places of `count`, evenly spread, both ends among them."""
    return np.unique(np.linspace(0, count - 1, min(count, most)).round().astype(int))


def _draw_regimes(panel, grid, codes):
    """Lines where regimes meet, and their names; those at the edge of the grid are left out."""
    present, counts = np.unique(codes, return_counts=True)
    large = present[counts >= LEAST * codes.size]
    small = ~np.isin(codes, large)
    for code in large:
        inside = codes == code
        if inside.all() or len(large) > 1:
            row, column = _middle(inside)
            name = Regime(code).name.lower().replace("_", "-\n", 2).replace("_", "-")
            place = {"ha": "center", "va": "center", "fontsize": drawing.NOTE, "bbox": PLATE}
            panel.text(grid[0][column], grid[1][row], name, **place)
        if len(large) > 1:
            field = np.ma.masked_array(inside.astype(float), small)
            panel.contour(*grid, field, [0.5], **BOUNDARY)


def _middle(inside):
    """Row and column of the cell of a region that is nearest to its mean."""
    cells = np.argwhere(inside)
    apart = ((cells - cells.mean(axis=0)) / inside.shape) ** 2
    return cells[apart.sum(axis=1).argmin()]


if "snakemake" in globals():
    with job.log_to(snakemake.log[0]):  # noqa: F821
        axes, outputs = study_files.read(
            snakemake.input.study,  # noqa: F821
            "velocity",
            "regime",
        )
        drawing.save(draw(axes, **outputs), snakemake.output.svg, snakemake.output.png)  # noqa: F821
