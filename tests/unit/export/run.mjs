// As run.c.
import { readFileSync, writeFileSync } from "node:fs";
import { UNRESOLVED, collide, model_form, rebound, velocity } from "./TABLE.mjs";
const collides = process.argv[2] === "collide", rows = [], said = [];
const bytes = readFileSync("in");
const all = new Float64Array(bytes.buffer, bytes.byteOffset, bytes.length / 8);
const body = ([mass, gyration, radius]) => ({ mass, gyration, radius });
function answer(x) {
    const part = (from) => x.slice(from, from + 3);
    const [friction, stiffness_ratio, restitution, relaxation_time, yield_pressure,
        effective_modulus, loss] = x;
    const pair = { friction, stiffness_ratio, restitution, relaxation_time, yield_pressure,
        effective_modulus, loss };
    const contact = [pair, part(7), body(part(10)), part(13), part(16), body(part(19)), part(22),
        part(25)];
    try {
        const r = collide(...contact);
        return [...r.velocity, ...r.spin, ...r.other_velocity, ...r.other_spin, ...r.impulse,
            r.incidence, r.restitution, r.error_bound, r.regime, model_form(...contact), 0];
    } catch (error) {
        if (!(error instanceof RangeError)) throw error;
        said.push(error.message);
        return [...Array(18).fill(NaN), UNRESOLVED, NaN, 1];
    }
}
const width = collides ? WIDTH : 5;
for (let i = 0; i < all.length; i += width) {
    const x = Array.from(all.subarray(i, i + width));
    if (collides) rows.push(...answer(x));
    else {
        const r = rebound(...x);
        rows.push(velocity(...x), r.velocity, r.peak_friction, r.dissipation, r.regime);
    }
}
writeFileSync("out", new Uint8Array(Float64Array.from(rows).buffer));
writeFileSync(1, said.join("\n"));
