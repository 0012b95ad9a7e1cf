"use strict";

// The continuum of planarimpact.continuum for one impact at a time: a round contact whose edge
// slips before its middle. The package bounds its error; this page takes fixed steps, and check.js
// compares it with answers of the package.
//
// The contact is a row of springs (method of dimensionality reduction), in the units E* = 1, R = 1,
// m2 = 1, |v2(0)| = 1: the spring at radius r bears a normal force of density L = h (a^2 - r^2), and
// tangential force of at most L, in mu times that. Its tangential deflection q follows the body,
// zeta^2 q' = w, and
//     w' = -beta T,   T = N times (sum of the tangential densities)/(sum of L).
// The loss is "elastic" (e = 1), "viscous" (each spring has a dashpot with the relaxation time tau)
// or "plastic" (Thornton's law, with tangential deflections that flow while metal yields).
const continuum = (() => {
  const LEAST_RESTITUTION = 0.1;
  // Springs, and steps in each half of the contact: for one impact, and for curves of many.
  const FINE = { springs: 24, steps: 480 };
  const COARSE = { springs: 12, steps: 240 };
  const TURNS = 60;
  const LONGEST = 60; // of half a contact; with the smallest restitution it is about 12
  const FLOW = 0.95; // as in planarimpact.normal_impact.yielding
  const ENERGY = 8 / 15; // of Hertz's law at the approach 1

  const covers = (e) => e >= LEAST_RESTITUTION;

  // The place between low and high where a function that is negative at low becomes positive, by
  // the rule of false position; an end that stays put counts half (Illinois).
  function root(low, high, of) {
    let [below, above] = [of(low), of(high)];
    let kept = 0;
    let place = low;
    for (let turn = 0; turn < TURNS; turn++) {
      if (above <= below) break;
      const before = place;
      place = (low * above - high * below) / (above - below);
      if (turn && Math.abs(place - before) <= 1e-9 * (high - low)) break;
      const value = of(place);
      if (value > 0) {
        [high, above] = [place, value];
        if (kept > 0) below /= 2;
        kept = 1;
      } else {
        [low, below] = [place, value];
        if (kept < 0) above /= 2;
        kept = -1;
      }
    }
    return place;
  }

  // ---- normal motion ------------------------------------------------------------------------
  // A law has a function for loading and one for unloading. Of an approach d and its rate v they tell
  // the square of the radius of contact a^2, h (with dashpots `lift`: L is a^2 + lift - r^2), and the
  // elastic energy held. The normal force has functions of its own, as it is asked for most often.
  // `touching` is a^2 in unloading, below 0 after it.

  // Hertz's law with dashpots; tau = 0 is elastic.
  function viscous(tau) {
    const force = (depth, square) => Math.max(2 * Math.sqrt(square) * (depth - square / 3), 0);
    const at = (d, depth, square) => {
      const radius = Math.sqrt(square);
      return {
        square,
        share: 1,
        lift: depth - square,
        stored: d * d * radius - (2 / 3) * d * radius ** 3 + radius ** 5 / 5,
      };
    };
    return {
      loading: {
        force: (d, v) => force(d + tau * v, Math.max(d, 0)),
        at: (d, v) => at(d, d + tau * v, Math.max(d, 0)),
      },
      unloading: {
        force: (d, v) => force(d + tau * v, Math.max(d + tau * v, 0)),
        at: (d, v) => at(d, d + tau * v, Math.max(d + tau * v, 0)),
      },
      touching: (d, v) => d + tau * v,
    };
  }

  // Thornton's law: loading is elastic up to the approach d_y and linear from there; unloading is
  // elastic along Hertz's law of a flatter sphere. While it yields, deflections in shear flow.
  function plastic(yield_velocity) {
    const yields = (yield_velocity ** 2 / (2 * ENERGY)) ** 0.4;
    const rate = Math.sqrt(2 * Math.sqrt(yields));
    const centre = yields / 3;
    const at_yield = Math.sqrt(Math.max(1 - 2 * ENERGY * yields ** 2.5, 0));
    const largest = centre + Math.hypot(yields - centre, at_yield / rate);
    const share_at = (d) =>
      d > yields ? (rate * rate * (d - centre)) / ((4 / 3) * d ** 1.5) : 1;
    const last = share_at(largest);
    const springs_back = last * largest;
    const touching = (d) => largest * (1 - (largest - d) / springs_back);
    const force = (square, share) => (4 / 3) * share * square ** 1.5;
    const at = (square, share) =>
      ({ square, share, lift: 0, stored: 0.4 * force(square, share) * share * square });
    return {
      loading: {
        force: (d) => force(Math.max(d, 0), share_at(d)),
        at: (d) => at(Math.max(d, 0), share_at(d)),
      },
      unloading: {
        force: (d) => force(Math.max(touching(d), 0), last),
        at: (d) => at(Math.max(touching(d), 0), last),
      },
      touching,
      flowed: (d) => {
        const over = Math.max(d / yields, 1);
        return FLOW * (over - 1.5 * Math.sqrt(over) + 0.5 / Math.sqrt(over));
      },
      restitution: Math.sqrt(0.8 * rate * rate * (largest - centre) * springs_back),
    };
  }

  // Approach and rate after a time, by one step of Runge and Kutta under a force.
  function step([d, v], time, force) {
    const half = time / 2;
    const a1 = -force(d, v);
    const [v2, a2] = [v + half * a1, -force(d + half * v, v + half * a1)];
    const [v3, a3] = [v + half * a2, -force(d + half * v2, v + half * a2)];
    const [v4, a4] = [v + time * a3, -force(d + time * v3, v + time * a3)];
    return [
      d + (time / 6) * (v + 2 * (v2 + v3) + v4),
      v + (time / 6) * (a1 + 2 * (a2 + a3) + a4),
    ];
  }

  // Half a contact in equal steps, from a state to where `over` becomes positive: its duration is
  // sought first, by steps of another length and a part of the last one.
  function run(start, { force, at }, over, steps) {
    const length = 4 / steps;
    let [now, duration] = [start, 0];
    let next = step(now, length, force);
    while (over(next) <= 0 && duration < LONGEST) {
      [now, duration] = [next, duration + length];
      next = step(now, length, force);
    }
    duration += root(0, length, (part) => over(step(now, part, force)));
    const rows = [];
    now = start;
    for (let k = 1; k <= steps; k++) {
      now = step(now, duration / steps, force);
      const [d, v] = now;
      rows.push({ time: (duration * k) / steps, d, v, force: force(d, v), ...at(d, v) });
    }
    return rows;
  }

  // Instants after contact, to separation; and the duration of compression.
  function instants({ loading, unloading, touching }, steps) {
    const rows = run([0, 1], loading, ([, v]) => -v, steps);
    const { time: compression, d: deepest } = rows.at(-1);
    const back = run([deepest, 0], unloading, ([d, v]) => -touching(d, v), steps);
    for (const row of back) rows.push({ ...row, time: compression + row.time });
    return { compression, rows };
  }

  // The relaxation time that leaves this restitution; few steps tell it.
  let last = {};
  function relaxation_time(e) {
    const left = (trial) => instants(viscous(trial), 60).rows.at(-1).v;
    if (last.e !== e) last = { e, tau: root(0, 8, (trial) => e + left(trial)) };
    return last.tau;
  }

  const known = new Map();

  // The normal motion with this restitution and loss: columns over the instants, times over t_c.
  function normal(e, loss, { springs, steps } = FINE) {
    const key = `${e} ${loss} ${springs}`;
    if (known.has(key)) return known.get(key);
    const yields = loss === "plastic" && e < 1;
    const tau = yields || e === 1 ? 0 : relaxation_time(e);
    const law = yields
      ? plastic(root(0.01, 1, (s) => plastic(s ** 4).restitution - e) ** 4)
      : viscous(tau);
    const { compression, rows } = instants(law, steps);
    const contact = [{ time: 0, d: 0, v: 1, force: law.loading.force(0, 1), ...law.loading.at(0, 1) }, ...rows];
    for (const row of contact) row.time /= compression;
    contact[steps].v = 0;
    Object.assign(contact.at(-1), { v: -e, force: 0, square: 0, lift: 0 });
    const motion = {
      e, loss, tau, springs, steps, compression, contact,
      largest: Math.max(...contact.map(({ force }) => force)),
      radius: Math.sqrt(Math.max(...contact.map(({ square }) => square))),
      largest_share: contact[steps].share,
      flow: rows.slice(0, steps).map(({ d }) => (yields ? law.flowed(d) : 0)),
    };
    if (known.size > 40) known.clear();
    known.set(key, motion);
    return motion;
  }

  // ---- springs ------------------------------------------------------------------------------

  // One impact. With `keep`, also its history: at each instant friction, velocity,
  // the number of springs that touch, innermost first, and their state.
  function solve(x, beta, zeta2, motion, keep = false) {
    const { contact, compression, largest, radius, flow, tau, springs, steps, loss } = motion;
    const width = radius / springs;
    const squares = Float64Array.from({ length: springs }, (_, i) => ((i + 0.5) * width) ** 2);
    const q = new Float64Array(springs);
    const density = new Float64Array(springs);
    const slips = new Int8Array(springs);
    const rows = keep ? [] : null;
    let w = x;
    let T = 0;
    let peak = 0;
    let work = 0;
    let sticks_ever = false;
    let touching = 0; // number of springs
    const keep_row = () =>
      rows.push({
        friction: T / largest, velocity: w, work, touching,
        density: density.slice(), slips: slips.slice(),
        sheared: zeta2 * width * q.reduce((sum, one) => sum + one * one, 0),
      });
    if (keep) {
      slips.fill(x > zeta2 ? 1 : 0);
      keep_row();
    }
    for (let k = 1; k < contact.length; k++) {
      const now = contact[k];
      const time = (now.time - contact[k - 1].time) * compression;
      const du = (w - (beta * T * time) / 2) * time / zeta2;
      const flows = k <= steps ? flow[k - 1] - (flow[k - 2] ?? 0) : 0;
      const decay = Math.exp(-flows);
      const gain = flows > 1e-6 ? (1 - decay) / flows : 1;
      const damping = tau / time;
      const top = now.square + now.lift;
      let [sum, limits, rubbed] = [0, 0, 0];
      // The springs are in order, innermost first; those beyond the edge have no deflection.
      let edge = touching;
      while (edge < springs && squares[edge] < now.square) edge++;
      while (edge > 0 && squares[edge - 1] >= now.square) {
        edge--;
        q[edge] = density[edge] = slips[edge] = 0;
      }
      touching = edge;
      for (let i = 0; i < edge; i++) {
        const limit = now.share * (top - squares[i]);
        const before = q[i] * decay;
        const free = before + du * gain;
        // p = q + tau q' stays within the limit; q' is the change in this step over its time.
        const most = (limit + damping * before) / (1 + damping);
        const least = (damping * before - limit) / (1 + damping);
        const held = free > most ? most : free < least ? least : free;
        slips[i] = free > most ? 1 : free < least ? -1 : 0;
        q[i] = held;
        density[i] = held + damping * (held - before);
        sum += density[i];
        limits += limit;
        rubbed += density[i] * (free - held);
        if (!slips[i] && now.force > 0) sticks_ever = true;
      }
      const share = limits > 0 ? sum / limits : 0;
      const T_now = share * now.force;
      w -= (beta * time * (T + T_now)) / 2;
      T = T_now;
      work += 2 * width * zeta2 * rubbed;
      peak = Math.max(peak, Math.abs(T));
      if (keep) keep_row();
    }
    const velocity = sticks_ever ? w : x - beta * (1 + motion.e);
    // Without dashpots all that the tangential motion loses is work of friction and flow.
    const lost = loss === "viscous" ? work : (x * x - velocity * velocity) / (2 * beta);
    return {
      velocity, peak_friction: peak / largest, dissipation: lost, slides: !sticks_ever, rows,
    };
  }

  // State at separation as in solver.rebound; peak_friction over mu times the largest normal force.
  const rebound = (x, beta, zeta2, e, loss) => solve(x, beta, zeta2, normal(e, loss));

  return { covers, normal, rebound, solve, COARSE, LEAST_RESTITUTION };
})();
