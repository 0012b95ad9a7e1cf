"use strict";

// A superball thrown at the floor under a table, and a ball thrown alike whose foot merely stops.
// The model is that of stronge1994.curves.superball: solid spheres, no gravity, three impacts.
// Velocities are positive forwards and up, spin clockwise in the side view.
const superball = (() => {
  const RADIUS = 0.025; // m
  const GAP = 0.7; // m, between floor and table
  const REACH = GAP - 2 * RADIUS; // of the centre
  const BETA = 3.5; // m2/m1 of a solid sphere
  const IMPACTS = ["floor", "table", "floor"];
  const MODELS = {
    continuum: (...groups) => spheres.velocity(...groups, spheres.VISCOUS),
    lumped: (...groups) => solver.rebound(...groups).velocity,
    rigid: (x, beta, zeta2, e) => solver.rigid_rebound(x, beta, e).velocity,
  };
  const OTHER = { continuum: "lumped", lumped: "continuum" };

  // ---- the path -----------------------------------------------------------------------------

  function later(state, passed) {
    const [place, height, turn] = [["place", "along"], ["height", "up"], ["turn", "spin"]].map(
      ([what, rate]) => state[what] + state[rate] * passed);
    return { ...state, time: state.time + passed, place, height, turn };
  }

  // States before the first impact, after each, and half way to the wall that would come next.
  function fly({ along, down, spin, friction, restitution: e, poisson_ratio: nu }, model) {
    const zeta2 = (2 - nu) / (2 * (1 - nu));
    const path = [{ time: 0, place: 0, height: REACH / 2, turn: 0, along, up: -down, spin }];
    let way = REACH / 2;
    for (const wall of IMPACTS) {
      const before = later(path[path.length - 1], way / Math.abs(path[path.length - 1].up));
      const side = wall === "floor" ? 1 : -1;
      // Clockwise spin moves the foot of the ball backwards, its top forwards.
      const contact = before.along - side * RADIUS * before.spin;
      const unit = friction * Math.abs(before.up);
      const x = Math.abs(contact) / unit;
      const change = Math.sign(contact) * unit * (MODELS[model](x, BETA, zeta2, e) - x);
      // The angular momentum about the contact stays: of the change, 2/7 goes to the centre.
      path.push({
        ...before,
        along: before.along + change / BETA,
        up: -e * before.up,
        spin: before.spin - (side * (1 - 1 / BETA) * change) / RADIUS,
      });
      way = REACH;
    }
    const last = path[path.length - 1];
    return [...path, later(last, REACH / 2 / Math.abs(last.up))];
  }

  // ---- the picture --------------------------------------------------------------------------

  const SLOWER = 10;
  const [METRE, SPEED] = [400, 16]; // units of the picture for 1 m, and for 1 m/s
  const [LEFT, BOTTOM] = [60, 294]; // the centre at place 0 and at height 0
  const WIDTH = 1.5; // m, in the picture to the right of the hand
  const scene = document.getElementById("superball-scene");
  const form = document.getElementById("superball-throw");
  const said = document.getElementById("superball-said");
  const still = matchMedia("(prefers-reduced-motion: reduce)");
  let flights; // of the ball and of the ghost
  let frame;

  const signed = (value, digits) => {
    const text = Math.abs(value).toFixed(digits);
    return `${Number(text) === 0 ? "" : value < 0 ? "\u2212" : "+"}${text}`;
  };
  const turning = (spin) =>
    Math.abs(spin) < 0.5 ? "" : spin > 0 ? ", clockwise" : ", anticlockwise";
  const on_screen = ({ place, height }) => [LEFT + METRE * place, BOTTOM - METRE * height];
  const arrow = (state) => {
    const [x, y] = on_screen(state);
    return `M${x},${y}l${SPEED * state.along},${-SPEED * state.up}`;
  };

  function draw(time) {
    for (const [name, path] of Object.entries(flights)) {
      const passed = path.filter((state) => state.time <= time);
      const last = passed[passed.length - 1];
      const now = later(last, time - last.time);
      const part = (selector) => scene.querySelector(`.${name} ${selector}`);
      part(".trace").setAttribute("d", `M${[...passed, now].map(on_screen).join("L")}`);
      part(".speed").setAttribute("d", arrow(now));
      const turn = (now.turn * 180) / Math.PI;
      part(".round").setAttribute("transform", `translate(${on_screen(now)})rotate(${turn})`);
      if (name === "ball") {
        document.getElementById("superball-now").textContent =
          `now: ${signed(now.along, 1)} m/s along, spin ${signed(now.spin, 0)} rad/s` +
          turning(now.spin);
      }
    }
  }

  function direction({ along }) {
    const speed = `${Math.abs(along).toFixed(1)}\u00A0m/s along the floor`;
    return `${along < 0 ? "back towards you" : "on, away from you,"} with ${speed}`;
  }

  // What follows from the form, at once.
  function show() {
    cancelAnimationFrame(frame);
    for (const input of form.querySelectorAll("[type=range]")) {
      const value = Number(input.value);
      const digits = Math.max(0, -Math.floor(Math.log10(Number(input.step))));
      input.parentNode.querySelector("span").textContent =
        input.name === "spin" ? signed(value, 0) : value.toFixed(digits);
    }
    const { model, ...given } = Object.fromEntries(new FormData(form));
    for (const name in given) given[name] = Number(given[name]);
    flights = { ghost: fly(given, "rigid"), ball: fly(given, model) };
    const { ghost, ball } = flights;
    const [end] = ball.slice(-1);
    const other = fly(given, OTHER[model]);
    const outside = end.place < -LEFT / METRE || end.place > WIDTH;
    said.textContent =
      `After floor, table and floor it flies ${direction(end)}. The ball whose foot merely stops` +
      ` flies ${direction(ghost[4])}. In the ${OTHER[model]} model the ball flies` +
      ` ${direction(other[4])}.${outside ? " It is outside the picture." : ""}`;
    const cells = (one) => `<td>${signed(one.along, 1)}</td><td>${signed(one.spin, 0)}</td>`;
    document.querySelector("#superball-numbers tbody").innerHTML = ["the throw", ...IMPACTS]
      .map((what, i) => `<tr><th scope="row">${what}</th>${cells(ball[i])}${cells(ghost[i])}</tr>`)
      .join("");
    scene.querySelector(".aim").setAttribute("d", arrow(ball[0]));
    draw(end.time);
  }

  function start() {
    show();
    document.getElementById("superball-heard").textContent = said.textContent;
    if (still.matches) return;
    const end = flights.ball[4].time;
    let first;
    frame = requestAnimationFrame(function step(now) {
      first ??= now;
      const time = Math.min((now - first) / 1000 / SLOWER, end);
      draw(time);
      if (time < end) frame = requestAnimationFrame(step);
    });
  }

  // ---- what the reader does -----------------------------------------------------------------

  form.addEventListener("input", show);
  form.addEventListener("submit", (event) => {
    event.preventDefault();
    start();
  });
  document.getElementById("superball-classic").addEventListener("click", () => {
    form.reset();
    start();
  });
  const hand = scene.querySelector(".hand");
  hand.addEventListener("pointerdown", (event) => hand.setPointerCapture(event.pointerId));
  hand.addEventListener("pointermove", (event) => {
    if (!hand.hasPointerCapture(event.pointerId)) return;
    const inverse = scene.getScreenCTM().inverse();
    const { x, y } = new DOMPoint(event.clientX, event.clientY).matrixTransform(inverse);
    form.elements.along.value = (x - LEFT) / SPEED;
    form.elements.down.value = (y - BOTTOM + (METRE * REACH) / 2) / SPEED;
    show();
  });
  hand.addEventListener("pointerup", start);
  show();

  return { fly };
})();
