"use strict";

// The microscope: the contact during the first bounce, by the model that is chosen. In the lumped
// model (Fig. 1 of the paper) a rigid body stands on a normal and a tangential spring; below them are
// a contact particle without mass and the surface. In the continuum it stands on a row of pairs of
// springs, of which the outer ones slip first. The picture travels with the body: what moves sideways
// is the surface, and what sticks moves with it. Right is the way of the throw. Units are those of the
// drawing.
const diagram = (() => {
  const MIDDLE = 220;
  const GROUND = 262;
  const PLATE = 170; // underside of the body before contact
  const DEFLECTION = 26; // a deflection of 1
  const FORCE = 62; // a force of 1
  const SPEED = 66; // the speed before the impact
  const FOOT = 290; // where the plate shows the velocity of the contact point
  const HATCH = 14; // of the surface
  const ROW = 150; // half the length of the row of springs
  const PAIRS = 29; // springs drawn in the row
  const LEAN = 0.09; // of a spring in the row at the limit of friction, of its largest length
  const part = (name) => document.getElementById(`diagram-${name}`);

  const { spring } = arrows;

  const draw_arrow = (name, ...ends) => part(name).setAttribute("d", arrows.straight(...ends));

  const move = (name, x, y) => part(name).setAttribute("transform", `translate(${x},${y})`);

  // A label beside an arrow that is long enough to bear one.
  function label(name, visible, x, y) {
    part(name).style.visibility = visible ? "visible" : "hidden";
    move(name, x, y);
  }

  // row: of the contact, positive the way that the contact point came, as `sign` of the impact says;
  // touching: false while the ball flies.
  function show(impact, row, touching) {
    const now = { ...row };
    for (const name of ["friction", "velocity", "spring", "way", "side"]) now[name] *= impact.sign;
    const lumped = impact.contact.style === "lumped";
    part("svg").classList.toggle("row", !lumped);
    part("svg").classList.toggle("flying", !touching);
    const plate = PLATE + DEFLECTION * (touching ? now.depth : 0);
    const foot = lumped && touching ? MIDDLE - DEFLECTION * now.spring : MIDDLE;
    move("body", MIDDLE, plate);
    if (lumped) show_particle(foot, plate);
    else show_row(impact, now, plate, touching);
    const shift = -DEFLECTION * now.way;
    part("surface").setAttribute("patternTransform", `translate(${shift % HATCH},0)`);
    move("origin", Math.max(MIDDLE + shift, -60), GROUND);
    show_state(now, lumped, touching);
    show_forces(touching ? now : { normal: 0, friction: 0 }, foot);
    show_velocity(impact, now, plate);
  }

  function show_particle(foot, plate) {
    move("carriage", foot, plate + 5);
    move("particle", foot, GROUND);
    part("normal-spring").setAttribute("d", spring(foot, plate + 19, foot, GROUND - 16));
    part("tangential-spring").setAttribute("d", spring(128, plate + 12, foot - 15, plate + 12));
  }

  // Springs of the row where they touch: their feet stick or slip, and they lean by their deflection.
  function show_row({ contact, e, sign }, { density, slips, radius }, plate, touching) {
    const motion = continuum.normal(e, contact.style);
    const unit = motion.radius ** 2 * motion.largest_share;
    let [sticking, slipping, free, bodies] = ["", "", "", ""];
    for (let i = 0; i < PAIRS; i++) {
      const share = (2 * i) / (PAIRS - 1) - 1;
      const top = MIDDLE + ROW * share;
      const touches = touching && Math.abs(share) < radius;
      // The outermost foot that touches stands for all springs beyond it.
      const outermost = touches && Math.abs(share) + 2 / (PAIRS - 1) >= radius;
      const place = outermost ? radius - 0.5 / motion.springs : Math.abs(share);
      // While the contact begins, its edge lies within the first spring.
      const k = Math.min(Math.floor(Math.max(place, 0) * motion.springs), motion.springs - 1);
      const lean = touches ? (sign * ROW * LEAN * 3 * density[k]) / unit : 0;
      const round = 100 * Math.abs(share) ** 2.4; // springs begin on the round body
      const end = touches ? GROUND : Math.min(GROUND - 2, plate + (GROUND - PLATE) - round + 4);
      bodies += spring(top, plate - round, top - lean, end - 7, 2.5);
      const foot = `M${(top - lean - 3.5).toFixed(1)},${end - 7}h7v7h-7z`;
      if (!touches) free += foot;
      else if (slips[k] === 0) sticking += foot;
      else slipping += foot;
    }
    part("row-springs").setAttribute("d", bodies);
    part("row-stuck").setAttribute("d", sticking);
    part("row-slipping").setAttribute("d", slipping);
    part("row-free").setAttribute("d", free);
  }

  function show_state({ sticks, side, in_restitution, approach }, lumped, touching) {
    const backwards = side < 0;
    part("svg").classList.toggle("sticking", touching && sticks);
    part("chevrons").setAttribute("transform", backwards ? "scale(-1,1)" : "");
    const slip = backwards ? "\u2190 SLIPS" : "SLIPS \u2192";
    const stick = lumped ? "\u25A0 STICKS" : "\u25A0 MIDDLE STICKS";
    part("state").textContent = touching ? (sticks ? stick : slip) : "in flight: no contact";
    const back = in_restitution ?? approach < 0;
    part("half").textContent = touching ? (back ? "restitution" : "compression") : "";
  }

  // Forces of the surface on the body, below it; the cone holds all that friction can bear.
  function show_forces({ normal, friction }, foot) {
    const [x, y] = [foot + FORCE * friction, GROUND + FORCE * normal];
    move("cone", foot, GROUND);
    draw_arrow("normal-force", foot, y, foot, GROUND);
    draw_arrow("friction-force", x, y, foot, y);
    draw_arrow("force", x, y, foot, GROUND);
    const half = FORCE * normal;
    part("limit").setAttribute("d", `M${foot - half},${y}H${foot + half}`);
    const away = friction > 0 ? -1 : 1;
    label("normal-label", normal > 0.4, foot + away * 14, y - half / 2 + 4);
    label("friction-label", Math.abs(friction) > 0.4, (x + foot) / 2, y + 15);
  }

  function show_velocity({ mu, x, contact, sign }, { velocity, approach }, plate) {
    const unit = SPEED / Math.hypot(1, mu * x);
    const foot = contact.style === "lumped" ? FOOT : MIDDLE;
    draw_arrow("before", foot, plate, foot + sign * unit * mu * x, plate + unit);
    const tip = [foot + unit * mu * velocity, plate + unit * approach];
    draw_arrow("velocity", foot, plate, ...tip);
  }

  return { show };
})();
