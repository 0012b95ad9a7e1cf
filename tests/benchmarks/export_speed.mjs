// The best time [s], and the sum of all answers. A row has normal, velocity, spin, stiffness ratio,
// restitution and loss.
import { readFileSync } from "node:fs";
import { bounce, solid_sphere_by_mass } from "./balls.mjs";
const bytes = readFileSync("collisions"), ball = solid_sphere_by_mass(0.01, 0.01), impacts = [];
const x = new Float64Array(bytes.buffer, bytes.byteOffset, COUNT * 12);
for (let i = 0; i < x.length; i += 12) {
    const [stiffness_ratio, restitution, loss] = x.subarray(i + 9, i + 12);
    impacts.push([
        { friction: 0.3, stiffness_ratio, restitution, loss },
        ...[0, 3, 6].map((at) => Array.from(x.subarray(i + at, i + at + 3))),
    ]);
}
let best = 1e9, sum = 0;
for (let repeat = 0; repeat < REPEATS; repeat += 1) {
    const start = process.cpuUsage();
    sum = 0;
    for (const [pair, n, v, w] of impacts) {
        const hit = bounce(pair, n, ball, v, w);
        sum += hit.velocity[0] + hit.spin[1];
    }
    const taken = process.cpuUsage(start);
    best = Math.min(best, (taken.user + taken.system) / 1e6);
}
console.log(best, sum);
