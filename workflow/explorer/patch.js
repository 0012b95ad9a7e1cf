"use strict";

// The patch of contact as seen through the floor: which part sticks, which part slips, and the
// friction on each part. The lumped model has one point, which is drawn as a patch that sticks or
// slips as a whole.
const patch = (() => {
  const RADIUS = 84; // of the largest contact
  const ARROWS = 5; // from the middle to the edge of the largest contact
  const LENGTH = 30; // of the arrow of mu times the largest pressure
  const ZONES = 6;
  const element = (id) => document.getElementById(id);

  // Places of the arrows: a hexagonal pattern, so that none stands out.
  const PLACES = [];
  for (let row = -ARROWS; row <= ARROWS; row++) {
    for (let column = -ARROWS; column <= ARROWS; column++) {
      const x = (column + (row % 2 ? 0.5 : 0)) / ARROWS;
      const y = (row * 0.866) / ARROWS;
      if (Math.hypot(x, y) < 1) PLACES.push([x, y]);
    }
  }

  // Circles from the edge inwards: where the state of the springs changes. `radius` is over the
  // largest one.
  function zones({ slips, touching, radius }) {
    const circles = [];
    [...slips].slice(0, touching).forEach((slip, i) => {
      const outer = i === touching - 1 ? radius : (i + 1) / slips.length;
      const last = circles.at(-1);
      if (last && last.slip === slip) last.outer = outer;
      else circles.push({ slip, outer });
    });
    return circles.reverse().slice(0, ZONES);
  }

  // Tangential stress at radii, over `unit`, from the densities of the springs: the integral of
  // -q'(s)/sqrt(s^2 - r^2) from r to the edge (Abel's transform), with q straight between springs.
  function stress(density, width, edge, radii, unit) {
    const inside = [...density].map((q, i) => [(i + 0.5) * width, q]).filter(([s]) => s < edge);
    const corners = [...inside, [edge, 0]];
    const integral = (s, r) => Math.log(s + Math.sqrt(Math.max(s * s - r * r, 0)));
    return radii.map((r) => {
      let sum = 0;
      for (let i = 1; i < corners.length; i++) {
        const [[s, q], [t, p]] = [corners[i - 1], corners[i]];
        if (t <= r || t - s < 1e-9) continue;
        sum += ((q - p) / (t - s)) * (integral(t, r) - integral(Math.max(s, r, 1e-6), r));
      }
      return sum / unit;
    });
  }

  function arrow(x, y, length) {
    if (Math.abs(length) < 1.5) return "";
    const head = 0.42 * length;
    const wide = Math.min(Math.abs(head), 5) * 0.55;
    const [tail, tip] = [x - length / 2, x + length / 2];
    const neck = (tip - head).toFixed(1);
    return `M${tail.toFixed(1)},${y.toFixed(1)}H${neck}M${neck},${(y - wide).toFixed(1)}` +
      `L${tip.toFixed(1)},${y.toFixed(1)}L${neck},${(y + wide).toFixed(1)}Z`;
  }

  // Stress as a function of the radius, on a fine grid.
  const GRID = Array.from({ length: 25 }, (_, i) => (i / 24) * 0.999);

  function stress_at(row, motion) {
    const edge = Math.sqrt(row.limit.square);
    if (!edge) return () => 0;
    const width = motion.radius / motion.springs;
    const radii = GRID.map((share) => share * edge);
    // The densities L = h (a^2 - r^2) of the largest contact have the largest stress 2 a h.
    const unit = 2 * motion.radius * motion.largest_share;
    const values = stress(row.density, width, edge, radii, unit);
    return (share) => {
      const place = (share * motion.radius / edge) * 24 / 0.999;
      if (place >= 24) return values[24];
      const i = Math.floor(place);
      return values[i] + (place - i) * (values[i + 1] - values[i]);
    };
  }

  // row: the contact now, or null while the ball flies; sign: the direction it came in.
  function show(name, row, sign, motion) {
    const svg = element(`patch-${name}`);
    const circles = svg.querySelectorAll("circle.zone");
    const radius = row ? row.radius : 0;
    let list = [];
    let force = () => 0;
    if (row && radius > 0.02) {
      if (motion) {
        list = zones(row);
        force = stress_at(row, motion);
      } else {
        list = [{ slip: row.sticks ? 0 : row.side, outer: radius }];
        // As under Hertz's pressure, with the same ratio of friction to its limit everywhere.
        const ratio = row.normal > 0 ? row.friction / row.normal : 0;
        force = (share) => ratio * Math.sqrt(Math.max(radius * radius - share * share, 0));
      }
    }
    circles.forEach((circle, i) => {
      const zone = list[i];
      circle.setAttribute("r", zone ? (RADIUS * zone.outer).toFixed(1) : 0);
      circle.classList.toggle("sticks", zone?.slip === 0);
    });
    const marks = PLACES.map(([x, y]) => {
      const share = Math.hypot(x, y);
      if (share >= radius - 0.02) return "";
      // Friction of the surface on the ball is against the direction it came in where positive.
      return arrow(RADIUS * x, RADIUS * y, -sign * LENGTH * force(share));
    });
    svg.querySelector(".stress").setAttribute("d", marks.join(""));
    return list;
  }

  // What the patch shows, in a few words.
  function words(list) {
    if (!list.length) return "no contact";
    const sticks = list.some(({ slip }) => slip === 0);
    const slips = list.some(({ slip }) => slip !== 0);
    if (sticks && slips) return "middle sticks, edge slips";
    return sticks ? "all of it sticks" : "all of it slips";
  }

  return { show, words };
})();
