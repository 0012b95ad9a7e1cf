"use strict";

// What each model says about an impact: the state at separation, and the whole contact.
// The models are the paper's lumped contact, its limit without tangential compliance, called rigid,
// and the continuum, which is elastic or has one of two losses. An impact has the groups x, beta,
// zeta2 and e, and mu. Where zeta2 is 0, the lumped model is the rigid one. CONTINUUM_ERROR is
// the largest error of the continuum of this page, in mu v2(0).
const models = (() => {
  const NAMES = {
    lumped: "the paper’s lumped model",
    rigid: "rigid limit",
    elastic: "continuum, elastic",
    viscous: "continuum, viscous",
    plastic: "continuum, plastic",
  };
  const TOGGLES = ["lumped", "rigid", "continuum"];
  const SPRINGS = ["lumped", "rigid"]; // one contact point, whose friction is exact
  const STOPPED = 0.0005; // of the tangential velocity before: less is called none
  const SAMPLES = 240; // of a contact of the lumped model
  const SHORTEST = 1e-6; // t_c, of a phase worth a word

  // The continuum with this loss, which at e = 1 is elastic.
  const style_of = (e, loss) => (e === 1 ? "elastic" : loss);

  const SOLVE = {
    lumped: ({ beta, zeta2, e }) => zeta2 === 0 ? SOLVE.rigid({ beta, e }) : (x) => {
      const state = solver.rebound(x, beta, zeta2, e);
      return { ...state, slides: state.regime === "SLIP_THROUGHOUT" };
    },
    rigid: ({ beta, e }) => (x) => {
      const state = solver.rigid_rebound(x, beta, e);
      return { ...state, slides: state.velocity > 0 };
    },
  };
  for (const style of ["elastic", "viscous", "plastic"]) {
    SOLVE[style] = ({ beta, zeta2, e }, effort) => {
      const motion = continuum.normal(e, style, effort);
      return (x) => continuum.solve(x, beta, zeta2, motion);
    };
  }

  // What is remembered for the last groups: while an angle is dragged, curves and limits stay.
  const memory = {};
  function remembered(style, { beta, zeta2, e }) {
    const key = `${beta} ${zeta2} ${e}`;
    if (memory[style]?.key !== key) memory[style] = { key, states: new Map() };
    return memory[style];
  }

  // A function from incidence to the state at separation, for curves.
  function curve(style, groups) {
    const { states } = remembered(style, groups);
    const solve = SOLVE[style](groups, continuum.COARSE);
    return (x) => {
      if (!states.has(x)) states.set(x, solve(x));
      return states.get(x);
    };
  }

  // The models of the toggles that can answer. Below e = 1 the continuum is there with both losses. It
  // is a body of one material, which has no less compliance along the surface than towards it.
  function chosen({ e, zeta2 }, toggles) {
    const continua = e === 1 ? ["elastic"] : ["viscous", "plastic"];
    const styles = { continuum: continuum.covers(e) && zeta2 >= 1 ? continua : [] };
    return TOGGLES.filter((name) => toggles.includes(name))
      .flatMap((name) => styles[name] ?? [name]);
  }

  // What each of these models says about one impact, whose `states` keep what has been solved. The
  // direction is 1 the way that the contact point came, -1 back, and 0 where the velocity is nothing,
  // or less than the error of the continuum. The rigid limit has no spring: where it does not slide
  // throughout it stops, whatever the others do. That is called mute, for it contradicts none of them.
  function outcomes(styles, impact) {
    return styles.map((style) => {
      const state = (impact.states[style] ??= SOLVE[style](impact)(impact.x));
      const error = SPRINGS.includes(style) ? 0 : CONTINUUM_ERROR;
      const none = Math.abs(state.velocity) <= Math.max(error, STOPPED * impact.x);
      const direction = none ? 0 : Math.sign(state.velocity);
      return { style, name: NAMES[style], ...state, direction,
        mute: style === "rigid" && direction === 0 };
    });
  }

  // Incidence from which the contact slides throughout.
  function slip_throughout_limit(style, groups) {
    return (remembered(style, groups).limit ??= found_limit(style, groups));
  }

  function found_limit(style, { beta, zeta2, e }) {
    if (SPRINGS.includes(style)) return solver.slip_throughout_limit(beta, zeta2, e);
    const alike = Math.max(zeta2, beta + e * (beta - zeta2));
    if (style !== "plastic") return alike;
    // While metal flows in shear, the middle may stick at larger incidences too.
    const solve = SOLVE[style]({ beta, zeta2, e });
    let [low, high] = [alike, Math.max((1 + e) * beta + zeta2, 2 * alike)];
    if (solve(low).slides) return low;
    for (let turn = 0; turn < 12; turn++) {
      const middle = (low + high) / 2;
      if (solve(middle).slides) high = middle;
      else low = middle;
    }
    return high;
  }

  // ---- the whole contact --------------------------------------------------------------------

  // The contact of one impact: its state at separation, and a row for each instant: `time` t/t_c,
  // `normal` and `friction` in the largest normal force (friction over mu too), `velocity` in
  // mu v2(0), `way` of the contact point in mu v2(0)/Omega, `approach` v2/v2(0), `depth` over the
  // largest, shares of `energy`; whether it, or a part of it, `sticks`, or else the side to which all
  // of it slips.
  // Rows are worked out when they are first asked for, as most contacts are never looked at.
  function contact(style, groups) {
    const { x, beta, zeta2, e, mu } = groups;
    let rows;
    return {
      style,
      state: SOLVE[style](groups)(x),
      end: SPRINGS.includes(style) ? 1 + e : continuum.normal(e, style).contact.at(-1).time,
      get rows() {
        if (rows) return rows;
        rows = SPRINGS.includes(style)
          ? spring_rows(x, beta, style === "rigid" ? 0 : zeta2, e)
          : continuum_rows(x, beta, zeta2, e, style);
        const before = (mu * x) ** 2 / beta + 1;
        rows.forEach((row, i) => {
          row.energy = energies(row, before, mu, beta);
          const last = rows[Math.max(i - 1, 0)];
          const step = ((row.time - last.time) * Math.PI) / 4;
          row.way = (last.way ?? 0) + step * (row.velocity + last.velocity);
        });
        return rows;
      },
    };
  }

  const spring_rows = (x, beta, zeta2, e) =>
    (zeta2 ? solver.history(x, beta, zeta2, e, SAMPLES) : solver.rigid_history(x, beta, e, SAMPLES))
    .map((row) => {
      const back = row.in_restitution;
      return {
        ...row,
        approach: (back ? -e : 1) * Math.sqrt(Math.max(1 - row.normal ** 2, 0)),
        depth: back ? 1 - e * e * (1 - row.normal) : row.normal,
        radius: Math.cbrt(row.normal), // as in Hertz's law; the model itself has no size
        spring: zeta2 * row.friction,
        pressed: ((back ? e : 1) * row.normal) ** 2,
        sheared: zeta2 * row.friction ** 2,
        deformed: back ? 1 - e * e : 0,
      };
    });

  function continuum_rows(x, beta, zeta2, e, style) {
    const motion = continuum.normal(e, style);
    const { rows } = continuum.solve(x, beta, zeta2, motion, true);
    const deepest = Math.max(...motion.contact.map(({ d }) => d));
    let before = { sticks: false, side: 1 };
    return rows.map((row, k) => {
      const { time, force, v, d, square, stored } = motion.contact[k];
      const touching = [...row.slips].slice(0, row.touching);
      if (k === 0) before = { sticks: x <= zeta2, side: 1 };
      else if (touching.length) {
        const sticks = touching.some((slip) => slip === 0);
        before = { sticks, side: sticks ? before.side : Math.sign(touching[0]) };
      }
      return {
        time, normal: force / motion.largest, friction: row.friction, velocity: row.velocity,
        approach: v, depth: d / deepest, ...before,
        pressed: 2 * stored, sheared: 2 * row.sheared, deformed: 1 - v * v - 2 * stored,
        worked: style === "viscous" ? 2 * row.work : undefined,
        radius: Math.sqrt(square) / motion.radius, density: row.density, slips: row.slips,
        touching: row.touching,
        limit: motion.contact[k],
      };
    });
  }

  // Shares of the energy before: of the motion, in the contact, lost. A viscous body also loses
  // energy of the tangential motion in its material.
  function energies({ approach, velocity, pressed, sheared, deformed, worked }, before, mu, beta) {
    const shares = {
      towards: approach ** 2 / before,
      along: (mu * velocity) ** 2 / beta / before,
      pressed: pressed / before,
      sheared: (mu * mu * sheared) / before,
      deformed: Math.max(deformed, 0) / before,
    };
    const left = 1 - Object.values(shares).reduce((sum, share) => sum + share);
    const rubbed = Math.max(worked === undefined ? left : (mu * mu * worked) / before, 0);
    shares.deformed = Math.max(shares.deformed + left - rubbed, 0);
    return { ...shares, rubbed };
  }

  // Stick and slip as they follow each other.
  function phases(rows) {
    const list = [];
    rows.forEach((row, i) => {
      const last = list.at(-1);
      if (last) last.end = row.time;
      const same = last && last.sticks === row.sticks && (row.sticks || last.side === row.side);
      if (!same && i < rows.length - 1) {
        list.push({ sticks: row.sticks, side: row.side, start: row.time, end: row.time });
      }
    });
    return list.filter(({ start, end }) => end - start > SHORTEST);
  }

  // The contact at a time: numbers between two instants, the rest of the earlier one.
  function at({ rows }, time) {
    const after = rows.findIndex((row) => row.time > time);
    if (after === 0) return rows[0];
    if (after < 0) return rows.at(-1);
    const [start, end] = [rows[after - 1], rows[after]];
    const share = (time - start.time) / (end.time - start.time);
    const mix = (name, from = start, to = end) => from[name] + share * (to[name] - from[name]);
    const mixed = { ...start, energy: { ...start.energy } };
    const names = ["normal", "friction", "velocity", "approach", "depth", "radius", "spring",
      "time", "way"];
    for (const name of names) if (name in start) mixed[name] = mix(name);
    // At the largest compression of the lumped model energy is lost in an instant.
    if (start.in_restitution === end.in_restitution) {
      for (const kind in start.energy) mixed.energy[kind] = mix(kind, start.energy, end.energy);
    }
    return mixed;
  }

  return { NAMES, TOGGLES, SPRINGS, STOPPED, style_of, curve, chosen, outcomes, contact, phases, at,
    slip_throughout_limit };
})();
