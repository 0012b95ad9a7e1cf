"use strict";

// What happens, in plain words.
const words = (() => {
  const way = (sign) => (sign > 0 ? "forwards" : "backwards");

  function percent(share) {
    return `${(100 * share).toFixed(share < 0.095 ? 1 : 0)}\u00A0%`;
  }

  // In the continuum a contact that sticks does so in its middle; its edge slips.
  function order({ phases, contact: { style } }) {
    const sticks = style === "lumped" ? "sticks" : "sticks in the middle";
    const verb = (phase) => (phase.sticks ? sticks : `slips ${way(phase.side)}`);
    if (phases.length === 1) return `the contact ${verb(phases[0])} throughout`;
    if (phases.length > 4) return `the contact sticks and slips in turn, ${phases.length} times in all`;
    const [first, ...others] = phases.map(verb);
    return `the contact ${first} first, ${others.map((one) => `then ${one}`).join(", ")}`;
  }

  function end({ x, e, contact: { state } }) {
    const share = Math.abs(state.velocity) / x;
    const leaves = e === 0 ? "does not bounce off, and moves on" : "leaves";
    if (share < models.STOPPED) return `The contact point ${leaves} without tangential velocity`;
    const how = `${leaves} ${way(state.velocity)}`;
    return `The contact point ${how}, with ${percent(share)} of the tangential velocity that it came with`;
  }

  // What the contact does in the first bounce, by the model that is looked at closer.
  function sentence(impact) {
    const name = models.NAMES[impact.contact.style];
    const model = `${name[0].toUpperCase()}${name.slice(1)}: `;
    if (impact.x === 0) return `${model}the contact point comes straight, and nothing slips.`;
    return `${model}${order(impact)}. ${end(impact)}.`;
  }

  // What the centre of the ball does.
  function centre({ before, after, e }) {
    const turned = Math.sign(after.along) * Math.sign(before.along) < 0;
    const goes = Math.abs(after.along) < 0.005 ? "does not move along the surface"
      : turned ? "turns back" : "goes on";
    const angle = (Math.atan2(Math.abs(after.along), after.up) * 180) / Math.PI;
    const leaving = e === 0 ? "" : ` and leaves at ${angle.toFixed(0)}\u00B0 to the normal`;
    return `Its centre ${goes}${leaving}.`;
  }

  const listed = (outcomes) => outcomes.map((one) => one.name).join("; ");

  // Whether the models shown agree: first in direction, then in whether it slips throughout.
  function agreement(all) {
    const speaking = all.filter((one) => !one.mute);
    const rigid = speaking.length < all.length
      ? " The rigid limit has no spring: it only stops." : "";
    if (!all.length) return { agrees: true, text: "No model is chosen: tick one above." };
    if (speaking.length < 2) return { agrees: true, text: rigid.trim() };
    const split = (parts) =>
      parts
        .map(([name, is]) => [name, speaking.filter(is)])
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

  return { sentence, centre, agreement };
})();
