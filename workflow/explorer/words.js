"use strict";

// What happens, in plain words. Forwards is the way of the throw, on the stage to the right.
const words = (() => {
  const way = (sign) => (sign > 0 ? "forwards" : "backwards");

  const SLOW = 0.05; // m/s: less is 0.0 where one digit is shown
  const TABLE = 0.7; // m above the floor
  const TINY = 1e-9; // incidence of a contact point that rolls, but for rounding

  function percent(share) {
    return `${(100 * share).toFixed(share < 0.095 ? 1 : 0)}\u00A0%`;
  }

  // What becomes of the contact point, and how it is said; `left` is the speed with which it leaves.
  const FATES = {
    still: () => "nothing slid",
    stopped: () => "the contact point stopped",
    slid_on: () => "the contact slipped throughout, and its point went on",
    slid_back: () => "the contact slipped throughout, and its point turned back",
    thrown_back: (left) => `the spring recoiled and threw the contact point back, ${left}`,
    swung: (left) => `the spring threw the contact point back and then forwards again, ${left}`,
    let_go: (left) => `the contact ended while the contact point still went on, ${left}`,
  };

  function fate({ x, contact: { state, rows } }) {
    if (x <= TINY) return "still";
    if (Math.abs(state.velocity) < models.STOPPED * x) return "stopped";
    const back = state.velocity < 0;
    if (!rows.some(({ sticks }) => sticks)) return back ? "slid_back" : "slid_on";
    if (back) return "thrown_back";
    return rows.some(({ velocity }) => velocity < -models.STOPPED * x) ? "swung" : "let_go";
  }

  // The contact point of one bounce, and what follows for the ball, which was `thrown` forwards or not.
  function bounced(bounce, thrown) {
    const { x, ball, after, contact: { state } } = bounce;
    const left = `at ${percent(Math.abs(state.velocity) / x)} of the speed it came with`;
    const verb = Math.abs(ball.along) < SLOW ? "sets off" : ball.along * after.along < 0 ? "turns round"
      : thrown && after.along < 0 ? "comes back" : "goes on";
    const goes = Math.abs(after.along) < SLOW ? "hardly moves along the surface"
      : `${verb}, ${Math.abs(after.along).toFixed(1)} m/s ${way(after.along)}`;
    return `${FATES[fate(bounce)](left)}; the ball ${goes}.`;
  }

  // What has happened in this throw up to now, in a line: `upper` and `lower` are the bounces of the
  // ball on a rigid contact and of that on a spring, of which `count` are over, of the throw `given`. Of a
  // `lone` ball only the lower one is told.
  function story({ upper, lower, given }, count, over, springy, lone) {
    if (!count) {
      return lone ? "" : springy ? "The same throw twice. Only the lower ball has a spring along the surface."
        : "The same throw twice. Neither ball has a spring along the surface: both contacts are rigid.";
    }
    const { wall } = lower[count - 1];
    const thrown = lower[0].ball.along > SLOW;
    const [own, rigid] = [lower, upper].map((all) => bounced(all[count - 1], thrown));
    const said = lone ? own[0].toUpperCase() + own.slice(1)
      : springy ? `With the spring: ${own} Without: ${rigid}` : `Both: ${rigid}`;
    return (over && !lone && ending(upper, lower, springy, given)) || `After bounce ${count} (${wall}). ${said}`;
  }

  const forwards = ({ after }) => after.along > SLOW;

  // What a throw forwards has come to, if the balls tell with spring and without what the spring does.
  function ending(upper, lower, springy, given) {
    const stopped = upper.every(({ contact: { state } }) => state.velocity === 0);
    if (lower[0].ball.along <= SLOW || !upper.every(forwards) || !stopped) return "";
    const end = "Without a spring the contact point stopped, and the ball went on.";
    if (!springy) return `Both balls went on. ${end}`;
    if (lower.every(forwards)) return missed(given);
    // The spin of an earlier bounce turns it, once.
    const turned = lower.findIndex((one) => !forwards(one));
    const thrown = lower[0].sign > 0 && lower.every((one) => fate(one) === "thrown_back");
    const back = lower.slice(turned).every(({ after }) => after.along < -SLOW);
    if (turned === 0 || !thrown || !back) return "";
    return "The ball with the spring came back. At each bounce the spring recoiled and threw the contact point " +
      `back. The ball spun fast, its ${lower[turned].wall === "table" ? "highest" : "lowest"} point ran forwards ` +
      `into the ${lower[turned].wall}, and friction there turned it round. ${end}`;
  }

  // Whether a spring could have turned a ball that went on: then the timing of its own is to blame.
  function missed(given) {
    const went = "The ball with the spring went on, too.";
    const { groups, compliance } = given;
    const turns = (share, table = given.table) => flight.bounces(flight.fly({ ...given, table }, (x) =>
      models.contact("lumped", { ...groups, x, zeta2: (share / compliance) * groups.zeta2 })))
      .at(-1).after.along < -SLOW;
    const other = Array.from({ length: 100 }, (_, i) => (i + 1) / 100)
      .sort((a, b) => Math.abs(a - compliance) - Math.abs(b - compliance)).find((share) => turns(share));
    if (other) {
      return `${went} Timing decides: with the tangential compliance ${other} the spring swings at another pace, ` +
        "and the ball comes back.";
    }
    const kept = flight.slowest(given);
    const under = !given.table && given.radius < TABLE / 4 && turns(compliance, TABLE) ?
      ` Under a table at ${TABLE} m it comes back.` : "";
    return kept <= SLOW ? "" : `${went} No spring can turn this throw round: however far its bounces throw the ` +
      `contact point back, at least ${kept.toFixed(1)} m/s forwards are left.${under}`;
  }

  return { story };
})();
