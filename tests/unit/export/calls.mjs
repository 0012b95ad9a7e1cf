// What is said to a caller who mistakes an argument.
import { PLASTIC, WALL, bounce, collide, model_form, solid_sphere_by_mass } from "./coarse.mjs";
const up = [0, 0, 1], down = [1, 0, -1], zero = [0, 0, 0], ball = solid_sphere_by_mass(0.1, 1);
const pair = { friction: 0.3, stiffness_ratio: 1.2, restitution: 0.8, loss: PLASTIC };
const law = { friction: 0.3, stiffness_ratio: 1.2, effective_modulus: 1e9 };
const message = (work) => {
    try {
        work();
        return "none";
    } catch (error) {
        return error instanceof RangeError ? error.message : String(error);
    }
};
console.log(message(() => bounce({ ...pair, restitution: 0 }, up, ball, down, zero)));
for (const one of [MISTAKES]) {
    const all = one.length > 5 ? one : [...one, ...Array(5 - one.length), WALL, zero, zero];
    const said = new Set([message(() => collide(...all)), message(() => model_form(...all))]);
    if (one.length < 6) said.add(message(() => bounce(...one)));
    console.log(...said);
}
