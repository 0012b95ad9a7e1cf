"""The table of spheres in C and JavaScript.

Both evaluate as `planarimpact.spheres` does: the same operations in the same order. Numbers are
stored as in the shipped file: whole numbers, each times a power of 1/2.
"""

import base64
import math
from collections.abc import Mapping
from string import Template
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from planarimpact import __version__, spheres
from planarimpact.export.languages import LANGUAGES, Language, comment, number, packed
from planarimpact.export.languages import table as numbers
from planarimpact.ground import checks
from planarimpact.ground.results import Regime
from planarimpact.spheres import table as tables
from planarimpact.spheres.table import LEFT, POWERS, RIGHT, Panel, Table

# Largest errors of the shipped tables by loss, and the tables by the larger of them.
BOUNDS = {"fine": spheres.ERROR_BOUND, "coarse": {"viscous": 2e-3, "plastic": 2e-2}}
TABLES: dict[float, str] = {max(bounds.values()): name for name, bounds in BOUNDS.items()}
# Coefficients of degree 2 and 3 fit into 16 bits, the others do not.
HIGH = np.array([sum(powers) > 1 for powers in POWERS])
PANEL_FIELDS = [
    *("functions", "patches", "varying", "rows", "columns"),
    *("edges", "patch", "cells", "units", "near"),
]
LAYOUT = [
    "The table. A loss, or a part of it, is a panel; a panel has patches, a patch has cells. In a "
    "cell, velocity, peak friction and with viscous loss work are polynomials of degree 3 in s, t "
    "and u: places over y = x/stiffness_ratio, restitution and b = mass_ratio/stiffness_ratio. A "
    "real number is a whole number times a power of 1/2.",
    "  limit: restitution between the two plastic panels, over u",
    "  panels: functions, patches, edges that vary, their rows over t and columns over u; where "
    "its edges, patches, cells, units and the entries of near begin",
    "  edges: of the panels, edges in y at the nodes of rows and columns",
    "  patches: where s has its root (0 nowhere, $left left, $right right); cells over s, t and u; "
    "the first cell",
    "  high, low: coefficients of each cell and function, of degree 2 and 3, and below",
    "  unit: powers of 1/2 for the coefficients of each function",
    "  near: 0, or which row of finer has the cells that answer in place of a cell",
    "  finer: into how many parts each way they are split; the first of them for each kind",
]
CODE = {
    "c": """\
struct ${p}result {
    double velocity;
    double peak_friction;
    double dissipation;
    int regime;
};

/* A place in a cell, and the first of its functions. */
struct ${p}place {
    int record;
    double s, t, u;
};

/* Where an impact is: its place, that before cells are split, and what follows from its edges. */
struct ${p}spot {
    const struct ${p}panel *panel;
    struct ${p}place at, whole;
    int patch, multiple;
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

/* One function of a cell, by Horner's rule. */
static inline double ${p}polynomial(int record, int units, struct ${p}place at)
{
    const short *a = ${p}high + $high * record;
    const int *c = ${p}low + $low * record;
    const double *k = ${p}unit + $powers * units, s = at.s, t = at.t, u = at.u;
    return $horner;
}

static inline struct ${p}spot ${p}find(double y, double b, double e, int loss)
{
    double u = (b - $b_least) / $b_span, at = u * $limits, t, over, across;
    double edge[7] = {0}, varying[7] = {0}, low, high, width, s;
    int i = ${p}index(at, $limits), early, j, k, cell, stride, root;
    double part = at - i, limit = (1 - part) * ${p}limit[i] + part * ${p}limit[i + 1];
    const int *corner, *patch;
    struct ${p}spot found;
    early = loss == ${P}PLASTIC && e < limit;
    found.panel = ${p}panels + (loss == ${P}VISCOUS ? 0 : early ? 1 : 2);
    if (loss == ${P}VISCOUS) {
        t = (e - $e_least) / $e_span;
    } else if (early) {
        double rest = $e_least / e - $e_least / limit;
        t = 1 - sqrt((rest > 0 ? rest : 0) / (1 - $e_least / limit));
    } else {
        t = sqrt(sqrt((1 - e) / (1 - limit)));
    }

    /* Edges, between four nodes. */
    at = t * found.panel->rows;
    i = ${p}index(at, found.panel->rows);
    over = at - i;
    at = u * found.panel->columns;
    j = ${p}index(at, found.panel->columns);
    across = at - j;
    stride = found.panel->varying;
    corner = ${p}edges + found.panel->edges + stride * (i * (found.panel->columns + 1) + j);
    for (k = 0; k < stride; ++k) {
        const int *next = corner + stride * (found.panel->columns + 1);
        double before = (1 - across) * (corner[k] * $unit) + across * (corner[k + stride] * $unit);
        double after = (1 - across) * (next[k] * $unit) + across * (next[k + stride] * $unit);
        varying[k] = (1 - over) * before + over * after;
    }
    edge[early ? 2 : 1] = 1;
    edge[early ? 1 : 2] = varying[0];
    edge[3] = varying[1];
    edge[found.panel->patches - 1] = b;
    edge[found.panel->patches] = b + e * (b - 1);

    /* The patch, and s in it. */
    found.patch = 0;
    low = edge[0];
    high = edge[1];
    for (k = 1; k < found.panel->patches; ++k) {
        if (y >= edge[k]) {
            ++found.patch;
            low = edge[k];
            high = edge[k + 1];
        }
    }
    width = high - low;
    s = ${p}clipped((y - low) / (width > 0 ? width : 1), 0, 1);
    patch = ${p}patches + 5 * (found.panel->patch + found.patch);
    root = patch[0];
    if (root == $right)
        s = 1 - sqrt(1 - s);
    else if (root == $left)
        s = sqrt(s);

    /* The cell. */
    found.at.s = s * patch[1];
    found.at.t = t * patch[2];
    found.at.u = u * patch[3];
    i = ${p}index(found.at.s, patch[1]);
    j = ${p}index(found.at.t, patch[2]);
    k = ${p}index(found.at.u, patch[3]);
    found.at.s -= i;
    found.at.t -= j;
    found.at.u -= k;
    cell = patch[4] + (i * patch[2] + j) * patch[3] + k;
    found.whole = found.at;
    found.whole.record = $reversed + cell;
    found.multiple = early && y >= varying[2] && y <= 1;

    /* Its own parts, and cells for each kind of plastic impact. */
    if (loss == ${P}PLASTIC && ${p}near[found.panel->near + cell]) {
        const int *finer = ${p}finer + 5 * ${p}near[found.panel->near + cell];
        const double *kinds = varying + stride - 4;
        int forward = y >= kinds[0] && y < kinds[1], returns = y >= kinds[2] && y < kinds[3];
        int parts = finer[0];
        cell = finer[1 + 2 * returns + !forward];
        if (parts > 1) {
            found.at.s *= parts;
            found.at.t *= parts;
            found.at.u *= parts;
            i = ${p}index(found.at.s, parts);
            j = ${p}index(found.at.t, parts);
            k = ${p}index(found.at.u, parts);
            found.at.s -= i;
            found.at.t -= j;
            found.at.u -= k;
            cell += (i * parts + j) * parts + k;
        }
    }
    found.at.record = found.panel->cells + cell * found.panel->functions;
    return found;
}

static inline double ${p}function(const struct ${p}spot *spot, int number)
{
    return ${p}polynomial(spot->at.record + number, spot->panel->units + number, spot->at);
}

/* Whether the table has an answer. */
static inline int ${p}covers(
    double x, double mass_ratio, double stiffness_ratio, double restitution, int loss)
{
    double ratio = mass_ratio / stiffness_ratio;
    return fabs(x) <= ${P}INCIDENCE_MAX && mass_ratio >= 1 && mass_ratio <= $largest
        && ratio >= $ratio_least && ratio <= $ratio_most && restitution >= $restitution_least
        && restitution <= 1 && (loss == ${P}VISCOUS || loss == ${P}PLASTIC);
}

/* The incidence from which the contact slides throughout. */
static inline double ${p}slides_from(
    double mass_ratio, double stiffness_ratio, double restitution)
{
    double limit = mass_ratio + restitution * (mass_ratio - stiffness_ratio);
    return limit > stiffness_ratio ? limit : stiffness_ratio;
}

/* Tangential velocity of the contact point at separation, v1(tf)/(mu v2(0)); NaN out of range. */
static inline double ${p}velocity(
    double x, double mass_ratio, double stiffness_ratio, double restitution, int loss)
{
    double size = fabs(x), velocity;
    if (!${p}covers(x, mass_ratio, stiffness_ratio, restitution, loss))
        return $nan;
    if (size >= ${p}slides_from(mass_ratio, stiffness_ratio, restitution)) {
        velocity = size - (1 + restitution) * mass_ratio;
    } else {
        struct ${p}spot spot = ${p}find(
            size / stiffness_ratio, mass_ratio / stiffness_ratio, restitution, loss);
        velocity = ${p}clipped(stiffness_ratio * ${p}function(&spot, 0), 0.0 - size, size);
    }
    return velocity * copysign(1.0, x);
}

/* The state at separation; NaN, and ${P}UNRESOLVED, out of range. */
static inline struct ${p}result ${p}rebound(
    double x, double mass_ratio, double stiffness_ratio, double restitution, int loss)
{
    struct ${p}result found = {$nan, $nan, $nan, ${P}UNRESOLVED};
    double size = fabs(x), beta = mass_ratio, zeta2 = stiffness_ratio, e = restitution, w;
    if (!${p}covers(x, beta, zeta2, e, loss))
        return found;
    if (size >= ${p}slides_from(beta, zeta2, e)) {
        double change = (1 + e) * beta;
        w = size - change;
        found.peak_friction = 1.0;
        if (loss == ${P}VISCOUS)
            found.dissipation = (1 + e) * (size - zeta2 - (beta - zeta2) * (1 + e) / 2);
        else
            found.dissipation = (1 + e) * (size - change / 2);
        found.regime = ${P}SLIP_THROUGHOUT;
    } else {
        struct ${p}spot spot = ${p}find(size / zeta2, beta / zeta2, e, loss);
        double peak = ${p}function(&spot, 1);
        w = ${p}clipped(zeta2 * ${p}function(&spot, 0), 0.0 - size, size);
        if (spot.panel == ${p}panels + 1 && spot.patch == 0) {
            double back = ${p}polynomial(spot.whole.record, $back, spot.whole);
            peak = back > peak ? back : peak;
        }
        found.peak_friction = ${p}clipped(peak, 0.0, 1.0);
        if (loss == ${P}VISCOUS) {
            double work = zeta2 * ${p}function(&spot, 2);
            found.dissipation = work > 0 ? work : 0.0;
        } else {
            found.dissipation = (size - w) * (size + w) / (2 * beta);
        }
        found.regime = size / zeta2 > 1 ? ${P}SLIP_STICK_SLIP : ${P}STICK_SLIP;
        if (spot.multiple)
            found.regime = ${P}MULTIPLE;
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
 * The edges: each number is stored as what it adds to its neighbours, before it and above, in 7
 * bits a byte, the lowest first.
 * @param {string} text base64
 * @returns {Int32Array}
 */
function unfolded(text) {
    const all = new Uint8Array(bytes(text)), found = new Int32Array($edges);
    let next = 0, i = 0;
    for (const { rows, columns, varying } of panels) {
        const down = (columns + 1) * varying, end = i + (rows + 1) * down;
        for (const start = i; i < end; i += 1) {
            let value = 0, shift = 0;
            for (; all[next] > 127; shift += 7) value += (all[next++] - 128) << shift;
            value += all[next++] << shift;
            value = value % 2 ? -(value + 1) / 2 : value / 2;
            const above = i - down >= start, before = (i - start) % down >= varying;
            if (above) value += found[i - down];
            if (before) value += found[i - varying];
            if (above && before) value -= found[i - down - varying];
            found[i] = value;
        }
    }
    return found;
}

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
 * One function of a cell, by Horner's rule.
 * @param {number} record
 * @param {number} units
 * @param {number} s
 * @param {number} t
 * @param {number} u
 * @returns {number}
 */
function polynomial(record, units, s, t, u) {
    const a = $high * record, c = $low * record, k = $powers * units;
    return $horner;
}

/**
 * Where an impact is: its place, that before cells are split, and what follows from its edges.
 * @param {number} y
 * @param {number} b
 * @param {number} e
 * @param {number} loss
 */
function find(y, b, e, loss) {
    const u = (b - $b_least) / $b_span, place = u * $limits;
    const cell_of_limit = index_of(place, $limits), part = place - cell_of_limit;
    const middle = (1 - part) * limit[cell_of_limit] + part * limit[cell_of_limit + 1];
    const early = loss === PLASTIC && e < middle;
    const panel = panels[loss === VISCOUS ? 0 : early ? 1 : 2];
    let t = (e - $e_least) / $e_span;
    if (early) {
        const rest = Math.max($e_least / e - $e_least / middle, 0);
        t = 1 - Math.sqrt(rest / (1 - $e_least / middle));
    } else if (loss === PLASTIC) {
        t = Math.sqrt(Math.sqrt((1 - e) / (1 - middle)));
    }

    // Edges, between four nodes.
    const row = index_of(t * panel.rows, panel.rows), over = t * panel.rows - row;
    const column = index_of(u * panel.columns, panel.columns);
    const across = u * panel.columns - column, stride = panel.varying;
    const corner = panel.edges + stride * (row * (panel.columns + 1) + column);
    const next = corner + stride * (panel.columns + 1), varying = [];
    for (let k = 0; k < stride; k += 1) {
        const before =
            (1 - across) * (edges[corner + k] * $unit) +
            across * (edges[corner + stride + k] * $unit);
        const after =
            (1 - across) * (edges[next + k] * $unit) +
            across * (edges[next + stride + k] * $unit);
        varying.push((1 - over) * before + over * after);
    }
    const edge = early ? [0, varying[0], 1] : [0, 1, varying[0]];
    if (panel.patches === 5) edge.push(varying[1]);
    edge.push(b, b + e * (b - 1));

    // The patch, and s in it.
    let patch = 0, low = edge[0], high = edge[1];
    for (let k = 1; k < panel.patches; k += 1) {
        if (y >= edge[k]) {
            patch += 1;
            low = edge[k];
            high = edge[k + 1];
        }
    }
    const width = high - low, row_of_patch = 5 * (panel.patch + patch);
    let s = clipped((y - low) / (width > 0 ? width : 1), 0, 1);
    const root = patches[row_of_patch];
    if (root === $right) s = 1 - Math.sqrt(1 - s);
    else if (root === $left) s = Math.sqrt(s);

    // The cell.
    const [, over_s, over_t, over_u, first] = patches.subarray(row_of_patch, row_of_patch + 5);
    const whole = [s * over_s, t * over_t, u * over_u];
    const i = index_of(whole[0], over_s);
    const j = index_of(whole[1], over_t);
    const k = index_of(whole[2], over_u);
    whole[0] -= i;
    whole[1] -= j;
    whole[2] -= k;
    let cell = first + (i * over_t + j) * over_u + k;
    const at = [...whole], back = early && patch === 0 ? $reversed + cell : -1;

    // Its own parts, and cells for each kind of plastic impact.
    const entry = loss === PLASTIC ? 5 * near[panel.near + cell] : 0;
    if (entry) {
        const [f, g, h, l] = varying.slice(-4), parts = finer[entry];
        const forward = y >= f && y < g, returns = y >= h && y < l;
        cell = finer[entry + 1 + (returns ? 2 : 0) + (forward ? 0 : 1)];
        if (parts > 1) {
            let within = 0;
            for (let axis = 0; axis < 3; axis += 1) {
                const fine = at[axis] * parts, index = index_of(fine, parts);
                at[axis] = fine - index;
                within = within * parts + index;
            }
            cell += within;
        }
    }
    const record = panel.cells + cell * panel.functions;
    const multiple = early && y >= varying[2] && y <= 1;
    return { record, units: panel.units, at, back, whole, multiple };
}

/**
 * A function at a place that `find` found.
 * @param {{record: number, units: number, at: number[]}} spot
 * @param {number} number
 * @returns {number}
 */
function function_of({ record, units, at }, number) {
    return polynomial(record + number, units + number, at[0], at[1], at[2]);
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
        && ratio >= $ratio_least && ratio <= $ratio_most && restitution >= $restitution_least
        && restitution <= 1 && (loss === VISCOUS || loss === PLASTIC);
}

/**
 * The incidence from which the contact slides throughout.
 * @param {number} mass_ratio
 * @param {number} stiffness_ratio
 * @param {number} restitution
 * @returns {number}
 */
function slides_from(mass_ratio, stiffness_ratio, restitution) {
    const limit = mass_ratio + restitution * (mass_ratio - stiffness_ratio);
    return Math.max(stiffness_ratio, limit);
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
    if (size >= slides_from(beta, zeta2, e)) return directed(size - (1 + e) * beta, x);
    const spot = find(size / zeta2, beta / zeta2, e, loss);
    return directed(clipped(zeta2 * function_of(spot, 0), 0 - size, size), x);
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
    if (size >= slides_from(beta, zeta2, e)) {
        const change = (1 + e) * beta;
        velocity = size - change;
        peak_friction = 1;
        dissipation = loss === VISCOUS
            ? (1 + e) * (size - zeta2 - (beta - zeta2) * (1 + e) / 2)
            : (1 + e) * (size - change / 2);
        regime = SLIP_THROUGHOUT;
    } else {
        const spot = find(size / zeta2, beta / zeta2, e, loss);
        velocity = clipped(zeta2 * function_of(spot, 0), 0 - size, size);
        peak_friction = function_of(spot, 1);
        if (spot.back >= 0) {
            const [s, t, u] = spot.whole;
            peak_friction = Math.max(peak_friction, polynomial(spot.back, $back, s, t, u));
        }
        peak_friction = clipped(peak_friction, 0, 1);
        dissipation = loss === VISCOUS
            ? Math.max(zeta2 * function_of(spot, 2), 0)
            : (size - velocity) * (size + velocity) / (2 * beta);
        regime = size / zeta2 > 1 ? SLIP_STICK_SLIP : STICK_SLIP;
        if (spot.multiple) regime = MULTIPLE;
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
  ${P}PLASTIC: elastic-plastic spheres

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
    dissipation: work of friction, in mu^2 m2 v2(0)^2
    regime: the order of stick and slip, one of the codes below

Units and signs: v1 and v2 are the tangential and the normal velocity of the contact point, before \
the impact (0) and after it (tf), both in one unit. v2(0) is positive towards the surface. mu is \
the coefficient of friction, above 0.

Range: |x| up to ${P}INCIDENCE_MAX, restitution from ${P}RESTITUTION_MIN to 1, mass_ratio from 1, \
mass_ratio/stiffness_ratio from ${P}RATIO_MIN to ${P}RATIO_MAX. Beyond it, and for NaN, the \
numbers are NaN and the regime is ${P}UNRESOLVED.

Error against the model, of velocity, peak_friction and dissipation: at most ${P}ERROR_VISCOUS or \
${P}ERROR_PLASTIC, by loss. It was measured at random impacts, half of them beside the edges of \
the table; it is not proved. Slip throughout is a formula.

Example:
$example
"""
EXAMPLES = {
    "c": """\
  #include "$file" // compile without -ffast-math, which does not know NaN

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
    panels : ndarray of int32, shape (panels, fields)
        See `PANEL_FIELDS`.
    edges : list of ndarray of int32, shape (rows, columns, edges)
    arrays : dict
        Tables of whole numbers by their names.
    unit : ndarray, shape (functions, 20)
    reversed : int
        The first record of `Panel.reversed`, whose units are the last.
    """

    panels: NDArray[Any]
    edges: list[NDArray[Any]]
    arrays: dict[str, NDArray[Any]]
    unit: NDArray[Any]
    reversed: int


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
    blocks = [
        _constants(bounds, prefix.upper(), chosen),
        comment(Template(one).substitute(left=LEFT, right=RIGHT) for one in LAYOUT),
        numbers(prefix + "limit", table.limit, chosen),
        _panels(layout.panels, prefix, language),
        _edges(layout.edges, prefix, language),
        *(packed(prefix + key, values, chosen) for key, values in layout.arrays.items()),
        numbers(prefix + "unit", layout.unit, chosen),
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
    """Panels one after the other, and what is used together side by side."""
    panels: list[list[int]] = []
    # Row 0 of `finer` stands for cells that answer themselves.
    parts: dict[str, list[NDArray[Any]]] = {
        "patches": [],
        "records": [],
        "exponents": [],
        "near": [],
        "finer": [np.zeros((1, 5), int)],
    }
    grids: list[NDArray[Any]] = []
    begins = "patches", "records", "exponents", "near"
    for panel in table.panels.values():
        functions = len(panel.coefficients)
        varying, rows, columns = panel.edges.shape
        counts = [functions, len(panel.roots), varying, rows - 1, columns - 1]
        counts.append(sum(map(np.size, grids)))
        grids.append(np.moveaxis(tables.packed(panel.edges)[0], 0, -1))
        panels.append(counts + [sum(map(len, parts[key])) for key in begins])
        whole, exponent = tables.packed(panel.coefficients)
        near, finer = _near(panel, sum(map(len, parts["finer"])))
        for key, part in {
            "patches": np.column_stack([panel.roots, panel.shapes, panel.first]),
            "records": whole.transpose(2, 0, 1).reshape(-1, len(POWERS)),
            "exponents": exponent,
            "near": near,
            "finer": finer,
        }.items():
            parts[key].append(part)
    reversed_ = sum(map(len, parts["records"]))
    whole, exponent = tables.packed(table.panels["plastic_low"].reversed)
    parts["records"].append(whole.T)
    parts["exponents"].append(exponent[None])
    joined = {key: np.concatenate(part) for key, part in parts.items()}
    arrays: dict[str, NDArray[Any]] = {
        "patches": joined["patches"].astype(np.int32),
        "high": joined["records"][:, HIGH].astype(np.int16),
        "low": joined["records"][:, ~HIGH].astype(np.int32),
        "near": joined["near"].reshape(1, -1).astype(np.uint16),
        "finer": joined["finer"].astype(np.int32),
    }
    unit = 2.0 ** -joined["exponents"].astype(float)
    return _Layout(np.array(panels), grids, arrays, unit, reversed_)


def _near(panel: Panel, first: int) -> tuple[NDArray[Any], NDArray[Any]]:
    """For each cell 0 or a row, from `first` on; and these rows, of split and twins."""
    others = panel.twins != np.arange(panel.twins.shape[1])
    some = np.flatnonzero(others.any(axis=0) | (panel.split > 1))
    entries = np.zeros(panel.twins.shape[1], int)
    entries[some] = first + np.arange(some.size)
    return entries, np.column_stack([panel.split[some], panel.twins[:, some].T])


def _constants(bounds: Mapping[str, float], prefix: str, language: Language) -> str:
    """What users may read: losses, range, error and the codes of regimes."""
    values = {
        "INCIDENCE_MAX": checks.LARGEST,
        "RESTITUTION_MIN": spheres.LEAST_RESTITUTION,
        "RATIO_MIN": spheres.LEAST_RATIO,
        "RATIO_MAX": spheres.LARGEST_RATIO,
        **{f"ERROR_{loss.upper()}": bound for loss, bound in bounds.items()},
    }
    lines = [(loss.upper(), str(code)) for code, loss in enumerate(spheres.LOSSES)]
    lines += [(name, number(value, language)) for name, value in values.items()]
    lines += [(regime.name, str(regime.value)) for regime in Regime]
    return "".join(language.constant.format(name=prefix + n, value=v) for n, v in lines)


def _panels(panels: NDArray[Any], prefix: str, language: str) -> str:
    rows = panels.tolist()
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


def _edges(grids: list[NDArray[Any]], prefix: str, language: str) -> str:
    """Edges; in JavaScript as `unfolded` reads them: most are near what their neighbours tell."""
    if language == "c":
        lines = [grid.reshape(-1, grids[0].shape[1]) for grid in grids]
        return packed(prefix + "edges", np.concatenate(lines), LANGUAGES[language])
    parts = [np.diff(np.diff(grid, axis=0, prepend=0), axis=1, prepend=0).ravel() for grid in grids]
    steps = np.concatenate(parts).astype(np.int64)
    bits = np.where(steps < 0, -2 * steps - 1, 2 * steps)[:, None] >> 7 * np.arange(5)
    goes_on = bits[:, 1:] > 0
    digits = bits % 128
    digits[:, :-1] += 128 * goes_on
    used = np.pad(goes_on, ((0, 0), (1, 0)), constant_values=True)
    text = base64.b64encode(digits[used].astype(np.uint8).tobytes()).decode()
    return f'const edges = unfolded("{text}");\n'


def _code(layout: _Layout, table: Table, prefix: str, language: str) -> str:
    """The functions, which name numbers and tables."""
    values = {
        "b_least": tables.B_LEAST,
        "b_span": tables.B_MOST - tables.B_LEAST,
        "e_least": tables.E_LEAST,
        "e_span": 1 - tables.E_LEAST,
        "unit": 2.0**-tables.FINE,
        "largest": checks.LARGEST,
        "ratio_least": spheres.LEAST_RATIO * (1 - spheres.ROUNDING),
        "ratio_most": spheres.LARGEST_RATIO * (1 + spheres.ROUNDING),
        "restitution_least": spheres.LEAST_RESTITUTION,
        "nan": math.nan,
    }
    at = ("high[a + {}]", "low[c + {}]", "unit[k + {}]")
    return Template(CODE[language]).substitute(
        {key: number(value, LANGUAGES[language]) for key, value in values.items()},
        p=prefix,
        P=prefix.upper(),
        left=LEFT,
        right=RIGHT,
        limits=table.limit.size - 1,
        high=np.count_nonzero(HIGH),
        low=np.count_nonzero(~HIGH),
        powers=len(POWERS),
        horner=_horner(*at) if language == "js" else _horner("a[{}]", "c[{}]", "k[{}]"),
        edges=sum(grid.size for grid in layout.edges),
        reversed=layout.reversed,
        back=len(layout.unit) - 1,
    )


def _horner(high: str, low: str, unit: str) -> str:
    """The polynomial of `table.polynomial` as one expression of coefficients."""
    places = {True: iter(range(len(HIGH))), False: iter(range(len(HIGH)))}
    lines: dict[tuple[int, ...], str] = {}
    for power, powers in enumerate(POWERS):
        is_high = bool(HIGH[power])
        name = (high if is_high else low).format(next(places[is_high]))
        term = f"{name} * {unit.format(power)}"
        key = powers[:2]
        lines[key] = f"({lines[key]}) * u + {term}" if key in lines else term
    whole: dict[int, str] = {}
    for (i, *_), line in lines.items():
        whole[i] = f"({whole[i]}) * t\n            + ({line})" if i in whole else line
    first, *others = whole.values()
    for other in others:
        first = f"({first}) * s\n        + ({other})"
    return first
