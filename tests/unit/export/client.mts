// What a caller in TypeScript writes, and what its compiler must refuse.
import * as spheres from "./coarse.mjs";
import { PLASTIC, type Collision, type Pair, type Vector } from "./coarse.mjs";

const ball = spheres.solid_sphere_by_density(0.01, 7800);
const pair: Pair = { friction: 0.3, stiffness_ratio: 1.2, restitution: 0.8, loss: PLASTIC };
const rubber = {
    friction: 0.8, stiffness_ratio: 1.5, restitution: 0.9, loss: spheres.VISCOUS };
const up: Vector = [0, 0, 1];
let velocity = [3, 0, -4], spin = [0, -50, 0];
let hit: Collision = spheres.bounce(rubber, up, ball, velocity, spin);
({ velocity, spin } = hit);
hit = spheres.collide(pair, up, ball, velocity, spin, spheres.WALL, [0, 0, 0], [0, 0, 0]);
const [x, , z]: [number, number, number] = hit.velocity;
const moved: number =
    spheres.model_form(pair, up, ball, velocity, spin, spheres.WALL, [0, 0, 0], [0, 0, 0]);
const { peak_friction } = spheres.rebound(1, 3.5, 1.2, 0.8, PLASTIC);
const known: boolean = spheres.covers(1, 3.5, 1.2, 0.8, PLASTIC);
const e: number = spheres.restitution_at(spheres.presets.tennis_ball.pair, 0.01, 0.01, 1);
const w: number = spheres.velocity(x + z + moved + peak_friction + e, 3.5, 1.2, 0.8, PLASTIC);
if (known && hit.regime === spheres.NO_IMPACT) spin = [w, 0, spheres.thin_shell(0.02, 0.003).mass];

// @ts-expect-error: the name does not say whether the number is a mass
spheres.solid_sphere(0.01, 7800);
// @ts-expect-error: no such loss
spheres.velocity(1, 3.5, 1.2, 0.8, 3);
// @ts-expect-error: no friction
spheres.bounce({ stiffness_ratio: 1.2 }, up, ball, velocity, spin);
// @ts-expect-error: no spin
spheres.bounce(pair, up, ball, velocity);
// @ts-expect-error: no vector
spheres.bounce(pair, { x: 0, y: 0, z: 1 }, ball, velocity, spin);
