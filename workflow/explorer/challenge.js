"use strict";

// Challenges: wishes about the rebound, and whether the present impact fulfils them.
const challenge = (() => {
  const UNCOVERED = "The continuum has no answer for this impact.";

  // What is missing, in words; nothing if a value is good enough.
  function near(what, value, wanted, tolerance) {
    const by = value - wanted;
    if (Math.abs(by) <= tolerance) return "";
    return `${what} is too ${by > 0 ? "large" : "small"} by ${Math.abs(by).toFixed(2)}.`;
  }
  function at_least(what, share, wanted) {
    if (share >= wanted) return "";
    const is = `${(100 * share).toFixed(1).replace("-", "\u2212")} %`;
    return `${what.replace("#", is)}. It must be ${100 * wanted} % or more.`;
  }
  const at_45 = (mu, x) => near("The angle (in °)", (Math.atan(mu * x) * 180) / Math.PI, 45, 0.5);
  const elastic = (e) => near("Restitution", e, 1, 0.005);

  // Velocities after are over those before: `kept` of any model, `round` of the continuum. An
  // answer has angle, mu, nu and m2/m1, with e = 1.
  const WISHES = [
    {
      wish: "At 45°, make the contact point slip from first to last.",
      hint: "The less friction can do, the longer the point slips.",
      answer: [45, 0.1, 0.3, 3.5],
      missing: ({ mu, x, beta, e }, kept) => at_45(mu, x) ||
        at_least("The impulse of friction is # of its limit", (x * (1 - kept)) / beta / (1 + e), 0.999),
    },
    {
      wish: "At 45°, make it stick from the first moment.",
      hint: "It sticks at first where tan θ is below µζ².",
      answer: [45, 1, 0.3, 3.5],
      missing: ({ mu, x, zeta2 }) => at_45(mu, x) || at_least("µζ² is # of tan θ", zeta2 / x, 1),
    },
    {
      wish: "An elastic solid ball strikes at 45°. Make friction take 22 % of the energy.",
      hint: "The point must hardly move along the surface after the impact.",
      answer: [45, 0.14, 0.3, 3.5],
      missing: ({ mu, x, beta, e }, kept) =>
        at_45(mu, x) || elastic(e) || near("m₂/m₁", beta, 3.5, 0.01) ||
        at_least("The share that friction takes is #", (1 - kept * kept) / (1 + beta / (mu * x) ** 2), 0.22),
    },
    {
      wish: "With <i>e</i> = 1, make the contact point come back with 60 % of its tangential speed.",
      hint: "No solid ball can: its best is 59 % here, 59.7 % in the continuum. A hollow one can.",
      answer: [42, 0.5, 0.5, 2.5],
      missing: ({ e }, kept) => elastic(e) || at_least("The share that comes back is #", -kept, 0.6),
    },
    {
      wish: "With <i>e</i> = 1, make the models disagree: in the lumped one the point goes on with" +
        " 5 % of its speed, in the continuum it comes back with 5 %.",
      hint: "Only the continuum has micro-slip. It matters where the whole contact sticks first.",
      answer: [32.6, 0.5, 0.3, 3.5],
      missing: ({ e, x, result }, _, round) =>
        elastic(e) || (round === undefined ? UNCOVERED : "") ||
        at_least("In the lumped model the share that goes on is #", result.velocity / x, 0.05) ||
        at_least("In the continuum the share that comes back is #", -round, 0.05),
    },
  ];

  // The share that the continuum keeps, with each loss.
  const rounds_of = (impact) =>
    models.outcomes(models.chosen(impact, ["continuum"]), impact)
      .map(({ name, velocity }) => [name, velocity / impact.x]);

  function judge({ missing }, impact, rounds) {
    if (impact.x === 0) return { words: "The blow is straight." };
    const [lacks, ...others] = [impact.result.velocity / impact.x, ...rounds.map(([, kept]) => kept)]
      .map((kept) => missing(impact, kept, rounds[0]?.[1]));
    const words = [lacks || "\u2713 You have met it."];
    others.forEach((other, i) => {
      if (!other === !lacks) return;
      words.push(`${rounds[i][0]}: ${other || "it is met."}`);
    });
    if (!lacks && !rounds.length) words.push(UNCOVERED);
    return { holds: !lacks, words: words.join(" ") };
  }

  const [list, heard] = document.querySelectorAll("#challenge :is(ol, .heard)");
  list.innerHTML = WISHES.map(
    ({ wish, hint }) => `<li><details name="wish"><summary>${wish}</summary>
      <details><summary>Hint</summary>${hint}</details><button type="button">Show an
      answer</button></details><span class="verdict"></span></li>`).join("");
  const verdicts = list.querySelectorAll(".verdict");

  function show(impact) {
    const rounds = rounds_of(impact);
    WISHES.forEach((wish, i) => {
      const { holds, words } = judge(wish, impact, rounds);
      const { classList } = verdicts[i];
      verdicts[i].textContent = words;
      if (holds && !classList.contains("holds")) heard.textContent = `Challenge ${i + 1} is met.`;
      classList.toggle("holds", Boolean(holds));
    });
  }

  // The stage and the controls come into view with an open challenge, which stays at the bottom.
  for (const details of list.querySelectorAll("li > details")) {
    details.addEventListener("toggle", () => {
      if (details.open) document.getElementById("stage").scrollIntoView({ block: "start" });
    });
  }

  WISHES.forEach(({ answer: [angle, mu, nu, beta] }, i) => {
    list.querySelectorAll("button")[i].addEventListener("click", () => page.go(
      `angle=${angle}&friction=${mu}&restitution=1&poisson_ratio=${nu}&mass_ratio=${beta}` +
        "&view=velocity"));
  });
  document.addEventListener("impact", (event) => show(event.detail));
  show(page.impact());
})();
