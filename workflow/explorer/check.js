"use strict";

// The solvers of this page against answers of the package, which the page carries.
const check = (() => {
  const ACCURACY = { lumped: 1e-9, continuum: CONTINUUM_ERROR };

  // The answers from which the solvers differ. An answer is the groups x, m2/m1, zeta^2, e and for
  // the continuum its loss; velocity, peak friction and for the lumped model dissipation, regime.
  function differing(answers) {
    return answers.filter(([groups, wanted]) => {
      const lumped = groups.length === 4;
      const state = lumped ? solver.rebound(...groups) : continuum.rebound(...groups);
      const numbers = [state.velocity, state.peak_friction, state.dissipation];
      const size = lumped ? ACCURACY.lumped * Math.max(groups[0], 1) : ACCURACY.continuum;
      // The continuum says no regime, and its work of friction is not held to this accuracy.
      const close = wanted.every((number, i) =>
        typeof number !== "number" || Math.abs(number - numbers[i]) <= size);
      return !close || (lumped && state.regime !== wanted[3]);
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
