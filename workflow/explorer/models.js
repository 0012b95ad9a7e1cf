"use strict";

// What both contacts of the page say about an impact: the paper's lumped contact, with a spring along
// the surface, and its limit without tangential compliance, called rigid. An impact has the groups x,
// beta, zeta2 and e, and mu. Where zeta2 is 0, the lumped contact is the rigid one.
const models = (() => {
  const NAMES = { lumped: "the paper’s lumped model", rigid: "rigid limit" };
  const STOPPED = 0.0005; // of the tangential velocity before: less is called none
  const SAMPLES = 240; // of a contact

  // The state at separation: `velocity`, `peak_friction` and `dissipation`, in the units of the solver.
  const state = (style, { x, beta, zeta2, e }) =>
    style === "rigid" || zeta2 === 0 ? solver.rigid_rebound(x, beta, e) : solver.rebound(x, beta, zeta2, e);

  // The contact of one impact: its state at separation, its `end` in t_c, and a row for each instant:
  // `time` t/t_c, `normal` and `friction` in the largest normal force (friction over mu too), `velocity`
  // in mu v2(0), `way` of the contact point and deflection `spring` along the surface in mu v2(0)/Omega,
  // `depth` over the largest; whether it `sticks`, or else the `side` to which it slips.
  // Rows are worked out when they are first asked for, as most contacts are never looked at.
  function contact(style, groups) {
    let rows;
    return {
      state: state(style, groups),
      end: 1 + groups.e,
      get rows() {
        return (rows ??= rows_of(style === "rigid" ? { ...groups, zeta2: 0 } : groups));
      },
    };
  }

  function rows_of({ x, beta, zeta2, e }) {
    const course = zeta2 ? solver.history(x, beta, zeta2, e, SAMPLES) : solver.rigid_history(x, beta, e, SAMPLES);
    let [way, last] = [0, course[0]];
    return course.map((row) => {
      way += ((row.time - last.time) * Math.PI) / 4 * (row.velocity + last.velocity);
      last = row;
      const depth = row.in_restitution ? 1 - e * e * (1 - row.normal) : row.normal;
      return { ...row, way, depth, spring: zeta2 * row.friction };
    });
  }

  // The contact at a time: numbers between two instants, the rest of the earlier one.
  function at({ rows }, time) {
    const after = rows.findIndex((row) => row.time > time);
    if (after === 0) return rows[0];
    if (after < 0) return rows.at(-1);
    const [start, end] = [rows[after - 1], rows[after]];
    const share = (time - start.time) / (end.time - start.time);
    const mixed = { ...start };
    for (const name of ["time", "normal", "friction", "velocity", "depth", "spring", "way"]) {
      mixed[name] += share * (end[name] - start[name]);
    }
    return mixed;
  }

  return { NAMES, STOPPED, state, contact, at };
})();
