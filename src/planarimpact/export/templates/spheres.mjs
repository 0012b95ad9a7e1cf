/*
 * spheres.mjs: the rebound of rough spheres after an oblique impact, every impact with materials
 * of its own.
 *
 * <version>
 * A template: the package replaces what stands between two marks, and the name of this file. The
 * table here only has the form of one.
 * </version>
 *
 * Model: the contact of Hertz with micro-slip (the continuum), with what takes the energy where
 * restitution is below 1, one for each impact:
 *   VISCOUS: Kelvin-Voigt spheres with one relaxation time
 *   PLASTIC: elastic-plastic spheres, which flow in shear while they yield
 *
 * Functions of the incidence x = v1(0)/(mu v2(0)), of any sign, and of
 *   mass_ratio: m2/m1, effective normal over tangential mass: 3.5 for solid spheres, 2.5 for thin
 *   shells
 *   stiffness_ratio: zeta^2, normal over tangential stiffness: (2 - nu)/(2 (1 - nu)), nu of
 *   Poisson
 *   restitution: e, the energetic coefficient
 *   loss: VISCOUS or PLASTIC
 * are
 *   covers(x, mass_ratio, stiffness_ratio, restitution, loss), whether there is an answer;
 *   velocity(x, mass_ratio, stiffness_ratio, restitution, loss), the velocity alone;
 *   rebound(x, mass_ratio, stiffness_ratio, restitution, loss), which has
 *     velocity: v1(tf)/(mu v2(0)), which has the sign opposite to x where the contact point has
 *       turned round
 *     peak_friction: largest friction, over mu times the largest normal force
 *     dissipation: work of friction, in mu^2 m2 v2(0)^2; with plastic loss also that of the flow
 *     in shear
 *     regime: the order of stick and slip, one of the codes below
 *
 * Units and signs: v1 and v2 are the tangential and the normal velocity of the contact point,
 * before the impact (0) and after it (tf), both in one unit. v2(0) is positive towards the
 * surface. mu is the coefficient of friction, above 0.
 *
 * Range: |x| up to INCIDENCE_MAX, restitution from RESTITUTION_MIN to 1, mass_ratio from 1,
 * stiffness_ratio up to STIFFNESS_MAX, mass_ratio/stiffness_ratio from RATIO_MIN to RATIO_MAX.
 * Beyond it, and for NaN, the numbers are NaN and the regime is UNRESOLVED.
 *
 * Error against the model, of velocity, peak_friction and dissipation: at most ERROR_VISCOUS or
 * ERROR_PLASTIC, by loss. It was measured by a search for the largest error; it is not proved.
 * Slip throughout is a line.
 *
 * Example:
 *   import * as spheres from "./spheres.mjs";
 *
 *   const v1 = 6, v2 = 5, mu = 0.8, e = 0.9; // a solid sphere of rubber, before the impact
 *   const v1_after = mu * v2 * spheres.velocity(v1 / (mu * v2), 3.5, 1.5, e, spheres.VISCOUS);
 *   const v2_after = -e * v2;
 */

/* <public> */
export const VISCOUS = 0;
export const PLASTIC = 1;
export const INCIDENCE_MAX = 8e+307;
export const RESTITUTION_MIN = 0.3;
export const STIFFNESS_MAX = 1.6;
export const RATIO_MIN = 1.5625;
export const RATIO_MAX = 3.5;
export const ERROR_VISCOUS = 0.003;
export const ERROR_PLASTIC = 0.04;
export const STICK = 0;
export const SLIP_STICK = 1;
export const STICK_SLIP = 2;
export const SLIP_STICK_SLIP = 3;
export const SLIP_THROUGHOUT = 4;
export const MULTIPLE = 5;
export const UNRESOLVED = 6;
/* </public> */

/*
 * Numbers of the functions below.
 *   B_LEAST, B_SPAN, E_LEAST, E_SPAN: ranges of b and restitution that u and t stand for
 *   UNIT: of the values
 *   MASS_RATIO_MOST, STIFFNESS_MOST, RATIO_LEAST, RATIO_MOST: bounds, which leave room for rounding
 *   NEARLY: a little less than 1: an impact so near to slip throughout slides throughout
 *   LEFT, RIGHT: where s has its root
 *   INTERVALS: intervals of limits over u
 */
/* <private> */
const B_LEAST = 1.55;
const B_SPAN = 2.0;
const E_LEAST = 0.295;
const E_SPAN = 0.705;
const UNIT = 0.000244140625;
const MASS_RATIO_MOST = 8e+307;
const STIFFNESS_MOST = 1.6000000016;
const RATIO_LEAST = 1.5625;
const RATIO_MOST = 3.5;
const NEARLY = 0.9999999999999991;
const LEFT = 1;
const RIGHT = 2;
const INTERVALS = 1;
/* </private> */

/*
 * The table. A loss, or a part of it, is a panel; a panel has patches. In a patch velocity, peak
 * friction and work are cubic splines in s, t and u: places over y = x/stiffness_ratio,
 * restitution and b = mass_ratio/stiffness_ratio.
 *   limits: restitutions between the three plastic panels, over u
 *   panels: its first patch, and how many; edges that vary, their intervals over t and u;
 *   coefficients over t and u; where its edges and splines begin in values, or -1
 *   patches: where s has its root (0 nowhere, LEFT left, RIGHT right), intervals over s, and the
 *   first coefficient over s
 *   values: edges in y, and coefficients of splines, in units of UNIT
 */

const limits = new Float64Array([
/* <limits> */
0.7,0.5,0.8,0.6,
/* </limits> */
]);

const panels = [
/* <panels> */
[0,4,0,1,1,4,4,-1,0,0,0],
[0,4,0,1,1,4,4,-1,0,0,0],
[0,4,0,1,1,4,4,-1,0,0,0],
[0,4,0,1,1,4,4,-1,0,0,0],
/* </panels> */
].map(([patch, patches, varying, rows, columns, over_t, over_u, edges, velocity, peak, work]) => (
    { patch, patches, varying, rows, columns, over_t, over_u, edges, velocity, peak, work }
));

const patches = new Int32Array([
/* <patches> */
0,1,0,1,1,4,
0,1,8,2,1,12,
/* </patches> */
]);

const shapes = [
/* <shapes> */
[1,1,3],
/* </shapes> */
];

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
    const count = shapes.reduce((sum, [layers, rows, columns]) => sum + layers * rows * columns, 0);
    const all = new Uint8Array(packed), numbers = new Int32Array(count);
    let next = 0, begin = 0;
    for (const [layers, rows, columns] of shapes) {
        const end = begin + layers * rows * columns;
        for (let i = begin; i < end; i += 1) {
            let value = 0, shift = 0;
            for (; all[next] > 127; shift += 7) value += (all[next++] - 128) << shift;
            value += all[next++] << shift;
            numbers[i] = value % 2 ? -(value + 1) / 2 : value / 2;
        }
        for (const [step, size] of [[1, columns], [columns, rows], [rows * columns, layers]])
            for (let i = begin; i < end; i += 1)
                if (Math.trunc((i - begin) / step) % size) numbers[i] += numbers[i - step];
        begin = end;
    }
    return numbers;
}

const values = unfolded(bytes(
/* <packed> */
"AAAA"
/* </packed> */
));

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
    const u = (b - B_LEAST) / B_SPAN, interval = index_of(u * INTERVALS, INTERVALS);
    const part = u * INTERVALS - interval, alike = b + e * (b - 1);
    const between = (k) => (1 - part) * limits[k] + part * limits[k + 1];
    const low_e = between(interval), high_e = between(interval + INTERVALS + 1);
    const which = loss === VISCOUS ? 0 : e < low_e ? 1 : e < high_e ? 2 : 3, panel = panels[which];
    const t = [
        () => (e - E_LEAST) / E_SPAN,
        () => 1 - Math.sqrt(clipped(E_LEAST / e - E_LEAST / low_e, 0, 1) / (1 - E_LEAST / low_e)),
        () => (e - low_e) / (high_e - low_e),
        () => Math.sqrt(Math.sqrt((1 - e) / (1 - high_e))),
    ][which]();

    // Edges, between four nodes.
    const row = index_of(t * panel.rows, panel.rows), over = t * panel.rows - row;
    const column = index_of(u * panel.columns, panel.columns);
    const across = u * panel.columns - column, columns = panel.columns + 1;
    const varying = [];
    for (let k = 0; k < panel.varying; k += 1) {
        const c = panel.edges + (k * (panel.rows + 1) + row) * columns + column;
        const next = c + columns;
        const before = (1 - across) * (values[c] * UNIT) + across * (values[c + 1] * UNIT);
        const after =
            (1 - across) * (values[next] * UNIT) + across * (values[next + 1] * UNIT);
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
    if (root === RIGHT) s = 1 - Math.sqrt(1 - s);
    else if (root === LEFT) s = Math.sqrt(s);

    const over_s = place(s, intervals);
    const over_t = place(t, panel.over_t - 3), over_u = place(u, panel.over_u - 3);
    let base = (first + over_s.index) * panel.over_t + over_t.index;
    base = base * panel.over_u + over_u.index;
    return {
        panel,
        base,
        slides: y >= edge[panel.patches] * NEARLY,
        weights: [over_s.weights, over_t.weights, over_u.weights],
    };
}

/**
 * A spline at a place of `find`, whose coefficients begin at a number of the values.
 * @param {ReturnType<typeof find>} spot
 * @param {number} begin
 * @returns {number}
 */
function spline({ panel, base, weights: [over_s, over_t, over_u] }, begin) {
    let outer = 0;
    for (let i = 0; i < 4; i += 1) {
        let middle = 0;
        for (let j = 0; j < 4; j += 1) {
            const c = begin + base + (i * panel.over_t + j) * panel.over_u;
            let inner = 0;
            for (let k = 0; k < 4; k += 1) inner += values[c + k] * over_u[k];
            middle += inner * over_t[j];
        }
        outer += middle * over_s[i];
    }
    return outer * UNIT;
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
    return Math.abs(x) <= INCIDENCE_MAX && mass_ratio >= 1 && mass_ratio <= MASS_RATIO_MOST
        && stiffness_ratio <= STIFFNESS_MOST && ratio >= RATIO_LEAST && ratio <= RATIO_MOST
        && restitution >= RESTITUTION_MIN && restitution <= 1
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
