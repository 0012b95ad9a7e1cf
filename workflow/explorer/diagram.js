"use strict";

// The microscope: the contact after Fig. 1 of the paper. A rigid body stands on a normal and a
// tangential spring; below them are a contact particle without mass and the surface. The picture
// travels with the body: what moves sideways is the surface, and in stick the particle moves with
// it. Units are those of the drawing.
const diagram = (() => {
  const MIDDLE = 220;
  const GROUND = 262;
  const PLATE = 170; // underside of the body before contact
  const DEFLECTION = 26; // a deflection of 1
  const FORCE = 62; // a force of 1
  const SPEED = 66; // the speed before the impact
  const FOOT = 290; // where the plate shows the velocity of the contact point
  const HATCH = 14; // of the surface
  const part = (name) => document.getElementById(`diagram-${name}`);

  function spring(x1, y1, x2, y2) {
    const [dx, dy] = [x2 - x1, y2 - y1];
    const length = Math.hypot(dx, dy);
    const aside = (share, side) =>
      `${(x1 + share * dx - (side * 7 * dy) / length).toFixed(1)},` +
      `${(y1 + share * dy + (side * 7 * dx) / length).toFixed(1)}`;
    const turns = Array.from({ length: 8 }, (_, i) => aside(0.15 + 0.1 * i, i % 2 ? 1 : -1));
    return `M${x1},${y1}L${aside(0.1, 0)}L${turns.join("L")}L${aside(0.9, 0)}L${x2},${y2}`;
  }

  const draw_arrow = (name, ...ends) => part(name).setAttribute("d", arrows.straight(...ends));

  const move = (name, x, y) => part(name).setAttribute("transform", `translate(${x},${y})`);

  // A label beside an arrow that is long enough to bear one.
  function label(name, shown, x, y) {
    part(name).style.visibility = shown ? "visible" : "hidden";
    move(name, x, y);
  }

  // now: state of the contact; way: distance that the body has gone along the surface.
  function show(impact, now, way) {
    const particle = MIDDLE - DEFLECTION * now.spring;
    const plate = PLATE + DEFLECTION * now.depth;
    move("body", MIDDLE, plate);
    move("carriage", particle, plate + 5);
    move("particle", particle, GROUND);
    part("normal-spring").setAttribute("d", spring(particle, plate + 19, particle, GROUND - 16));
    part("tangential-spring").setAttribute("d", spring(128, plate + 12, particle - 15, plate + 12));
    const shift = -DEFLECTION * way;
    part("surface").setAttribute("patternTransform", `translate(${shift % HATCH},0)`);
    move("origin", Math.max(MIDDLE + shift, -60), GROUND);
    draw_state(now);
    draw_forces(now, particle);
    draw_velocity(impact, now, plate);
  }

  function draw_state({ phase }) {
    const backwards = phase.side < 0;
    part("svg").classList.toggle("sticking", phase.sticks);
    part("chevrons").setAttribute("transform", backwards ? "scale(-1,1)" : "");
    const slip = backwards ? "\u2190 SLIPS" : "SLIPS \u2192";
    part("state").textContent = phase.sticks ? "\u25A0 STICKS" : slip;
    part("half").textContent = phase.in_restitution ? "restitution" : "compression";
  }

  // Forces of the surface on the body, below it; the cone holds all that friction can bear.
  function draw_forces({ normal, friction }, particle) {
    const [x, y] = [particle + FORCE * friction, GROUND + FORCE * normal];
    move("cone", particle, GROUND);
    draw_arrow("normal-force", particle, y, particle, GROUND);
    draw_arrow("friction-force", x, y, particle, y);
    draw_arrow("force", x, y, particle, GROUND);
    const half = FORCE * normal;
    part("limit").setAttribute("d", `M${particle - half},${y}H${particle + half}`);
    const away = friction > 0 ? -1 : 1;
    label("normal-label", normal > 0.4, particle + away * 14, y - half / 2 + 4);
    label("friction-label", Math.abs(friction) > 0.4, (x + particle) / 2, y + 15);
  }

  function draw_velocity({ mu, x }, { velocity, approach }, plate) {
    const unit = SPEED / Math.hypot(1, mu * x);
    draw_arrow("before", FOOT, plate, FOOT + unit * mu * x, plate + unit);
    const tip = [FOOT + unit * mu * velocity, plate + unit * approach];
    draw_arrow("velocity", FOOT, plate, ...tip);
  }

  return { show };
})();
