"use strict";

// Points of a print that were read: how uncertain they are, which error of a curve they would show, and the file
// for the run. Places are in pixels.
const readings = (() => {
  const SAME_POINT = 0.03; // share of the picture in which two readings of one point lie
  const SAME_CLICK = 0.05; // px
  const MOST_OF_LINE = 15; // points: between nearer ones a draughtsman's errors are alike
  const BEYOND_ENDS = 10; // scales by which a curve is continued, as by the run
  const STEPS = 10; // in which a free scale is fitted
  // What the run refuses, too. Letters are those of all alphabets, as in Python.
  const PLACEHOLDER = new RegExp(`^(?:${DATA.refused.placeholder.replace("\\W", "[^\\p{L}\\p{N}_]")})$`, "iu");
  const round = (value, digits) => Number(value.toPrecision(digits));

  // Points of two readings that are the same, nearest first.
  function paired(first, second, size) {
    const near = first.flatMap((a) => second.map((b) => ({ a, b, far: maps.far(a, b) })))
      .filter(({ far }) => far < SAME_POINT * size).sort((one, other) => one.far - other.far);
    const found = [];
    for (const { a, b } of near) {
      if (!found.flat().some((one) => one === a || one === b)) found.push([a, b]);
    }
    return found;
  }

  // The points to save, with one standard deviation of a mark and of a point in units of both axes; or {refused}.
  function judged(map, { readings: [first, second], width, by }, is_line, size) {
    if (map.refused) return map;
    const is_twice = (one, i, all) => all.slice(0, i).some((other) => maps.far(one, other) < SAME_CLICK);
    if ([first, second].some((places) => places.some(is_twice))) {
      return { refused: "A point stands twice in one reading. Remove it there." };
    }
    const is_followed = by.startsWith("followed");
    const found = is_line ? of_line(map, first, width, is_followed) : of_markers(map, first, second, size);
    if (found.refused) return found;
    const scales = found.points.map(map.scale);
    const pixel = [0, 1].map((i) => maps.rms(scales.map((scale) => scale[i])));
    return { ...found, marks: pixel.map((one) => one * found.mark), sigmas: pixel.map((one) => one * found.point) };
  }

  function of_line(map, all, width, is_followed) {
    if (all.length < 2) return { refused: "Read two points of the line, or more." };
    if (!(width > 0)) return { refused: "How wide is the line? Its width is not known unless it is followed." };
    // A line is read once: without a spare mark nothing tells how well one clicks.
    const mark = map.freedom ? Math.max(maps.CLICK, map.sigma) : 2 * maps.CLICK;
    const origin = `a quarter of the width of the line${is_followed ? "" : ", and the clicks, as those of the marks"}`;
    const count = Math.min(all.length, MOST_OF_LINE);
    const points = Array.from({ length: count }, (_, i) => all[Math.round(i * (all.length - 1) / (count - 1))]);
    return { points, mark, point: Math.hypot(width / 4, is_followed ? 0 : mark), origin, width };
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
    if (Math.max(...gaps) < 1e-6) return { refused: "Both readings are the same. Read the points anew." };
    const clicks = Math.sqrt((1 + maps.dot(gaps, gaps) / 2) / (4 + 2 * pairs.length));
    const mark = Math.max(map.sigma, clicks);
    const points = pairs.map(([a, b]) => [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2]);
    const values = 4 + map.freedom + 2 * pairs.length; // the prior counts once, though both use it
    return { points, mark, point: mark / Math.SQRT2, origin: "mean of two readings, and the marks", values };
  }

  // What the run takes for the distance of a point from a curve, if both axes have these scales: how far the nearest
  // place of the curve is, `size` with a sign, this place, and how much that changes with x and with y of the point.
  function nearest({ x, y }, point, scales) {
    const scaled = (place) => place.map((one, i) => one / scales[i]);
    const from = (a, b) => [b[0] - a[0], b[1] - a[1]];
    const at = scaled(point);
    const chain = x.map((one, i) => scaled([one, y[i]])).filter((one, i, all) => !i || maps.far(one, all[i - 1]) > 0);
    const last = chain.length - 2;
    const all = chain.slice(1).map((end, i) => {
      const [step, length] = [from(chain[i], end), maps.far(chain[i], end)];
      const [low, high] = [i ? 0 : -BEYOND_ENDS / length, i < last ? 1 : 1 + BEYOND_ENDS / length];
      const share = Math.min(high, Math.max(low, maps.dot(from(chain[i], at), step) / length ** 2));
      const place = chain[i].map((one, k) => one + share * step[k]);
      return { far: maps.far(at, place), place, across: [-step[1] / length, step[0] / length] };
    });
    const { far, place, across } = all.reduce((best, one) => (one.far < best.far ? one : best));
    const gap = from(place, at);
    const size = far * (Math.sign(maps.dot(gap, across)) || 1);
    const direction = scaled(far > 1e-9 ? gap.map((one) => one / size) : across);
    return { far, size, place: place.map((one, i) => one * scales[i]), direction };
  }

  // The error of a curve that the run would notice nine times of ten, as a share of its y; of its x, if the scale
  // of y is free: then the curve has the scale that fits best, by the steps of `judging/scales.py`. The points share
  // the errors of the map, and of a draughtsman.
  function noticed(map, found, curve, allowance, is_free) {
    let at = seen_at(map, found, curve, allowance);
    for (let [step, factor] = [0, 1]; is_free && step < STEPS; step += 1) {
      factor *= 1 + at.product(at.larger, at.far) / at.product(at.larger, at.larger);
      at = seen_at(map, found, { x: curve.x, y: curve.y.map((one) => factor * one) }, allowance);
    }
    const { product, wider, larger } = at;
    const whole = product(larger, larger);
    const seen = is_free ? product(wider, wider) - product(wider, larger) ** 2 / whole : whole;
    const degrees = found.points.length - (is_free ? 1 : 0);
    const { of_line: known, of_points: estimated } = DATA.noncentrality;
    const row = estimated[Math.min(degrees, estimated.length) - 1];
    const limit = found.width ? known[degrees - 1]
      : row?.[Math.min((found.values - 4) / 2 - degrees, row.length - 1)];
    return Math.sqrt((limit ?? Infinity) / seen);
  }

  // How far points are from a curve, how much that changes with its width and size, and the product by S^-1 of the run.
  function seen_at(map, found, curve, allowance) {
    const sigmas = found.sigmas.map((one, i) => Math.hypot(one, allowance[i]));
    const near = found.points.map((point) => nearest(curve, map.to_axes(point), sigmas));
    const shifts = near.map(({ place, direction }) => maps.times(maps.transposed(map.shifts(place)), direction));
    const covariance = map.covariance(found.marks);
    const weights = maps.inverse(shifts.map((a, i) => shifts.map((b, k) =>
      Number(i === k) + maps.dot(a, maps.times(covariance, b)) + (found.width ? 1 : 0))));
    const [wider, larger] = [0, 1].map((i) => near.map(({ place, direction }) => place[i] * direction[i]));
    const product = (a, b) => maps.dot(a, maps.times(weights, b));
    return { far: near.map(({ size }) => size), wider, larger, product };
  }

  // Why a file would be refused; empty if it would not be.
  function missing({ who, when, from, incidence, series }) {
    const empty = (text, least) => text.trim().length < least || PLACEHOLDER.test(text.trim());
    const no_day = !/^\d{4}-\d\d-\d\d$/.test(when) || new Date(when) > Date.now() + 864e5;
    if (empty(who, 2)) return "Who read the points? Give a name.";
    if (no_day) return "When were they read? Give the day, not a later one than today.";
    if (empty(from, 3)) return "From what were they read? Say which figure, page and copy.";
    if (series.open.includes("incidence") && !/^\d*\.?\d+$/.test(incidence.trim())) {
      return "The paper does not state the incidence. Give that of the print: its velocity at time 0.";
    }
    return "";
  }

  // Why the run would refuse the points; empty if it would not.
  function unfit({ ranges, columns }, map, { points, marks, sigmas }) {
    for (const [i, [low, high]] of ranges.entries()) {
      const [sigma, most] = [Math.max(marks[i], sigmas[i]), DATA.refused.largest_sigma * (high - low)];
      if (sigma > most) {
        const sizes = `${round(sigma, 2)}; the run allows up to ${round(most, 2)}`;
        return `Sigma along ${"xy"[i]} is ${sizes}. Read at a larger size.`;
      }
      const out = points.map((place) => map.to_axes(place)[i])
        .find((value) => Math.max(low - value, value - high) > DATA.refused.slack * (high - low));
      if (out !== undefined) {
        const where = `${columns[i]} = ${round(out, 3)} is outside ${low} to ${high}`;
        return `${where}. Are marks or columns exchanged, or a sign turned?`;
      }
    }
    return "";
  }

  // The file: who, when, from what and how; marks and sigmas, from which the run knows all errors; and the points.
  function csv({ who, when, from, incidence, series }, range, map, placed, found, how) {
    const pixels = placed.map((m) => `(${m.x}, ${m.y}) at ${m.u.toFixed(1)}, ${m.v.toFixed(1)}`).join("; ");
    const sigmas = [...found.marks, ...found.sigmas].map((one) => round(one, 4));
    const [mark_sigma_x, mark_sigma_y, sigma_x, sigma_y] = sigmas;
    const head = {
      series: series.id, who, when, from,
      how: `${how}; ${placed.length} marks, residual ${map.residual.toFixed(2)} px; pixels of the marks: ${pixels}`,
      axes: range.map((ends) => ends.join(" to ")).join("; "), marks: placed.map(({ x, y }) => `${x} ${y}`).join("; "),
      mark_sigma_x, mark_sigma_y, tilt: map.tilt, sigma_x, sigma_y, sigma_origin: found.origin,
      ...(found.values ? { sigma_values: found.values } : { line_width: round(found.width, 3) }),
      ...(series.open.includes("incidence") ? { incidence } : {}),
    };
    const notes = Object.entries(head).map(([name, value]) => `# ${name}: ${`${value}`.trim().replace(/\s+/g, " ")}`);
    const points = found.points.map((place) => map.to_axes(place).map((value) => round(value, 6)));
    const rows = [series.columns, ...points.sort((a, b) => a[0] - b[0])];
    return [...notes, ...rows.map((row) => row.join(","))].join("\n") + "\n";
  }

  return { judged, nearest, noticed, missing, unfit, csv, round };
})();
