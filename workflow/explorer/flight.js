"use strict";

// A ball that is thrown on a floor, or between a floor and a table, with gravity: flights and
// bounces in turn. Lengths in m, velocities in m/s, along the floor and up; spin in rad/s, clockwise
// positive, as a ball spins that rolls to the right. A place is that of the lowest point of the ball.
const flight = (() => {
  const HAND = 0.6; // height of the hand; a ball that comes in flat starts lower
  const BOUNCES = 5;
  const UNDER_TABLE = 3; // bounces: floor, table, floor
  const SLOWEST = 0.3; // m/s towards the surface; slower bounces are left out
  const SLIDES = 0.3; // s, shown of a ball that does not bounce off
  const LONGEST = 0.5; // s, of a flight without gravity that does not end at a wall, or begins there
  const MOST = 6; // s, of any flight that is shown to its end
  const RADIANS = Math.PI / 180;

  // Velocities of the ball just before the first bounce.
  const first = ({ angle, speed, spin }) => (
    { along: speed * Math.sin(angle * RADIANS), up: -speed * Math.cos(angle * RADIANS), spin });

  // The throw of a ball that leaves the hand with these velocities, down or level.
  function aimed({ along, up, height, gravity }) {
    const down = Math.sqrt(up * up + 2 * gravity * height);
    return { angle: Math.atan2(along, down) / RADIANS, speed: Math.hypot(along, down) };
  }

  // The ball in the hand.
  function start({ angle, speed, spin, table, radius, gravity }) {
    const { along, up } = first({ angle, speed, spin });
    const most = table ? Math.min(HAND, (table - 2 * radius) / 2) : HAND;
    const height = Math.min(most, gravity ? (up * up) / (2 * gravity) : -LONGEST * up);
    const square = Math.max(up * up - 2 * gravity * height, 0);
    return { place: 0, height, along, up: -Math.sqrt(square), spin, turn: 0, gravity };
  }

  function later(ball, time) {
    const height = ball.height + time * ball.up - (ball.gravity * time * time) / 2;
    return {
      ...ball,
      place: ball.place + time * ball.along,
      height: Math.max(height, 0),
      up: ball.up - ball.gravity * time,
      turn: ball.turn + time * ball.spin,
    };
  }

  // The wall that a ball reaches next, and when; without gravity perhaps none.
  function next({ height, up, gravity: g }, gap) {
    const rise = gap - height;
    if (gap && up > 0 && up * up > 2 * g * rise) {
      return { wall: "table", time: (2 * rise) / (up + Math.sqrt(up * up - 2 * g * rise)) };
    }
    if (g) return { wall: "floor", time: (up + Math.sqrt(up * up + 2 * g * height)) / g };
    return up < 0 ? { wall: "floor", time: height / -up } : { wall: null, time: LONGEST };
  }

  // Incidence at a wall: clockwise spin moves the foot of a ball backwards and its top forwards.
  // `sign` is the direction in which the contact point comes; models call that forwards.
  function incidence(ball, wall, { radius, friction }) {
    const side = wall === "floor" ? -radius : radius;
    const contact = ball.along + side * ball.spin;
    const unit = friction * Math.abs(ball.up);
    return { x: Math.abs(contact) / unit, unit, sign: contact < 0 ? -1 : 1, side };
  }

  // The ball after a bounce that leaves the contact point with `velocity`, in mu v2(0). A share
  // m1/m2 of its change goes to the centre, the rest is spin about it.
  function rebounded(ball, { x, unit, sign, side }, velocity, { mass_ratio: beta, restitution: e }) {
    const change = sign * unit * (velocity - x);
    return {
      ...ball,
      along: ball.along + change / beta,
      up: -e * ball.up,
      spin: ball.spin + ((1 - 1 / beta) * change) / side,
      gravity: e === 0 ? 0 : ball.gravity, // a ball that does not bounce off lies on the floor
    };
  }

  // Flights and bounces, from the hand on. `contact_of` is the contact of a model, by incidence.
  function fly(given, contact_of) {
    const gap = given.table ? given.table - 2 * given.radius : 0;
    const parts = [];
    let ball = start(given);
    for (let count = 0; count < (gap ? UNDER_TABLE : BOUNCES); count++) {
      const { wall, time } = next(ball, gap);
      parts.push({ kind: "flight", ball, time });
      if (!wall) return parts;
      if (count && time > MOST) {
        parts.at(-1).time = MOST;
        return parts;
      }
      ball = later(ball, time);
      if (wall === "floor") ball.height = 0;
      if (count === 0) Object.assign(ball, first(given));
      if (Math.abs(ball.up) < SLOWEST && count) return parts;
      const strike = incidence(ball, wall, given);
      const contact = contact_of(strike.x);
      const after = rebounded(ball, strike, contact.state.velocity, given);
      parts.push({ kind: "bounce", ball, after, wall, contact, ...strike });
      ball = after;
      if (ball.up === 0) {
        parts.push({ kind: "flight", ball, time: SLIDES });
        return parts;
      }
    }
    const { wall, time } = next(ball, gap);
    const shown = wall ? (gap ? 0.9 : 0.5) * time : time;
    parts.push({ kind: "flight", ball, time: Math.min(shown, MOST) });
    return parts;
  }

  const bounces = (parts) => parts.filter(({ kind }) => kind === "bounce");

  // The least velocity forwards of the ball after any bounce, whatever its contacts are: each may reverse
  // the velocity of its contact point fully, in part or not at all. It is linear in each of these shares,
  // so that it is least where each is none or all.
  function slowest(given) {
    const choices = Array.from({ length: 2 ** BOUNCES }, (_, choice) => {
      let count = 0;
      const parts = fly(given, (x) => ({ state: { velocity: (choice >> count++) % 2 ? -x : x } }));
      return bounces(parts).map(({ after }) => after.along);
    });
    return Math.min(...choices.flat());
  }

  return { first, aimed, start, later, fly, bounces, slowest };
})();
