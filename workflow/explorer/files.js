"use strict";

// What a reader takes along: the numbers as CSV, a picture as PNG, the address of the page.
const files = (() => {
  const element = (id) => document.getElementById(id);
  const PIXELS = 2; // of a picture, for one of the page
  const MARGIN = 16;
  const LINE = 24;

  // A field with a comma or a quotation mark needs quotation marks round it.
  const field = (value) => (/[",]/.test(value) ? `"${value.replaceAll('"', '""')}"` : `${value}`);

  // The impact and what both contacts say about it, as comments; then the curves of the chart.
  function csv(impact, state, { xs, curves, quantity }) {
    const given = [
      ["angle of incidence theta [deg]", state.angle],
      ["friction coefficient mu [1]", impact.mu],
      ["restitution e [1]", impact.e],
      ["Poisson's ratio nu [1]", state.poisson_ratio],
      ["mass ratio m2/m1 [1]", impact.beta],
      ["stiffness ratio zeta^2 [1]", impact.zeta2],
      ["incidence v1(0)/(mu v2(0)) [1]", impact.x],
      ["tangential compliance over that of the body [1]", state.compliance],
      ["speed [m/s]", state.speed],
      ["spin, clockwise [rad/s]", state.spin],
      ["radius [mm]", state.radius],
    ];
    const said = curves.flatMap(({ style }) => {
      const { velocity, peak_friction, dissipation } = models.state(style, impact);
      return [
        ["v1(tf)/(mu v2(0)) [1]", velocity],
        ["largest F1/(mu largest F2) [1]", peak_friction],
        ["work of friction/(mu^2 m2 v2(0)^2) [1]", dissipation],
      ].map(([unit, value]) => [`${models.NAMES[style]}: ${unit}`, value]);
    });
    const head = ["incidence v1(0)/(mu v2(0)) [1]", "angle of incidence theta [deg]"];
    head.push(...curves.map(({ style }) => `${models.NAMES[style]}: ${quantity}`));
    const rows = xs.map((x, i) => [
      x, (Math.atan(impact.mu * x) * 180) / Math.PI, ...curves.map(({ ys }) => ys[i]),
    ]);
    const notes = [...given, ...said].map(([name, value]) => `# ${name} = ${value}`);
    return [...notes, ...[head, ...rows].map((row) => row.map(field).join(","))].join("\n") + "\n";
  }

  // The text of an element in one line, with indices as signs of Unicode where there are such.
  function plain(part) {
    const copy = part.cloneNode(true);
    for (const sub of copy.querySelectorAll("sub")) {
      sub.textContent = { 1: "\u2081", 2: "\u2082" }[sub.textContent] ?? `_${sub.textContent}`;
    }
    return copy.textContent.replace(/\s+/g, " ").trim();
  }

  // A copy of a drawing that needs no style sheet, without what only invites to act.
  function standalone(svg, width, height) {
    const copy = svg.cloneNode(true);
    const [from, to] = [svg, copy].map((one) => [one, ...one.querySelectorAll("*")]);
    const KEPT = [
      "fill", "fill-opacity", "stroke", "stroke-width", "stroke-dasharray", "stroke-linecap",
      "stroke-linejoin", "opacity", "display", "visibility", "font-family", "font-size", "font-style",
      "font-weight", "text-anchor", "paint-order",
    ];
    from.forEach((one, i) => {
      const style = getComputedStyle(one);
      for (const name of KEPT) to[i].style.setProperty(name, style.getPropertyValue(name));
    });
    for (const part of copy.querySelectorAll(".invitation")) part.remove();
    copy.setAttribute("width", width);
    copy.setAttribute("height", height);
    return new XMLSerializer().serializeToString(copy);
  }

  // A drawing with lines of text above and below, on a canvas. A line may begin with a swatch: then
  // it is [style of its curve, text].
  async function picture(svg, above, below) {
    const { width, height } = svg.getBoundingClientRect();
    const image = new Image();
    image.src = `data:image/svg+xml,${encodeURIComponent(standalone(svg, width, height))}`;
    await image.decode();
    const canvas = document.createElement("canvas");
    canvas.width = PIXELS * (width + 2 * MARGIN);
    const { color, backgroundColor, fontFamily } = getComputedStyle(document.body);
    const pen = canvas.getContext("2d");
    const font = (size) => `${size}px ${fontFamily}`;
    const wrapped = (text) => {
      pen.font = font(15);
      return text.split(" ").reduce((lines, word) => {
        const longer = `${lines.at(-1)} ${word}`.trim();
        if (pen.measureText(longer).width <= width) return [...lines.slice(0, -1), longer];
        return [...lines, word];
      }, [""]);
    };
    const top = above.flatMap(wrapped);
    const foot = below.flatMap((line) => (typeof line === "string" ? wrapped(line) : [line]));
    canvas.height = PIXELS * (height + LINE * (top.length + foot.length) + 3 * MARGIN);
    pen.scale(PIXELS, PIXELS);
    pen.fillStyle = backgroundColor;
    pen.fillRect(0, 0, canvas.width, canvas.height);
    let y = MARGIN;
    const write = (text, x = MARGIN) => {
      pen.fillStyle = color;
      pen.font = font(15);
      pen.fillText(text, x, (y += LINE) - 6);
    };
    top.forEach((text) => write(text));
    pen.drawImage(image, MARGIN, y, width, height);
    y += height + MARGIN / 2;
    for (const line of foot) {
      if (typeof line === "string") {
        write(line);
        continue;
      }
      const [curve, text] = line;
      const { stroke, strokeWidth, strokeDasharray } = getComputedStyle(curve);
      pen.strokeStyle = stroke;
      pen.lineWidth = parseFloat(strokeWidth);
      pen.setLineDash(strokeDasharray === "none" ? [] : strokeDasharray.split(",").map(parseFloat));
      pen.beginPath();
      pen.moveTo(MARGIN, y + LINE - 11);
      pen.lineTo(MARGIN + 34, y + LINE - 11);
      pen.stroke();
      write(text, MARGIN + 42);
    }
    return new Promise((done) => canvas.toBlob(done, "image/png"));
  }

  function save(name, blob) {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(blob);
    link.download = name;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  }

  // True if the text is on the clipboard.
  const copy = (text) => navigator.clipboard?.writeText(text).then(() => true, () => false);

  return { csv, picture, plain, save, copy };
})();
