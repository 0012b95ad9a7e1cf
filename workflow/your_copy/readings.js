"use strict";

// Points of a print that were read: how uncertain they are, which error of a curve they would show, and the file
// for the run. Places are in pixels.
const readings = (() => {
  const SAME_POINT = 0.03; // share of the picture in which two readings of one point lie
  const SAME_CLICK = 0.05; // px
  const MOST_OF_LINE = 15; // points: between nearer ones a draughtsman's errors are alike
  // What the run refuses, too. Letters are those of all alphabets, as in Python.
  const PLACEHOLDER = new RegExp(`^(?:${DATA.refused.placeholder.replace("\\W", "[^\\p{L}\\p{N}_]")})$`, "iu");
  const round = (value, digits) => Number(value.toPrecision(digits));
  const unit_of = (column) => column.match(/\[(.*)\]/)[1].replace(/^1$/, "");

  // Points of two readings that are the same, nearest first.
  function paired(first, second, size) {
    const near = first.flatMap((a, i) => second.map((b, k) => ({ i, k, far: maps.far(a, b) })))
      .filter(({ far }) => far < SAME_POINT * size).sort((a, b) => a.far - b.far);
    const found = [];
    for (const one of near) {
      if (!found.some(({ i, k }) => i === one.i || k === one.k)) found.push(one);
    }
    return found.map(({ i, k }) => [first[i], second[k]]);
  }

  const thinned = (points) => (points.length <= MOST_OF_LINE ? points
    : Array.from({ length: MOST_OF_LINE }, (_, i) => points[Math.round(i * (points.length - 1) / (MOST_OF_LINE - 1))]));

  // The points to save, with one standard deviation of a mark and of a point in units of both axes; or {refused}.
  function judged(map, { readings: [first, second], widths: [width], by }, is_line, size) {
    if (map.refused) return map;
    if ([first, second].some((places) => places.some((a, i) => places.slice(0, i).some((b) => maps.far(a, b) < SAME_CLICK)))) {
      return { refused: "A point stands twice in one reading. Remove it there." };
    }
    const found = is_line ? of_line(map, first, width, by.startsWith("followed")) : of_markers(map, first, second, size);
    if (found.refused) return found;
    const scales = found.points.map(map.scale);
    const pixel = [0, 1].map((i) => maps.rms(scales.map((scale) => scale[i])));
    return { ...found, marks: pixel.map((one) => one * found.mark), sigmas: pixel.map((one) => one * found.point) };
  }

  function of_line(map, points, width, is_followed) {
    if (points.length < 2) return { refused: "Read two points of the line, or more." };
    if (!(width > 0)) return { refused: "How wide is the line? Its width is not known unless it is followed." };
    const mark = Math.max(maps.CLICK, map.sigma);
    const origin = `a quarter of the width of the line${is_followed ? "" : ", and the clicks, as those of the marks"}`;
    return { points: thinned(points), mark, point: Math.hypot(width / 4, is_followed ? 0 : mark), origin, width };
  }

  function of_markers(map, first, second, size) {
    if (!first.length || !second.length) {
      return { refused: "The uncertainty is known once you have read the points twice." };
    }
    const pairs = paired(first, second, size);
    if (pairs.length !== first.length || first.length !== second.length) {
      const counts = `${first.length} and ${second.length} points, of which ${pairs.length} are the same`;
      return { refused: `The readings have ${counts}. Remove, or read, those that one of them lacks.` };
    }
    const gaps = pairs.map(([a, b]) => maps.far(a, b));
    if (Math.max(...gaps) < 1e-6) return { refused: "Both readings are the same. Read the points again, on their own." };
    const clicks = Math.sqrt((1 + pairs.length * maps.rms(gaps) ** 2 / 2) / (4 + 2 * pairs.length));
    const mark = Math.max(map.sigma, clicks);
    const points = pairs.map(([a, b]) => [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2]);
    const values = 8 + map.freedom + 2 * pairs.length;
    return { points, mark, point: mark / Math.SQRT2, origin: "mean of two readings, and the marks", values };
  }

  // How much the distance of a point from a curve changes with x and with y, in sigmas.
  function direction({ x, y }, point, sigmas) {
    const scaled = (place) => place.map((one, i) => one / sigmas[i]);
    const chain = x.map((value, i) => scaled([value, y[i]]));
    const near = chain.slice(1).map((end, i) => trace.beside(scaled(point), [chain[i], end]));
    const i = near.indexOf(Math.min(...near));
    const [along, up] = [0, 1].map((k) => chain[i + 1][k] - chain[i][k]);
    const length = Math.hypot(along, up) || 1;
    return scaled([-up / length, along / length]);
  }

  // The error of a curve that the run would notice nine times of ten, as a share of its y; of its x, if the scale
  // of y is free. The points share the errors of the map, and of a draughtsman.
  function noticed(map, found, curve, allowance, is_free) {
    const points = found.points.map(map.to_axes);
    const sigmas = found.sigmas.map((one, i) => Math.hypot(one, allowance[i]));
    const directions = points.map((point) => direction(curve, point, sigmas));
    const shifts = points.map((point, k) => maps.times(maps.transposed(map.shifts(point)), directions[k]));
    const covariance = map.covariance(found.marks);
    const weights = maps.inverse(shifts.map((a, i) => shifts.map((b, k) =>
      Number(i === k) + maps.dot(a, maps.times(covariance, b)) + (found.width ? 1 : 0))));
    const [wider, larger] = [0, 1].map((i) => points.map((point, k) => directions[k][i] * point[i]));
    const product = (a, b) => maps.dot(a, maps.times(weights, b));
    const seen = is_free ? product(wider, wider) - product(wider, larger) ** 2 / product(larger, larger) : product(larger, larger);
    const degrees = points.length - (is_free ? 1 : 0);
    const { of_line: known, of_points: estimated } = DATA.noncentrality;
    const row = estimated[Math.min(degrees, estimated.length) - 1];
    const limit = found.width ? known[degrees - 1] : row?.[Math.min((found.values - 8) / 2 - degrees, row.length - 1)];
    return Math.sqrt((limit ?? Infinity) / seen);
  }

  // Why a file would be refused; empty if it would not be.
  function missing({ who, when, from, incidence, series }) {
    const empty = (text, least) => text.trim().length < least || PLACEHOLDER.test(text.trim());
    if (empty(who, 2)) return "Who read the points? Give a name.";
    if (!/^\d{4}-\d\d-\d\d$/.test(when) || new Date(when) > Date.now() + 864e5) return "When were they read? Give the day, not a later one than today.";
    if (empty(from, 3)) return "From what were they read? Say which figure, page and copy.";
    if (series.open.includes("incidence") && !/^\d*\.?\d+$/.test(incidence.trim())) {
      return "The paper does not state the incidence. Give that of the print: its velocity at time 0.";
    }
    return "";
  }

  // Why the run would refuse the points; empty if it would not.
  function unfit({ ranges, columns }, map, { points, marks, sigmas }) {
    for (const [i, axis] of ["x", "y"].entries()) {
      const [low, high] = ranges[i];
      const [sigma, most] = [Math.max(marks[i], sigmas[i]), DATA.refused.largest_sigma * (high - low)];
      if (sigma > most) {
        return `Sigma along ${axis} is ${round(sigma, 2)}; the run allows up to ${round(most, 2)}. Read at a larger size.`;
      }
      const out = points.map((place) => map.to_axes(place)[i])
        .find((value) => Math.max(low - value, value - high) > DATA.refused.sigmas_outside * sigmas[i]);
      if (out !== undefined) {
        return `${columns[i]} = ${round(out, 3)} is outside ${low} to ${high}. Are marks or columns exchanged, or a sign turned?`;
      }
    }
    return "";
  }

  // The file: who, when, from what and how; marks and sigmas, from which the run knows all errors; and the points.
  function csv({ who, when, from, incidence, series }, range, map, placed, found, how) {
    const pixels = placed.map((m) => `(${m.x}, ${m.y}) at ${m.u.toFixed(1)}, ${m.v.toFixed(1)}`).join("; ");
    const [mark_sigma_x, mark_sigma_y, sigma_x, sigma_y] = [...found.marks, ...found.sigmas].map((one) => round(one, 4));
    const head = {
      series: series.id, who, when, from,
      how: `${how}; ${placed.length} marks, residual ${map.residual.toFixed(2)} px; pixels of the marks: ${pixels}`,
      axes: range.map((ends) => ends.join(" to ")).join("; "), marks: placed.map(({ x, y }) => `${x} ${y}`).join("; "),
      mark_sigma_x, mark_sigma_y, tilt: map.tilt, sigma_x, sigma_y, sigma_origin: found.origin,
      ...(found.values ? { sigma_values: found.values } : { line_width: round(found.width, 3) }),
      ...(series.open.includes("incidence") ? { incidence } : {}),
    };
    const notes = Object.entries(head).map(([name, value]) => `# ${name}: ${`${value}`.trim().replace(/\s+/g, " ")}`);
    const rows = found.points.map((place) => map.to_axes(place).map((value) => round(value, 6))).sort((a, b) => a[0] - b[0]);
    return [...notes, ...[series.columns, ...rows].map((row) => row.join(","))].join("\n") + "\n";
  }

  return { judged, noticed, missing, unfit, csv, unit_of, round };
})();
