"use strict";

// The lumped solver of planarimpact (lumped, stick_slip, slip_onset, normal, rigid), for one
// impact at a time: the same formulas under the same names, without the Python package's way past
// thousands of phases. Equations are those of Stronge (1994) where they are named.
//
// Units 1/Omega, |v2(0)|, mu |v2(0)| and m2 Omega |v2(0)| for time, normal and tangential velocity
// and normal force, with friction T in mu times that; omega^2 = beta/zeta^2:
//     w' = -beta T,  T = s/zeta^2,  stick: s' = w while |T| <= N,  slip: T = side N.
// In stick T = A sin(theta) and w = sqrt(beta zeta^2) A cos(theta). Time runs as an angle eta that
// vanishes with the normal force: Omega t in compression, Omega (tf - t)/e in restitution.
// Arguments: incidence x = v1(0)/(mu v2(0)) >= 0, mass ratio beta = m2/m1 >= 1, stiffness ratio
// zeta2 > 0, restitution e from 0 to 1.
const solver = (() => {
  const HALF_PI = Math.PI / 2;
  // The root finder is cubic: after a step of this share of the bracket the root is at rounding.
  const LAST_STEP = 1e-6;
  const FREE_TURNS = 8;
  const MOST_TURNS = 100;
  const TINY = 2 ** -1022;

  // ---- normal motion (Table 1) --------------------------------------------------------------

  const force = (eta) => Math.sin(eta);

  // Impulse between eta and the nearer end of contact; in restitution times e.
  const impulse = (eta) => 2 * Math.sin(eta / 2) ** 2;

  // t/t_c at eta, and back.
  const time = (eta, e, in_restitution) =>
    in_restitution ? 1 + e * (1 - eta / HALF_PI) : eta / HALF_PI;

  const angle = (t, e, in_restitution) =>
    HALF_PI * Math.min(Math.max(in_restitution ? (1 + e - t) / e : t, 0), 1);

  // ---- thresholds ---------------------------------------------------------------------------

  // K = e beta - zeta^2/e where positive: slip in restitution has the velocity C - K cos(eta).
  function restick_coefficient(beta, zeta2, e) {
    const excess = e * (e * beta) - zeta2;
    return excess > 0 ? excess / e : 0;
  }

  // Incidence from which slip never ends (by Eqs 17 to 20; the heading of Eq. 26 prints (1 + e) beta).
  const slip_throughout_limit = (beta, zeta2, e) =>
    Math.max(zeta2, beta + restick_coefficient(beta, zeta2, e));

  // ---- onset of slip: the first |T| = N -----------------------------------------------------

  // Both from one tangent, as in Python, so that rounding is the same.
  function sin_cos(a) {
    const tangent = Math.tan(a / 2);
    const double = 2 / (1 + tangent * tangent);
    return [tangent * double, double - 1];
  }

  // First eta' <= eta with sin(eta') = |amplitude sin(theta + rate (eta - eta'))|, searched only
  // where it is alone. Returns eta', theta there from the start of its half-wave, its half-wave.
  function in_restitution(eta, theta, amplitude, rate) {
    rate = Math.max(rate, TINY);
    const fast = rate > 1;
    // T that still rises at the end stays below its amplitude.
    const highest = fast ? amplitude : amplitude * Math.sin(Math.min(theta + rate * eta, HALF_PI));
    const reached = Math.min(eta, Math.asin(Math.min(highest, 1)));
    const theta_reached = theta + rate * (eta - reached);
    let wave = Math.floor(theta_reached / Math.PI);
    let rho = theta_reached - wave * Math.PI;
    const [normal, fall] = sin_cos(reached);
    const [friction, swing] = sin_cos(rho);
    const falling = rate * swing * normal + friction * fall <= 0;
    let passed = wave === 0 || (falling && rho > HALF_PI);
    let reach = null;
    if (fast && !passed && rho > HALF_PI) {
      reach = reach_behind_crest(reached, rho, amplitude, rate);
      passed = reach === null;
    }
    // For rate <= 1 there is one crossing, in the half-wave in which stick would end.
    wave = fast
      ? wave + (passed ? 1 : 0)
      : Math.max(wave, Math.ceil((theta_reached + rate * reached) / Math.PI) - 1);
    const start = Math.max(theta_reached, wave * Math.PI);
    eta = Math.max(reached - (start - theta_reached) / rate, 0);
    rho = start - wave * Math.PI;
    const widest = reach ?? (fast ? Math.min(eta, (HALF_PI - rho) / rate) : eta);
    const advance = Math.min(crossing(eta, rho, amplitude, rate, Math.max(widest, 0)), eta);
    return [eta - advance, rho + rate * advance, wave];
  }

  // The zero in [0, widest] of sin(eta - a) - amplitude sin(rho + rate a); bisection guards.
  function crossing(eta, rho, amplitude, rate, widest) {
    const last_step = LAST_STEP * widest;
    const narrowest = Math.max(LAST_STEP * last_step, Number.MIN_VALUE);
    let [low, high, trial] = [0, widest + last_step, 0];
    for (let turn = 0; turn < MOST_TURNS; turn++) {
      const before = trial;
      const [normal, fall] = sin_cos(eta - before);
      const [sine, cosine] = sin_cos(rho + rate * before);
      const friction = sine * amplitude;
      const excess = normal - friction;
      const descent = fall + cosine * amplitude * rate;
      // While N - |T| grows, what lies below zero is rounding.
      if (excess > 0 || (turn === 0 && descent < 0)) low = before;
      else high = before;
      // The nearer root of the Taylor parabola; good also where the descent vanishes.
      const root = descent * descent - 2 * excess * (rate * rate * friction - normal);
      trial = before + (2 * excess) / (descent + Math.sqrt(Math.max(root, 0)));
      // Rounding can throw `trial` to and fro: then every other turn halves the bracket.
      const halves = turn >= FREE_TURNS && turn % 2 === 1;
      const inside = !halves && trial >= low && trial <= high;
      if (!inside) trial = (low + high) / 2;
      const moving = !inside || Math.abs(trial - before) > last_step;
      if (!moving || !(high - low > narrowest)) return trial;
    }
    throw lost();
  }

  // By when a falling |T| whose ratio to N still rises meets N in this half-wave, or null. The
  // ratio rises while turn = |T|'N - |T|N' > 0: to the end if the contact ends first, else to the
  // one zero of the turn. Newton's iterates approach that from before, down to rounding.
  function reach_behind_crest(eta, rho, amplitude, rate) {
    if (rate * eta <= Math.PI - rho) return eta;
    let theta = rho;
    for (let count = 0; count < MOST_TURNS; count++) {
      const advance = (theta - rho) / rate;
      const [normal, fall] = sin_cos(eta - advance);
      const [friction, swing] = sin_cos(theta);
      if (normal <= amplitude * friction) return advance;
      const turn = rate * swing * normal + friction * fall;
      const bend = (rate - 1 / rate) * friction * normal;
      const before = theta;
      if (turn > 0 && bend > 0) theta = Math.min(theta + turn / bend, Math.PI);
      if (theta === before) return null;
    }
    throw lost();
  }

  const lost = () => new Error(`no onset of slip after ${MOST_TURNS} turns`);

  // First eta > 0 with x/(zeta^2 rate) sin(rate eta) = sin(eta), for rate < 1 (omega < Omega): in
  // u = eta^2, (T - N)/eta is increasing and concave, and Newton's iterates rise to the root. The
  // first that does not is at rounding.
  function in_compression(x, zeta2, rate) {
    const amplitude = x / (zeta2 * rate);
    const ratio = x / zeta2;
    let u = Math.min((6 * (1 - ratio)) / (1 - ratio * rate * rate), HALF_PI ** 2);
    for (let count = 0; count < MOST_TURNS; count++) {
      const eta = Math.sqrt(u);
      const [friction, swing] = sin_cos(rate * eta);
      const [normal, fall] = sin_cos(eta);
      const excess = amplitude * friction - normal;
      const slope = amplitude * (rate * eta * swing - friction) - eta * fall + normal;
      const step = slope > 0 ? (-2 * u * excess) / slope : 0;
      const before = u;
      u = Math.min(Math.max(u + step, u), HALF_PI ** 2);
      if (u === before) return eta;
    }
    throw lost();
  }

  // ---- phases -------------------------------------------------------------------------------

  const slip = (in_restitution, eta, side, velocity) =>
    ({ sticks: false, in_restitution, eta, side, velocity });

  const stick = (in_restitution, eta, side, amplitude, theta) =>
    ({ sticks: true, in_restitution, eta, side, amplitude, theta });

  // Stick that starts with T = N and T' = N' = slope; gap = 1 - |slope|, free of cancellation.
  function tangent(slope, gap, rate) {
    const start = Math.sqrt(gap * (1 + Math.abs(slope)));
    return {
      amplitude: Math.hypot(start, slope / rate),
      theta: Math.atan2(rate * start, slope),
      eta: Math.atan2(start, Math.abs(slope)),
    };
  }

  // Friction and velocity of one phase at an angle eta of its half (Eqs 10 to 16).
  function state(phase, eta, beta, zeta2, e) {
    const share = phase.in_restitution ? e : 1;
    if (phase.sticks) {
      const omega = Math.sqrt(beta / zeta2);
      const [sine, cosine] = sin_cos(phase.theta + omega * share * Math.abs(eta - phase.eta));
      const crest = phase.side * phase.amplitude;
      return [crest * sine, omega * zeta2 * crest * cosine];
    }
    const passed = Math.abs(impulse(eta) - impulse(phase.eta));
    return [phase.side * force(eta), phase.velocity - phase.side * beta * share * passed];
  }

  // Velocity and dissipation at separation, largest friction, regime, and all phases in order.
  function solve(x, beta, zeta2, e) {
    let found;
    if (x >= slip_throughout_limit(beta, zeta2, e)) found = slipping(x, beta, zeta2, e);
    else if (x > beta && x > zeta2) found = after_late_slip(x, beta, zeta2, e);
    else found = from_compression(x, beta, zeta2, e);
    if (found.stick) alternate(found, beta, zeta2, e);
    // Rounding creates no energy.
    found.velocity = Math.min(Math.max(found.velocity, -x), x);
    found.dissipation = Math.max(found.dissipation, 0);
    return found;
  }

  // Slip throughout (Eqs 26, 27, 41).
  function slipping(x, beta, zeta2, e) {
    const change = (1 + e) * beta;
    return {
      velocity: x - change,
      peak_friction: 1,
      dissipation: (1 + e) * (x - change / 2),
      regime: "SLIP_THROUGHOUT",
      phases: [slip(false, 0, 1, x), slip(true, HALF_PI, 1, x - beta)],
    };
  }

  // Stick from the start (Eqs 10, 11) or after slip in compression (Eqs 17 to 20).
  function from_compression(x, beta, zeta2, e) {
    const omega = Math.sqrt(beta / zeta2);
    const slips_first = x > zeta2;
    const reach = slips_first ? beta - zeta2 : zeta2;
    const slope = (slips_first ? beta - x : x) / reach;
    const gap = slips_first ? (x - zeta2) / reach : 0;
    const { amplitude, theta, eta } = tangent(slope, gap, omega);
    const phases = slips_first ? [slip(false, 0, 1, x)] : [];
    phases.push(stick(false, eta, 1, amplitude, theta));
    const theta_c = theta + omega * (HALF_PI - eta);
    const [sine, cosine] = sin_cos(theta_c);
    const friction = amplitude * sine;
    if (omega < 1 && friction > 1) return break_in_compression(x, beta, zeta2, e, omega, phases);
    const found = {
      velocity: omega * zeta2 * amplitude * cosine,
      peak_friction: theta_c < HALF_PI ? friction : amplitude,
      dissipation: (gap * gap * reach) / 2,
      regime: slips_first ? "SLIP_STICK" : "STICK",
      phases,
    };
    const held = stick(true, HALF_PI, 1, amplitude, theta_c);
    if (e === 0 || x === 0) {
      // The strain energy is lost at separation.
      found.dissipation += (zeta2 * friction * friction) / 2;
      phases.push(held);
    } else {
      found.stick = held;
    }
    return found;
  }

  // Initial stick that breaks before maximum compression (omega < Omega) slips to the end.
  function break_in_compression(x, beta, zeta2, e, omega, phases) {
    const eta = in_compression(x, zeta2, omega);
    const onset = x * Math.cos(omega * eta);
    const passed = impulse(eta);
    const compressed = onset - beta * (1 - passed);
    const final = onset - beta * (1 + e - passed);
    let work = (1 - passed) * (onset - zeta2 * (1 - passed) + compressed);
    work += e * compressed + e * final + zeta2;
    phases.push(slip(false, eta, 1, onset), slip(true, HALF_PI, 1, compressed));
    return {
      velocity: final, peak_friction: 1, dissipation: work / 2, regime: "STICK_SLIP", phases,
    };
  }

  // Stick after a first slip that ended in restitution, at cos(eta) = (x - beta)/K (Eq. 21).
  function after_late_slip(x, beta, zeta2, e) {
    const reach = restick_coefficient(beta, zeta2, e);
    const slope = (beta - x) / reach;
    const gap = (reach + (beta - x)) / reach;
    const work = x - zeta2 + (x - beta) + e * (beta - x) * slope;
    const { amplitude, theta, eta } = tangent(slope, gap, e * Math.sqrt(beta / zeta2));
    return {
      peak_friction: 1,
      dissipation: work / 2,
      regime: "SLIP_STICK",
      phases: [slip(false, 0, 1, x), slip(true, HALF_PI, 1, x - beta)],
      stick: stick(true, eta, 1, amplitude, theta),
    };
  }

  // Slip and stick in turn until it slides to separation (Eqs 12 to 16, 22 to 25); the direction
  // of slip is that of the friction at its start. Adds to what has been found.
  function alternate(found, beta, zeta2, e) {
    const omega = Math.sqrt(beta / zeta2);
    const rate = e * omega;
    // Each stick has a half-wave of T of its own, a part of it at the ends.
    const most = Math.floor(rate) + 3;
    for (let count = 0; count < most; count++) {
      const held = found.stick;
      const [eta, rho, wave] = in_restitution(held.eta, held.theta, held.amplitude, rate);
      const side = wave % 2 === 0 ? held.side : -held.side;
      const onset = omega * zeta2 * held.amplitude * Math.cos(rho);
      const ahead = impulse(eta);
      const final = onset - beta * e * ahead;
      found.velocity = side * final;
      found.phases.push(held, slip(true, eta, side, side * onset));
      if (count === 0) {
        const rising = wave === 0 && rho < HALF_PI;
        // Slip that went through maximum compression met N = 1 there.
        found.peak_friction = held.eta < HALF_PI ? 1 : rising ? force(eta) : held.amplitude;
        found.regime = found.regime === "STICK" ? "STICK_SLIP" : "SLIP_STICK_SLIP";
      }
      // e times the slip velocity here and at separation. Where it would turn round, slip ends.
      const here = e * onset + zeta2 * (1 - ahead);
      const there = e * final + zeta2;
      if (!(rate > 1 && there < 0)) {
        found.dissipation += (ahead * (here + there)) / 2;
        return;
      }
      const excess = e * (e * beta) - zeta2;
      found.dissipation += (here * (here / excess)) / 2;
      const gap = -there / excess; // that slip ends at cos(eta) = 1 - gap
      const next = tangent(gap - 1, gap, rate);
      found.stick = stick(true, next.eta, side, next.amplitude, next.theta);
      found.regime = "MULTIPLE";
    }
    throw new Error("more sticks than there can be");
  }

  // ---- what the page calls ------------------------------------------------------------------

  // State at separation: velocity v1(tf)/(mu v2(0)), peak_friction in mu m2 Omega v2(0),
  // dissipation by friction in mu^2 m2 v2(0)^2, regime.
  function rebound(x, beta, zeta2, e) {
    const { velocity, peak_friction, dissipation, regime } = solve(x, beta, zeta2, e);
    return { velocity, peak_friction, dissipation, regime };
  }

  // The limit of negligible tangential compliance (Eqs 34, 35): slides to a halt, then sticks.
  function rigid_rebound(x, beta, e) {
    const slides = x / beta >= 1 + e;
    const stopped = Math.min(x / beta, 1);
    const velocity = slides ? x - (1 + e) * beta : 0;
    return {
      velocity,
      peak_friction: Math.sqrt(stopped * (2 - stopped)),
      dissipation: Math.min(x / beta, 1 + e) * (x / 2 + velocity / 2),
    };
  }

  // The whole contact in this limit, as `history` gives it: friction ends where the point stops.
  function rigid_history(x, beta, e, samples = 400) {
    const end = 1 + e;
    const stop = Math.min(x / beta, end); // impulse at which the contact point has come to rest
    const halt = stop <= 1 ? time(Math.acos(1 - stop), e, false)
      : time(Math.acos(Math.min((stop - 1) / e, 1)), e, true);
    const grid = Array.from({ length: samples }, (_, i) => (i / (samples - 1)) * end);
    const instants = [...grid.filter((t) => t !== halt), halt].sort((a, b) => a - b);
    return instants.map((t) => {
      const in_restitution = t > 1;
      const eta = e || !in_restitution ? angle(t, e, in_restitution) : 0;
      const passed = in_restitution ? 1 + e * (1 - impulse(eta)) : impulse(eta);
      const sticks = t >= halt && stop < end;
      return { time: t, normal: force(eta), friction: sticks ? 0 : force(eta),
        velocity: Math.max(x - beta * passed, 0), sticks, side: 1, in_restitution };
    });
  }

  // The contact at `samples` instants evenly spread, and where each phase starts: time t/t_c,
  // normal force and friction in m2 Omega v2(0) and mu times that, velocity in mu v2(0), whether it
  // sticks, the direction of slip, and whether it is in restitution.
  function history(x, beta, zeta2, e, samples = 400) {
    const phases = ended(solve(x, beta, zeta2, e).phases, e);
    const step = (1 + e) / (samples - 1);
    const grid = Array.from({ length: samples }, (_, i) => i * step);
    grid[samples - 1] = 1 + e;
    const rows = phases.flatMap((phase) => {
      const instant = (eta, t) => {
        const [friction, velocity] = state(phase, eta, beta, zeta2, e);
        const { sticks, side, in_restitution } = phase;
        return { time: t, normal: force(eta), friction, velocity, sticks, side, in_restitution };
      };
      const inside = grid.filter((t) => t > phase.start && t < phase.end);
      const row_at = (t) => instant(angle(t, e, phase.in_restitution), t);
      const last = phase === phases.at(-1) ? [instant(phase.eta_end, phase.end)] : [];
      return [instant(phase.eta, phase.start), ...inside.map(row_at), ...last];
    });
    if (e === 0) rows.at(-1).in_restitution = true; // what is pressed in stays there
    return rows;
  }

  // Phases with their last eta, and their times: each ends where the next one starts, or with its
  // half of the contact.
  function ended(phases, e) {
    const chosen = phases.filter((phase) => e > 0 || !phase.in_restitution);
    return chosen.map((phase, index) => {
      const next = chosen[index + 1];
      const same = next && next.in_restitution === phase.in_restitution;
      const eta_end = same ? next.eta : next || !phase.in_restitution ? HALF_PI : 0;
      const [start, end] = [phase.eta, eta_end].map((eta) => time(eta, e, phase.in_restitution));
      return { ...phase, eta_end, start, end };
    });
  }

  return { rebound, rigid_rebound, slip_throughout_limit, history, rigid_history };
})();
