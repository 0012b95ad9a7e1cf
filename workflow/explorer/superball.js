"use strict";

// A superball between floor and table, as in stronge1994/figures/superball: a solid sphere, no
// gravity. Velocities are positive forwards and up, spin clockwise in the side view.
const superball = (() => {
  const RADIUS = 0.025; // m
  const REACH = 0.7 - 2 * RADIUS; // m, of the centre between floor and table
  const BETA = 3.5; // m2/m1 of a solid sphere
  const WALLS = ["floor", "table", "floor"];
  const MODELS = {
    continuum: (...groups) => spheres.velocity(...groups, spheres.VISCOUS),
    lumped: (...groups) => solver.rebound(...groups).velocity,
    rigid: (x, beta, zeta2, e) => solver.rigid_rebound(x, beta, e).velocity,
  };

  function later(state, passed) {
    const { time, place, height, turn, along, up, spin } = state;
    return {
      ...state,
      time: time + passed,
      place: place + passed * along,
      height: height + passed * up,
      turn: turn + passed * spin,
    };
  }
  const after = (state, way) => later(state, way / Math.abs(state.up));

  // States at the throw, after each impact, and half way to the wall that would come next.
  function fly({ along, down, spin, friction, restitution: e, poisson_ratio: nu }, model) {
    const zeta2 = (2 - nu) / (2 * (1 - nu));
    let last = { time: 0, place: 0, height: REACH / 2, turn: 0, along, up: -down, spin };
    const path = [last];
    for (const wall of WALLS) {
      last = after(last, last.time ? REACH : REACH / 2);
      // Clockwise spin moves the foot of the ball backwards, its top forwards.
      const side = wall === "floor" ? -RADIUS : RADIUS;
      const contact = last.along + side * last.spin;
      const unit = friction * Math.abs(last.up);
      const x = Math.abs(contact) / unit;
      const change = Math.sign(contact) * unit * (MODELS[model](x, BETA, zeta2, e) - x);
      // 2/7 of the change goes to the centre, so the angular momentum about the contact stays.
      last = {
        ...last,
        along: last.along + change / BETA,
        up: -e * last.up,
        spin: last.spin + ((1 - 1 / BETA) * change) / side,
      };
      path.push(last);
    }
    return [...path, after(last, REACH / 2)];
  }

  const [METRE, SPEED] = [400, 16]; // 1 m and 1 m/s in the picture
  const [LEFT, MIDDLE] = [60, 176]; // the hand
  const part = (name) => document.querySelector(`#superball ${name}`);
  const [scene, form, hand, said] = ["svg", "form", ".hand", ".said"].map(part);
  let flights, frame;

  const text = (value, digits) =>
    (Number(value.toFixed(digits)) || 0).toFixed(digits).replace("-", "\u2212");
  const point = ({ place, height }) =>
    [LEFT + METRE * place, MIDDLE + METRE * (REACH / 2 - height)];
  const arrow = (state) => `M${point(state)}l${SPEED * state.along},${-SPEED * state.up}`;

  function draw(time) {
    for (const [name, path] of Object.entries(flights)) {
      const passed = path.filter((state) => state.time <= time);
      const now = later(passed.at(-1), time - passed.at(-1).time);
      const [trace, speed, ball] = part(`.${name}`).children;
      trace.setAttribute("d", `M${[...passed, now].map(point).join("L")}`);
      speed.setAttribute("d", arrow(now));
      const degrees = (now.turn * 180) / Math.PI;
      ball.setAttribute("transform", `translate(${point(now)})rotate(${degrees})`);
      const way = now.spin > 0 ? ", clockwise" : now.spin < 0 ? ", anticlockwise" : "";
      part(".turns").textContent = `Spin now: ${text(now.spin, 0)} rad/s${way}`;
    }
  }

  const direction = ({ along }) =>
    `${along < 0 ? "back towards you" : "away from you"} at ${Math.abs(along).toFixed(1)} m/s`;

  // All that follows from the form, the whole trace at once.
  function show() {
    cancelAnimationFrame(frame);
    const { model, ...given } = Object.fromEntries(new FormData(form));
    for (const name in given) {
      given[name] = Number(given[name]);
      form.elements[name].previousElementSibling.textContent = form.elements[name].value;
    }
    const other = model === "lumped" ? "continuum" : "lumped";
    const [stops, thrown, differs] = ["rigid", model, other].map((one) => fly(given, one));
    flights = { stops, thrown };
    said.textContent =
      `After floor, table and floor the superball flies ${direction(thrown[4])} along the floor.` +
      ` The ball whose lowest point only stops flies ${direction(stops[4])}.` +
      ` In the ${other} model the superball flies ${direction(differs[4])}.`;
    part("tbody").innerHTML = ["throw", ...WALLS].map((what, i) => `<tr><th scope="row">${what}</th>
      <td>${text(thrown[i].along, 1)}</td><td>${text(thrown[i].spin, 0)}</td>
      <td>${text(stops[i].along, 1)}</td></tr>`).join("");
    part(".aim").setAttribute("d", arrow(thrown[0]));
    draw(thrown[4].time);
  }

  function start() {
    show();
    part(".heard").textContent = said.textContent;
    if (matchMedia("(prefers-reduced-motion: reduce)").matches) return;
    let first;
    frame = requestAnimationFrame(function step(now) {
      first ??= now;
      const time = Math.min((now - first) / 1e4, flights.thrown[4].time);
      draw(time);
      if (time < flights.thrown[4].time) frame = requestAnimationFrame(step);
    });
  }

  form.addEventListener("input", show);
  form.addEventListener("submit", (event) => {
    event.preventDefault();
    start();
  });
  form.addEventListener("reset", () => setTimeout(start)); // the form resets after the event
  // A touch here throws, it does not scroll; browsers ignore touch-action inside SVG.
  hand.addEventListener("touchstart", (event) => event.preventDefault(), { passive: false });
  hand.addEventListener("pointerdown", (event) => hand.setPointerCapture(event.pointerId));
  hand.addEventListener("pointermove", (event) => {
    if (!hand.hasPointerCapture(event.pointerId)) return;
    const place = new DOMPoint(event.clientX, event.clientY);
    const { x, y } = place.matrixTransform(scene.getScreenCTM().inverse());
    form.elements.along.value = (x - LEFT) / SPEED;
    form.elements.down.value = (y - MIDDLE) / SPEED;
    show();
  });
  hand.addEventListener("pointerup", start);
  show();

  return { fly };
})();
