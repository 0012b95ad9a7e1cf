"use strict";

// Follow a line in a picture through clicks, and give points in the middle of it. Places are in pixels.
const trace = (() => {
  const COUNT = 15; // points at most: as many as the judge may take as independent
  const FAINTEST = 20; // of 255: the least difference in colour between a line and its paper
  const [INKED, EDGE] = [0.4, 0.2]; // shares of this difference: what is ink, and where a line ends

  const median = (list) => list.toSorted((a, b) => a - b)[Math.floor(list.length / 2)];
  const distance = ([a, b], [c, d]) => Math.hypot(c - a, d - b);
  const direction = (from, to) => [0, 1].map((i) => (to[i] - from[i]) / (distance(from, to) || 1));
  const smallest = (list, size) => list.reduce((best, one) => (size(one) < size(best) ? one : best), list[0]);

  // The ink nearest to a place, across a direction: how far its middle is off, its width, its level (by how much its
  // colour differs from that of the paper), and whether it is alone. Null without ink of nearly this level.
  function across(colour, [u, v], [du, dv], half, level) {
    const offs = Array.from({ length: 4 * half + 1 }, (_, i) => i / 2 - half);
    const seen = offs.map((off) => colour([u - off * dv, v + off * du]));
    const paper = [0, 1, 2].map((n) => median(seen.map((one) => one[n]))); // most of what is seen
    const ink = seen.map((one) => Math.max(...paper.map((value, n) => Math.abs(one[n] - value))));
    const inked = [...ink.keys()].filter((i) => ink[i] > INKED * level);
    let first = smallest(inked, (i) => Math.abs(offs[i]));
    if (!(Math.abs(offs[first]) < 0.8 * half)) return null;
    let last = first;
    while (ink[first - 1] > EDGE * level) first--;
    while (ink[last + 1] > EDGE * level) last++;
    const part = ink.slice(first, last + 1);
    const [sum, most] = [part.reduce((a, b) => a + b), Math.max(...part)];
    const off = part.reduce((all, one, i) => all + one * offs[first + i], 0) / sum;
    return { off, width: sum / most / 2, level: most, alone: inked.every((i) => i >= first && i <= last) };
  }

  // The line at a click, where its width and level are not known yet.
  const at_click = (colour, click, way) => [12, 24, 48].map((half) => {
    const some = across(colour, click, way, half, FAINTEST / INKED);
    return some && across(colour, click, way, half, some.level);
  }).find((found, i) => found?.width < 7 * 2 ** i && Math.abs(found.off) < 6 * 2 ** i);

  // {points, width, length, left_out} of the line through all clicks: its length, and how much of it has no points; or
  // {lost, leg, move}: where it was lost, behind which click, and which one to move, counted from 1.
  function follow(colour, clicks) {
    const ways = clicks.map((_, i) => direction(clicks[Math.max(0, i - 1)], clicks[Math.max(1, i)]));
    const known = clicks.map((click, i) => at_click(colour, click, ways[i])).filter(Boolean);
    if (!known.length) return { lost: clicks[0], leg: 1, move: 1 };
    const usual = median(known.map((one) => one.width));
    let level = median(known.map((one) => one.level));
    const [step, half] = [Math.max(1, usual / 3), Math.ceil(Math.max(12, 3 * usual))];
    const jump = 0.25 + 0.75 * usual; // sideways in a step; the arcs of a marker are farther away
    const gap = Math.max(28, 12 * usual); // as between dashes, or in a marker
    // Where lines cross the ink is wide, at the end of a dash it is cut: its middle is not that of the line.
    const is_line = (found) => found?.width > 0.6 * usual && found.width < 1.3 * usual;
    const points = [];
    let [here, way, missed, run, length, left_out, skipped] = [clicks[0], ways[0], 0, 0, 0, 0, 0];
    for (const [i, goal] of clicks.slice(1).entries()) {
      const before = points.length;
      const ahead = () => way[0] * (goal[0] - here[0]) + way[1] * (goal[1] - here[1]);
      // A line that has a corner at a click does not go on as before, but from there towards the next one.
      const next = here.map((one, n) => one + 2 * usual * way[n]);
      const turned = ahead() < 0.7 * distance(here, goal);
      if (turned && !is_line(across(colour, next, way, half, level))) {
        [here, way, run] = [clicks[i], direction(clicks[i], goal), 0];
      }
      for (let left = 3 * distance(here, goal); ahead() > 0 || distance(here, goal) > half / 2; left -= step) {
        const found = across(colour, here, way, half, level);
        // Behind a gap the line may be farther off, if no other ink is near.
        const most = !points.length ? half / 2 : jump + (found?.alone ? 0.5 * missed : 0);
        const good = is_line(found) && Math.abs(found.off) < most;
        const past = ahead() <= 0 && distance(here, goal) < 1.5 * half;
        if (past || left < 0 || (!good && missed > gap)) {
          // Where it runs into another line it is left out up to the next click, unless too much would be.
          const goes_on = before && ++skipped <= clicks.length / 3 && i + 2 < clicks.length;
          if (!goes_on || !is_line(at_click(colour, goal, ways[i + 1]))) {
            return { lost: here, leg: i + 1, move: points.length ? i + 2 : 1 };
          }
          points.length = before;
          length = points.at(-1).length;
          [way, missed, run] = [ways[i + 1], step, 0];
          break;
        }
        if (good) {
          here = [here[0] - found.off * way[1], here[1] + found.off * way[0]];
          const part = points.length ? distance(points.at(-1).here, here) : 0;
          length += part;
          left_out += missed ? part : 0;
          points.push({ here, length, width: found.width });
          level += 0.1 * (found.level - level); // the light may be uneven
          // The way of the last points behind a gap or a corner, once these are enough.
          if (run > 4) way = direction(points.at(-Math.min(run, 9)).here, here);
        }
        [missed, run] = good ? [0, run + 1] : [missed + step, 0];
        here = [here[0] + step * way[0], here[1] + step * way[1]];
      }
      if (missed) here = goal; // a click is nearer to the line than a guess
    }
    const width = median(points.map((one) => one.width));
    // Even places along the line. Beside a gap the middle is less sure, and the width is not that of the line.
    const kept = Array.from({ length: COUNT }, (_, i) => smallest(
      points.filter((one) => Math.abs(one.length / length - i / (COUNT - 1)) < 0.1 / COUNT),
      (one) => Math.abs(one.width - width))).filter(Boolean);
    if (kept.length < 2) return { lost: here, leg: 1, move: 1 };
    return { points: kept.map((one) => one.here), width, length, left_out };
  }

  return { follow };
})();
