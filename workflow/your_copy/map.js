"use strict";

// From values on the axes to pixels of a picture, by marks whose values are known. A scan is turned and
// sheared: an affine map. A photo is also seen at an angle: a perspective one. Both by least squares.
const maps = (() => {
  const UNKNOWNS = { affine: 6, perspective: 8 };
  // A perspective is taken if it leaves less than this share of the affine map's residual for each degree of
  // freedom, which is more than a click can err. Four marks leave it none: then if the affine map is far off.
  const [CLEARLY, OF_CLICKS, FAR_OFF] = [0.85, 0.25, 1.5]; // the last two in pixels
  const LEVEL = 0.02; // width over length of what counts as a line

  // Gauss elimination with the largest pivots; null if the equations depend on each other.
  function solve(matrix, right) {
    const rows = matrix.map((row, i) => [...row, right[i]]);
    for (let i = 0; i < rows.length; i++) {
      const best = rows.slice(i).reduce((top, row, k) =>
        Math.abs(row[i]) > Math.abs(rows[top][i]) ? i + k : top, i);
      [rows[i], rows[best]] = [rows[best], rows[i]];
      if (!(Math.abs(rows[i][i]) > 1e-9)) return null;
      for (let k = 0; k < rows.length; k++) {
        const share = k === i ? 0 : rows[k][i] / rows[i][i];
        if (share) rows[k] = rows[k].map((cell, j) => cell - share * rows[i][j]);
      }
    }
    return rows.map((row, i) => row.at(-1) / row[i]);
  }

  const mean = (list) => list.reduce((sum, one) => sum + one, 0) / list.length;
  const rms = (list) => Math.sqrt(mean(list.map((one) => one * one)));

  // Middle and size of points along both directions, and how wide they lie beside a line.
  function spread(points) {
    const middle = [0, 1].map((i) => mean(points.map((point) => point[i])));
    const size = [0, 1].map((i) => rms(points.map((point) => point[i] - middle[i])));
    const both = mean(points.map((p) => (p[0] - middle[0]) * (p[1] - middle[1]))) / (size[0] * size[1]);
    const width = size[0] > 0 && size[1] > 0 ? Math.sqrt(Math.max(0, 1 - Math.abs(both)) / (1 + Math.abs(both))) : 0;
    return { middle, size, width };
  }

  const image = ([a, b, c, d, e, f, g = 0, h = 0], [x, y]) => {
    const w = g * x + h * y + 1;
    return [(a * x + b * y + c) / w, (d * x + e * y + f) / w];
  };

  // The inverse of a map, by the adjugate of its matrix.
  function inverse([a, b, c, d, e, f, g = 0, h = 0]) {
    const adjugate = [e - f * h, c * h - b, b * f - c * e, f * g - d, a - c * g, c * d - a * f,
      d * h - e * g, b * g - a * h, a * e - b * d];
    return adjugate.slice(0, 8).map((one) => one / adjugate[8]);
  }

  const dot = (a, b) => a.reduce((sum, one, i) => sum + one * b[i], 0);

  // How both coordinates of an image change with each unknown.
  function slopes(found, [x, y]) {
    const [u, v] = image(found, [x, y]);
    const w = 1 / ((found[6] ?? 0) * x + (found[7] ?? 0) * y + 1);
    return [[x * w, y * w, w, 0, 0, 0, -u * x * w, -u * y * w], [0, 0, 0, x * w, y * w, w, -v * x * w, -v * y * w]]
      .map((row) => row.slice(0, found.length));
  }

  // Gauss and Newton, from the middle of the picture; an affine map takes one step. With the matrix of the
  // last step, whose inverse is the covariance of the unknowns.
  function unknowns(kind, from, to) {
    let [found, matrix] = [[1, 0, 0, 0, 1, 0, 0, 0].slice(0, UNKNOWNS[kind]), null];
    for (let step = 0; step < (kind === "affine" ? 1 : 12); step++) {
      const rows = from.flatMap((point) => slopes(found, point));
      const off = from.flatMap((point, i) => image(found, point).map((one, k) => to[i][k] - one));
      const columns = found.map((_, i) => rows.map((row) => row[i]));
      matrix = columns.map((one) => columns.map((other) => dot(one, other)));
      const change = solve(matrix, columns.map((one) => dot(one, off)));
      if (!change) return null;
      found = found.map((one, i) => one + change[i]);
    }
    return found.every(Number.isFinite) ? { found, matrix } : null;
  }

  // The map for marks {x, y, u, v}: values on the axes, and pixels.
  function of_kind(kind, marks, values, pixels) {
    const scaled = ({ middle, size }, [a, b]) => [(a - middle[0]) / size[0], (b - middle[1]) / size[1]];
    const back = ({ middle, size }, [a, b]) => [a * size[0] + middle[0], b * size[1] + middle[1]];
    const solved = unknowns(kind, marks.map((m) => scaled(values, [m.x, m.y])),
      marks.map((m) => scaled(pixels, [m.u, m.v])));
    if (!solved) return null;
    const { found, matrix } = solved;
    const reverse = inverse(found);
    const to_pixels = (point) => back(pixels, image(found, scaled(values, point)));
    const to_axes = (point) => back(values, image(reverse, scaled(pixels, point)));
    const off = marks.map((m) => {
      const [[u, v], [x, y]] = [to_pixels([m.x, m.y]), to_axes([m.u, m.v])];
      return { u: m.u - u, v: m.v - v, x: x - m.x, y: y - m.y };
    });
    const freedom = 2 * marks.length - UNKNOWNS[kind];
    const of_freedom = freedom ? Math.sqrt(off.reduce((sum, o) => sum + o.u ** 2 + o.v ** 2, 0) / freedom) : null;
    const residual = { pixels: rms(off.map((o) => Math.hypot(o.u, o.v))), x: rms(off.map((o) => o.x)),
      y: rms(off.map((o) => o.y)) };
    // By how much the marks leave a place uncertain, in pixels along each direction.
    const sigma = (place) => (of_freedom ?? 0) * Math.sqrt(mean(
      slopes(found, scaled(values, to_axes(place))).map((row) => dot(row, solve(matrix, row)))));
    // Units of the axes for a pixel.
    const scale = (point) => {
      const [right, left] = [1, -1].map((step) => to_axes([point[0] + step / 2, point[1]]));
      const [down, up] = [1, -1].map((step) => to_axes([point[0], point[1] + step / 2]));
      return [0, 1].map((i) => Math.hypot(right[i] - left[i], down[i] - up[i]));
    };
    return { kind, to_pixels, to_axes, off, of_freedom, residual, sigma, scale };
  }

  // The map, or why there is none: {refused}.
  function fit(marks) {
    if (marks.length < 3) {
      return { refused: `Set ${3 - marks.length} more of the marks: three are needed, six or more are better.` };
    }
    const [values, pixels] = [spread(marks.map((m) => [m.x, m.y])), spread(marks.map((m) => [m.u, m.v]))];
    if (Math.min(values.width, pixels.width) < LEVEL) {
      return { refused: "The marks lie on one line. Set one that is away from it, on the other axis." };
    }
    const [affine, perspective] = ["affine", "perspective"].map((kind) =>
      2 * marks.length >= UNKNOWNS[kind] ? of_kind(kind, marks, values, pixels) : null);
    const better = perspective && (perspective.of_freedom === null ? affine.of_freedom > FAR_OFF
      : affine.of_freedom > OF_CLICKS && perspective.of_freedom < CLEARLY * affine.of_freedom);
    return better ? perspective : affine;
  }

  return { fit, rms };
})();
