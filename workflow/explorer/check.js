"use strict";

// The solver of this page against answers of the package, which the page carries.
const check = (() => {
  const ACCURACY = 1e-9;

  // The answers from which the solver differs, each as its groups and what the package found.
  function differing(answers) {
    return answers.filter(([groups, wanted]) => {
      const found = solver.rebound(...groups);
      const numbers = [found.velocity, found.peak_friction, found.dissipation];
      const size = ACCURACY * Math.max(groups[0], 1);
      const close = numbers.every((number, i) => Math.abs(number - wanted[i]) <= size);
      return !close || found.regime !== wanted[3];
    });
  }

  // A page whose solver is wrong says so above everything else.
  function warn(answers) {
    const wrong = differing(answers).length;
    if (!wrong) return;
    const words = document.createElement("p");
    words.setAttribute("role", "alert");
    words.className = "refused";
    words.textContent = `Do not trust this page: its solver differs from the package in ${wrong} ` +
      `of ${answers.length} impacts.`;
    document.querySelector("main").prepend(words);
  }

  return { differing, warn };
})();
