"use strict";

// The chart over all incidences as SVG markup, written anew at every change. It is as wide as it stands
// on the screen, so that type keeps its size on a phone.
const charts = (() => {
  const tall = (width) => Math.min(262, Math.max(190, 0.56 * width));
  const MARGIN = { right: 10, top: 20, bottom: 20 };
  const LETTER = 7.6; // width of one, at most
  const CURVE = 100; // vertices

  const number = (value, digits = 2) =>
    Number(value.toFixed(digits)).toString().replace("-", "\u2212");

  function ticks(low, high, count) {
    const raw = (high - low) / count;
    const decade = 10 ** Math.floor(Math.log10(raw));
    const step = decade * [1, 2, 5, 10].find((nice) => nice * decade >= raw * 0.999);
    const first = Math.ceil(low / step - 1e-9);
    const last = Math.floor(high / step + 1e-9);
    return Array.from({ length: last - first + 1 }, (_, i) => (first + i) * step);
  }

  // Scales, frame and ticks over the ranges x and y.
  function axes(svg, width, x, y, x_ticks = ticks(...x, width / 80)) {
    const height = tall(width);
    const y_ticks = ticks(...y, 5);
    const left = Math.max(42, 10 + LETTER * Math.max(...y_ticks.map((one) => number(one).length)));
    const right = width - MARGIN.right;
    const bottom = height - MARGIN.bottom;
    const X = (value) => left + ((value - x[0]) / (x[1] - x[0])) * (right - left);
    const Y = (value) => bottom - ((value - y[0]) / (y[1] - y[0])) * (bottom - MARGIN.top);
    const rows = y_ticks.map(
      (value) => `<line class="grid" x1="${left}" x2="${right}" y1="${Y(value)}"
        y2="${Y(value)}"/><text class="tick" text-anchor="end" x="${left - 6}"
        y="${Y(value) + 4}">${number(value)}</text>`,
    );
    const columns = x_ticks.map(
      (value) => `<line class="axis" x1="${X(value)}" x2="${X(value)}" y1="${bottom}"
        y2="${bottom - 4}"/><text class="tick" text-anchor="middle" x="${X(value)}"
        y="${bottom + 15}">${number(value)}</text>`,
    );
    const zero = Y(Math.min(Math.max(0, y[0]), y[1]));
    const frame = `<path class="axis" d="M${left},${MARGIN.top}V${bottom}H${right}"/>
      <line class="axis" x1="${left}" x2="${right}" y1="${zero}" y2="${zero}"/>`;
    svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    return { X, Y, bottom, markup: rows.join("") + columns.join("") + frame };
  }

  function line(style, xs, ys, { X, Y }) {
    const points = Array.from(xs, (x, i) => `${X(x).toFixed(1)},${Y(ys[i]).toFixed(1)}`);
    return `<polyline class="${style}" points="${points.join(" ")}"/>`;
  }

  // A stretch of the axis with the first of its words that fits above.
  function band(style, start, end, words, { X, bottom }) {
    const [left, width] = [X(start), X(end) - X(start)];
    const height = bottom - MARGIN.top;
    const word = words.find((one) => width > LETTER * one.length) ?? "";
    return `<rect class="band ${style}" x="${left}" width="${width}" y="${MARGIN.top}"
      height="${height}"/><rect class="head ${style}" x="${left}" width="${width}" y="2"
      height="16"/><text class="word" x="${left + width / 2}" y="14">${word}</text>`;
  }

  const guide = (place, { X, bottom }) =>
    `<line class="guide" x1="${X(place)}" x2="${X(place)}" y1="${MARGIN.top}" y2="${bottom}"/>`;

  // What can be drawn against incidence: its name, the value for what a model found, and what is
  // drawn beside it. Over angles the unit is the speed S before the impact.
  const VIEWS = {
    velocity: {
      over_angle: false,
      quantity: "v1(tf)/(mu v2(0)) [1]",
      value: (found) => found.velocity,
    },
    forces: {
      over_angle: true,
      quantity: "largest F1 / largest F2 x cos(theta) [1]",
      value: (found, mu, cosine) => mu * cosine * found.peak_friction,
      beside: (cosine) => cosine,
    },
    energy: {
      over_angle: true,
      quantity: "work of friction / (m2 S^2/2) [1]",
      value: (found, mu, cosine) => 2 * (mu * cosine) ** 2 * found.dissipation,
    },
  };

  const REGIMES = [
    ["stick", "sticks first", "sticks"],
    ["mixed", "slips first", "slips"],
    ["slip", "slips throughout", "throughout"],
  ];

  // Largest incidence of the chart for this impact.
  const widest = ({ limit, x }) => Math.max(8, 1.25 * limit, 1.08 * x);

  // The curves of both contacts over all incidences up to `far`, thresholds among their vertices, with
  // the present impact on each. The one with the spring lies on top, and the bands are its regimes.
  function incidence(svg, width, impact, view, far = widest(impact)) {
    const { mu, x, beta, zeta2, e, limit } = impact;
    const { over_angle, quantity, value, beside } = VIEWS[view];
    const to_angle = (incidence) => (Math.atan(mu * incidence) * 180) / Math.PI;
    const place = (incidence) => (over_angle ? to_angle(incidence) : incidence);
    const range = over_angle ? [0, 90] : [0, far];
    const x_ticks = over_angle ? [0, 30, 60, 90] : undefined;
    const even = Array.from({ length: CURVE }, (_, i) => i / (CURVE - 1));
    const xs = over_angle
      ? even.map((share) => Math.tan((share * 89.95 * Math.PI) / 180) / mu)
      : even.map((share) => share * far);
    const limits = [zeta2, beta, limit, (1 + e) * beta];
    xs.push(...limits.filter((threshold) => threshold > 0 && place(threshold) < range[1]));
    xs.sort((a, b) => a - b);
    const cosine = (incidence) => 1 / Math.hypot(1, mu * incidence);
    const curves = ["lumped", "rigid"].map((style) => {
      const measure = (one) => value(models.state(style, { ...impact, x: one }), mu, cosine(one));
      return { style, ys: xs.map(measure), present: measure(x) };
    });
    const beyond = beside ? xs.map((one) => beside(cosine(one))) : [];
    const every = [...curves.flatMap(({ ys, present }) => [...ys, present]), ...beyond];
    const [low, high] = [Math.min(0, ...every), Math.max(0.1, ...every)];
    const room = 0.06 * (high - low);
    const y = [low < 0 ? low - room : 0, high + room];
    const scales = axes(svg, width, range, y, x_ticks);
    const places = xs.map(place);
    const edges = [0, zeta2, limit, Infinity].map((edge) => Math.min(place(edge), range[1]));
    const bands = REGIMES.map(([style, ...words], i) =>
      edges[i + 1] > edges[i] ? band(style, edges[i], edges[i + 1], words, scales) : "");
    const here = Math.min(place(x), range[1]);
    const drawn = [...curves].reverse();
    svg.innerHTML =
      bands.join("") + scales.markup + guide(here, scales) +
      (beside ? line("normal", places, beyond, scales) : "") +
      drawn.map(({ style, ys }) => line(`curve ${style}`, places, ys, scales)).join("") +
      drawn.map(({ style, present }) => `<circle class="present ${style}" cx="${scales.X(here)}"
        cy="${scales.Y(present)}" r="${style === "lumped" ? 6 : 4}"/>`).join("");
    return { quantity, xs, curves };
  }

  return { incidence, number };
})();
