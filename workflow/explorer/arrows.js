"use strict";

// Arrows as one outline, of which too short ones are left out, and springs.
const arrows = (() => {
  function straight(x1, y1, x2, y2) {
    const length = Math.hypot(x2 - x1, y2 - y1);
    if (length < 3) return "";
    const [ux, uy] = [(x2 - x1) / length, (y2 - y1) / length];
    const head = Math.min(11, length);
    const corner = (along, aside) =>
      `${(x1 + along * ux - aside * uy).toFixed(1)},${(y1 + along * uy + aside * ux).toFixed(1)}`;
    const shaft = length - head;
    const half = [[0, 1.6], [shaft, 1.6], [shaft, 5.5]];
    const other = half.map(([along, aside]) => [along, -aside]).reverse();
    const sides = [...half, [length, 0], ...other];
    return `M${sides.map(([along, aside]) => corner(along, aside)).join("L")}Z`;
  }

  // Round a centre, from the top, by an angle in radians that grows clockwise; a line, no outline.
  function round(x, y, radius, sweep) {
    if (Math.abs(sweep) < 0.12) return "";
    const point = (angle, far) =>
      `${(x + far * Math.sin(angle)).toFixed(1)},${(y - far * Math.cos(angle)).toFixed(1)}`;
    const side = Math.sign(sweep);
    const back = sweep - side * Math.min(8 / radius, Math.abs(sweep));
    const large = Math.abs(sweep) > Math.PI ? 1 : 0;
    return `M${point(0, radius)}A${radius},${radius} 0 ${large} ${side > 0 ? 1 : 0} ` +
      `${point(sweep, radius)}M${point(back, radius - 6)}L${point(sweep, radius)}` +
      `L${point(back, radius + 6)}`;
  }

  // A zigzag of a width from one end to the other.
  function spring(x1, y1, x2, y2, width = 7) {
    const [dx, dy] = [x2 - x1, y2 - y1];
    const length = Math.hypot(dx, dy);
    const aside = (share, side) =>
      `${(x1 + share * dx - (side * width * dy) / length).toFixed(1)},` +
      `${(y1 + share * dy + (side * width * dx) / length).toFixed(1)}`;
    const turns = Array.from({ length: 8 }, (_, i) => aside(0.15 + 0.1 * i, i % 2 ? 1 : -1));
    return `M${x1.toFixed(1)},${y1}L${aside(0.1, 0)}L${turns.join("L")}L${aside(0.9, 0)}` +
      `L${x2.toFixed(1)},${y2}`;
  }

  return { straight, round, spring };
})();
