"use strict";

// What happens, in plain words.
const words = (() => {
  const SHORTEST = 1e-6; // t_c, of a phase worth a word

  // Stick and slip as they follow each other, whatever the half of the contact.
  function phases(contact) {
    const merged = [];
    for (const { sticks, side, start, end } of contact.phases) {
      const last = merged[merged.length - 1];
      if (last && last.sticks === sticks && (sticks || last.side === side)) last.end = end;
      else if (end - start > SHORTEST) merged.push({ sticks, side, start, end });
    }
    return merged;
  }

  const verb = (phase) => (phase.sticks ? "sticks" : `slips ${way(phase.side)}`);
  const way = (sign) => (sign > 0 ? "forwards" : "backwards");

  function percent(share) {
    return `${(100 * share).toFixed(share < 0.095 ? 1 : 0)}\u00A0%`;
  }

  function order(phases) {
    if (phases.length === 1) return `It ${verb(phases[0])} throughout`;
    if (phases.length > 4) return `It sticks and slips in turn, ${phases.length} times in all`;
    const [first, ...rest] = phases.map(verb);
    return `It ${first} first, ${rest.map((one) => `then ${one}`).join(", ")}`;
  }

  function end({ x, e, result }) {
    const share = Math.abs(result.velocity) / x;
    const leaves = e === 0 ? "does not bounce off, and moves on" : "leaves";
    if (share < models.STOPPED) return `The contact point ${leaves} without tangential velocity`;
    const how = `${leaves} ${way(result.velocity)}`;
    return `The contact point ${how}, with ${percent(share)} of its tangential velocity`;
  }

  const sentence = (impact) =>
    impact.x === 0
      ? "A straight blow: it sticks, and nothing moves along the surface."
      : `${order(impact.phases)}. ${end(impact)}.`;

  // What the centre of a ball does that came without spin.
  function centre(impact) {
    const { x, e, result } = impact;
    const after = ball.motion(impact, result.velocity);
    if (x === 0) return "The ball does not begin to spin.";
    const angle = e === 0 ? "" : ` It leaves at ${ball.angle(impact).toFixed(0)}\u00B0.`;
    const goes = after.centre < 0 ? "turns back" : "goes on forwards";
    const share = percent(Math.abs(after.centre) / x);
    let spin = "The ball spins forwards.";
    if (Math.abs(after.spin) < models.STOPPED * x) spin = "It does not spin.";
    else if (result.velocity < 0 && after.centre > 0) {
      spin = "The ball spins so fast that its contact point runs backwards.";
    }
    return `The centre ${goes} with ${share} of its tangential velocity.${angle} ${spin}`;
  }

  const listed = (found) => found.map((one) => one.name).join("; ");

  // Whether the models shown agree: first in direction, then in whether it slips throughout.
  function agreement(all) {
    const found = all.filter((one) => !one.mute);
    const rigid = found.length < all.length ? " The rigid limit has no spring: it only stops." : "";
    if (found.length < 2) return { agrees: true, text: rigid.trim() };
    const split = (parts) =>
      parts
        .map(([name, is]) => [name, found.filter(is)])
        .filter(([, those]) => those.length)
        .map(([name, those]) => `${name}: ${listed(those)}.`);
    const directions = split([
      ["Forwards", (one) => one.direction > 0],
      ["Backwards", (one) => one.direction < 0],
      ["Stops, or almost", (one) => one.direction === 0],
    ]);
    if (directions.length > 1) {
      const text = `The models disagree on the direction. ${directions.join(" ")}${rigid}`;
      return { agrees: false, text };
    }
    const slips = split([
      ["Slips throughout", (one) => one.slides],
      ["Also sticks", (one) => !one.slides],
    ]);
    if (slips.length > 1) {
      return { agrees: false, text: `The models disagree on slip. ${slips.join(" ")}${rigid}` };
    }
    return { agrees: true, text: `The models shown agree on the direction.${rigid}` };
  }

  return { phases, sentence, centre, agreement };
})();
