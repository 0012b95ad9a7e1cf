"""The table of spheres in C and JavaScript.

Both evaluate as `planarimpact.spheres` does: the same operations in the same order. Numbers are
stored as in the shipped file: whole numbers, each times a power of 1/2.
"""

import base64
import math
from collections.abc import Mapping
from string import Template
from typing import NamedTuple

import numpy as np

from planarimpact import __version__, spheres
from planarimpact.export.languages import LANGUAGES, Language, comment, number
from planarimpact.export.languages import table as numbers
from planarimpact.ground import checks
from planarimpact.ground.arrays import Integers
from planarimpact.ground.results import Regime
from planarimpact.spheres import table as tables
from planarimpact.spheres.table import LEFT, ORDER, PACKED, RIGHT, ROOTS, Table

# Largest errors of the shipped tables by loss, and the tables by the larger of them.
BOUNDS = {"fine": spheres.ERROR_BOUND, "coarse": {"viscous": 3e-3, "plastic": 4e-2}}
TABLES: dict[float, str] = {max(bounds.values()): name for name, bounds in BOUNDS.items()}
PANEL_FIELDS = "patch", "patches", "varying", "rows", "columns", "over_t", "over_u", *PACKED
LAYOUT = [
    "The table. A loss, or a part of it, is a panel; a panel has patches. In a patch velocity, "
    "peak friction and work are cubic splines in s, t and u: places over y = x/stiffness_ratio, "
    "restitution and b = mass_ratio/stiffness_ratio.",
    "  limits: restitutions between the three plastic panels, over u",
    "  panels: its first patch, and how many; edges that vary, their intervals over t and u; "
    "coefficients over t and u; where its edges and splines begin in values, or -1",
    "  patches: where s has its root (0 nowhere, $left left, $right right), intervals over s, and "
    "the first coefficient over s",
    "  values: edges in y, and coefficients of splines, in units of $unit",
]
CODE = {
    "c": """\
struct ${p}result {
    double velocity;
    double peak_friction;
    double dissipation;
    int regime;
};

/* Where an impact is: what the splines need, and what follows from its edges. */
struct ${p}spot {
    const struct ${p}panel *panel;
    int base, slides;
    double over_s[4], over_t[4], over_u[4];
};

/* Which of so many intervals a value from 0 to so many is in. */
static inline int ${p}index(double at, int count)
{
    int index = (int)at;
    return index < count ? index : count - 1;
}

static inline double ${p}clipped(double value, double low, double high)
{
    return value < low ? low : value > high ? high : value;
}

/* The interval that a value from 0 to 1 is in, and the four B-splines there. */
static inline int ${p}place(double value, int count, double *weights)
{
    double at = value * count;
    int index = ${p}index(at, count);
    double x = at - index, left = 1 - x;
    weights[0] = left * left * left / 6;
    weights[1] = (x * x * (x - 2) * 3 + 4) / 6;
    weights[2] = (left * left * (left - 2) * 3 + 4) / 6;
    weights[3] = x * x * x / 6;
    return index;
}

/* A spline, whose coefficients begin at a number of the values. */
static inline double ${p}spline(const struct ${p}spot *spot, int begin)
{
    const int *first = ${p}values + begin + spot->base;
    double found = 0;
    int i, j, k;
    for (i = 0; i < 4; ++i) {
        double middle = 0;
        for (j = 0; j < 4; ++j) {
            const int *c = first + (i * spot->panel->over_t + j) * spot->panel->over_u;
            double inner = 0;
            for (k = 0; k < 4; ++k)
                inner += c[k] * spot->over_u[k];
            middle += inner * spot->over_t[j];
        }
        found += middle * spot->over_s[i];
    }
    return found * $unit;
}

static inline struct ${p}spot ${p}find(double y, double b, double e, int loss)
{
    double u = (b - $b_least) / $b_span, at = u * $limits, t, over, across;
    double edge[6] = {0}, varying[2] = {0}, low, high, width, s, alike = b + e * (b - 1);
    const double *limit = ${p}limits + ${p}index(at, $limits);
    double part = at - ${p}index(at, $limits), less = (1 - part) * limit[0] + part * limit[1];
    double more = (1 - part) * limit[$limits + 1] + part * limit[$limits + 2];
    int which = loss == ${P}VISCOUS ? 0 : e < less ? 1 : e < more ? 2 : 3, i, j, k;
    const struct ${p}panel *panel = ${p}panels + which;
    const int *patch;
    struct ${p}spot found;
    if (which == 0)
        t = (e - $e_least) / $e_span;
    else if (which == 1)
        t = 1 - sqrt(${p}clipped($e_least / e - $e_least / less, 0, 1) / (1 - $e_least / less));
    else if (which == 2)
        t = (e - less) / (more - less);
    else
        t = sqrt(sqrt((1 - e) / (1 - more)));

    /* Edges, between four nodes. */
    at = t * panel->rows;
    i = ${p}index(at, panel->rows);
    over = at - i;
    at = u * panel->columns;
    j = ${p}index(at, panel->columns);
    across = at - j;
    for (k = 0; k < panel->varying; ++k) {
        int columns = panel->columns + 1;
        const int *c = ${p}values + panel->edges + (k * (panel->rows + 1) + i) * columns + j;
        double before = (1 - across) * (c[0] * $unit) + across * (c[1] * $unit);
        double after = (1 - across) * (c[columns] * $unit) + across * (c[columns + 1] * $unit);
        varying[k] = (1 - over) * before + over * after;
    }
    edge[1] = 1;
    if (which == 0) {
        edge[2] = varying[0];
        edge[3] = varying[1] < b ? varying[1] : b;
        edge[4] = b;
        edge[5] = alike;
    } else {
        edge[3] = which == 3 ? b : varying[0];
        edge[2] = (1 + edge[3]) / 2;
        edge[4] = which == 1 ? varying[1] : alike;
    }

    /* The patch, and s in it. */
    which = panel->patch;
    low = edge[0];
    high = edge[1];
    for (k = 1; k < panel->patches; ++k) {
        if (y >= edge[k]) {
            ++which;
            low = edge[k];
            high = edge[k + 1];
        }
    }
    width = high - low;
    s = ${p}clipped((y - low) / (width > 0 ? width : 1), 0, 1);
    patch = ${p}patches + 3 * which;
    if (patch[0] == $right)
        s = 1 - sqrt(1 - s);
    else if (patch[0] == $left)
        s = sqrt(s);

    found.panel = panel;
    found.slides = y >= edge[panel->patches] * $nearly;
    found.base = patch[2] + ${p}place(s, patch[1], found.over_s);
    found.base = found.base * panel->over_t + ${p}place(t, panel->over_t - 3, found.over_t);
    found.base = found.base * panel->over_u + ${p}place(u, panel->over_u - 3, found.over_u);
    return found;
}

/* Whether the table has an answer. */
static inline int ${p}covers(
    double x, double mass_ratio, double stiffness_ratio, double restitution, int loss)
{
    double ratio = mass_ratio / stiffness_ratio;
    return fabs(x) <= ${P}INCIDENCE_MAX && mass_ratio >= 1 && mass_ratio <= $largest
        && stiffness_ratio <= $stiffness_most && ratio >= $ratio_least && ratio <= $ratio_most
        && restitution >= $restitution_least && restitution <= 1
        && (loss == ${P}VISCOUS || loss == ${P}PLASTIC);
}

/* Tangential velocity of the contact point at separation, v1(tf)/(mu v2(0)); NaN out of range. */
static inline double ${p}velocity(
    double x, double mass_ratio, double stiffness_ratio, double restitution, int loss)
{
    double size = fabs(x), velocity;
    struct ${p}spot spot;
    if (!${p}covers(x, mass_ratio, stiffness_ratio, restitution, loss))
        return $nan;
    spot = ${p}find(size / stiffness_ratio, mass_ratio / stiffness_ratio, restitution, loss);
    if (spot.slides) {
        velocity = size - (1 + restitution) * mass_ratio;
    } else {
        velocity = stiffness_ratio * ${p}spline(&spot, spot.panel->velocity);
        velocity = ${p}clipped(velocity, 0.0 - size, size);
    }
    return velocity * copysign(1.0, x);
}

/* The state at separation; NaN, and ${P}UNRESOLVED, out of range. */
static inline struct ${p}result ${p}rebound(
    double x, double mass_ratio, double stiffness_ratio, double restitution, int loss)
{
    struct ${p}result found = {$nan, $nan, $nan, ${P}UNRESOLVED};
    double size = fabs(x), beta = mass_ratio, zeta2 = stiffness_ratio, e = restitution, w;
    struct ${p}spot spot;
    if (!${p}covers(x, beta, zeta2, e, loss))
        return found;
    spot = ${p}find(size / zeta2, beta / zeta2, e, loss);
    if (spot.slides) {
        double change = (1 + e) * beta;
        w = size - change;
        found.peak_friction = 1.0;
        if (loss == ${P}VISCOUS)
            found.dissipation = (1 + e) * (size - zeta2 - (beta - zeta2) * (1 + e) / 2);
        else
            found.dissipation = (1 + e) * (size - change / 2);
        found.regime = ${P}SLIP_THROUGHOUT;
    } else {
        double peak = ${p}spline(&spot, spot.panel->peak);
        w = ${p}clipped(zeta2 * ${p}spline(&spot, spot.panel->velocity), 0.0 - size, size);
        found.peak_friction = ${p}clipped(peak, 0.0, 1.0);
        if (loss == ${P}VISCOUS) {
            double work = zeta2 * ${p}spline(&spot, spot.panel->work);
            found.dissipation = work > 0 ? work : 0.0;
        } else {
            found.dissipation = (size - w) * (size + w) / (2 * beta);
        }
        found.regime = size > zeta2 ? ${P}SLIP_STICK_SLIP : ${P}STICK_SLIP;
        if (!(size > 0.0))
            found.regime = ${P}STICK;
    }
    found.velocity = w * copysign(1.0, x);
    return found;
}
""",
    "js": """\
/**
 * The bytes of a table.
 * @param {string} text base64
 * @returns {ArrayBuffer}
 */
function bytes(text) {
    return Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0)).buffer;
}

/**
 * The values: of each number is stored what its neighbours along each axis do not tell, in 7 bits a
 * byte, the lowest first. Neighbours are rows * columns, columns and 1 apart.
 * @param {ArrayBuffer} packed
 * @returns {Int32Array}
 */
function unfolded(packed) {
    const all = new Uint8Array(packed), found = new Int32Array($count);
    let next = 0, begin = 0;
    for (const [layers, rows, columns] of shapes) {
        const end = begin + layers * rows * columns;
        for (let i = begin; i < end; i += 1) {
            let value = 0, shift = 0;
            for (; all[next] > 127; shift += 7) value += (all[next++] - 128) << shift;
            value += all[next++] << shift;
            found[i] = value % 2 ? -(value + 1) / 2 : value / 2;
        }
        for (const [step, size] of [[1, columns], [columns, rows], [rows * columns, layers]])
            for (let i = begin; i < end; i += 1)
                if (Math.trunc((i - begin) / step) % size) found[i] += found[i - step];
        begin = end;
    }
    return found;
}
const values = unfolded(bytes("$packed"));

/**
 * Which of so many intervals a value from 0 to so many is in.
 * @param {number} at
 * @param {number} count
 * @returns {number}
 */
function index_of(at, count) {
    return Math.min(Math.trunc(at), count - 1);
}

/**
 * @param {number} value
 * @param {number} low
 * @param {number} high
 * @returns {number}
 */
function clipped(value, low, high) {
    return value < low ? low : value > high ? high : value;
}

/**
 * The interval that a value from 0 to 1 is in, and the four B-splines there.
 * @param {number} value
 * @param {number} count
 */
function place(value, count) {
    const at = value * count, index = index_of(at, count), x = at - index, left = 1 - x;
    const weights = [
        left * left * left / 6,
        (x * x * (x - 2) * 3 + 4) / 6,
        (left * left * (left - 2) * 3 + 4) / 6,
        x * x * x / 6,
    ];
    return { index, weights };
}

/**
 * Where an impact is: what the splines need, and what follows from its edges.
 * @param {number} y
 * @param {number} b
 * @param {number} e
 * @param {number} loss
 */
function find(y, b, e, loss) {
    const u = (b - $b_least) / $b_span, interval = index_of(u * $limits, $limits);
    const part = u * $limits - interval, alike = b + e * (b - 1);
    const between = (k) => (1 - part) * limits[k] + part * limits[k + 1];
    const less = between(interval), more = between(interval + $limits + 1);
    const which = loss === VISCOUS ? 0 : e < less ? 1 : e < more ? 2 : 3, panel = panels[which];
    const t = [
        () => (e - $e_least) / $e_span,
        () => 1 - Math.sqrt(clipped($e_least / e - $e_least / less, 0, 1) / (1 - $e_least / less)),
        () => (e - less) / (more - less),
        () => Math.sqrt(Math.sqrt((1 - e) / (1 - more))),
    ][which]();

    // Edges, between four nodes.
    const row = index_of(t * panel.rows, panel.rows), over = t * panel.rows - row;
    const column = index_of(u * panel.columns, panel.columns);
    const across = u * panel.columns - column, columns = panel.columns + 1;
    const varying = [];
    for (let k = 0; k < panel.varying; k += 1) {
        const c = panel.edges + (k * (panel.rows + 1) + row) * columns + column;
        const next = c + columns;
        const before = (1 - across) * (values[c] * $unit) + across * (values[c + 1] * $unit);
        const after =
            (1 - across) * (values[next] * $unit) + across * (values[next + 1] * $unit);
        varying.push((1 - over) * before + over * after);
    }
    const third = which === 3 ? b : varying[0];
    const edge = which === 0
        ? [0, 1, varying[0], Math.min(varying[1], b), b, alike]
        : [0, 1, (1 + third) / 2, third, which === 1 ? varying[1] : alike];

    // The patch, and s in it.
    let patch = 0, low = edge[0], high = edge[1];
    for (let k = 1; k < panel.patches; k += 1) {
        if (y >= edge[k]) {
            patch += 1;
            low = edge[k];
            high = edge[k + 1];
        }
    }
    const width = high - low, row_of_patch = 3 * (panel.patch + patch);
    let s = clipped((y - low) / (width > 0 ? width : 1), 0, 1);
    const [root, intervals, first] = patches.subarray(row_of_patch, row_of_patch + 3);
    if (root === $right) s = 1 - Math.sqrt(1 - s);
    else if (root === $left) s = Math.sqrt(s);

    const over_s = place(s, intervals);
    const over_t = place(t, panel.over_t - 3), over_u = place(u, panel.over_u - 3);
    let base = (first + over_s.index) * panel.over_t + over_t.index;
    base = base * panel.over_u + over_u.index;
    return {
        panel,
        base,
        slides: y >= edge[panel.patches] * $nearly,
        weights: [over_s.weights, over_t.weights, over_u.weights],
    };
}

/**
 * A spline at a place that `find` found, whose coefficients begin at a number of the values.
 * @param {ReturnType<typeof find>} spot
 * @param {number} begin
 * @returns {number}
 */
function spline({ panel, base, weights: [over_s, over_t, over_u] }, begin) {
    let found = 0;
    for (let i = 0; i < 4; i += 1) {
        let middle = 0;
        for (let j = 0; j < 4; j += 1) {
            const c = begin + base + (i * panel.over_t + j) * panel.over_u;
            let inner = 0;
            for (let k = 0; k < 4; k += 1) inner += values[c + k] * over_u[k];
            middle += inner * over_t[j];
        }
        found += middle * over_s[i];
    }
    return found * $unit;
}

/**
 * Whether the table has an answer.
 * @param {number} x
 * @param {number} mass_ratio
 * @param {number} stiffness_ratio
 * @param {number} restitution
 * @param {number} loss
 * @returns {boolean}
 */
export function covers(x, mass_ratio, stiffness_ratio, restitution, loss) {
    const ratio = mass_ratio / stiffness_ratio;
    return Math.abs(x) <= INCIDENCE_MAX && mass_ratio >= 1 && mass_ratio <= $largest
        && stiffness_ratio <= $stiffness_most && ratio >= $ratio_least && ratio <= $ratio_most
        && restitution >= $restitution_least && restitution <= 1
        && (loss === VISCOUS || loss === PLASTIC);
}

/**
 * Velocity in the direction of x.
 * @param {number} velocity
 * @param {number} x
 * @returns {number}
 */
function directed(velocity, x) {
    return x < 0 || Object.is(x, -0) ? -velocity : velocity;
}

/**
 * Tangential velocity of the contact point at separation.
 * @param {number} x incidence, v1(0)/(mu v2(0))
 * @param {number} mass_ratio
 * @param {number} stiffness_ratio
 * @param {number} restitution
 * @param {number} loss VISCOUS or PLASTIC
 * @returns {number} v1(tf)/(mu v2(0)); NaN out of range
 */
export function velocity(x, mass_ratio, stiffness_ratio, restitution, loss) {
    const size = Math.abs(x), beta = mass_ratio, zeta2 = stiffness_ratio, e = restitution;
    if (!covers(x, beta, zeta2, e, loss)) return NaN;
    const spot = find(size / zeta2, beta / zeta2, e, loss);
    if (spot.slides) return directed(size - (1 + e) * beta, x);
    return directed(clipped(zeta2 * spline(spot, spot.panel.velocity), 0 - size, size), x);
}

/**
 * @typedef {object} Result
 * @property {number} velocity
 * @property {number} peak_friction
 * @property {number} dissipation
 * @property {number} regime
 */

/**
 * The state at separation.
 * @param {number} x incidence, v1(0)/(mu v2(0))
 * @param {number} mass_ratio
 * @param {number} stiffness_ratio
 * @param {number} restitution
 * @param {number} loss VISCOUS or PLASTIC
 * @returns {Result} NaN, and UNRESOLVED, out of range
 */
export function rebound(x, mass_ratio, stiffness_ratio, restitution, loss) {
    const size = Math.abs(x), beta = mass_ratio, zeta2 = stiffness_ratio, e = restitution;
    let velocity = NaN, peak_friction = NaN, dissipation = NaN, regime = UNRESOLVED;
    if (!covers(x, beta, zeta2, e, loss))
        return { velocity, peak_friction, dissipation, regime };
    const spot = find(size / zeta2, beta / zeta2, e, loss);
    if (spot.slides) {
        const change = (1 + e) * beta;
        velocity = size - change;
        peak_friction = 1;
        dissipation = loss === VISCOUS
            ? (1 + e) * (size - zeta2 - (beta - zeta2) * (1 + e) / 2)
            : (1 + e) * (size - change / 2);
        regime = SLIP_THROUGHOUT;
    } else {
        velocity = clipped(zeta2 * spline(spot, spot.panel.velocity), 0 - size, size);
        peak_friction = spline(spot, spot.panel.peak);
        peak_friction = clipped(peak_friction, 0, 1);
        dissipation = loss === VISCOUS
            ? Math.max(zeta2 * spline(spot, spot.panel.work), 0)
            : (size - velocity) * (size + velocity) / (2 * beta);
        regime = size > zeta2 ? SLIP_STICK_SLIP : STICK_SLIP;
        if (size === 0) regime = STICK;
    }
    return { velocity: directed(velocity, x), peak_friction, dissipation, regime };
}
""",
}

WORDS = """\
$file: the rebound of rough spheres after an oblique impact, every impact with materials of its own.
Written by planarimpact $version. Do not edit it: write it anew.

Model: the contact of Hertz with micro-slip (the continuum), with what takes the energy where \
restitution is below 1, one for each impact:
  ${P}VISCOUS: Kelvin-Voigt spheres with one relaxation time
  ${P}PLASTIC: elastic-plastic spheres, which flow in shear while they yield

Functions of the incidence x = v1(0)/(mu v2(0)), of any sign, and of
  mass_ratio: m2/m1, effective normal over tangential mass: 3.5 for solid spheres, 2.5 for thin \
shells
  stiffness_ratio: zeta^2, normal over tangential stiffness: (2 - nu)/(2 (1 - nu)), nu of Poisson
  restitution: e, the energetic coefficient
  loss: ${P}VISCOUS or ${P}PLASTIC
are
  ${p}covers(x, mass_ratio, stiffness_ratio, restitution, loss), whether there is an answer;
  ${p}velocity(x, mass_ratio, stiffness_ratio, restitution, loss), the velocity alone;
  ${p}rebound(x, mass_ratio, stiffness_ratio, restitution, loss), which has
    velocity: v1(tf)/(mu v2(0)), which has the sign opposite to x where the contact point has
      turned round
    peak_friction: largest friction, over mu times the largest normal force
    dissipation: work of friction, in mu^2 m2 v2(0)^2; with plastic loss also that of the flow in \
shear
    regime: the order of stick and slip, one of the codes below

Units and signs: v1 and v2 are the tangential and the normal velocity of the contact point, before \
the impact (0) and after it (tf), both in one unit. v2(0) is positive towards the surface. mu is \
the coefficient of friction, above 0.

Range: |x| up to ${P}INCIDENCE_MAX, restitution from ${P}RESTITUTION_MIN to 1, mass_ratio from 1, \
stiffness_ratio up to ${P}STIFFNESS_MAX, mass_ratio/stiffness_ratio from ${P}RATIO_MIN to \
${P}RATIO_MAX. Beyond it, and for NaN, the \
numbers are NaN and the regime is ${P}UNRESOLVED.

Error against the model, of velocity, peak_friction and dissipation: at most ${P}ERROR_VISCOUS or \
${P}ERROR_PLASTIC, by loss. It was measured by a search for the largest error; it is not \
proved. Slip throughout is a line.

Example:
$example
"""
EXAMPLES = {
    "c": """\
  #include "$file"

  double v1 = 6.0, v2 = 5.0, mu = 0.8, e = 0.9; // a solid sphere of rubber, before the impact
  double v1_after = mu * v2 * ${p}velocity(v1 / (mu * v2), 3.5, 1.5, e, ${P}VISCOUS);
  double v2_after = -e * v2;""",
    "js": """\
  import * as spheres from "./$file";

  const v1 = 6, v2 = 5, mu = 0.8, e = 0.9; // a solid sphere of rubber, before the impact
  const v1_after = mu * v2 * spheres.velocity(v1 / (mu * v2), 3.5, 1.5, e, spheres.VISCOUS);
  const v2_after = -e * v2;""",
}


class _Layout(NamedTuple):
    """The table as the code has it.

    Attributes
    ----------
    panels : list of list of int
        See `PANEL_FIELDS`.
    patches : ndarray of int32, shape (patches, 3)
    values : list of ndarray of int32, shape (layers, rows, columns)
        Edges and splines.
    """

    panels: list[list[int]]
    patches: Integers
    values: list[Integers]


def text(table: Table, bounds: Mapping[str, float], file: str, name: str, language: str) -> str:
    """The file of a table of spheres.

    Parameters
    ----------
    table : Table
        Of `planarimpact.spheres.table`.
    bounds : mapping
        Its largest errors by loss.
    file : str
        What the file is called.
    name : str
        What its functions and constants begin with, where the language wants it.
    language : str
        A key of `LANGUAGES`.
    """
    chosen = LANGUAGES[language]
    prefix = f"{name}_" if chosen.named else ""
    layout = _laid_out(table)
    unit = number(2.0**-table.exponent, chosen)
    blocks = [
        _constants(bounds, prefix.upper(), chosen),
        comment(Template(one).substitute(left=LEFT, right=RIGHT, unit=unit) for one in LAYOUT),
        numbers(prefix + "limits", table.limits.ravel(), chosen),
        _panels(layout.panels, prefix, language),
        numbers(prefix + "patches", layout.patches, chosen),
        _values(layout.values, prefix, language),
        _code(layout, table, prefix, language),
    ]
    words = Template(WORDS).substitute(
        file=file,
        version=__version__,
        example=Template(EXAMPLES[language]).substitute(file=file, p=prefix, P=prefix.upper()),
        p=prefix,
        P=prefix.upper(),
    )
    return chosen.file.format(
        words=comment(words.splitlines()), NAME=name.upper(), code="\n".join(blocks)
    )


def _laid_out(table: Table) -> _Layout:
    """Panels one after the other."""
    panels: list[list[int]] = []
    patches: list[tuple[int, int, int]] = []
    values: list[Integers] = []
    for name, panel in table.panels.items():
        over_t, over_u = panel.velocity.shape[1:]
        varying, rows, columns = panel.edges.shape
        row = [len(patches), len(ROOTS[name]), varying, rows - 1, columns - 1, over_t, over_u]
        for field in PACKED:
            part = tables.whole(getattr(panel, field), table.exponent)
            row.append(sum(map(np.size, values)) if part.size else -1)
            values += [part] if part.size else []
        panels.append(row)
        first = np.cumsum([0, *panel.intervals + ORDER - 1])
        patches += zip(ROOTS[name], panel.intervals.tolist(), first.tolist(), strict=False)
    return _Layout(panels, np.array(patches, np.int32), values)


def _constants(bounds: Mapping[str, float], prefix: str, language: Language) -> str:
    """What users may read: losses, range, error and the codes of regimes."""
    values = {
        "INCIDENCE_MAX": checks.LARGEST,
        "RESTITUTION_MIN": spheres.LEAST_RESTITUTION,
        "STIFFNESS_MAX": spheres.LARGEST_STIFFNESS,
        "RATIO_MIN": spheres.LEAST_RATIO,
        "RATIO_MAX": spheres.LARGEST_RATIO,
        **{f"ERROR_{loss.upper()}": bound for loss, bound in bounds.items()},
    }
    lines = [(loss.upper(), str(code)) for code, loss in enumerate(spheres.LOSSES)]
    lines += [(name, number(value, language)) for name, value in values.items()]
    lines += [(regime.name, str(regime.value)) for regime in Regime]
    return "".join(language.constant.format(name=prefix + n, value=v) for n, v in lines)


def _panels(rows: list[list[int]], prefix: str, language: str) -> str:
    if language == "c":
        values = ",\n".join(f"    {{{', '.join(map(str, row))}}}" for row in rows)
        fields = ", ".join(PANEL_FIELDS)
        return (
            f"struct {prefix}panel {{\n    int {fields};\n}};\n"
            f"static const struct {prefix}panel {prefix}panels[{len(rows)}] = {{\n{values}\n}};\n"
        )
    named = [
        ", ".join(f"{field}: {value}" for field, value in zip(PANEL_FIELDS, row, strict=True))
        for row in rows
    ]
    return "const panels = [\n" + "".join(f"    {{ {row} }},\n" for row in named) + "];\n"


def _values(values: list[Integers], prefix: str, language: str) -> str:
    """Edges and splines; in JavaScript their shapes, as `_code` has the values themselves."""
    if language == "js":
        return f"const shapes = {[list(part.shape) for part in values]};\n"
    rows = [row for part in values for row in part.reshape(-1, part.shape[2]).tolist()]
    lines = ",\n".join(",".join(map(str, row)) for row in rows)
    return f"static const int {prefix}values[{sum(map(len, rows))}] = {{\n{lines}\n}};\n"


def _packed(values: list[Integers]) -> str:
    """The values for JavaScript, as `unfolded` reads them: most are near what neighbours tell."""
    steps = np.concatenate([tables.steps(part).ravel() for part in values]).astype(np.int64)
    bits = np.where(steps < 0, -2 * steps - 1, 2 * steps)[:, None] >> 7 * np.arange(5)
    goes_on = bits[:, 1:] > 0
    digits = bits % 128
    digits[:, :-1] += 128 * goes_on
    used = np.pad(goes_on, ((0, 0), (1, 0)), constant_values=True)
    return base64.b64encode(digits[used].astype(np.uint8).tobytes()).decode()


def _code(layout: _Layout, table: Table, prefix: str, language: str) -> str:
    """The functions, which name numbers and tables."""
    values = {
        "b_least": tables.B_LEAST,
        "b_span": tables.B_MOST - tables.B_LEAST,
        "e_least": tables.E_LEAST,
        "e_span": 1 - tables.E_LEAST,
        "unit": 2.0**-table.exponent,
        "largest": checks.LARGEST,
        "stiffness_most": spheres.LARGEST_STIFFNESS * (1 + spheres.ROUNDING),
        "ratio_least": spheres.LEAST_RATIO * (1 - spheres.ROUNDING),
        "ratio_most": spheres.LARGEST_RATIO * (1 + spheres.ROUNDING),
        "restitution_least": spheres.LEAST_RESTITUTION,
        "nearly": tables.NEARLY,
        "nan": math.nan,
    }
    return Template(CODE[language]).substitute(
        {key: number(value, LANGUAGES[language]) for key, value in values.items()},
        p=prefix,
        P=prefix.upper(),
        left=LEFT,
        right=RIGHT,
        limits=table.limits.shape[1] - 1,
        count=sum(map(np.size, layout.values)),
        packed=_packed(layout.values) if language == "js" else "",
    )
