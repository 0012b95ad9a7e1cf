"use strict";

// What each model says about the state at separation: the paper's lumped contact, its rigid limit,
// and the continuum of the table of spheres, which is elastic or has one of two losses.
const models = (() => {
  const NAMES = {
    lumped: "lumped",
    rigid: "rigid",
    elastic: "continuum, elastic",
    viscous: "continuum, viscous",
    plastic: "continuum, plastic",
  };
  const TOGGLES = ["lumped", "rigid", "continuum"];
  const STOPPED = 0.0005; // of the tangential velocity before: less is called none

  function continua({ beta, zeta2, e }) {
    const losses = [["viscous", spheres.VISCOUS], ["plastic", spheres.PLASTIC]];
    return (e === 1 ? [["elastic", spheres.VISCOUS]] : losses)
      .filter(([, loss]) => spheres.covers(0, beta, zeta2, e, loss))
      .map(([style, loss]) => ({
        style,
        error: loss === spheres.VISCOUS ? spheres.ERROR_VISCOUS : spheres.ERROR_PLASTIC,
        solve: (x) => spheres.rebound(x, beta, zeta2, e, loss),
        slides: ({ regime }) => regime === spheres.SLIP_THROUGHOUT,
      }));
  }

  // The models of the toggles that can answer for the groups of an impact. The table of spheres
  // covers fewer groups than the sliders.
  function chosen(impact, toggles) {
    const { beta, zeta2, e } = impact;
    const all = {
      lumped: () => [{
        style: "lumped",
        error: 0,
        solve: (x) => solver.rebound(x, beta, zeta2, e),
        slides: ({ regime }) => regime === "SLIP_THROUGHOUT",
      }],
      rigid: () => [{
        style: "rigid",
        error: 0,
        solve: (x) => solver.rigid_rebound(x, beta, e),
        slides: ({ velocity }) => velocity > 0,
      }],
      continuum: () => continua(impact),
    };
    return TOGGLES.filter((name) => toggles.includes(name)).flatMap((name) => all[name]());
  }

  // What each of these models says about one impact. The direction is 1 forwards, -1 backwards, and
  // 0 where the velocity is nothing, or less than the error of the table. The rigid limit has no
  // spring: where it does not slide throughout it stops, whatever the others do. That is called
  // mute, for it contradicts none of them.
  function outcomes(list, { x }) {
    return list.map(({ style, error, solve, slides }) => {
      const found = solve(x);
      const none = Math.abs(found.velocity) <= Math.max(error, STOPPED * x);
      const direction = none ? 0 : Math.sign(found.velocity);
      const mute = style === "rigid" && direction === 0;
      return { style, name: NAMES[style], ...found, direction, slides: slides(found), mute };
    });
  }

  return { NAMES, TOGGLES, STOPPED, chosen, outcomes };
})();
