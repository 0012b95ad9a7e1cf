"use strict";

// Two readings of the same points: how uncertain they are, and the file for the run. Places are in pixels.
const readings = (() => {
  const SAME_POINT = 0.03; // share of the picture in which two readings of one point lie
  // What the run refuses, too. Letters are those of all alphabets, as in Python.
  const PLACEHOLDER = new RegExp(`^(?:${DATA.refused.placeholder.replace("\\W", "[^\\p{L}\\p{N}_]")})$`, "iu");
  const round = (value, digits) => Number(value.toPrecision(digits));
  const unit_of = (column) => column.match(/\[(.*)\]/)[1].replace(/^1$/, "");

  // Points of two readings that are the same, nearest first.
  function paired(first, second, size) {
    const near = first.flatMap((a, i) => second.map((b, k) => ({ i, k, far: Math.hypot(a[0] - b[0], a[1] - b[1]) })))
      .filter(({ far }) => far < SAME_POINT * size).sort((a, b) => a.far - b.far);
    const found = [];
    for (const one of near) {
      if (!found.some(({ i, k }) => i === one.i || k === one.k)) found.push(one);
    }
    return found.map(({ i, k }) => [first[i], second[k]]);
  }

  // Both sigmas in units of the axes, by two readings, the marks, and for a line half its width; or {refused}.
  function sigmas(map, [first, second], widths, size, is_line) {
    if (map.refused) return map;
    if (!first.length || !second.length) {
      return { refused: "The uncertainty is known once you have read the points twice." };
    }
    const half = Math.max(...widths) / 2;
    const line = half > 0 || is_line;
    if (line && Math.min(first.length, second.length) < 2) {
      return { refused: "A line needs two points in each reading, or more." };
    }
    const pairs = line ? [] : paired(first, second, size);
    if (!line && (pairs.length !== first.length || first.length !== second.length)) {
      const counts = `${first.length} and ${second.length} points, of which ${pairs.length} are the same`;
      return { refused: `The readings have ${counts}. Remove, or read, those that one of them lacks.` };
    }
    const scales = first.map(map.scale);
    const beside = maps.rms(second.map((place) => trace.beside(place, first)));
    if (`${first}` === `${second}`) return { refused: "Both readings are the same. Read the points again, on their own." };
    const of_marks = maps.rms(first.map(map.sigma));
    const [x, y] = [0, 1].map((i) => {
      const pixel = maps.rms(scales.map((scale) => scale[i]));
      const twice = line ? pixel * beside : maps.rms(pairs.map(([a, b]) => map.to_axes(a)[i] - map.to_axes(b)[i]));
      return Math.hypot(twice / Math.SQRT2, pixel * of_marks, pixel * half);
    });
    const origin = "two readings, root mean square of their difference over the square root of 2" +
      `${half ? "; half the width of the line" : ""}${of_marks ? "; residual of the marks" : ""}`;
    return { x, y, origin, ...(line ? {} : { values: pairs.length }) };
  }

  // Why a file would be refused; empty if it would not be.
  function missing({ who, when, from, incidence, series }) {
    const empty = (text) => text.trim().length < 3 || PLACEHOLDER.test(text.trim());
    if (empty(who)) return "Who read the points? Give a name.";
    if (!/^\d{4}-\d\d-\d\d$/.test(when) || new Date(when) > Date.now() + 864e5) return "When were they read? Give the day, not a later one than today.";
    if (empty(from)) return "From what were they read? Say which figure, page and copy.";
    if (series.open.includes("incidence") && !/^\d*\.?\d+$/.test(incidence.trim())) {
      return "The paper does not state the incidence. Give that of the print: its velocity at time 0.";
    }
    return "";
  }

  // Why the run would refuse the points; empty if it would not.
  function unfit({ ranges, columns }, map, found, places) {
    for (const [i, axis] of ["x", "y"].entries()) {
      const [low, high] = ranges[i];
      const most = DATA.refused.largest_sigma * (high - low);
      if (found[axis] > most) {
        return `Sigma along ${axis} is ${round(found[axis], 2)}; the run allows up to ${round(most, 2)}. Read at a larger size.`;
      }
      const out = places.map((place) => map.to_axes(place)[i])
        .find((value) => Math.max(low - value, value - high) > DATA.refused.sigmas_outside * found[axis]);
      if (out !== undefined) {
        return `${columns[i]} = ${round(out, 3)} is outside ${low} to ${high}. Are marks or columns exchanged, or a sign turned?`;
      }
    }
    return "";
  }

  // The file: who, when, from what and how, both sigmas, and the points of the first reading.
  function csv({ who, when, from, incidence, series }, map, marks, { x, y, origin, values }, places, how) {
    const [along_x, along_y] = ["x", "y"].map((axis, i) =>
      `${round(map.residual[axis], 2)} ${unit_of(series.columns[i])} along ${axis}`);
    const stated = marks.map((m) => `(${m.x}, ${m.y}) at ${m.u.toFixed(1)}, ${m.v.toFixed(1)}`).join("; ");
    const residual = `residual ${map.residual.pixels.toFixed(2)} px: ${along_x}, ${along_y}`;
    const head = {
      series: series.id, who, when, from,
      how: `${how}; ${marks.length} marks, ${map.kind} map, ${residual}; pixels of the marks: ${stated}`,
      sigma_x: round(x, 3), sigma_y: round(y, 3), sigma_origin: origin,
      ...(values ? { sigma_values: values } : {}), ...(series.open.includes("incidence") ? { incidence } : {}),
    };
    const notes = Object.entries(head).map(([name, value]) => `# ${name}: ${`${value}`.trim().replace(/\s+/g, " ")}`);
    const rows = places.map((place) => map.to_axes(place).map((value) => round(value, 6))).sort((a, b) => a[0] - b[0]);
    return [...notes, ...[series.columns, ...rows].map((row) => row.join(","))].join("\n") + "\n";
  }

  return { sigmas, missing, unfit, csv, unit_of };
})();
