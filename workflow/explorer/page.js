"use strict";

// The page: its controls, its address, and what moves. State is what the controls show and what
// stands behind # in the address; everything else follows from it. After each change it sends the
// document an event "impact", whose detail is the impact as solved.
const page = (() => {
  const element = (id) => document.getElementById(id);
  const SLIDERS = ["angle", "friction", "restitution", "poisson_ratio", "mass_ratio"];
  const MILLISECONDS = 2200; // that one t_c takes at speed 1
  const FLIGHT = 1300; // ms of the flight in or out at speed 1
  const REST = 700; // ms between two showings
  const SAMPLES = 240;
  const SETTLED = 300; // ms without a change, after which the address says the state
  const INTENT = 8; // pixels that a finger moves before its direction counts
  // A comma is read as a decimal point, never as a separator of thousands.
  const NUMBER = /^[+-]?(\d+([.,]\d*)?|[.,]\d+)(e[+-]?\d+)?$/i;

  const state = { view: "velocity", models: models.TOGGLES };
  let impact; // solved from the state
  let list; // the models shown
  let scales; // of the charts
  let frozen; // the end of the axis of incidence while its chart is dragged
  let playing = !matchMedia("(prefers-reduced-motion: reduce)").matches;
  const beginning = () => (playing ? -1 : 0);
  let t = beginning(); // t/t_c in contact; below 0 and above 1 + e it is flight, of length 1 each

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
    const wanted = given.get("models")?.split(" ");
    if (wanted) state.models = models.TOGGLES.filter((name) => wanted.includes(name));
  }

  // The part of the address that presets have too.
  function impact_address() {
    const rounded = SLIDERS.map((name) => [name, Number(state[name].toFixed(4))]);
    return new URLSearchParams([...rounded, ["view", state.view]]).toString();
  }

  // The models are named where some are left out.
  function address() {
    if (state.models.length === models.TOGGLES.length) return impact_address();
    const shown = new URLSearchParams({ models: state.models.join(" ") });
    return `${impact_address()}&${shown}`;
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

  // t within the contact: during a flight the nearer end of it.
  const in_contact = () => Math.min(Math.max(t, 0), 1 + impact.e);

  // The contact at t, with its approach v2/v2(0) and depth u2 in v2(0)/Omega.
  function present() {
    const { contact, beta, zeta2, e } = impact;
    const now = solver.at(contact, in_contact(), beta, zeta2, e);
    const back = now.phase.in_restitution || (e === 0 && t >= 1);
    return {
      ...now,
      back,
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
    const here = in_contact();
    ball.show(impact, now, t);
    diagram.show(impact, now, way_at(impact, here));
    charts.move_cursor(element("forces"), scales.forces, here, [now.normal, now.friction]);
    charts.move_cursor(element("velocity"), scales.velocity, here, [now.velocity]);
    element("time").value = t;
    element("clock").textContent = t === here ? t.toFixed(2) : "\u2013";
    show_energies(2, "now", energies(now, now.back));
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
    const after = ball.motion(impact, result.velocity);
    const found = {
      incidence: charts.number(x, 3),
      velocity: charts.number(result.velocity, 3),
      centre: charts.number(after.centre, 3),
      spin: charts.number(after.spin, 3),
      friction: charts.number(result.peak_friction, 3),
      stick: angle(zeta2),
      slip: angle(limit),
      frequency: charts.number(Math.sqrt(beta / zeta2), 2),
    };
    for (const name in found) element(`number-${name}`).textContent = found[name];
  }

  // What each model says of this impact, with a word beside the numbers where they disagree.
  function show_models() {
    const { mu, x, beta } = impact;
    const before = 1 + (mu * x) ** 2 / beta;
    const found = models.outcomes(list, impact);
    const row = ({ style, name, velocity, peak_friction, dissipation, direction, slides }) => {
      const way = ["back", "stops", "on"][direction + 1] + (slides ? ", slips throughout" : "");
      const lost = (200 * mu * mu * dissipation) / before;
      return `<tr><th scope="row"><span class="ink ${style}">${name}</span></th>` +
        `<td>${charts.number(velocity, Math.abs(velocity) < 1000 ? 3 : 0)}</td><td>${way}</td>` +
        `<td>${charts.number(peak_friction, 3)}</td><td>${lost.toFixed(1)}</td></tr>`;
    };
    element("outcomes").tBodies[0].innerHTML = found.map(row).join("");
    const { agrees, text } = words.agreement(found);
    element("agreement").textContent = text;
    element("agreement").classList.toggle("disagree", !agrees);
    // The sentence is that of the lumped model, whether its curve is shown or not.
    const [lumped] = models.outcomes(models.chosen(impact, ["lumped"]), impact);
    const other = ({ direction, slides, mute }) =>
      !mute && (direction !== lumped.direction || slides !== lumped.slides);
    element("doubt").textContent =
      found.some(other) ? "Other models say otherwise: see the table." : "";
    const wanted = state.models.includes("continuum");
    const covered = found.some(({ style }) => style !== "lumped" && style !== "rigid");
    element("uncovered").hidden = !wanted || covered;
    element("own-force").hidden = !covered || state.view !== "forces";
  }

  function show_controls() {
    for (const name of SLIDERS) {
      element(name).value = state[name];
      const typed = element(`${name}-number`);
      if (typed !== document.activeElement) show_typed(name);
    }
    element("stiffness_ratio").textContent = charts.number(impact.zeta2, 3);
    element("no-ball").hidden = state.mass_ratio >= 2;
    element("view").value = state.view;
    element("time").max = 2 + state.restitution;
    for (const name of models.TOGGLES) {
      element(`model-${name}`).checked = state.models.includes(name);
    }
    for (const part of document.querySelectorAll("[data-view]")) {
      part.hidden = !part.dataset.view.split(" ").includes(state.view);
    }
    for (const button of document.querySelectorAll(".body")) {
      button.ariaPressed = Number(button.dataset.mass_ratio) === state.mass_ratio;
    }
    const here = impact_address();
    let about = "";
    for (const button of document.querySelectorAll(".preset")) {
      button.ariaPressed = button.dataset.state === here;
      if (button.dataset.state === here) about = button.dataset.about;
    }
    element("about").textContent = about;
    const hollow = element("thin-shell").ariaPressed === "true";
    element("ball-svg").classList.toggle("shell", hollow);
  }

  const show_typed = (name) =>
    (element(`${name}-number`).value = Number(state[name].toFixed(4)));

  function refresh() {
    // Sizes are read before anything changes, which would cost time. Type is larger on a projector,
    // and a chart is drawn larger with it.
    const zoom = parseFloat(getComputedStyle(document.documentElement).fontSize) / 16;
    const names = ["forces", "velocity", "incidence"];
    const wide = Object.fromEntries(names.map((one) => [one, element(one).clientWidth / zoom]));
    impact = solved();
    list = models.chosen(impact, state.models);
    t = Math.min(t, 2 + state.restitution);
    element("sentence").textContent = words.sentence(impact);
    element("of-the-centre").textContent = words.centre(impact);
    // Hidden, it keeps its place: nothing jumps while the slider is moved.
    element("caution").classList.toggle("idle", impact.e === 1);
    const end = frozen ?? charts.widest(impact);
    scales = {
      forces: charts.forces(element("forces"), wide.forces, impact),
      velocity: charts.velocity(element("velocity"), wide.velocity, impact),
      incidence: charts.incidence(
        element("incidence"), wide.incidence, impact, state.view, list, end),
    };
    ball.prepare(impact);
    show_numbers();
    show_controls();
    show_models();
    const motion = { velocity: impact.x, approach: 1, normal: 0, friction: 0 };
    show_energies(1, "before", energies(motion, false));
    const left = { ...motion, velocity: impact.result.velocity, approach: impact.e };
    show_energies(3, "after", energies(left, true));
    show_time();
    document.dispatchEvent(new CustomEvent("impact", { detail: impact }));
  }

  // ---- what the reader does -----------------------------------------------------------------

  let pressed = false;
  for (const kind of ["pointerdown", "pointerup", "pointercancel"]) {
    addEventListener(kind, () => (pressed = kind === "pointerdown"), true);
  }

  // At the end of a change, one entry in the history of the browser: Back undoes the change.
  let waiting;
  function remember() {
    clearTimeout(waiting);
    waiting = setTimeout(() => {
      if (pressed) remember();
      else if (location.hash !== `#${address()}`) history.pushState(null, "", `#${address()}`);
    }, SETTLED);
  }

  function changed() {
    refresh();
    remember();
  }

  // What a reader has typed, or NaN.
  function parsed(text) {
    const trimmed = text.trim();
    return NUMBER.test(trimmed) ? Number(trimmed.replace(",", ".")) : NaN;
  }

  function type(name, value) {
    set(name, value);
    element("refused").textContent = "";
    changed();
  }

  const allowed = (name, value) =>
    value >= Number(element(name).min) && value <= Number(element(name).max);

  // Numbers count while they are typed; one that is not allowed is refused when it is complete.
  function on_typing(name) {
    const box = element(`${name}-number`);
    box.addEventListener("input", () => {
      const value = parsed(box.value);
      if (allowed(name, value)) type(name, value);
    });
    box.addEventListener("change", () => {
      if (!allowed(name, parsed(box.value))) {
        const label = document.querySelector(`label[for=${name}]`).textContent;
        const { min, max } = element(name);
        element("refused").textContent = `${label}: \u201C${box.value}\u201D is refused. ` +
          `Allowed are numbers from ${min} to ${max}.`;
      }
      show_typed(name);
    });
    box.addEventListener("blur", () => show_typed(name));
    box.addEventListener("keydown", (event) => {
      const way = { ArrowUp: 1, ArrowDown: -1 }[event.key];
      if (!way) return;
      event.preventDefault();
      type(name, Number((state[name] + way * Number(box.dataset.step)).toFixed(4)));
      show_typed(name);
    });
  }

  for (const name of SLIDERS) {
    const slider = element(name);
    state[name] = Number(slider.value);
    slider.addEventListener("input", () => type(name, slider.value));
    on_typing(name);
  }
  for (const name of models.TOGGLES) {
    element(`model-${name}`).addEventListener("change", () => {
      state.models = models.TOGGLES.filter((one) => element(`model-${one}`).checked);
      changed();
    });
  }
  element("view").addEventListener("change", (event) => {
    state.view = event.target.value;
    changed();
  });
  for (const button of document.querySelectorAll(".preset")) {
    button.addEventListener("click", () => go(button.dataset.state));
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
    const end = 2 + state.restitution;
    if (t < end) {
      const slow = t >= 0 && t < end - 1 ? MILLISECONDS : FLIGHT;
      t = Math.min(t + (passed / slow) * Number(element("speed").value), end);
      rested = 0;
      show_time();
    } else if ((rested += passed) > REST) {
      t = -1;
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
    const typing = event.target.matches("a, button, select, summary, input:not([type=range])");
    if (event.key !== " " || typing) return;
    event.preventDefault();
    play(!playing);
  });

  function go_to(time) {
    play(false);
    t = Math.min(Math.max(time, -1), 2 + state.restitution);
    show_time();
  }
  element("time").addEventListener("input", (event) => go_to(Number(event.target.value)));

  // Pressing or dragging in a chart: the time there, or the incidence. A mouse acts at once. A
  // finger acts by a tap, or once it has moved more along the chart than across it: to scroll the
  // page, starting on a chart, changes nothing.
  function on_drag(svg, action, begin = () => {}, end = () => {}) {
    let start = null; // where it was pressed
    let dragging = false;
    const drag = (event) => {
      if (!dragging) {
        dragging = true;
        svg.setPointerCapture(event.pointerId);
        begin();
      }
      action(event);
    };
    const away = (event) => [event.clientX - start.x, event.clientY - start.y].map(Math.abs);
    const finish = () => {
      if (dragging) end();
      start = null;
      dragging = false;
    };
    svg.addEventListener("pointerdown", (event) => {
      if (!event.isPrimary || event.button !== 0) return;
      start = { x: event.clientX, y: event.clientY };
      if (event.pointerType !== "touch") drag(event);
    });
    svg.addEventListener("pointermove", (event) => {
      if (!start || !event.isPrimary) return;
      const [along, across] = away(event);
      if (dragging || (along > INTENT && along > across)) drag(event);
      else if (across > INTENT) finish();
    });
    svg.addEventListener("pointerup", (event) => {
      if (start && !dragging) drag(event);
      finish();
    });
    svg.addEventListener("pointercancel", finish);
  }
  on_drag(element("forces"), (event) => go_to(scales.forces.at(event)));
  on_drag(element("velocity"), (event) => go_to(scales.velocity.at(event)));
  on_drag(
    element("incidence"),
    (event) => {
      set("angle", scales.incidence.angle(event));
      changed();
    },
    () => (frozen = charts.widest(impact)),
    () => {
      frozen = undefined;
      refresh();
    },
  );

  // ---- how it looks, and what a reader takes along --------------------------------------------

  const root = document.documentElement;

  // Some browsers keep nothing for a page that is a file.
  function stored(name) {
    try {
      return localStorage.getItem(name);
    } catch {
      return null;
    }
  }

  function store(name, value) {
    try {
      localStorage.setItem(name, value);
    } catch {
      // It is forgotten with the page.
    }
  }

  const is_dark = () =>
    root.dataset.theme
      ? root.dataset.theme === "dark"
      : matchMedia("(prefers-color-scheme: dark)").matches;

  function look({ theme, mode }) {
    if (theme) root.dataset.theme = theme;
    if (mode) root.dataset.mode = mode;
    element("do-dark").ariaPressed = is_dark();
    const projector = root.dataset.mode === "projector";
    element("do-projector").ariaPressed = projector;
    element(projector ? "rebound" : "stage").after(element("controls"));
  }

  const tell = (text) => (element("told").textContent = text);

  const about_impact = () =>
    `θ = ${charts.number(state.angle)}°, µ = ${charts.number(state.friction)}, ` +
    `e = ${charts.number(state.restitution)}, ν = ${charts.number(state.poisson_ratio, 3)}, ` +
    `m₂/m₁ = ${charts.number(state.mass_ratio)}`;

  const ACTIONS = {
    dark() {
      const theme = is_dark() ? "light" : "dark";
      store("explorer-theme", theme);
      look({ theme });
    },
    projector() {
      const mode = root.dataset.mode === "projector" ? "desk" : "projector";
      store("explorer-mode", mode);
      look({ mode });
      refresh();
    },
    async copy() {
      const link = `${location.href.split("#")[0]}#${address()}`;
      const copied = await files.copy(link);
      tell(copied ? "The link is copied." : `Copy this link: ${link}`);
    },
    csv() {
      const text = files.csv(impact, state, models.outcomes(list, impact), scales.incidence);
      files.save("impact.csv", new Blob([text], { type: "text/csv" }));
      tell("impact.csv has the curves shown and the numbers of this impact.");
    },
    async ball() {
      const above = [words.sentence(impact), words.centre(impact)];
      const below = [`Lumped model: ${about_impact()}`];
      files.save("ball.png", await files.picture(element("ball-svg"), above, below));
      tell("ball.png has the picture of the ball.");
    },
    async curve() {
      const legend = scales.incidence.curves.map(({ style }) =>
        [element("incidence").querySelector(`polyline.${style}`), models.NAMES[style]]);
      const shown = element("view").selectedOptions[0].textContent;
      const unit = document.querySelector(".above [data-view]:not([hidden])").textContent;
      const along = document.querySelector(".under [data-view]:not([hidden])").textContent;
      const above = [`${shown}: ${unit}`.replace(/\s+/g, " ")];
      const below = [`against ${along}`.replace(/\s+/g, " "), ...legend, about_impact()];
      files.save("curve.png", await files.picture(element("incidence"), above, below));
      tell("curve.png has the curve.");
    },
  };
  for (const name in ACTIONS) element(`do-${name}`).addEventListener("click", ACTIONS[name]);

  // ---- start --------------------------------------------------------------------------------

  // The state of the page's address; what that does not say is as the page opens.
  function restore() {
    clearTimeout(waiting);
    state.models = models.TOGGLES;
    state.view = "velocity";
    const named = document.querySelector(".preset[data-opening]");
    const opening = named ?? document.querySelector(".preset");
    if (opening) read(opening.dataset.state);
    read(location.hash.slice(1));
    refresh();
  }

  look({ theme: stored("explorer-theme"), mode: stored("explorer-mode") });
  restore();
  play(playing);
  addEventListener("popstate", () => {
    const place = location.hash.slice(1);
    // A place on the page, as #main, says no state.
    if (place === "" || place.includes("=")) restore();
  });
  let width = innerWidth;
  addEventListener("resize", () => {
    if (innerWidth !== width) refresh();
    width = innerWidth;
  });

  // Goes to the state that an address says, as a preset does.
  function go(to) {
    read(to);
    t = beginning();
    changed();
  }

  return { go, address, impact: () => impact };
})();
