/*
 * spheres.mjs: impacts of rough spheres, every impact with bodies and materials of its own.
 *
 * A ball that bounces on a floor at rest (z is up; metres, kilograms, radians, seconds):
 *   import * as spheres from "./spheres.mjs";
 *
 *   const ball = spheres.solid_sphere_by_mass(0.03, 0.1);
 *   const rubber = {
 *       friction: 0.8, stiffness_ratio: 1.5, restitution: 0.9, loss: spheres.VISCOUS };
 *   let velocity = [3, 0, -4], spin = [0, -50, 0];
 *   const hit = spheres.bounce(rubber, [0, 0, 1], ball, velocity, spin);
 *   velocity = hit.velocity;
 *   spin = hit.spin;
 * Where there is no answer, collide, bounce and model_form throw a RangeError: it names the field,
 * its value and what is allowed. spheres.d.mts beside this file has the types; it may be missing.
 *
 * <version>
 * Written by planarimpact $value. Do not edit it: write it anew.
 * </version>
 *
 * <about>
$text
 * </about>
 */

/* <public> */
export const $name = $value;
/* </public> */

/*
 * <constants>
$text
 * </constants>
 */
/* <private> */
const $name = $value;
/* </private> */

/*
 * <table>
$text
 * </table>
 */

const limits = new Float64Array([
/* <limits> */
$numbers,
/* </limits> */
]);

const panels = [
/* <panels> */
[$row],
/* </panels> */
].map(([patch, patches, varying, rows, columns, over_t, over_u, edges, velocity, peak, work]) => (
    { patch, patches, varying, rows, columns, over_t, over_u, edges, velocity, peak, work }
));

const patches = new Int32Array([
/* <patches> */
$numbers,
/* </patches> */
]);

const shapes = [
/* <shapes> */
[$row],
/* </shapes> */
];

// The bytes of a table.
function bytes(text) {
    return Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0)).buffer;
}

// The values: of each number is stored what its neighbours along each axis do not tell, in 7 bits a
// byte, the lowest first. Neighbours are rows * columns, columns and 1 apart.
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
"$text"
/* </packed> */
));

// Viscous restitution over the root of the relaxation time, a series of Chebyshev's polynomials.
const series = new Float64Array([
/* <series> */
$numbers,
/* </series> */
]);

// Which of so many intervals a value from 0 to so many is in.
function index_of(at, count) {
    return Math.min(Math.trunc(at), count - 1);
}

function clipped(value, low, high) {
    return value < low ? low : value > high ? high : value;
}

// The interval that a value from 0 to 1 is in, and the four B-splines there.
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

// Where an impact is: what the splines need, and what follows from its edges.
function find(y, b, e, loss) {
    const viscous = loss === VISCOUS;
    const u = viscous ? (b - B_LEAST_VISCOUS) / B_SPAN_VISCOUS
        : (b - B_LEAST_PLASTIC) / B_SPAN_PLASTIC;
    const interval = index_of(u * INTERVALS, INTERVALS);
    const part = u * INTERVALS - interval, alike = b + e * (b - 1), least = E_LEAST_PLASTIC;
    const between = (k) => (1 - part) * limits[k] + part * limits[k + 1];
    const low_e = between(interval), high_e = between(interval + INTERVALS + 1);
    const which = viscous ? 0 : e < low_e ? 1 : e < high_e ? 2 : 3, panel = panels[which];
    let t = 0;
    if (which === 0) t = (e - E_LEAST_VISCOUS) / (1 - E_LEAST_VISCOUS);
    else if (which === 1)
        t = 1 - Math.sqrt(clipped(least / e - least / low_e, 0, 1) / (1 - least / low_e));
    else if (which === 2) t = (e - low_e) / (high_e - low_e);
    else t = Math.sqrt(Math.sqrt((1 - e) / (1 - high_e)));

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
        ? [0, 1, 1 + (b - 1) * varying[0], 1 + (b - 1) * varying[1], b, alike]
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
    const root = patches[row_of_patch], first = patches[row_of_patch + 2];
    if (root === RIGHT) s = 1 - Math.sqrt(1 - s);
    else if (root === LEFT) s = Math.sqrt(s);

    const over_s = place(s, patches[row_of_patch + 1]);
    const over_t = place(t, panel.over_t - 3), over_u = place(u, panel.over_u - 3);
    let base = (first + over_s.index) * panel.over_t + over_t.index;
    base = base * panel.over_u + over_u.index;
    return {
        panel,
        base,
        slides: y >= edge[panel.patches] * NEARLY,
        scale: patch === 0 ? y : 1,
        weights: [over_s.weights, over_t.weights, over_u.weights],
    };
}

// A spline at a place of `find`, whose coefficients begin at a number of the values.
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

// Velocity of a contact that sticks for a while, from x, and the velocity if it slid throughout:
// within the energy that there is, and what friction can do.
function sticking(spot, x, zeta2, sliding) {
    const share = spline(spot, spot.panel.velocity) * spot.scale;
    return clipped(zeta2 * share + 0, sliding > 0 - x ? sliding : 0 - x, x);
}

// The least restitution of a loss in the table.
function least_restitution(loss) {
    return loss === VISCOUS ? RESTITUTION_MIN_VISCOUS : RESTITUTION_MIN_PLASTIC;
}

// Whether the table has an answer.
export function covers(x, mass_ratio, stiffness_ratio, restitution, loss) {
    const ratio = mass_ratio / stiffness_ratio;
    return Math.abs(x) <= INCIDENCE_MAX && mass_ratio >= 1 && mass_ratio <= MASS_RATIO_MOST
        && stiffness_ratio <= STIFFNESS_MOST && ratio >= RATIO_LEAST && ratio <= RATIO_MOST
        && restitution >= least_restitution(loss) && restitution <= 1
        && (loss === VISCOUS || loss === PLASTIC);
}

// Velocity in the direction of x.
function directed(velocity, x) {
    return x < 0 || Object.is(x, -0) ? -velocity : velocity;
}

// Tangential velocity of the contact point at separation.
export function velocity(x, mass_ratio, stiffness_ratio, restitution, loss) {
    const size = Math.abs(x), beta = mass_ratio, zeta2 = stiffness_ratio, e = restitution;
    if (!covers(x, beta, zeta2, e, loss)) return NaN;
    const spot = find(size / zeta2, beta / zeta2, e, loss);
    const sliding = size - (1 + e) * beta;
    return directed(spot.slides ? sliding : sticking(spot, size, zeta2, sliding), x);
}

// The state at separation.
export function rebound(x, mass_ratio, stiffness_ratio, restitution, loss) {
    const size = Math.abs(x), beta = mass_ratio, zeta2 = stiffness_ratio, e = restitution;
    let velocity = NaN, peak_friction = NaN, dissipation = NaN, regime = UNRESOLVED;
    if (!covers(x, beta, zeta2, e, loss))
        return { velocity, peak_friction, dissipation, regime };
    const spot = find(size / zeta2, beta / zeta2, e, loss);
    velocity = size - (1 + e) * beta;
    if (spot.slides) {
        const change = (1 + e) * beta;
        peak_friction = 1;
        dissipation = loss === VISCOUS
            ? (1 + e) * (size - zeta2 - (beta - zeta2) * (1 + e) / 2)
            : (1 + e) * (size - change / 2);
        regime = SLIP_THROUGHOUT;
    } else {
        velocity = sticking(spot, size, zeta2, velocity);
        peak_friction = clipped(spline(spot, spot.panel.peak) * spot.scale, 0, 1);
        dissipation = loss === VISCOUS
            ? zeta2 * Math.max(spline(spot, spot.panel.work) * spot.scale * spot.scale, 0)
            : (size - velocity) * (size + velocity) / (2 * beta);
        regime = size > zeta2 ? SLIP_STICK_SLIP : STICK_SLIP;
        if (size === 0) regime = STICK;
    }
    return { velocity: directed(velocity, x), peak_friction, dissipation, regime };
}

// A flat body that neither moves nor turns by an impact; it may have a velocity.
export const WALL = { mass: Infinity, gyration: Infinity, radius: 0 };

// A homogeneous sphere, from its radius [m] and its mass [kg].
export function solid_sphere_by_mass(radius, mass) {
    return { mass, gyration: radius * Math.sqrt(0.4), radius };
}

// A homogeneous sphere, from its radius [m] and its density [kg/m^3].
export function solid_sphere_by_density(radius, density) {
    const mass = density * radius * radius * radius * (4 / 3 * Math.PI);
    return solid_sphere_by_mass(radius, mass);
}

// A thin hollow sphere, from its radius [m] and its mass [kg].
export function thin_shell(radius, mass) {
    return { mass, gyration: radius * Math.sqrt(2 / 3), radius };
}

function dot(a, b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

function cross(a, b) {
    return [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ];
}

function scaled(factor, a) {
    return [factor * a[0], factor * a[1], factor * a[2]];
}

// a + factor b
function sum(a, factor, b) {
    return [a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]];
}

// The fifth root of a number above 0. That of a library differs from one language to the next.
function fifth_root(value) {
    let scale = 1;
    if (!(value > 0 && value <= 1e308)) return NaN;
    for (; value > 32; value *= 0.03125) scale *= 2;
    for (; value < 1; value *= 32) scale *= 0.5;
    let root = 1 + (value - 1) / (14 + value);
    for (let i = 0; i < 4; i += 1) { // Halley's method
        const power = root * root * root * root * root;
        root *= (2 * power + 3 * value) / (3 * power + 2 * value);
    }
    return root * scale;
}

// Whether the loss that goes with a restitution is one, or is left out where nothing is lost.
function knows_loss(loss, restitution) {
    return loss === VISCOUS || loss === PLASTIC || (loss === 0 && restitution === 1);
}

// Restitution of a pair at a normal speed.
export function restitution_at(pair, mass, radius, speed) {
    const { loss = 0, relaxation_time = 0, yield_pressure = 0 } = pair;
    const { restitution: fixed = loss === 0 ? 0 : NaN } = pair;
    const modulus = pair.effective_modulus;
    const is_fixed = fixed !== 0 || loss !== 0;
    if (Number(is_fixed) + Number(relaxation_time !== 0) + Number(yield_pressure !== 0) !== 1)
        return NaN;
    if (yield_pressure !== 0) {
        // Thornton's sphere, with lengths over (m2 v2^2/(E* R^(1/2)))^(2/5): a is the radius of
        // contact where it yields, the approach is then a^2, and at the end `depth`.
        const first = modulus / mass * radius / speed * radius / speed * radius;
        const a = 1.5707963267948966 * (yield_pressure / modulus) * fifth_root(first);
        const left = 1 - a * a * a * a * a * (16 / 15), part = 2 / 3 * (a * a);
        if (!(a > 0)) return NaN;
        if (!(left > 0)) return 1;
        const reach = Math.sqrt(part * part + left / (2 * a)), depth = a * a / 3 + reach;
        return clipped(2 * a * reach * Math.sqrt(0.6 / Math.sqrt(depth)), 0, 1);
    }
    if (relaxation_time !== 0) {
        const stiff = modulus / mass;
        const tau = relaxation_time * fifth_root(stiff * radius * stiff * speed);
        const at = 2 * (Math.sqrt(tau) / SPAN) - 1;
        if (!(tau >= 0 && tau <= LONGEST)) return NaN;
        let total = 0, last = 0;
        for (let i = SERIES - 1; i > 0; i -= 1) // Clenshaw's method
            [total, last] = [series[i] + 2 * at * total - last, total];
        return clipped(series[0] + at * total - last, LEAST, 1);
    }
    return knows_loss(loss, fixed) && typeof fixed === "number" ? fixed : NaN;
}

// 1/r; 0 where the radius is 0, as of a wall, which is flat.
function curvature({ radius }) {
    return radius > 0 ? 1 / radius : 0;
}

// A value in a message.
function shown(value) {
    const word = (one) => (typeof one === "string" ? `"${one}"` : String(one));
    if (typeof value !== "object" || !value) return word(value);
    if (Array.isArray(value)) return `[${value.map(word).join(", ")}]`;
    return `{ ${Object.entries(value).map(([name, one]) => `${name}: ${word(one)}`).join(", ")} }`;
}

function refusal(field, value, allowed) {
    return new RangeError(`${field} = ${shown(value)}: allowed is ${allowed}`);
}

// The sum of the sizes of a vector's components, after a check of the vector.
function checked_size(field, value) {
    if (value?.length === 3) {
        const x = value[0], y = value[1], z = value[2];
        if (Number.isFinite(x) && Number.isFinite(y) && Number.isFinite(z))
            return Math.abs(x) + Math.abs(y) + Math.abs(z);
    }
    throw refusal(field, value, "an array of three finite numbers");
}

function check_body(field, { mass, gyration, radius }) {
    if (!(typeof mass === "number" && mass > 0))
        throw refusal(`${field}.mass`, mass, "a number above 0");
    if (!(typeof gyration === "number" && gyration > 0))
        throw refusal(`${field}.gyration`, gyration, "a number above 0");
    if (!(Number.isFinite(radius) && radius >= 0))
        throw refusal(`${field}.radius`, radius, "a finite number from 0");
}

function check_laws(pair) {
    const { loss = 0, relaxation_time = 0, yield_pressure = 0, effective_modulus } = pair;
    const { restitution = loss === 0 ? 0 : NaN } = pair;
    const is_fixed = restitution !== 0 || loss !== 0;
    if (Number(is_fixed) + Number(relaxation_time !== 0) + Number(yield_pressure !== 0) !== 1) {
        throw refusal("pair", pair, "either restitution with loss, or one of relaxation_time and "
            + "yield_pressure, with effective_modulus and no loss");
    }
    if (is_fixed) {
        if (!(typeof restitution === "number" && restitution >= 0 && restitution <= 1))
            throw refusal("pair.restitution", pair.restitution, "a number from 0 to 1");
        if (!knows_loss(loss, restitution)) {
            throw refusal("pair.loss", pair.loss, "the constant VISCOUS or PLASTIC; it may be left "
                + "out where restitution is 1");
        }
        return;
    }
    const numbers = { effective_modulus, relaxation_time, yield_pressure };
    for (const field in numbers) {
        const value = numbers[field], least = field === "effective_modulus" ? 5e-324 : 0;
        if (!(Number.isFinite(value) && value >= least))
            throw refusal(`pair.${field}`, value, "a finite number above 0");
    }
}

// An impact that is to come: what `change` and `collide` need, the normal with the length 1 to
// rounding, the unit vector along which the contact point moves, and m2 over the mass of each body.
// Null if nothing approaches.
function before(pair, normal, body, velocity, spin, other, other_velocity, other_spin) {
    checked_size("normal", normal);
    const fast = checked_size("velocity", velocity), turns = checked_size("spin", spin);
    const other_fast = checked_size("other_velocity", other_velocity);
    const other_turns = checked_size("other_spin", other_spin);
    const length = Math.sqrt(dot(normal, normal));
    if (!(Math.abs(length - 1) <= LENGTH_ERROR))
        throw refusal("normal", normal, "a vector whose length is within 1e-6 of 1");
    if (!pair) throw refusal("pair", pair, "an object");
    if (!body) throw refusal("body", body, "an object");
    if (!other) throw refusal("other", other, "an object");

    check_body("body", body);
    check_body("other", other);
    const lighter = Math.min(body.mass, other.mass);
    if (!(lighter < Infinity))
        throw refusal("body.mass", body.mass, "a finite number where other.mass is not one");

    const { friction, stiffness_ratio: zeta2 } = pair;
    if (!(Number.isFinite(friction) && friction >= 0))
        throw refusal("pair.friction", friction, "a finite number from 0");
    if (!(typeof zeta2 === "number" && zeta2 > 0 && zeta2 <= STIFFNESS_MOST)) {
        const allowed = `a number above 0, up to ${STIFFNESS_MAX}`;
        throw refusal("pair.stiffness_ratio", zeta2, allowed);
    }
    const inverse = lighter / body.mass, other_inverse = lighter / other.mass;
    const share = inverse / (inverse + other_inverse);
    const other_share = other_inverse / (inverse + other_inverse);
    const arm = body.radius / body.gyration, other_arm = other.radius / other.gyration;
    const beta = (1 + arm * arm) * share + (1 + other_arm * other_arm) * other_share;
    if (!covers(0, beta, zeta2, 1, VISCOUS)) {
        const allowed = `a number from ${RATIO_MIN} to ${RATIO_MAX}`;
        throw refusal("mass_ratio/stiffness_ratio", beta / zeta2, allowed);
    }
    check_laws(pair);

    // Velocity of the contact point of the body against that of the other one.
    const n = [normal[0] / length, normal[1] / length, normal[2] / length];
    const turn = sum(scaled(body.radius, spin), other.radius, other_spin);
    const point = sum(sum(velocity, -1, other_velocity), -1, cross(turn, n));
    const along = dot(point, n);
    if (along >= 0 && along < Infinity) return null;
    // What can change is bounded, so that no number of the result overflows.
    const sideways = sum(point, -along, n), v1 = Math.sqrt(dot(sideways, sideways)), v2 = -along;
    const m2 = lighter / (inverse + other_inverse), speed = 2 * (v1 + v2);
    if (!(m2 * v2 * v2 + m2 * v1 * v1 < Infinity && m2 * speed < Infinity && m2 / beta > 0
          && fast + speed < Infinity && other_fast + speed < Infinity
          && turns + speed * share * arm / body.gyration < Infinity
          && other_turns + speed * other_share * other_arm / other.gyration < Infinity)) {
        throw refusal("velocity", velocity, "a vector whose numbers are neither too large nor too "
            + "small to compute with, as those of the spins and bodies are");
    }
    const unit = Math.min(friction * v2, v1 / INCIDENCE_LEAST);
    if (!(unit < Infinity)) {
        throw refusal("pair.friction", friction,
            "a number that stays finite times the normal velocity");
    }

    const yields = pair.yield_pressure > 0;
    const e = restitution_at(pair, m2, 1 / (curvature(body) + curvature(other)), v2);
    if (!(e >= 0)) {
        const field = yields ? "yield_pressure" : "relaxation_time";
        throw refusal(`pair.${field}`, pair[field], yields ? "a smaller or a larger number"
            : `a number so small that e is above ${LEAST}`);
    }
    // Where nothing is lost, the table of viscous spheres is nearer.
    const plastic = e !== 1 && (pair.loss === PLASTIC || yields);
    return {
        normal: n,
        tangent: scaled(v1 > 0 ? 1 / v1 : 0, sideways),
        share,
        other_share,
        v1,
        v2,
        unit, // mu v2
        m2,
        beta,
        zeta2,
        e,
        x: v1 > 0 ? v1 / unit : 0,
        loss: plastic ? PLASTIC : VISCOUS,
    };
}

// What an impact of this loss adds to x, the tangential velocity, and its regime.
function change({ x, beta, zeta2, e }, loss) {
    const slides = 0 - (1 + e) * beta, least = least_restitution(loss), known = e >= least;
    if (!(x > 0)) return { added: 0, regime: STICK };
    if (x > INCIDENCE_MAX || (loss === VISCOUS && x >= beta + e * (beta - zeta2)))
        return { added: slides, regime: SLIP_THROUGHOUT };
    const spot = find(x / zeta2, beta / zeta2, known ? e : least, loss);
    if (known && spot.slides) return { added: slides, regime: SLIP_THROUGHOUT };
    const regime = !known ? UNRESOLVED : x > zeta2 ? SLIP_STICK_SLIP : STICK_SLIP;
    return { added: spot.slides ? slides : sticking(spot, x, zeta2, x + slides) - x, regime };
}

// The collision of two bodies, or of one with a wall.
export function collide(
    pair, normal, body, velocity, spin, other, other_velocity, other_spin
) {
    const impact = before(
        pair, normal, body, velocity, spin, other, other_velocity, other_spin);
    if (!impact) {
        return {
            velocity: [...velocity],
            spin: [...spin],
            other_velocity: [...other_velocity],
            other_spin: [...other_spin],
            impulse: [0, 0, 0],
            incidence: NaN,
            restitution: NaN,
            error_bound: NaN,
            regime: NO_IMPACT,
        };
    }

    const { added, regime } = change(impact, impact.loss);
    // The impulse is over m2, as velocities are in the range of numbers.
    const along = impact.unit * (added / impact.beta), twist = 0 - along;
    const impulse =
        sum(scaled(impact.v2 * (1 + impact.e), impact.normal), along, impact.tangent);
    const turn = cross(impact.normal, impact.tangent);
    const turned = twist * impact.share * (body.radius / body.gyration) / body.gyration;
    const other_turned =
        twist * impact.other_share * (other.radius / other.gyration) / other.gyration;
    let error_bound = Math.min(impact.unit, impact.v1)
        * Math.max(impact.zeta2 / STIFFNESS_STATED, 1)
        * (impact.loss === VISCOUS ? ERROR_VISCOUS : ERROR_PLASTIC);
    if (regime === STICK || regime === SLIP_THROUGHOUT) error_bound = 0;
    else if (regime === UNRESOLVED) error_bound = NaN;
    return {
        velocity: sum(velocity, impact.share, impulse),
        spin: sum(spin, turned, turn),
        other_velocity: sum(other_velocity, 0 - impact.other_share, impulse),
        other_spin: sum(other_spin, other_turned, turn),
        impulse: scaled(impact.m2, impulse),
        incidence: impact.x,
        restitution: impact.e,
        error_bound,
        regime,
    };
}

// The collision of a body with a surface at rest.
export function bounce(pair, normal, body, velocity, spin) {
    return collide(pair, normal, body, velocity, spin, WALL, [0, 0, 0], [0, 0, 0]);
}

// How far the velocity of the contact point after the impact would move with the other loss.
export function model_form(...contact) {
    const impact = before(...contact);
    if (!impact) return NaN;
    if (impact.e === 1) return 0;
    const viscous = change(impact, VISCOUS), plastic = change(impact, PLASTIC);
    if (viscous.regime === UNRESOLVED || plastic.regime === UNRESOLVED) return NaN;
    return impact.unit * Math.abs(viscous.added - plastic.added);
}

// Bodies with their pairs of materials, and the sources of the numbers.
export const presets = {
/* <presets> */
/*
$text
 */
    $name: {
        body: { mass: $mass, gyration: $gyration, radius: $radius },
        pair: {
            friction: $friction, stiffness_ratio: $stiffness_ratio, restitution: $restitution,
            relaxation_time: $relaxation_time, yield_pressure: $yield_pressure,
            effective_modulus: $effective_modulus, loss: $loss,
        },
    },
/* </presets> */
};
