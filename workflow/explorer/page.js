"use strict";

// The page: its controls, its address, and what moves. State is what the controls show and what
// stands behind # in the address; everything else follows from it. After each change it sends the
// document an event "impact", whose detail is the impact as solved.
const page = (() => {
  const element = (id) => document.getElementById(id);
  const SLIDERS = ["angle", "friction", "restitution", "poisson_ratio", "mass_ratio"];
  const MILLISECONDS = 2200; // that one t_c takes at speed 1
  const REST = 700; // ms between two showings
  const SAMPLES = 240;

  const state = { view: "velocity" };
  let impact; // solved from the state
  let scales; // of the charts
  let t = 0; // t/t_c
  let playing = !matchMedia("(prefers-reduced-motion: reduce)").matches;

  // ---- state --------------------------------------------------------------------------------

  function set(name, text) {
    const { min, max } = element(name);
    const value = Number(text);
    if (text === "" || !Number.isFinite(value)) return;
    state[name] = Math.min(Math.max(value, Number(min)), Number(max));
  }

  function read(address) {
    const given = new URLSearchParams(address);
    for (const name of SLIDERS) if (given.has(name)) set(name, given.get(name));
    const known = [...element("view").options].map((option) => option.value);
    if (known.includes(given.get("view"))) state.view = given.get("view");
  }

  function address() {
    const rounded = SLIDERS.map((name) => [name, Number(state[name].toFixed(4))]);
    return new URLSearchParams([...rounded, ["view", state.view]]).toString();
  }

  // ---- the impact ---------------------------------------------------------------------------

  // zeta^2 of a body that strikes one of the same material, or a rigid one.
  const stiffness_ratio = (nu) => (2 - nu) / (2 * (1 - nu));

  function solved() {
    const { angle, friction: mu, restitution: e, mass_ratio: beta } = state;
    const zeta2 = stiffness_ratio(state.poisson_ratio);
    const x = Math.tan((angle * Math.PI) / 180) / mu;
    const contact = solver.history(x, beta, zeta2, e, SAMPLES);
    return {
      mu, x, beta, zeta2, e, contact,
      result: solver.rebound(x, beta, zeta2, e),
      limit: solver.slip_throughout_limit(beta, zeta2, e),
      phases: words.phases(contact),
      ways: ways(contact),
    };
  }

  // Distance along the surface in mu v2(0)/Omega at the samples; for the drawing, by trapezia.
  function ways({ time, velocity }) {
    let way = 0;
    return time.map((now, i) => {
      const mean = i ? (velocity[i] + velocity[i - 1]) / 2 : 0;
      return (way += ((now - (time[i - 1] ?? 0)) * mean * Math.PI) / 2);
    });
  }

  function way_at({ contact, ways }, now) {
    const after = contact.time.findIndex((one) => one > now);
    if (after < 1) return after ? ways[ways.length - 1] : 0;
    const [start, end] = [contact.time[after - 1], contact.time[after]];
    return ways[after - 1] + ((now - start) / (end - start)) * (ways[after] - ways[after - 1]);
  }

  // The contact at t, with its approach v2/v2(0) and depth u2 in v2(0)/Omega.
  function present() {
    const { contact, beta, zeta2, e } = impact;
    const now = solver.at(contact, t, beta, zeta2, e);
    const back = now.phase.in_restitution;
    return {
      ...now,
      approach: (back ? -e : 1) * Math.cos(now.eta),
      depth: back ? 1 - e * e * (1 - now.normal) : now.normal,
    };
  }

  // Shares of the energy before: of the motion, in the springs, lost; by normal and tangential.
  function energies({ velocity, approach, normal, friction }, back) {
    const { mu, x, beta, zeta2, e } = impact;
    const before = (mu * x) ** 2 / beta + 1;
    const shares = {
      towards: approach ** 2 / before,
      along: (mu * velocity) ** 2 / beta / before,
      pressed: ((back ? e : 1) * normal) ** 2 / before,
      sheared: (zeta2 * (mu * friction) ** 2) / before,
      deformed: back ? (1 - e * e) / before : 0,
    };
    const rest = Object.values(shares).reduce((sum, share) => sum + share);
    return { ...shares, rubbed: Math.max(1 - rest, 0) };
  }

  // ---- drawing ------------------------------------------------------------------------------

  function show_time() {
    const now = present();
    diagram.show(impact, now, way_at(impact, t));
    charts.move_cursor(element("forces"), scales.forces, t, [now.normal, now.friction]);
    charts.move_cursor(element("velocity"), scales.velocity, t, [now.velocity]);
    element("time").value = t;
    element("clock").textContent = t.toFixed(2);
    show_energies(2, "now", energies(now, now.phase.in_restitution || impact.e === 0 && t >= 1));
  }

  function show_energies(column, moment, shares) {
    const kinds = Object.entries(shares);
    element(`bar-${moment}`).innerHTML = kinds
      .map(([kind, share]) => `<i class="${kind}" style="width:${100 * share}%"></i>`)
      .join("");
    for (const [kind, share] of kinds) {
      element(`energy-${kind}`).cells[column].textContent =
        share < 5e-4 ? "\u2013" : (100 * share).toFixed(1);
    }
  }

  function show_numbers() {
    const { x, beta, zeta2, limit, mu, result } = impact;
    const angle = (incidence) =>
      `${charts.number((Math.atan(mu * incidence) * 180) / Math.PI, 1)}\u00B0`;
    const found = {
      incidence: charts.number(x, 3),
      velocity: charts.number(result.velocity, 3),
      friction: charts.number(result.peak_friction, 3),
      stick: angle(zeta2),
      slip: angle(limit),
      frequency: charts.number(Math.sqrt(beta / zeta2), 2),
    };
    for (const name in found) element(`number-${name}`).textContent = found[name];
  }

  function show_controls() {
    for (const name of SLIDERS) {
      element(name).value = state[name];
      const typed = element(`${name}-number`);
      if (typed !== document.activeElement) typed.value = Number(state[name].toFixed(4));
    }
    element("stiffness_ratio").textContent = charts.number(impact.zeta2, 3);
    element("view").value = state.view;
    element("time").max = 1 + state.restitution;
    for (const part of document.querySelectorAll("[data-view]")) {
      part.hidden = !part.dataset.view.split(" ").includes(state.view);
    }
    for (const button of document.querySelectorAll(".body")) {
      button.ariaPressed = Number(button.dataset.mass_ratio) === state.mass_ratio;
    }
    const here = address();
    let about = "";
    for (const button of document.querySelectorAll(".preset")) {
      button.ariaPressed = button.dataset.state === here;
      if (button.dataset.state === here) about = button.dataset.about;
    }
    element("about").textContent = about;
    const hollow = element("thin-shell").ariaPressed === "true";
    element("diagram-svg").classList.toggle("shell", hollow);
  }

  function show_continuum() {
    const { drawn } = scales.incidence;
    for (const style of ["elastic", "viscous", "plastic"]) {
      element(`legend-${style}`).hidden = !drawn.includes(style);
    }
    const wanted = state.view === "velocity" && element("continuum").checked;
    element("uncovered").hidden = !wanted || drawn.length > 0;
  }

  function refresh() {
    const width = element("plots").clientWidth; // before anything changes, which would cost time
    impact = solved();
    t = Math.min(t, 1 + state.restitution);
    element("sentence").textContent = words.sentence(impact);
    // Hidden, it keeps its place: nothing jumps while the slider is moved.
    element("caution").classList.toggle("idle", impact.e === 1);
    scales = {
      forces: charts.forces(element("forces"), width, impact),
      velocity: charts.velocity(element("velocity"), width, impact),
      incidence: charts.incidence(
        element("incidence"), width, impact, state.view, element("continuum").checked),
    };
    show_numbers();
    show_controls();
    show_continuum();
    const motion = { velocity: impact.x, approach: 1, normal: 0, friction: 0 };
    show_energies(1, "before", energies(motion, false));
    const left = { ...motion, velocity: impact.result.velocity, approach: impact.e };
    show_energies(3, "after", energies(left, true));
    show_time();
    document.dispatchEvent(new CustomEvent("impact", { detail: impact }));
  }

  // ---- what the reader does -----------------------------------------------------------------

  let remembered;
  function changed() {
    refresh();
    // Browsers allow an address to change only so often.
    clearTimeout(remembered);
    remembered = setTimeout(() => history.replaceState(null, "", `#${address()}`), 250);
  }

  for (const name of SLIDERS) {
    const [slider, typed] = [element(name), element(`${name}-number`)];
    state[name] = Number(slider.value);
    for (const input of [slider, typed]) {
      input.addEventListener("input", () => {
        set(name, input.value);
        changed();
      });
    }
    typed.addEventListener("blur", show_controls);
  }
  element("continuum").addEventListener("change", refresh);
  element("view").addEventListener("change", (event) => {
    state.view = event.target.value;
    changed();
  });
  for (const button of document.querySelectorAll(".preset")) {
    button.addEventListener("click", () => {
      go(button.dataset.state);
    });
  }
  for (const button of document.querySelectorAll(".body")) {
    button.addEventListener("click", () => {
      set("mass_ratio", button.dataset.mass_ratio);
      changed();
    });
  }

  let last; // time of the frame before
  let rested = 0;
  function frame(now) {
    if (!playing) return;
    const passed = Math.min(now - (last ?? now), 100);
    last = now;
    const end = 1 + state.restitution;
    if (t < end) {
      t = Math.min(t + (passed / MILLISECONDS) * Number(element("speed").value), end);
      rested = 0;
      show_time();
    } else if ((rested += passed) > REST) {
      t = 0;
    }
    requestAnimationFrame(frame);
  }

  function play(on) {
    playing = on;
    last = undefined;
    element("play").textContent = on ? "\u275A\u275A" : "\u25B6";
    element("play").ariaLabel = on ? "Pause" : "Play";
    if (on) requestAnimationFrame(frame);
  }

  element("play").addEventListener("click", () => play(!playing));
  document.addEventListener("keydown", (event) => {
    const typing = event.target.matches("button, select, input[type=number]");
    if (event.key !== " " || typing) return;
    event.preventDefault();
    play(!playing);
  });

  function go_to(time) {
    play(false);
    t = Math.min(Math.max(time, 0), 1 + state.restitution);
    show_time();
  }
  element("time").addEventListener("input", (event) => go_to(Number(event.target.value)));

  // Pressing or dragging in a chart: the time there, or the incidence.
  function on_drag(svg, action) {
    svg.addEventListener("pointerdown", (event) => {
      svg.setPointerCapture(event.pointerId);
      action(event);
    });
    svg.addEventListener("pointermove", (event) => event.buttons && action(event));
  }
  on_drag(element("forces"), (event) => go_to(scales.forces.at(event)));
  on_drag(element("velocity"), (event) => go_to(scales.velocity.at(event)));
  on_drag(element("incidence"), (event) => {
    set("angle", scales.incidence.angle(event));
    changed();
  });

  // ---- start --------------------------------------------------------------------------------

  const first = document.querySelector(".preset");
  if (first) read(first.dataset.state);
  read(location.hash.slice(1));
  refresh();
  play(playing);
  addEventListener("hashchange", () => {
    read(location.hash.slice(1));
    refresh();
  });
  let width = innerWidth;
  addEventListener("resize", () => {
    if (innerWidth !== width) refresh();
    width = innerWidth;
  });

  // Goes to the state that an address says, as a preset does.
  function go(to) {
    read(to);
    t = 0;
    changed();
  }

  return { go, impact: () => impact };
})();
