"use strict";

// The whole ball: it flies in without spin, touches the surface, and leaves with spin. The time t
// runs from -1 to 0 in flight, from 0 to 1 + e in contact, in slow motion, and on for 1 in flight.
// Both flights take equally long, so their paths compare the speeds. During contact the ball does
// not move visibly: only its velocity and its spin change.
const ball = (() => {
  const MIDDLE = 240;
  const GROUND = 262;
  const RADIUS = 40;
  const ROOM = { along: 160, up: GROUND - 2 * RADIUS - 30 }; // for the path of the centre
  const SPEED = 52; // length of the speed before the impact
  const ARC = 62; // radius of the arcs of both angles
  const TURN = 2.6; // radians of the arrow of a spin with which the rim has the speed before
  const part = (name) => document.getElementById(`ball-${name}`);
  const degrees = (radians) => (radians * 180) / Math.PI;

  // Velocity of the centre along the surface and radius times spin, in mu v2(0), when the contact
  // point has this velocity. A tangential impulse P changes the centre by P/m and the contact point
  // by P/m1 = (m2/m1) P/m. Spin is positive where it moves the contact point forwards.
  function motion({ x, beta }, velocity) {
    const centre = x + (velocity - x) / beta;
    return { centre, spin: velocity - centre };
  }

  // Between the path on which the centre leaves and the normal, in degrees; 90 for e = 0.
  function angle(impact) {
    const { mu, e, result } = impact;
    return degrees(Math.atan2(Math.abs(mu * motion(impact, result.velocity).centre), e));
  }

  // Lengths of the drawing: vectors of velocity over the speed before, x to the right, y down, and
  // how far the ball comes in `reach` at that speed.
  function drawing(impact) {
    const { mu, x, e, result } = impact;
    const speed = Math.hypot(1, mu * x);
    const after = motion(impact, result.velocity);
    const before = [(mu * x) / speed, 1 / speed];
    const leaving = [(mu * after.centre) / speed, -e / speed];
    const far = ([along, up]) =>
      Math.min(ROOM.along / Math.abs(along), ROOM.up / Math.abs(up));
    const reach = Math.min(far(before), far(leaving));
    return { speed, before, leaving, reach, turn: (-mu * after.spin * reach) / (speed * RADIUS) };
  }

  const CENTRE = [MIDDLE, GROUND - RADIUS];
  const point = ([along, up], far) => [CENTRE[0] + along * far, CENTRE[1] + up * far];

  // From the normal to a direction, both from the centre of the ball in contact.
  function arc([along, up]) {
    const size = Math.hypot(along, up);
    if (size < 1e-3 || Math.abs(along / size) < 0.02) return "";
    const [x, y] = point([along / size, up / size], ARC);
    return `M${MIDDLE},${CENTRE[1] - ARC}A${ARC},${ARC} 0 0 ${along > 0 ? 1 : 0} ${x},${y}`;
  }

  // What stays while time runs: the paths, their angles, where the ball comes from and goes to.
  function prepare(impact) {
    const { before, leaving, reach, turn } = drawing(impact);
    const back = before.map((one) => -one);
    const line = (direction) => `M${point(direction, reach)}L${CENTRE}`;
    part("path-in").setAttribute("d", line(back));
    part("path-out").setAttribute("d", line(leaving));
    part("arc-in").setAttribute("d", arc(back));
    part("arc-out").setAttribute("d", arc(leaving));
    place("start", point(back, reach), 0);
    place("end", point(leaving, reach), turn);
    const incident = degrees(Math.atan(impact.mu * impact.x));
    part("angle-in").textContent = `in: \u03B8 = ${incident.toFixed(1)}\u00B0`;
    part("angle-out").textContent =
      impact.e === 0 ? "out: stays down" : `out: ${angle(impact).toFixed(1)}\u00B0`;
  }

  const place = (name, [x, y], turn) =>
    part(name).setAttribute("transform", `translate(${x},${y}) rotate(${degrees(turn)})`);

  function draw_velocity(name, [x, y], [along, up]) {
    part(name).setAttribute("d", arrows.straight(x, y, x + SPEED * along, y + SPEED * up));
  }

  // A label, kept inside the picture.
  function label(name, x, y) {
    part(name).setAttribute("x", Math.min(Math.max(x, 56), 424));
    part(name).setAttribute("y", y);
  }

  // now: state of the contact at t, at one of its ends during the flights.
  function show(impact, now, t) {
    const { before, leaving, reach, turn, speed } = drawing(impact);
    const left = Math.max(t - (1 + impact.e), 0);
    const [x, y] = t < 0 ? point(before, t * reach) : point(leaving, left * reach);
    const { centre, spin } = motion(impact, now.velocity);
    place("body", [x, y], left * turn);
    const along = impact.mu / speed;
    const up = now.approach / speed;
    draw_velocity("centre", [x, y], [along * centre, up]);
    draw_velocity("contact", [x, y + RADIUS], [along * now.velocity, up]);
    // Each label stands where neither arrow is: beside the ball, and below its foot.
    const aside = x < 330 ? RADIUS + 54 : -RADIUS - 30;
    label("centre-label", x + aside, y + (x < 330 ? Math.min(SPEED * up, 24) : 0));
    const tip = SPEED * Math.max(up, 0);
    label("contact-label", x + SPEED * along * (up > 0 ? now.velocity : 0), y + RADIUS + tip + 16);
    part("spin").setAttribute("d", arrows.round(x, y, RADIUS + 10, -TURN * along * spin));
    const stage = t < 0 ? "flies in" : left ? "leaves" : "contact, in slow motion";
    part("moment").textContent = stage;
  }

  return { motion, angle, prepare, show };
})();
