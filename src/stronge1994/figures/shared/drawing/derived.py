"""What drawings show beside the columns of their tables, made of these before anything is drawn.

A drawing gets its curves with these columns and tables added, and draws nothing else, see
`checked`. Each figure that needs more has a function of its name here.
"""

import itertools
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, TypeAlias

import numpy as np

from planarimpact.ground.arrays import Array, ArrayLike
from stronge1994 import curve_names
from stronge1994.csv_tables import Column, Columns, Curves, Row
from stronge1994.figures.shared.drawing import checked
from stronge1994.figures.shared.drawing.house_style import Points, Series, Settings
from stronge1994.goodness import ChiSquared, chi_squared

Entry: TypeAlias = Mapping[str, Any]  # a comparison of the config
Bounds: TypeAlias = dict[str, tuple[float, float]]
LESS, MORE = checked.BARS


def shown(figure: str, curves: Curves, settings: Settings, points: Points) -> tuple[Curves, Points]:
    """Curves and reference series of a figure, with all that its drawing shows."""
    if figure in SERIES:
        points = {name: SERIES[figure](name, series) for name, series in points.items()}
    if figure in CURVES:
        curves = CURVES[figure](curves, settings, points)
    return curves, points


def tables(curves: Curves, points: Points) -> Curves:
    """All tables of which a figure may show numbers: its curves, and series with their errors."""
    found = dict(curves)
    for name, series in points.items():
        if "axes" in series:
            found[name] = {}
            for which, column, sigma in zip("xy", series["axes"], series["sigma"], strict=True):
                values = series[which]
                found[name] |= {column: values, column + LESS: values - sigma}
                found[name][column + MORE] = values + sigma
    return found


# ---- Figs 3 and 4 -------------------------------------------------------------------------------

NORMAL, LIMIT = "normal_force [m2 Omega v2(0)]", "friction_limit [mu m2 Omega v2(0)]"


def _contacts(curves: Curves, settings: Settings, points: Points) -> Curves:
    """Beside the friction its limit, where it acts backward."""
    return {name: curve | {LIMIT: -curve[NORMAL]} for name, curve in curves.items()}


# ---- Fig. 5 -------------------------------------------------------------------------------------

# These points are measured against the angle: they must be converted to the axes of the figure.
MEASURED_ANGLES = "kharaz2001/tangential_restitution"


def _contact_series(name: str, series: Series) -> Series:
    """Measurements against the angle, converted to the axes of the figure with their errors."""
    if name != MEASURED_ANGLES:
        return series
    groups = [series["parameters"][key] for key in ("mass_ratio", "friction")]
    angle, ratio = series["x"], series["y"]
    angle_error, ratio_error = series["sigma"]
    x, y = contact_velocities(angle, ratio, *groups)
    by_angle = np.subtract(contact_velocities(angle + angle_error, ratio, *groups), (x, y))
    by_ratio = np.subtract(contact_velocities(angle, ratio + ratio_error, *groups), (x, y))
    columns = "incidence [mu v2(0)]", "velocity [mu v2(0)]"
    sigma = np.hypot(by_angle, by_ratio)
    return {"x": x, "y": y, "sigma": sigma, "line": False, "axes": columns}


def contact_velocities(
    angle: ArrayLike, centre_restitution: ArrayLike, mass_ratio: float, friction: float
) -> tuple[Array, Array]:
    """Measured points of a sphere without spin in the axes of the figure.

    Parameters
    ----------
    angle : array_like
        Angle of incidence in degrees.
    centre_restitution : array_like
        Tangential velocity of the centre, after over before.
    mass_ratio, friction : float
        beta and mu.

    Returns
    -------
    incidence, velocity : ndarray
        x = tan(theta)/mu and w = x (beta e_t - (beta - 1)).

    Examples
    --------
    >>> x, w = contact_velocities(45.0, 1.0, 3.5, 0.5)
    >>> round(float(x), 9), round(float(w), 9)
    (2.0, 2.0)
    """
    x = np.tan(np.radians(angle)) / friction
    return x, x * (mass_ratio * np.asarray(centre_restitution) - (mass_ratio - 1))


# ---- error against time -------------------------------------------------------------------------

ERROR, FLOOR = "rms_velocity [mu v2(0)]", 1e-12  # smaller errors are rounding
IMPACTS, TIME, MILLISECONDS = "impacts [1]", "time [us]", "time [ms]"


def _times(columns: Columns, old: str, busy: str, new: str, factor: float) -> Columns:
    """A time in another unit, and down to what the processor worked."""
    time = factor * columns[old]
    return {new: time, new + LESS: time / np.maximum(columns.get(busy, 1.0), 1)}


def _convergence(curves: Curves, settings: Settings, points: Points) -> Curves:
    return {
        name: curve | _times(curve, "time [s]", "busy_time [1]", MILLISECONDS, 1e3)
        if "time [s]" in curve
        else curve
        for name, curve in curves.items()
    }


def over_batches(name: str) -> str:
    """Name of the table of the times of one row of results/curves/trade.csv."""
    return f"{name}, over batches"


def trade(curves: Curves, settings: Settings, points: Points) -> Curves:
    """Times in microseconds, errors from rounding on, and a table over the batches of each row."""
    found = {}
    for name, row in curves.items():
        known = [b for b in sorted(settings["batches"]) if f"time_{b} [s]" in row]
        times = [
            _times(row, f"time_{b} [s]", f"busy_{b} [1]", f"time_{b} [us]", 1e6) for b in known
        ]
        over: Columns = {IMPACTS: np.array(known, float)}
        for end in ("", LESS):
            cells = [time[f"time_{b} [us]{end}"] for b, time in zip(known, times, strict=True)]
            over[TIME + end] = np.concatenate([[], *cells])
        found[name] = row | {key: value for time in times for key, value in time.items()}
        if ERROR in row:
            found[name] |= {ERROR: np.maximum(row[ERROR], FLOOR)}
        found[over_batches(name)] = over
    return found


# ---- pairs of materials -------------------------------------------------------------------------

E, BETA_0 = "restitution [1]", "tangential_restitution [1]"
PARAMETERS = "each pair's parameters"
CHI_SQUARED = "chi_squared [1]"
# Points of one restitution are drawn side by side, so far apart.
APART = 0.0055


def _beside(name: str, series: Series) -> Series:
    return series | {"x": side_by_side(series["x"]), "restitution": series["x"]}


def side_by_side(x: Array) -> Array:
    """Abscissae of points; those of nearly the same are moved apart a little, about their mean.

    Examples
    --------
    >>> side_by_side(np.array([0.9, 0.97, 0.9])).round(3).tolist()
    [0.897, 0.97, 0.903]
    """
    moved, order = x.copy(), np.argsort(x, kind="stable")
    for same in np.split(order, np.flatnonzero(np.diff(x[order]) > APART) + 1):
        moved[same] = x[same].mean() + APART * (np.arange(len(same)) - (len(same) - 1) / 2)
    return moved


def _inelastic(curves: Curves, settings: Settings, points: Points) -> Curves:
    """Chi-squared of each model."""
    series = points.get(settings["points"])
    models = [name.removesuffix(", pairs") for name in curves if name.endswith(", pairs")]
    fits = {model: goodness(curves, model, series) for model in models} if series else {}
    return curves | {
        f"chi-squared of {model}": {CHI_SQUARED: np.array([fit.value]), "p [1]": np.array([fit.p])}
        for model, fit in fits.items()
    }


def goodness(curves: Curves, model: str, series: Series) -> ChiSquared:
    """Chi-squared of a model over the measured pairs, with the uncertainty of their parameters.

    It is that of the verdicts.
    """
    name, sigma = f"{model}, pairs", series["sigma"][1]
    place = {pair: row for row, pair in enumerate(curves[name]["pair"])}
    rows = [place[pair] for pair in series["columns"]["pair"]]
    up, down = (
        curves[curve_names.shifted(name, PARAMETERS, sign)][BETA_0][rows] for sign in (1, -1)
    )
    distance = (series["y"] - curves[name][BETA_0][rows]) / sigma
    return chi_squared(distance, np.diag((up - down) / 2 / sigma))


# ---- rod ----------------------------------------------------------------------------------------

TILT, OVER_MU = "tilt [deg]", "friction_over_mu [m2 Omega v2(0)]"
RIBBONS = {"regime": "", "jams": "", "rigid: jams": "rigid, "}  # whose regime or jams


def ribbon(row: str, ratio: str) -> str:
    """Name of the table of one row of parts, over the tilt."""
    return f"ribbon of {row}, {ratio}"


def _rod(curves: Curves, settings: Settings, points: Points) -> Curves:
    """Friction over mu, and the parts of the tilt that have one regime, or jam."""
    contact = curves["contact"]
    over_mu = contact["friction_force [m2 Omega v2(0)]"] / settings["friction"]
    found = curves | {"contact": contact | {OVER_MU: over_mu}}
    for ratio in settings["velocity_ratio"]:
        name = curve_names.name("v1/v2", ratio)
        for row, kind in RIBBONS.items():
            curve = curves[kind + name]
            labels = curve["regime" if row == "regime" else "jams [1]"]
            found[ribbon(row, name)] = _parts(curve[TILT], labels)
    return found


def _parts(x: Array, labels: Column) -> Columns:
    """Edges of parts with one label, half way between two points, and the label behind each."""
    changes = np.flatnonzero(labels[1:] != labels[:-1])
    edges = np.array([x[0], *(x[changes] + x[changes + 1]) / 2, x[-1]])
    return {TILT: edges, "label": labels[[*changes, -1, -1]]}


# ---- digits -------------------------------------------------------------------------------------

OMEGA = "omega [Omega]"
KINDS = {"digits": "correct digits found", "digits_allowed": "allowed by the condition"}
OUTPUTS = ("velocity", "peak_friction", "dissipation")
MOST_DIGITS = 16
# So many digits may be lost, see the comparison `stability-digits`.
WORSE = 2
LINES = {0: "as many as allowed", WORSE: f"{WORSE} digits fewer"}
ACROSS, MEDIAN = "omega [cell]", "median [1]"
# Lower edges of the cells, each with its label. The first cell has none: it holds all below.
OMEGAS = {10.0**k: f"$10^{{{k}}}$" if k % 3 == 0 else "" for k in range(-5, 7)}
OMEGAS[1.0] = "1"
RESTITUTIONS = {5e-324: "", 1e-16: "$10^{-16}$", 1e-8: "$10^{-8}$", 1e-4: "$10^{-4}$"}
RESTITUTIONS |= {0.01: "0.01", 0.1: "0.1", 0.5: "0.5", 1.0: ""}
INCIDENCES = {5e-324: ""}
INCIDENCES |= {10.0**k: f"$10^{{{k}}}$" for k in (-16, -8, -4, -2, 0, 2, 4, 8)}
INCIDENCES[1.0] = "1"
UPRIGHT = {"restitution [1]": RESTITUTIONS, "incidence [mu v2(0)]": INCIDENCES}


def _stability(curves: Curves, settings: Settings, points: Points) -> Curves:
    """Medians of the digits in cells of the parameters; pairs of digits that occur, to a tenth.

    The least of a cell would be misleading: in every cell some output passes through zero.
    """
    impacts = curves["impacts"]
    found = dict(curves)
    for (name, edges), (kind, words) in itertools.product(UPRIGHT.items(), KINDS.items()):
        digits = np.min([impacts[f"{kind}_{output} [1]"] for output in OUTPUTS], axis=0)
        column, row = (
            np.digitize(impacts[OMEGA], list(OMEGAS)),
            np.digitize(impacts[name], list(edges)),
        )
        cells = np.full((len(edges) + 1, len(OMEGAS) + 1), np.nan)
        for cell in set(zip(row, column, strict=True)):
            cells[cell] = np.median(digits[(row == cell[0]) & (column == cell[1])])
        rows, columns = np.indices(cells.shape) + 0.5
        places = {ACROSS: columns.ravel(), in_cells(name): rows.ravel()}
        found[f"{words}, {name}"] = places | {MEDIAN: cells.ravel()}
    for output in OUTPUTS:
        pairs = np.stack([impacts[f"{kind}_{output} [1]"] for kind in ("digits_allowed", "digits")])
        allowed, digits = np.unique(np.round(pairs, 1), axis=1)
        found[f"digits of {output}"] = {"digits_allowed [1]": allowed, "digits [1]": digits}
    ends = np.array([0.0, MOST_DIGITS])
    for fewer, words in LINES.items():
        found[words] = {"digits_allowed [1]": ends, "digits [1]": ends - fewer}
    return found


def in_cells(column: str) -> str:
    """Name of a column that counts cells of another.

    Examples
    --------
    >>> in_cells("restitution [1]")
    'restitution [cell]'
    """
    return f"{column.partition(' [')[0]} [cell]"


# ---- superball ----------------------------------------------------------------------------------

PLACE, HEIGHT, SPIN = "place [m]", "height [m]", "spin_y [rad/s]"
# Where the number of a flight stands, as a share of the flight, and its size as a share of the gap.
NEAR, SIZE = 0.36, 0.065


def sense(flight: int) -> str:
    """Name of the table of the round arrow that shows the sense of the spin."""
    return f"sense of spin {flight}"


def _superball(curves: Curves, settings: Settings, points: Points) -> Curves:
    """Round arrows, clockwise if spin_y > 0, and open where no flight crosses them."""
    path, radius = curves["path"], SIZE * settings["throw"]["gap"]
    ways = np.diff(path[PLACE]) + 1j * np.diff(path[HEIGHT])
    found = dict(curves)
    for number, (x, y, way, spin) in enumerate(
        zip(path[PLACE], path[HEIGHT], ways, path[SPIN], strict=False)
    ):
        angles = np.angle(1j * way) - np.sign(spin) * np.radians(np.linspace(35, 325, 60))
        found[sense(number)] = {
            PLACE: x + NEAR * way.real + radius * np.cos(angles),
            HEIGHT: y + NEAR * way.imag + radius * np.sin(angles),
        }
    return found


# ---- study --------------------------------------------------------------------------------------


def slice_of(axes: Mapping[str, Array], velocity: Array, places: Mapping[str, int]) -> Columns:
    """All of a grid that has the given places on some of its axes."""
    cut = tuple(places.get(name, slice(None)) for name in axes)
    free = [values for name, values in axes.items() if name not in places]
    names = [name for name in axes if name not in places]
    grid = np.meshgrid(*free, indexing="ij")
    units = {"incidence": "mu v2(0)"}
    found = {f"{n} [{units.get(n, '1')}]": g.ravel() for n, g in zip(names, grid, strict=True)}
    return found | {"velocity [mu v2(0)]": velocity[cut].ravel()}


# ---- residuals ----------------------------------------------------------------------------------

DISTANCE = "distance [sigma]"
# A comparison with more points is left out: it would be a block of ink, and a large file.
MOST_POINTS = 1000


# Curve, reference and quantity of a strip.
Strip: TypeAlias = tuple[str, str, str]
ALL, RMS_ALLOWED, RMS = "allowed for all", "allowed for it", "of the points"


def title(strip: Strip) -> str:
    """What stands over a strip."""
    return f"{strip[0]}  -  {strip[1]}"


def strips(
    residuals: Sequence[Row], comparisons: Mapping[str, Entry], verdicts: Mapping[str, Row]
) -> dict[Strip, Curves]:
    """Tables of each strip, those with the same axis after each other.

    The points of a comparison are called "COMPARISON, VERDICT"; what is allowed, and the root mean
    square, "COMPARISON, " and one of the constants above: the lower line, then the upper one.
    """
    found: dict[Strip, dict[str, list[tuple[float, float]]]] = {}
    counts = Counter(row["comparison"] for row in residuals)
    for row in residuals:
        entry = comparisons[row["comparison"]]
        if entry["metric"] in ("distance", "vertices") and counts[row["comparison"]] <= MOST_POINTS:
            key = entry.get("curve", "all curves"), entry["reference"], row["quantity"]
            part = found.setdefault(key, {}).setdefault(row["comparison"], [])
            part.append((float(row["at"]), float(row[DISTANCE])))
    quantities = list(dict.fromkeys(quantity for _, _, quantity in found))
    return {
        key: {
            name: table
            for comparison, points in found[key].items()
            for name, table in _strip(
                key[2], comparison, points, comparisons[comparison], verdicts[comparison]
            )
        }
        for key in sorted(found, key=lambda key: quantities.index(key[2]))
    }


def _strip(
    quantity: str, name: str, points: Sequence[tuple[float, float]], entry: Entry, row: Row
) -> Iterator[tuple[str, Columns]]:
    x, distance = np.transpose(points)
    span = np.array([x.min(), x.max()])
    span = span if span[0] < span[1] else span + [-0.5, 0.5]

    def lines(*heights: float) -> Columns:
        return {quantity: np.tile(span, len(heights)), DISTANCE: np.repeat(heights, 2)}

    yield f"{name}, {row['verdict']}", {quantity: x, DISTANCE: distance}
    # Chi-squared gives no bounds: it judges all points together.
    bounds = entry.get("regression", {} if row["p"] else {"max": (0.0, 1.0)})
    if "max" in bounds:
        yield f"{name}, {ALL}", lines(-bounds["max"][1], bounds["max"][1])
    if "rms" in bounds:
        low, high = bounds["rms"]
        rms = float(np.sqrt(np.mean(distance**2)))
        yield f"{name}, {RMS_ALLOWED}", lines(-low, -high, low, high)
        yield f"{name}, {RMS}", lines(-rms, rms)


def tables_of_strips(found: Mapping[Strip, Curves]) -> Curves:
    """All tables of all strips, each with the title of its strip before its name."""
    return {
        f"{title(strip)}: {name}": table
        for strip, parts in found.items()
        for name, table in parts.items()
    }


CURVES: dict[str, Callable[[Curves, Settings, Points], Curves]] = {
    "fig3": _contacts,
    "fig4": _contacts,
    "convergence": _convergence,
    "trade": trade,
    "inelastic": _inelastic,
    "rod": _rod,
    "stability": _stability,
    "superball": _superball,
}
SERIES: dict[str, Callable[[str, Series], Series]] = {
    "fig5": _contact_series,
    "inelastic": _beside,
}
