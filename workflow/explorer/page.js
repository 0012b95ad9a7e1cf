"use strict";

// The page: its controls, its address, and what moves. State is what the controls show and what
// stands behind # in the address; everything else follows from it.
const page = (() => {
  const element = (id) => document.getElementById(id);
  const SLIDERS = ["angle", "friction", "restitution", "poisson_ratio", "mass_ratio", "speed", "spin",
    "table", "compliance", "radius", "gravity"];
  // Compliance along the surface, over that of the body; radius in mm, gravity in m/s^2.
  const OPENING = {
    angle: 50, friction: 0.4, restitution: 1, poisson_ratio: 0.3, mass_ratio: 3.5, compliance: 1,
    speed: 5, spin: 0, table: 0, radius: 25, gravity: 9.81, view: "velocity",
  };
  const ALWAYS = ["angle", "friction", "restitution", "poisson_ratio", "mass_ratio"]; // in the address
  // Less is none: a stiffer spring has too many phases, and a ball would fall for too long.
  const [LEAST, LEAST_GRAVITY] = [0.005, 0.1];
  const SETTLED = 300; // ms without a change, after which the address says the state
  const TOLD = 5000; // ms that a message stays
  const INVITATION = "Press Throw, or drag a ball";
  // A comma is read as a decimal point, never as a separator of thousands.
  const NUMBER = /^[+-]?(\d+([.,]\d*)?|[.,]\d+)(e[+-]?\d+)?$/i;
  const still = matchMedia("(prefers-reduced-motion: reduce)");
  const root = document.documentElement;
  // Its address: of a copy that is shown inside a notebook, what that says of it. `?stage` is the stage
  // alone, for the frames of the lectures, `&hall` that of slides, `&ask` asks before it shows. Keys that
  // the stage does not use turn slides.
  const place = root.dataset.address ? new URL(root.dataset.address, "file:///") : location;
  const query = new URLSearchParams(place.search);
  const [embedded, hall] = [query.has("stage"), query.has("hall")];

  const state = { ...OPENING };
  let impact; // the first bounce, solved from the state
  let flights; // of both balls
  let chart; // what it shows, and its scale
  let told; // how far the show was when the line below the stage was written
  let playing = false;
  let now = 0; // s of the show
  let lone = false; // one ball alone, as the reader chose
  let asked = query.has("ask") || !embedded ? "guess" : undefined; // the step of the question
  const tells = !place.hash.includes("="); // this page explains what it asked, not the lecture round it
  let guess; // of the place where the ball will be, in m from the hand

  // ---- state --------------------------------------------------------------------------------

  const limits = (name) => [Number(element(name).min), Number(element(name).max)];

  const name_of = (name) =>
    document.querySelector(`label[for=${name}]`)?.textContent.trim().replace(/:$/, "") ?? name;

  const refuse = (name, text, allowed) =>
    element("refused").append(
      `${name_of(name)}: \u201C${text}\u201D is refused. Allowed: ${allowed}. `);

  // What a reader has typed, or NaN.
  function parsed(text) {
    const trimmed = text.trim();
    return NUMBER.test(trimmed) ? Number(trimmed.replace(",", ".")) : NaN;
  }

  const is_allowed = (name, value) => value >= limits(name)[0] && value <= limits(name)[1];

  const between = (name) => `numbers from ${limits(name).join(" to ")}`;

  // The state that an address says; what it does not say, or is not allowed, is as the page opens.
  function read(address) {
    const given = new URLSearchParams(address);
    const values = { ...OPENING };
    for (const name of SLIDERS) {
      if (!given.has(name)) continue;
      const value = parsed(given.get(name));
      if (is_allowed(name, value)) values[name] = value;
      else refuse(name, given.get(name), between(name));
    }
    const view = given.get("view") ?? OPENING.view;
    const known = [...element("view").options].map((option) => option.value);
    if (known.includes(view)) values.view = view;
    else refuse("view", view, known.join(", "));
    return values;
  }

  // What is as the page opens is left out, but for the first controls.
  function address(values = state) {
    const written = (value) => typeof value === "number" ? Number(value.toFixed(4)) : value;
    const said = Object.keys(OPENING)
      .filter((name) => ALWAYS.includes(name) || values[name] !== OPENING[name])
      .map((name) => [name, written(values[name])]);
    return new URLSearchParams(said).toString();
  }

  // The same of the throw alone, whatever is looked at.
  const throw_address = (values) => address({ ...values, view: OPENING.view });

  // ---- the throw ----------------------------------------------------------------------------

  // zeta^2 of a body that strikes one of the same material, or a rigid one.
  const stiffness_ratio = (nu) => (2 - nu) / (2 * (1 - nu));

  // The throw as the flights need it, in SI, with the groups of its impacts.
  function thrown() {
    const { friction: mu, restitution: e, mass_ratio: beta } = state;
    const compliance = state.compliance < LEAST ? 0 : state.compliance;
    const groups = { mu, e, beta, zeta2: compliance * stiffness_ratio(state.poisson_ratio) };
    const radius = state.radius / 1000;
    const table = state.table > 4 * radius ? state.table : 0;
    const gravity = state.gravity < LEAST_GRAVITY ? 0 : state.gravity;
    return { ...state, radius, table, gravity, groups };
  }

  const LANES = { upper: "rigid", lower: "lumped" }; // the contacts of both balls

  // Both flights, and the impact that the chart shows: the first bounce of the ball with the spring.
  function solved(throw_) {
    const { groups } = throw_;
    flights = Object.fromEntries(Object.entries(LANES).map(([lane, style]) =>
      [lane, flight.fly(throw_, (x) => models.contact(style, { ...groups, x }))]));
    const { x, ball } = flights.lower.find(({ kind }) => kind === "bounce");
    const limit = solver.slip_throughout_limit(groups.beta, groups.zeta2, groups.e);
    return { ...groups, x, before: ball, limit };
  }

  // ---- drawing ------------------------------------------------------------------------------

  // What changes while time runs.
  function show_time() {
    stage.show(now);
    element("time").value = now;
    show_story();
  }

  // The line below the stage: what has happened up to now.
  function show_story() {
    const { bounces: count, over, said: moment } = stage.progress(now);
    element("time").ariaValueText = moment;
    if (over && asked === "guess" && guess !== undefined) ask("met");
    const key = `${count} ${over} ${asked} ${now > 0}`;
    if (told === key) return;
    told = key;
    const [upper, lower] = Object.keys(LANES).map((lane) => flight.bounces(flights[lane]));
    const given = thrown();
    const said = asked ? STEPS[asked][0](lower)
      : words.story({ upper, lower, given }, count, over, impact.zeta2 > 0, lone);
    if (element("sentence").textContent !== said) element("sentence").textContent = said;
  }

  function show_controls() {
    for (const name of SLIDERS) {
      element(name).value = state[name];
      const typed = element(`${name}-number`);
      if (typed !== document.activeElement) show_typed(name);
    }
    element("stiffness_ratio").textContent = charts.number(stiffness_ratio(state.poisson_ratio), 3);
    element("given").textContent =
      `Ball of radius ${charts.number(state.radius)}\u00A0mm, drawn larger; gravity ` +
      (impact.before.gravity ? `${charts.number(impact.before.gravity)}\u00A0m/s\u00B2.` : "is left out.");
    element("no-ball").hidden = state.mass_ratio >= 2;
    element("view").value = state.view;
    element("time").max = stage.duration();
    for (const part of document.querySelectorAll("[data-view]")) {
      part.hidden = !part.dataset.view.split(" ").includes(state.view);
    }
    for (const button of document.querySelectorAll(".body")) {
      button.ariaPressed = Number(button.dataset.mass_ratio) === state.mass_ratio;
    }
    const here = throw_address(state);
    const option = presets.find(([written]) => written === here)?.[1];
    element("preset").value = option?.value ?? "";
    element("about").innerHTML = option?.dataset.about ?? "";
    const hollow = element("thin-shell").ariaPressed === "true";
    element("stage-svg").classList.toggle("shell", hollow);
    element("caution").hidden = state.restitution === 1;
  }

  function show_names() {
    const [with_spring, without, taken] = innerWidth < 600 ? ["spring", "no spring", "no spring"]
      : ["contact with a spring", "contact without a spring", "its spring is taken away"];
    stage.part("upper-name").textContent = `\u25CF ${without}:`;
    stage.part("lower-name").textContent = `\u25CF ${impact.zeta2 ? with_spring : taken}:`;
  }

  const show_typed = (name) =>
    (element(`${name}-number`).value = Number(state[name].toFixed(3)));

  function refresh() {
    const throw_ = thrown();
    // Read before anything changes, which would cost time. Type is larger in a wide frame, and the
    // chart is drawn larger with it.
    const svg = element("incidence");
    const wide = (Math.max(svg.clientWidth, 160) * 16) / parseFloat(getComputedStyle(root).fontSize);
    impact = solved(throw_);
    stage.prepare(throw_, flights, { hall, lone: lone || bare(), bare: bare() });
    stage.put_guess(bare() ? guess : undefined);
    told = undefined;
    now = Math.min(now, stage.duration());
    if (!embedded && element("rebound").open) {
      chart = charts.incidence(svg, wide, impact, state.view);
    }
    show_controls();
    show_names();
    show_time();
  }

  // ---- what the reader does -----------------------------------------------------------------

  let pressed = false;
  for (const kind of ["pointerdown", "pointerup", "pointercancel"]) {
    addEventListener(kind, () => (pressed = kind === "pointerdown"), true);
  }

  // At the end of a change, one entry in the history of the browser: Back undoes the change. A stage
  // in a frame leaves the history of its page alone.
  let waiting;
  function remember() {
    clearTimeout(waiting);
    waiting = setTimeout(() => {
      if (pressed) remember();
      else if (place === location && location.hash !== `#${address()}`) {
        const how = embedded ? "replaceState" : "pushState";
        history[how](null, "", `#${address()}`);
      }
    }, SETTLED);
  }

  let due = false; // what the next frame draws: not more than once in a frame
  function redraw() {
    if (due) return;
    due = true;
    requestAnimationFrame(() => {
      due = false;
      refresh();
    });
  }

  function changed() {
    remember();
    redraw();
  }

  function take(values) {
    for (const [name, value] of Object.entries(values)) {
      const [least, most] = limits(name);
      state[name] = Math.min(Math.max(value, least), most);
    }
    element("refused").textContent = "";
    if (!playing) {
      now = 0;
      play(false);
    }
    changed();
  }

  // Numbers count while they are typed; one that is not allowed is refused when it is complete.
  function on_typing(name) {
    const box = element(`${name}-number`);
    box.addEventListener("input", () => {
      const value = parsed(box.value);
      if (is_allowed(name, value)) take({ [name]: value });
    });
    box.addEventListener("change", () => {
      if (!is_allowed(name, parsed(box.value))) {
        element("refused").textContent = "";
        refuse(name, box.value, between(name));
      }
      show_typed(name);
    });
    box.addEventListener("blur", () => show_typed(name));
    box.addEventListener("keydown", (event) => {
      const way = { ArrowUp: 1, ArrowDown: -1 }[event.key];
      if (!way) return;
      event.preventDefault();
      take({ [name]: Number((state[name] + way * Number(box.dataset.step)).toFixed(4)) });
      show_typed(name);
    });
  }

  for (const name of SLIDERS) {
    const slider = element(name);
    slider.addEventListener("input", () => take({ [name]: Number(slider.value) }));
    on_typing(name);
  }
  element("view").addEventListener("change", (event) => {
    state.view = event.target.value;
    changed();
  });
  element("preset").addEventListener("change", (event) => {
    if (event.target.value) go(event.target.value);
  });
  element("rebound").addEventListener("toggle", redraw);
  for (const button of document.querySelectorAll(".body")) {
    button.addEventListener("click", () => take({ mass_ratio: Number(button.dataset.mass_ratio) }));
  }

  // ---- the show -----------------------------------------------------------------------------

  let last; // time of the frame before
  function frame(time) {
    if (!playing) return;
    const passed = Math.min(time - (last ?? time), 100) / 1000;
    last = time;
    now = Math.min(now + passed, stage.duration());
    show_time();
    if (now >= stage.duration()) play(false);
    else requestAnimationFrame(frame);
  }

  // Throws the ball, or goes on. Who wants no motion sees one moment after the other.
  function play(on) {
    if (on && element("play").disabled) return;
    if (on && still.matches) return next_moment();
    if (on && now >= stage.duration() - 1e-3) now = 0;
    playing = on;
    last = undefined;
    const within = now > 0 && now < stage.duration() - 1e-3;
    element("play").textContent = on ? "\u275A\u275A Pause" : within ? "\u25B6 Go on" : "\u25B6 Throw";
    if (on) requestAnimationFrame(frame);
  }

  // Throws the ball from the hand.
  function throw_ball() {
    now = 0;
    play(true);
  }

  // The next moment at which something begins; a question without a magnifying glass has but the end.
  function next_moment() {
    const all = bare() ? [stage.duration()] : stage.moments();
    go_to(all.find((one) => one > now + 1e-6) ?? all[0]);
  }

  function go_to(time) {
    now = Math.min(Math.max(time, 0), stage.duration());
    play(false);
    show_time();
  }

  element("play").addEventListener("click", () => play(!playing));
  element("do-start").addEventListener("click", () => go_to(0));
  element("do-moment").addEventListener("click", next_moment);
  element("do-lone").addEventListener("click", () => {
    lone = !lone;
    element("do-lone").ariaPressed = lone;
    refresh();
  });
  element("time").addEventListener("input", (event) => go_to(Number(event.target.value)));
  document.addEventListener("keydown", (event) => {
    const own = "a, button, select, summary, [role], input:not([type=range])";
    const used = "input, select, [role]" + (event.key === " " ? `, ${own}` : "");
    if (embedded && !event.target.matches(used)) parent.postMessage({ key: event.key }, "*");
    if (event.key !== " " || event.target.matches(own)) return;
    event.preventDefault();
    play(!playing);
  });

  // The ball in the hand: dragged, it aims, and let go, it flies. The knob on its rim gives it spin.
  function on_hand(name, move, release) {
    const handle = stage.part(name);
    // A touch here throws, it does not scroll; browsers ignore touch-action inside SVG.
    handle.addEventListener("touchstart", (event) => event.preventDefault(), { passive: false });
    handle.addEventListener("pointerdown", (event) => {
      if (!event.isPrimary || event.button !== 0 || asked) return;
      go_to(0);
      stage.hold(true);
      handle.setPointerCapture(event.pointerId);
    });
    handle.addEventListener("pointermove", (event) => {
      if (!handle.hasPointerCapture(event.pointerId)) return;
      take(move(event));
    });
    const let_go = () => {
      stage.hold(false);
      refresh();
    };
    handle.addEventListener("pointerup", () => {
      let_go();
      release();
    });
    handle.addEventListener("pointercancel", let_go);
  }
  on_hand("grasp", (event) => stage.aim_at(event, "lower"), throw_ball);
  on_hand("other-grasp", (event) => stage.aim_at(event, "upper"), throw_ball);
  on_hand("knob", (event) => ({ spin: Math.round(stage.spin_at(event) / 5) * 5 }), () => {});
  const invite = (text) => (stage.part("invitation").textContent = text);
  stage.part("grasp").addEventListener("focus", ({ target }) => {
    if (target.matches(":focus-visible")) {
      invite("\u2190 \u2192 angle, \u2191 \u2193 speed, Page Up/Down spin, Enter throws");
    }
  });
  stage.part("grasp").addEventListener("blur", () => invite(INVITATION));
  stage.part("grasp").addEventListener("keydown", (event) => {
    const turn = (name, by) => ({ [name]: Number((state[name] + by).toFixed(4)) });
    const change = {
      ArrowRight: turn("angle", 1), ArrowLeft: turn("angle", -1), ArrowUp: turn("speed", 0.2),
      ArrowDown: turn("speed", -0.2), PageUp: turn("spin", 20), PageDown: turn("spin", -20),
    }[event.key];
    if (change && !asked) take(change);
    else if (event.key === "Enter") throw_ball();
    else if (event.key === " ") play(!playing);
    else return;
    event.preventDefault();
  });

  // ---- the question ---------------------------------------------------------------------------

  // Who comes without a throw is asked before he sees: where one ball will be; then, with its twin whose
  // contact has no spring, why. Each step has its sentence, what its button says, and what comes next.
  const COUNT = ["", "only", "second", "third", "fourth", "fifth"];
  const STEPS = {
    guess: [(bounces) => now > 0 ? "Your guess stands." : guess === undefined
      ? `Where will the ball be, on its way up after its ${COUNT[bounces.length]} bounce? Click on that place.`
      : "Your guess stands. Now press Throw.", "Skip the question"],
    met: [() => {
      const off = stage.last_place() - guess;
      return Math.abs(off) < 0.1 ? "Well guessed: there it is." :
        `It is ${Math.abs(off).toFixed(1)} m ${off < 0 ? "left" : "right"} of your guess.`;
    }, "Compare it with a twin", "twin"],
    twin: [() => "Two balls, thrown alike. One thing in their contacts differs: see the magnifying glasses. Why do the " +
      `balls part? ${tells ? "Say it in your words, then press Explain." : "Keep your answer: the lecture comes back to it."}`,
    "Explain"],
  };

  // One ball is seen, and no magnifying glass.
  const bare = () => asked === "guess" || asked === "met";

  function ask(step) {
    asked = step;
    if (step) root.dataset.asks = step;
    else delete root.dataset.asks;
    element("do-ask").textContent = step && (step !== "twin" || tells) ? STEPS[step][1] : "";
    invite(step === "guess" ? "" : INVITATION);
    element("play").disabled = step === "guess" && guess === undefined;
    refresh();
  }

  function put_guess(there) {
    guess = Math.min(Math.max(there, -9), 9);
    element("play").disabled = false;
    const handle = stage.part("guess");
    handle.setAttribute("aria-valuenow", guess.toFixed(2));
    handle.setAttribute("aria-valuetext", `${guess.toFixed(2)} m from the hand`);
    told = undefined;
    stage.put_guess(guess);
    show_story();
  }

  element("do-ask").addEventListener("click", () => {
    const next = STEPS[asked][2];
    ask(next);
    if (next) throw_ball();
  });
  const guesses = () => asked === "guess" && !playing && now === 0;
  element("stage-svg").addEventListener("click", (event) => {
    if (guesses() && !event.target.closest("#stage-hand")) put_guess(stage.place_at(event));
  });
  stage.part("guess").addEventListener("keydown", (event) => {
    const by = { ArrowLeft: -0.1, ArrowRight: 0.1, ArrowDown: -0.1, ArrowUp: 0.1 }[event.key];
    if (!by || !guesses()) return;
    event.preventDefault();
    put_guess((guess ?? 0) + by);
  });

  // ---- how it looks, and what a reader takes along --------------------------------------------

  // The page round a stage says when it becomes dark or light.
  addEventListener("message", ({ data }) => {
    if (embedded && ["dark", "light"].includes(data?.theme)) root.dataset.theme = data.theme;
  });

  let telling;
  function tell(text) {
    element("told").textContent = text;
    clearTimeout(telling);
    telling = setTimeout(() => (element("told").textContent = ""), TOLD);
  }

  const about_impact = () =>
    `θ = ${charts.number(state.angle)}°, µ = ${charts.number(state.friction)}, ` +
    `e = ${charts.number(state.restitution)}, ν = ${charts.number(state.poisson_ratio, 3)}, ` +
    `m₂/m₁ = ${charts.number(state.mass_ratio)}, compliance ${charts.number(state.compliance)}, ` +
    `${charts.number(state.speed)} m/s, ${charts.number(state.spin)} rad/s` +
    (state.table ? `, table at ${charts.number(state.table)} m` : "");

  const ACTIONS = {
    async copy() {
      const link = `${location.href.split("#")[0]}#${address()}`;
      const copied = await files.copy(link);
      const where = location.protocol === "file:"
        ? " It opens on this machine alone: for others put explorer.html on a web server, or send it." : "";
      tell(copied ? `The link is copied.${where}` : `Copy this link: ${link}`);
    },
    csv() {
      const text = files.csv(impact, state, chart);
      files.save("impact.csv", new Blob([text], { type: "text/csv" }));
      tell("impact.csv has the curves shown and the numbers of this impact.");
    },
    async ball() {
      const above = [element("sentence").textContent];
      files.save("stage.png", await files.picture(element("stage-svg"), above, [about_impact()]));
      tell("stage.png has the picture of the stage.");
    },
    async curve() {
      const legend = chart.curves.map(({ style }) =>
        [element("incidence").querySelector(`polyline.${style}`), models.NAMES[style]]);
      const shown = element("view").selectedOptions[0].textContent;
      const of = (place) => files.plain(document.querySelector(`${place} [data-view]:not([hidden])`));
      const [unit, along] = [of(".above"), of(".under")];
      const above = [`${shown}: ${unit}`];
      const below = [`against ${along}`, ...legend, about_impact()];
      files.save("curve.png", await files.picture(element("incidence"), above, below));
      tell("curve.png has the curve.");
    },
  };
  for (const name in ACTIONS) element(`do-${name}`).addEventListener("click", ACTIONS[name]);

  // ---- start --------------------------------------------------------------------------------

  // The balls and figures of the menu, by the address that the page writes for them.
  const presets = [...element("preset").options].filter(({ value }) => value)
    .map((option) => [throw_address(read(option.value)), option]);

  // Takes the state that an address says. Who names a chart sees it.
  function enter(said) {
    element("refused").textContent = "";
    Object.assign(state, read(said));
    if (/\bview=/.test(said)) element("rebound").open = true;
  }

  // The state of the page's address; without one, that of the first ball.
  function restore() {
    clearTimeout(waiting);
    const said = place.hash.slice(1);
    enter(said.includes("=") ? said : presets[0][1].value);
    now = 0;
    playing = false;
    // Who has a throw is not asked. Back asks nobody again.
    ask(said.includes("=") && !query.has("ask") ? undefined : asked);
    play(false);
  }

  if (embedded) root.dataset.mode = hall ? "stage hall" : "stage";
  restore();
  addEventListener("popstate", () => {
    // A place on the page, as #main, says no state.
    if (location.hash === "" || location.hash.includes("=")) restore();
  });
  // Also when the words below it take more lines.
  new ResizeObserver(redraw).observe(element("stage-svg"));
  addEventListener("resize", redraw);

  // Goes to the state that an address says, as a preset does.
  function go(to) {
    enter(to);
    go_to(0);
    changed();
  }

  return { go };
})();
