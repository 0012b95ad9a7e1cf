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

  function order(phases) {
    if (phases.length === 1) return `It ${verb(phases[0])} throughout`;
    if (phases.length > 4) return `It sticks and slips in turn, ${phases.length} times in all`;
    const [first, ...rest] = phases.map(verb);
    return `It ${first} first, ${rest.map((one) => `then ${one}`).join(", ")}`;
  }

  function end({ x, e, result }) {
    const share = Math.abs(result.velocity) / x;
    const percent = (100 * share).toFixed(share < 0.095 ? 1 : 0);
    const leaves = e === 0 ? "does not bounce off, and moves on" : "leaves";
    if (share < 0.0005) return `The contact point ${leaves} without tangential velocity`;
    const how = `${leaves} ${way(result.velocity)}`;
    return `The contact point ${how}, with ${percent}\u00A0% of its tangential velocity`;
  }

  const sentence = (impact) =>
    impact.x === 0
      ? "A straight blow: it sticks, and nothing moves along the surface."
      : `${order(impact.phases)}. ${end(impact)}.`;

  return { phases, sentence };
})();
