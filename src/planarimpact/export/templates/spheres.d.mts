/*
 * Types of spheres.mjs, for TypeScript and for editors. The top of that file has the rest.
 *
 * <version>
 * Written by planarimpact $value. Do not edit it: write it anew.
 * </version>
 */

/* <public> */
export const $name: $value;
/* </public> */

/** What takes the energy. */
export type Loss = typeof VISCOUS | typeof PLASTIC;

/** x, y and z. */
export type Vector = readonly number[];

export interface Body {
    /** [kg] */
    readonly mass: number;
    /** [m] */
    readonly gyration: number;
    /** [m] */
    readonly radius: number;
}

/** Either restitution and loss, or effective_modulus and one of the two numbers before it. */
export interface Pair {
    readonly friction: number;
    readonly stiffness_ratio: number;
    readonly restitution?: number | undefined;
    /** 0, or left out, where nothing is lost or where it follows from the next two numbers. */
    readonly loss?: Loss | 0 | undefined;
    /** [s] */
    readonly relaxation_time?: number | undefined;
    /** [Pa] */
    readonly yield_pressure?: number | undefined;
    /** [Pa] */
    readonly effective_modulus?: number | undefined;
}

export interface Collision {
    velocity: [number, number, number];
    spin: [number, number, number];
    other_velocity: [number, number, number];
    other_spin: [number, number, number];
    /** On the body [N s]. */
    impulse: [number, number, number];
    /** v1(0)/(mu v2(0)) */
    incidence: number;
    restitution: number;
    /** [m/s] */
    error_bound: number;
    regime: number;
}

export interface Result {
    /** v1(tf)/(mu v2(0)) */
    velocity: number;
    peak_friction: number;
    dissipation: number;
    regime: number;
}

/** A flat body that neither moves nor turns by an impact; it may have a velocity. */
export const WALL: Body;

/**
 * A homogeneous sphere.
 * @param radius [m]
 * @param mass [kg]
 */
export function solid_sphere_by_mass(radius: number, mass: number): Body;

/**
 * A homogeneous sphere.
 * @param radius [m]
 * @param density [kg/m^3]
 */
export function solid_sphere_by_density(radius: number, density: number): Body;

/**
 * A thin hollow sphere.
 * @param radius [m]
 * @param mass [kg]
 */
export function thin_shell(radius: number, mass: number): Body;

/**
 * The collision of two bodies, or of one with a wall.
 * @param normal from the other body to the body, of length 1
 * @param velocity [m/s]
 * @param spin [rad/s]
 * @param other_velocity [m/s]
 * @param other_spin [rad/s]
 * @throws {RangeError} for bad arguments, and bodies and materials beyond the table
 */
export function collide(
    pair: Pair,
    normal: Vector,
    body: Body,
    velocity: Vector,
    spin: Vector,
    other: Body,
    other_velocity: Vector,
    other_spin: Vector,
): Collision;

/**
 * The collision of a body with a surface at rest.
 * @param normal out of the surface, of length 1
 * @param velocity [m/s]
 * @param spin [rad/s]
 * @throws {RangeError} as `collide`
 */
export function bounce(
    pair: Pair, normal: Vector, body: Body, velocity: Vector, spin: Vector,
): Collision;

/**
 * How far the velocity of the contact point after the impact would move with the other loss.
 * @param contact the arguments of `collide`
 * @returns [m/s]; NaN where the table lacks one of the losses, or without impact
 * @throws {RangeError} as `collide`
 */
export function model_form(...contact: Parameters<typeof collide>): number;

/** Whether the table has an answer. */
export function covers(
    x: number, mass_ratio: number, stiffness_ratio: number, restitution: number, loss: Loss,
): boolean;

/**
 * Tangential velocity of the contact point at separation.
 * @param x incidence, v1(0)/(mu v2(0))
 * @returns v1(tf)/(mu v2(0)); NaN out of range
 */
export function velocity(
    x: number, mass_ratio: number, stiffness_ratio: number, restitution: number, loss: Loss,
): number;

/**
 * The state at separation.
 * @param x incidence, v1(0)/(mu v2(0))
 * @returns NaN, and UNRESOLVED, out of range
 */
export function rebound(
    x: number, mass_ratio: number, stiffness_ratio: number, restitution: number, loss: Loss,
): Result;

/**
 * Restitution of a pair at a normal speed.
 * @param mass effective mass m2, 1/m2 = 1/M + 1/M' [kg]
 * @param radius effective radius R, 1/R = 1/r + 1/r' [m]
 * @param speed [m/s]
 * @returns NaN if the pair is not complete
 */
export function restitution_at(pair: Pair, mass: number, radius: number, speed: number): number;

/** Bodies with their pairs of materials. spheres.mjs has the sources of the numbers. */
export const presets: {
/* <presets> */
    $name: { body: Body, pair: Pair };
/* </presets> */
};
