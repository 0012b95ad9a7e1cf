"use strict";

// Follow a dark line in a picture, from one click to the next, and give points in the middle of it.
const trace = (() => {
  const STEP = 2; // pixels
  const MOST_GAP = 14; // steps without ink, as between dashes
  const COUNT = 60; // points, at most

  // How dark each pixel is, 0 to 1, with the brightness of the paper as 0.
  function darkness(picture) {
    const canvas = document.createElement("canvas");
    const [width, height] = [picture.naturalWidth, picture.naturalHeight];
    Object.assign(canvas, { width, height });
    const pen = canvas.getContext("2d", { willReadFrequently: true });
    pen.drawImage(picture, 0, 0);
    const { data } = pen.getImageData(0, 0, width, height);
    const grey = new Float32Array(width * height);
    for (let i = 0; i < grey.length; i++) grey[i] = (data[4 * i] + data[4 * i + 1] + data[4 * i + 2]) / 765;
    const sorted = grey.filter((_, i) => i % 97 === 0).sort();
    const [ink, paper] = [sorted[0], sorted[Math.floor(0.8 * sorted.length)]];
    const dark = grey.map((one) => Math.min(1, Math.max(0, (paper - one) / (paper - ink || 1))));
    // Between the middles of pixels, which lie at halves.
    return ([u, v]) => {
      const [x, y] = [Math.min(width - 1.001, Math.max(0, u - 0.5)), Math.min(height - 1.001, Math.max(0, v - 0.5))];
      const [i, k] = [Math.floor(x), Math.floor(y)];
      const [p, q] = [x - i, y - k];
      const at = (a, b) => dark[(k + b) * width + i + a];
      return (1 - q) * ((1 - p) * at(0, 0) + p * at(1, 0)) + q * ((1 - p) * at(0, 1) + p * at(1, 1));
    };
  }

  // The middle of the ink across a direction, as a distance from a point, and its width; null without ink.
  function across(dark, [u, v], [du, dv], reach) {
    const profile = [];
    for (let s = -reach; s <= reach; s += 0.5) profile.push([s, dark([u - s * dv, v + s * du])]);
    const inked = profile.map(([s, ink], i) => (ink > 0.4 ? i : -1)).filter((i) => i >= 0);
    if (!inked.length) return null;
    let first = inked.reduce((best, i) => (Math.abs(profile[i][0]) < Math.abs(profile[best][0]) ? i : best));
    let last = first;
    while (first > 0 && profile[first - 1][1] > 0.2) first--;
    while (last < profile.length - 1 && profile[last + 1][1] > 0.2) last++;
    const part = profile.slice(first, last + 1);
    const ink = part.reduce((sum, [, one]) => sum + one, 0);
    return { off: part.reduce((sum, [s, one]) => sum + s * one, 0) / ink, width: ink / 2 };
  }

  const unit = ([a, b]) => [a / (Math.hypot(a, b) || 1), b / (Math.hypot(a, b) || 1)];

  // Points along a line through all clicks, in pixels, and its width. {lost} says where it ended too early.
  function follow(dark, clicks, reach = 6) {
    const [points, widths] = [[], []];
    for (let i = 0; i + 1 < clicks.length; i++) {
      let [here, goal, gap] = [clicks[i], clicks[i + 1], 0];
      let way = unit([goal[0] - here[0], goal[1] - here[1]]);
      let left = 4 * Math.hypot(goal[0] - here[0], goal[1] - here[1]) / STEP;
      while (left-- > 0) {
        const found = across(dark, here, way, reach);
        // Where lines cross the ink is wide, and its middle is not that of the line.
        const crossed = found && widths.length > 4 && found.width > 1.6 * median(widths);
        if (found && !crossed) {
          here = [here[0] - found.off * way[1], here[1] + found.off * way[0]];
          if (points.length) {
            const [du, dv] = unit([here[0] - points.at(-1)[0], here[1] - points.at(-1)[1]]);
            way = unit([0.75 * way[0] + 0.25 * du, 0.75 * way[1] + 0.25 * dv]);
          }
          points.push(here);
          widths.push(found.width);
        }
        gap = found ? 0 : gap + 1;
        if (gap > MOST_GAP) return { points, lost: here };
        const rest = [goal[0] - here[0], goal[1] - here[1]];
        const passed = rest[0] * way[0] + rest[1] * way[1] < 0;
        if (Math.hypot(...rest) < 1.5 * STEP || (Math.hypot(...rest) < 2 * reach && passed)) break;
        here = [here[0] + STEP * way[0], here[1] + STEP * way[1]];
      }
      // Another line leads past the click.
      if (left <= 0 || Math.hypot(goal[0] - here[0], goal[1] - here[1]) > reach) return { points, lost: here };
    }
    if (!points.length) return { points, lost: clicks[0] };
    const every = Math.max(1, Math.ceil(points.length / COUNT));
    return { points: points.filter((_, i) => i % every === 0), width: median(widths) };
  }

  const median = (list) => [...list].sort((a, b) => a - b)[Math.floor(list.length / 2)];

  // Distance of a point from a chain of points, in pixels.
  function beside(point, chain) {
    let least = Infinity;
    for (let i = 0; i + 1 < chain.length; i++) {
      const [[a, b], [c, d]] = [chain[i], chain[i + 1]];
      const squared = (c - a) ** 2 + (d - b) ** 2 || 1;
      const share = Math.min(1, Math.max(0, ((point[0] - a) * (c - a) + (point[1] - b) * (d - b)) / squared));
      least = Math.min(least, Math.hypot(point[0] - a - share * (c - a), point[1] - b - share * (d - b)));
    }
    return least;
  }

  return { darkness, follow, beside };
})();
