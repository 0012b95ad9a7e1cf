"use strict";

// The solver of this page against answers of the package, which the page carries.
const check = (() => {
  const ACCURACY = 1e-9; // of the incidence, and at least absolute

  // The answers from which the solver differs. An answer is the groups x, m2/m1, zeta^2 and e;
  // velocity, peak friction, dissipation and regime.
  function differing(answers) {
    return answers.filter(([groups, wanted]) => {
      const state = solver.rebound(...groups);
      const numbers = [state.velocity, state.peak_friction, state.dissipation];
      const size = ACCURACY * Math.max(groups[0], 1);
      const close = numbers.every((number, i) => Math.abs(number - wanted[i]) <= size);
      return !close || state.regime !== wanted[3];
    });
  }

  // A page whose solver is wrong says so above everything else.
  function warn(answers) {
    const wrong = differing(answers).length;
    if (!wrong) return;
    const warning = document.createElement("p");
    warning.setAttribute("role", "alert");
    warning.className = "refused";
    warning.textContent = `Do not trust this page: its solver differs from the package in ${wrong} ` +
      `of ${answers.length} impacts.`;
    document.querySelector("main").prepend(warning);
  }

  return { differing, warn };
})();
