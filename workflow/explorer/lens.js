"use strict";

// A magnifying glass at the ball while it touches: the spring along the surface between the ball and
// its foot, the friction that the surface exerts on the ball, and the velocity of the contact point.
// The glass travels with the foot: while the foot sticks the surface stands still. Without tangential
// compliance a strut stands where the spring was. Deflections are drawn in units of the impact, very
// large; lengths here are in shares of the radius of the glass.
const lens = (() => {
  const GROUND = 0.38; // of the surface, below the middle
  const GAP = 0.52; // between ball and surface before contact
  const PRESSED = 0.17; // of that at the largest compression
  const DEFLECTION = 0.4; // a deflection of 1
  const FORCE = 0.75; // of friction at the largest normal force
  const SPEED = 0.6; // of the fastest contact point of the throw
  const HATCH = 0.26;
  const UNDERSIDE = 1.7; // radius of the ball in the glass
  const LINE = 17; // px between two lines of words
  const AT_REST = 0.06; // of the velocity in the deflection
  const SLIDES = 1e-9; // incidence from which on something does

  // What the contact does now; `first` is its incidence.
  function words({ sticks, velocity, spring }, springy, first) {
    if (first < SLIDES) return "nothing slides";
    if (!sticks) return "slips: friction at its limit";
    if (!springy) return "stopped: nothing throws it back";
    if (Math.abs(velocity) < AT_REST * Math.abs(spring)) return "sticks: point at rest, spring stretched most";
    if (velocity * spring <= 0) return "sticks: spring recoils";
    return `sticks: spring stretches${spring > 0 ? "" : " the other way"}`;
  }

  // Markup of the glass: `now` a row of the contact, `sign` the direction in which the contact point
  // came, `up` 1 on the floor and -1 under the table. Its middle is at (x, y), its radius `size`;
  // `speed` is mu v2(0) of this bounce over that of the fastest contact point of the throw. `tip` is
  // the place of the contact; words stand on that `side`, if they are not said elsewhere.
  function show({ lane, now, first, speed, sign, up, springy, x, y, size, tip, side, worded }) {
    const u = (value) => value * size;
    const place = (across, down) => [x + u(across), y + up * u(down)];
    const [, ground] = place(0, GROUND);
    const shear = sign * DEFLECTION * (now.spring || 0);
    const foot = sign * DEFLECTION * (now.way - (now.spring || 0)); // gone along the surface
    const bottom = place(shear, GROUND - GAP + PRESSED * now.depth);
    const end = place(0, GROUND - 0.1);
    const hatch = Array.from({ length: 11 }, (_, i) => {
      const [left] = place((i - 5) * HATCH - (foot % HATCH), 0);
      return `M${left.toFixed(1)},${ground.toFixed(1)}l${u(-0.14).toFixed(1)},${(up * u(0.16)).toFixed(1)}`;
    }).join("");
    const middle = bottom[1] - up * u(UNDERSIDE);
    const edge = ground + up * 2 * size;
    const friction = -sign * FORCE * now.friction;
    const level = ground - up * u(0.05);
    const side_of_foot = x + Math.sign(friction) * u(0.1);
    const beside = x + side * (size + 8);
    const said = words(now, springy, first).split(/(?<=:) /);
    const text = said.map((line, i) => `<text class="lens-words ${now.sticks ? "sticks" : ""}" x="${beside}"
      y="${y + 5 + LINE * (i - (said.length - 1) / 2)}" text-anchor="${side > 0 ? "start" : "end"}">${line}</text>`);
    const joint = springy
      ? `<path class="spring friction" d="${arrows.spring(...bottom, ...end, 0.09 * size)}"/>`
      : `<path class="strut" d="M${bottom}L${end}"/>`;
    const half = u(0.1);
    const id = `lens-clip-${lane}`;
    return `<path class="leader" d="M${tip}L${x + (tip[0] < x ? -size : size) * 0.98},${y}"/>
      <clipPath id="${id}"><circle cx="${x}" cy="${y}" r="${size}"/></clipPath>
      <g clip-path="url(#${id})"><circle class="glass" cx="${x}" cy="${y}" r="${size}"/>
      <path class="earth" d="M${x - size},${ground}H${x + size}V${edge}H${x - size}Z"/>
      <path class="hatch" d="${hatch}"/><path class="ground" d="M${x - size},${ground}H${x + size}"/>
      <circle class="under" cx="${bottom[0]}" cy="${middle}" r="${u(UNDERSIDE)}"/>${joint}
      <path class="${now.sticks ? "holds" : "slides"}" d="M${x - half},${ground}v${-up * half}h${2 * half}v${up * half}Z"/>
      <path class="arrow velocity" d="${arrows.straight(bottom[0], bottom[1] - up * u(0.16),
        bottom[0] + u(sign * SPEED * now.velocity * speed), bottom[1] - up * u(0.16))}"/>
      <path class="arrow friction" d="${arrows.straight(side_of_foot, level, side_of_foot + u(friction), level)}"/>
      </g><circle class="glass-rim" cx="${x}" cy="${y}" r="${size}"/>
      ${worded ? text.join("") : ""}`;
  }

  return { show, words };
})();
