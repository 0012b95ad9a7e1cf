/*
 * pair.mjs: the rebound of one pair of rough bodies after an oblique impact.
 *
 * <model>
 * A template: the package replaces what stands between two marks, and the name of this file. Here
 * is a rigid body, fitted with the tolerance 0.01.
 * </model>
 *
 * Functions of the incidence x = v1(0)/(mu v2(0)), of any sign:
 *   velocity(x) is the velocity alone.
 *   rebound(x) has
 *     velocity: v1(tf)/(mu v2(0)), which has the sign opposite to x where the contact point has
 *       turned round
 *     peak_friction: largest friction, over mu times the largest normal force
 *     dissipation: work of friction, in mu^2 m2 v2(0)^2
 *     regime: the order of stick and slip, one of the codes below
 *
 * Units and signs: v1 and v2 are the tangential and the normal velocity of the contact point,
 * before the impact (0) and after it (tf), both in one unit. v2(0) is positive towards the
 * surface. mu is the coefficient of friction, above 0.
 *
 * Range: |x| up to INCIDENCE_MAX. For any other x, NaN among them, the numbers are NaN and the
 * regime is UNRESOLVED.
 *
 * Measured error against the model: ERROR_VELOCITY for velocity and ERROR_PEAK_FRICTION for
 * peak_friction. That is twice the largest difference that a search found, plus the tolerance of
 * the model if it has one. Nothing is proved: a narrow kink of the model may have escaped the
 * search. A regime changes within a hundredth of the tolerance of the fit from where that of the
 * model does.
 *
 * Example:
 *   import * as pair from "./pair.mjs";
 *
 *   const v1 = 6, v2 = 5, mu = 0.8; // before the impact
 *   const v1_after = mu * v2 * pair.velocity(v1 / (mu * v2));
 *   const v2_after = -pair.RESTITUTION * v2;
 */

/* <public> */
export const MASS_RATIO = 3.5;
export const STIFFNESS_RATIO = 1.21;
export const RESTITUTION = 1.0;
export const INCIDENCE_MAX = 8e+307;
export const ERROR_VELOCITY = 0.0;
export const ERROR_PEAK_FRICTION = 3.257481802076967e-07;
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
 *   SCALE: cells of first for each unit of |x|
 *   SLIDES_FROM: the |x| from which on the contact slides throughout
 *   CHANGE, IMPULSE: changes of tangential and of normal velocity there
 *   GAINS: 1 if the model may gain energy; if 0, velocities are at most |x|, so that rounding and
 *     the fit create none
 */
/* <private> */
const SCALE = 9.142857142857142;
const SLIDES_FROM = 7.0;
const CHANGE = 7.0;
const IMPULSE = 2.0;
const GAINS = 0;
/* </private> */

/*
 * Polynomials over pieces of |x|, in the variable sqrt(|x| - kink) - centre.
 *   start: left ends of the pieces, and infinity
 *   first: the piece at the left of each cell of equal width, where the search begins
 *   rows: kink, centre, 8 coefficients of velocity and 8 of peak friction in ascending powers
 *   label: regime of the piece
 */

const start = new Float64Array([
/* <start> */
0.0,0.875,3.5,4.375,Infinity,
/* </start> */
]);

const first = new Uint16Array([
/* <first> */
0,0,0,0,0,0,0,0,0,1,1,1,1,1,1,1,1,1,1,1,
1,1,1,1,1,1,1,1,1,1,1,1,1,2,2,2,2,2,2,2,
2,3,3,3,3,3,3,3,3,3,3,3,3,3,3,3,3,3,3,3,
3,3,3,3,3,
/* </first> */
]);

const rows = new Float64Array([
/* <rows> */
0.0,0.4677,0.0,0.0,0.0,0.0,
0.0,0.0,0.0,0.0,0.348,0.72,
-0.0778,-0.05846,-0.005035,-0.00264,-0.0006057,-0.0002715,
0.0,1.403,0.0,0.0,0.0,0.0,
0.0,0.0,0.0,0.0,0.8992,0.3901,
-0.3031,-0.1233,-0.04261,-0.02266,-0.01557,-0.009676,
3.5,0.4677,0.0,0.0,0.0,0.0,
0.0,0.0,0.0,0.0,1.0,0.0,
0.0,0.0,0.0,0.0,0.0,0.0,
3.5,1.403,0.0,0.0,0.0,0.0,
0.0,0.0,0.0,0.0,1.0,0.0,
0.0,0.0,0.0,0.0,0.0,0.0,
/* </rows> */
]);

const label = new Uint8Array([
/* <label> */
1,1,1,1,
/* </label> */
]);

/**
 * @typedef {object} Result
 * @property {number} velocity
 * @property {number} peak_friction
 * @property {number} dissipation
 * @property {number} regime
 */

/**
 * The piece of a size |x|.
 * @param {number} size
 * @returns {number}
 */
function piece_of(size) {
    let piece = first[Math.trunc(size * SCALE)];
    while (size >= start[piece + 1]) piece += 1;
    return piece;
}

/**
 * Its variable there.
 * @param {number} piece
 * @param {number} size
 * @returns {number}
 */
function root_of(piece, size) {
    const at = 18 * piece;
    return Math.sqrt(size - rows[at]) - rows[at + 1];
}

/**
 * A polynomial with the coefficients of ascending powers that begin there.
 * @param {number} at
 * @param {number} root
 * @returns {number}
 */
function polynomial(at, root) {
    let value = rows[at + 7];
    value = value * root + rows[at + 6];
    value = value * root + rows[at + 5];
    value = value * root + rows[at + 4];
    value = value * root + rows[at + 3];
    value = value * root + rows[at + 2];
    value = value * root + rows[at + 1];
    value = value * root + rows[at];
    return value;
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
 * Velocity for |x|, at most so large, where the contact does not slide throughout. For most = 0
 * both bounds are 0: -most would be -0.
 * @param {number} piece
 * @param {number} root
 * @param {number} most
 * @returns {number}
 */
function fitted(piece, root, most) {
    return clipped(polynomial(18 * piece + 2, root), 0 - most, most);
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
 * @returns {number} v1(tf)/(mu v2(0)); NaN out of range
 */
export function velocity(x) {
    const size = Math.abs(x);
    if (!(size <= INCIDENCE_MAX)) return NaN;
    if (size >= SLIDES_FROM) return directed(size - CHANGE, x);
    const piece = piece_of(size);
    return directed(fitted(piece, root_of(piece, size), GAINS ? Infinity : size), x);
}

/**
 * The state at separation.
 * @param {number} x incidence, v1(0)/(mu v2(0))
 * @returns {Result} NaN, and UNRESOLVED, out of range
 */
export function rebound(x) {
    const size = Math.abs(x);
    let velocity = NaN, impulse = NaN, peak_friction = NaN, regime = UNRESOLVED;
    if (size <= INCIDENCE_MAX) {
        if (size >= SLIDES_FROM) {
            velocity = size - CHANGE;
            impulse = IMPULSE;
            peak_friction = 1;
            regime = SLIP_THROUGHOUT;
        } else {
            const piece = piece_of(size), root = root_of(piece, size);
            velocity = fitted(piece, root, GAINS ? Infinity : size);
            impulse = (size - velocity) / MASS_RATIO;
            peak_friction = clipped(polynomial(18 * piece + 10, root), 0, 1);
            regime = label[piece];
        }
        if (size === 0) regime = STICK;
    }
    const dissipation = impulse * (size / 2 + velocity / 2);
    return { velocity: directed(velocity, x), peak_friction, dissipation, regime };
}
