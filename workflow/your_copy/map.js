"use strict";

// From values on the axes to pixels of a picture, by marks whose values are known. A scan is turned and sheared,
// a photo is also seen at an angle: a perspective. Least squares find it, with a prior for its tilt.
const maps = (() => {
  const CLICK = 0.5; // px, a first guess of how far a click misses, worth four values
  const TILT = { any: 0.1, scan: 0.01 }; // one standard deviation, for half an axis
  const [MOST_TILTS, POOR] = [3.5, 1.5]; // of marks that fit each other; px, of a mark among them that does not
  // Sum of variances, for marks that are off by half an axis, from which on they leave an unknown open. The run
  // allows ten times as much.
  const LOOSE = 1000;
  const LEVEL = 0.02; // sine of the angle between axes that lie on one line

  const add = (list) => list.reduce((sum, one) => sum + one, 0);
  const rms = (list) => Math.sqrt(add(list.map((one) => one * one)) / list.length);
  const dot = (a, b) => add(a.map((one, i) => one * b[i]));
  const times = (matrix, vector) => matrix.map((row) => dot(row, vector));
  const transposed = (matrix) => matrix[0].map((_, i) => matrix.map((row) => row[i]));
  const far = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1]);

  // Gauss and Jordan, with the largest pivots; null if the rows depend on each other.
  function inverse(matrix) {
    const rows = matrix.map((row, i) => [...row, ...matrix.map((_, k) => Number(k === i))]);
    for (let i = 0; i < rows.length; i++) {
      const best = rows.slice(i).reduce((top, row, k) =>
        Math.abs(row[i]) > Math.abs(rows[top][i]) ? i + k : top, i);
      [rows[i], rows[best]] = [rows[best], rows[i]];
      if (!(Math.abs(rows[i][i]) > 1e-9)) return null;
      rows[i] = rows[i].map((cell) => cell / rows[i][i]);
      for (let k = 0; k < rows.length; k++) {
        const share = k === i ? 0 : rows[k][i];
        if (share) rows[k] = rows[k].map((cell, j) => cell - share * rows[i][j]);
      }
    }
    return rows.map((row) => row.slice(rows.length));
  }

  // Normal equations of rows; the seventh unknown and the next are tilts, with this prior.
  const normal = (rows, prior = 0) => transposed(rows).map((one, i, all) =>
    all.map((other, k) => dot(one, other) + (i === k && i > 5 ? prior : 0)));

  const is_loose = (rows) => !(add(inverse(normal(rows))?.map((row, i) => row[i]) ?? [Infinity]) < LOOSE);

  // How errors of the unknowns move a place along each axis, in halves of it.
  const basis = ([x, y]) => [[x, y, 1, 0, 0, 0, x * x, x * y], [0, 0, 0, x, y, 1, x * y, y * y]];

  const image = ([a, b, c, d, e, f, g, h], [x, y]) => {
    const w = g * x + h * y + 1;
    return [(a * x + b * y + c) / w, (d * x + e * y + f) / w];
  };

  // Gauss and Newton. The first step, from a map of everything to the middle, leads to the best map without tilt.
  function solved(from, to, sigma, prior) {
    let found = [0, 0, 0, 0, 0, 0, 0, 0];
    let off = to;
    for (let step = 0; step < 15; step++) {
      const rows = from.flatMap(([x, y]) => {
        const [u, v] = image(found, [x, y]);
        const w = sigma * (found[6] * x + found[7] * y + 1);
        return [[x, y, 1, 0, 0, 0, -u * x, -u * y], [0, 0, 0, x, y, 1, -v * x, -v * y]]
          .map((row) => row.map((one) => one / w));
      });
      const right = times(transposed(rows), off.flat()).map((one, i) => one / sigma - (i > 5 ? prior * found[i] : 0));
      const covariance = inverse(normal(rows, prior));
      if (!covariance) return null;
      const change = times(covariance, right);
      found = found.map((one, i) => one + change[i]);
      off = from.map((place, i) => image(found, place).map((one, k) => to[i][k] - one));
    }
    const squares = add(off.flat().map((one) => one * one));
    return { found, off, squares, cost: squares / sigma ** 2 + prior * (found[6] ** 2 + found[7] ** 2) };
  }

  // The mark without which the others fit best, and how far it is from where they put it.
  function worst(from, to, prior) {
    const all = from.map((_, i) => {
      const [rest, places] = [from, to].map((list) => list.filter((_, k) => k !== i));
      const own = solved(rest, places, CLICK, prior);
      return { i, cost: own?.cost ?? Infinity, off: own ? far(image(own.found, from[i]), to[i]) : 0 };
    });
    return all.reduce((best, one) => (one.cost < best.cost ? one : best));
  }

  // The map for marks {x, y, u, v}, values on axes of this range and pixels; or why there is none: {refused}.
  function fit(marks, range, is_scan) {
    if (marks.length < 3) {
      return { refused: `Set ${3 - marks.length} more of the marks: four or more are needed, three for a flat-bed scan.` };
    }
    const [mid, half] = [1, -1].map((sign) => range.map(([low, high]) => (high + sign * low) / 2));
    const scaled = (point) => point.map((one, i) => (one - mid[i]) / half[i]);
    const from = marks.map(({ x, y }) => scaled([x, y]));
    const on_line = "The marks lie on one line. Set one that is away from it, on the other axis.";
    if (is_loose(from.map((place) => [1, ...place]))) return { refused: on_line };
    if (!is_scan && is_loose(from.flatMap(basis))) {
      return { refused: "Set the corner opposite the origin too, or three marks on each axis. Fewer are enough only " +
        "if this is a flat-bed scan and no photo: then tick it." };
    }
    const middle = ["u", "v"].map((key) => add(marks.map((mark) => mark[key])) / marks.length);
    const to = marks.map(({ u, v }) => [u - middle[0], v - middle[1]]);
    const tilt = is_scan ? TILT.scan : TILT.any;
    const freedom = Math.max(0, 2 * marks.length - 8);
    const sigma_of = ({ squares }) => Math.sqrt((1 + squares) / (4 + freedom));
    const first = solved(from, to, CLICK, tilt ** -2);
    const { found, off, squares } = solved(from, to, sigma_of(first), tilt ** -2);
    const sigma = sigma_of({ squares });
    const wrong = sigma > POOR && marks.length > 4 ? worst(from, to, tilt ** -2) : null;
    const [a, b, c, d, e, f, g, h] = found;
    const [x_axis, y_axis] = [[a - g * c, d - g * f], [b - h * c, e - h * f]];
    const sine = (x_axis[0] * y_axis[1] - x_axis[1] * y_axis[0]) / Math.hypot(...x_axis) / Math.hypot(...y_axis);
    const problems = [
      [!(Math.hypot(g, h) < (marks.length < 5 ? MOST_TILTS * tilt : 0.9)),
        "The marks do not fit each other: set them again, or correct their numbers."],
      [sine > LEVEL, "The picture would be mirrored: are two marks exchanged, or is a sign wrong?"],
      [!(sine < -LEVEL), on_line],
    ].filter(([is_so]) => is_so);
    if (problems.length) return { refused: problems[0][1], worst: wrong };
    const back = inverse([[a, b, c], [d, e, f], [g, h, 1]]).flat().map((one, _, all) => one / all[8]);
    const to_pixels = (point) => image(found, scaled(point)).map((one, i) => one + middle[i]);
    const to_axes = (place) =>
      image(back, place.map((one, i) => one - middle[i])).map((one, i) => one * half[i] + mid[i]);
    // Units of the axes for a pixel.
    const scale = ([u, v]) => {
      const [right, left, down, up] = [[u + 0.5, v], [u - 0.5, v], [u, v + 0.5], [u, v - 0.5]].map(to_axes);
      return [0, 1].map((i) => Math.hypot(right[i] - left[i], down[i] - up[i]));
    };
    // By how much errors of the unknowns move a point along both axes, and their covariance if marks have these sigmas.
    const shifts = (point) => basis(scaled(point)).map((row, i) => row.map((one) => one * half[i]));
    const covariance = (sigmas) => inverse(normal(
      from.flatMap((place) => basis(place).map((row, i) => row.map((one) => one * half[i] / sigmas[i]))), tilt ** -2));
    return {
      tilt, freedom, sigma, off: off.map((one) => Math.hypot(...one)), residual: Math.sqrt(squares / marks.length),
      worst: wrong, to_pixels, to_axes, scale, shifts, covariance,
    };
  }

  return { CLICK, fit, inverse, transposed, times, dot, rms, far };
})();
