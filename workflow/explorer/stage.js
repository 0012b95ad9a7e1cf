"use strict";

// The stage: two balls thrown alike, the upper one with a rigid contact and the lower one with a spring
// along the surface, each above its own floor and below the name of its contact; or the lower one
// alone. The time of the show, in seconds, stretches each contact.
const stage = (() => {
  const SLOW_FLIGHT = 3; // times slower than in nature, and under a table, where flights are short
  const SLOW_BELOW = 10;
  const FIRST_CONTACT = 1.5; // s that one t_c takes in the first bounce, and in the others
  const LATER_CONTACT = 1;
  const UNSEEN_CONTACT = 0.1; // where no magnifying glass shows it
  const SHOWN = 3; // flights that the frame shows; later ones may leave it
  const STEP = 0.012; // s between two corners of a path
  const RADIANS_A_SECOND = 80; // of spin that turns the knob by one radian
  // Heights: of the name of a lane, of the floor of the upper lane, and of that of the lower one, in
  // which the scale stands.
  const [NAME, FLOOR, BASE] = [24, 9, 24];
  const RULERS = [5, 1, 0.5, 0.1]; // m; the first that takes at most a sixth of the width
  const slower = () => (shown.given.table ? SLOW_BELOW : SLOW_FLIGHT);
  const LANES = ["upper", "lower"];
  const [LENS, HALL_LENS] = [64, 125]; // px, radius of the magnifying glass at most; in a hall
  const element = (id) => document.getElementById(id);
  const svg = element("stage-svg");
  const part = (name) => element(`stage-${name}`);

  let shown; // what `prepare` was given, and what follows from it
  let mode = {}; // `lone`: the lower ball alone; `bare`: no magnifying glass; `hall`: a large one
  let frame; // of the picture: see `framed`
  let held; // the frame while the ball is aimed

  // ---- the show in time ---------------------------------------------------------------------

  // Segments of the show. Both balls bounce at the same instants, as both have the same restitution.
  function segments(parts) {
    const list = [];
    let start = 0;
    parts.forEach((one, index) => {
      const pace = mode.bare ? UNSEEN_CONTACT
        : list.some(({ kind }) => kind === "bounce") ? LATER_CONTACT : FIRST_CONTACT;
      const length = one.kind === "flight" ? slower() * one.time : pace * one.contact.end;
      list.push({ kind: one.kind, index, start, length });
      start += length;
    });
    return list;
  }

  // The show ends with the last flight, or when a ball reaches the edge of the frame.
  function ended() {
    const last = shown.segments.at(-1);
    const leaving = lanes().map((lane) =>
      shown.traces[lane].find((corner) => {
        const [x] = place_of(corner, lane);
        return x < frame.radius || x > frame.width - frame.radius;
      })?.now ?? Infinity);
    return Math.min(last.start + last.length, ...leaving);
  }

  const duration = () => shown.end;

  // Times of the show at which something begins: each contact, flight, stick, slip, way back, push of
  // friction the other way; and its end.
  function moments() {
    const list = shown.segments.flatMap(({ kind, index, start, length }) => {
      if (kind === "flight") return [start];
      const { rows, end } = shown.flights.lower[index].contact;
      const differs = (i, name) => Math.sign(rows[i][name]) !== Math.sign(rows[i - 1][name]);
      const changes = rows.filter(({ sticks }, i) => i > 1 && (sticks !== rows[i - 1].sticks ||
        differs(i, "velocity") || differs(i, "friction")));
      return [{ time: 0.02 }, ...changes].map(({ time }) => start + (length * (time + 1e-6)) / end);
    });
    return [...list.filter((one) => one > 0 && one < shown.end), shown.end];
  }

  // The segment at a time of the show, and how far it has gone, from 0 to 1.
  function moment(now) {
    const segment = shown.segments.findLast(({ start }) => start <= now) ?? shown.segments[0];
    const share = segment.length ? Math.min((now - segment.start) / segment.length, 1) : 1;
    return { segment, share };
  }

  // Ball, bounce and instant of its contact in one lane now.
  function lane_at(parts, { segment, share }) {
    const one = parts[segment.index];
    if (one.kind === "flight") return { ball: flight.later(one.ball, share * one.time) };
    const row = models.at(one.contact, share * one.contact.end);
    const gone = (row.velocity - one.x) / (one.contact.state.velocity - one.x || 1);
    const mix = (name) => one.ball[name] + gone * (one.after[name] - one.ball[name]);
    return {
      ball: { ...one.ball, along: mix("along"), spin: mix("spin") }, bounce: one,
      row: share < 1 ? row : null,
    };
  }

  // ---- the frame ----------------------------------------------------------------------------

  // Size in pixels, and the scale in pixels for a metre that shows the first bounces. Balls are drawn
  // larger than they are.
  function framed(flights, gap) {
    const width = Math.max(svg.clientWidth, 200);
    const height = Math.max(svg.clientHeight, 120);
    const floor = height - BASE; // of the lower lane
    const sky = mode.lone ? floor - NAME : (floor - 2 * NAME - FLOOR) / 2; // of each lane
    const radius = Math.min(24, sky / 6) * (gap ? 0.8 : 1);
    const places = [0];
    const heights = [gap || 0.3];
    const count = gap ? Infinity : SHOWN;
    for (const parts of Object.values(flights)) {
      for (const one of parts.filter(({ kind }) => kind === "flight").slice(0, count)) {
        for (let i = 0; i <= 8; i++) {
          const ball = flight.later(one.ball, (one.time * i) / 8);
          places.push(ball.place);
          heights.push(ball.height);
        }
      }
    }
    const [left, right] = [Math.min(...places), Math.max(...places)];
    const room = width - 5 * radius;
    const tall = sky - 2 * radius - 16; // below the knob or a table
    const scale = Math.min(room / Math.max(right - left, 0.4), tall / Math.max(...heights));
    const used = Math.min((right - left) * scale, room);
    const origin = 2 * radius - left * scale + (room - used) / 2;
    // Pixels for 1 m/s of the ball in the hand: its arrow ends above the floor.
    const [{ ball }] = flights.upper;
    const free = scale * ball.height + radius;
    const aim = Math.min(18, width / 36, free / Math.max(-ball.up, 0.1));
    return { width, height, radius, floor, upper: NAME + sky, sky, scale, origin, gap, aim };
  }

  const lanes = () => (mode.lone ? ["lower"] : LANES);

  const floor_of = (lane) => (lane === "upper" ? frame.upper : frame.floor);

  const place_of = ({ place, height }, lane) => [
    frame.origin + frame.scale * place,
    floor_of(lane) - frame.scale * height - frame.radius,
  ];

  // ---- drawing ------------------------------------------------------------------------------

  // Corners of the path of a lane, with the time of the show.
  function traced(parts, list) {
    return parts.flatMap((one, i) => {
      if (one.kind !== "flight") return [];
      const { start, length } = list[i];
      const steps = Math.max(Math.ceil(one.time / STEP), 1);
      return Array.from({ length: steps + 1 }, (_, k) => ({
        now: start + (length * k) / steps, ...flight.later(one.ball, (one.time * k) / steps) }));
    });
  }

  function prepare(given, flights, how = {}) {
    const gap = given.table ? given.table - 2 * given.radius : 0;
    mode = how;
    shown = { given, flights };
    const list = (shown.segments = segments(flights.upper));
    const speeds = Object.values(flights).flat().map(({ x, unit }) => (x ?? 0) * unit || 0);
    shown.fastest = Math.max(...speeds) || 1;
    shown.traces = Object.fromEntries(
      Object.entries(flights).map(([lane, parts]) => [lane, traced(parts, list)]));
    put_frame(held ?? framed(flights, gap));
  }

  // Draws what stands still in a frame.
  function put_frame(new_frame) {
    frame = new_frame;
    shown.end = ended();
    const { width, height, radius, floor, upper, scale, gap } = frame;
    svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    const board = (top, low) => `M0,${top}H${width}V${low}H0Z`;
    const floors = lanes().map(floor_of);
    svg.classList.toggle("lone", !!mode.lone);
    part("floor").setAttribute("d",
      floors.map((low) => board(low, low === floor ? height : low + FLOOR)).join(""));
    part("edge").setAttribute("d", floors.map((low) => `M0,${low}H${width}`).join(""));
    const under = scale * gap + 2 * radius; // the table of a lane, above its floor
    part("table").setAttribute("d", !gap ? "" :
      floors.map((low) => board(low - under - 5, low - under)).join(""));
    part("table-word").textContent = gap ? "table" : "";
    part("table-word").setAttribute("x", width - 12);
    part("table-word").setAttribute("y", floors[0] - under - 9);
    part("lower-words").setAttribute("y", floor - frame.sky - 6);
    const [end, line] = [width - 12, floor + BASE / 2];
    const metres = RULERS.find((one) => scale * one < width / 6) ?? RULERS.at(-1);
    part("ruler").setAttribute("d", `M${end},${line - 4}v8m0,-4h${-scale * metres}m0,-4v8`);
    part("metre").textContent = `${metres} m`;
    part("metre").setAttribute("x", end - scale * metres - 6);
    part("metre").setAttribute("y", line + 4);
    for (const name of ["moment", "invitation"]) part(name).setAttribute("y", line + 5);
    show_hand();
  }

  // Numbers beside the name of each lane.
  const speed_words = ({ along, spin }) => {
    const way = along < -0.005 ? "back" : "forwards";
    const senses = frame.width < 600 ? ["\u21BB", "\u21BA"] : ["clockwise", "anticlockwise"];
    const turning = Math.abs(spin) < 0.5 ? "no spin" :
      `${Math.abs(spin).toFixed(0)} rad/s ${senses[spin > 0 ? 0 : 1]}`;
    const going = Math.abs(along) < 0.05 ? "" : `${Math.abs(along).toFixed(1)} m/s ${way}, `;
    return `${going}${turning}`;
  };

  function show_lane(lane, now, at_moment) {
    const { ball, bounce, row } = lane_at(shown.flights[lane], at_moment);
    const [x, y] = place_of(ball, lane);
    const { radius } = frame;
    const degrees = (ball.turn * 180) / Math.PI;
    const size = radius / 20;
    part(`${lane}-ball`).setAttribute("transform",
      `translate(${x.toFixed(1)},${y.toFixed(1)}) rotate(${degrees.toFixed(1)}) scale(${size})`);
    const corners = shown.traces[lane];
    const until = corners.findIndex((corner) => corner.now > now);
    const behind = (until < 0 ? corners : corners.slice(0, until)).map((one) => place_of(one, lane));
    behind.push([x, y]);
    part(`${lane}-path`).setAttribute("d",
      `M${behind.map(([a, b]) => `${a.toFixed(1)},${b.toFixed(1)}`).join("L")}`);
    const foot = bounce?.wall === "table" ? y - radius : y + radius;
    const seen = row && !mode.bare;
    part(`${lane}-numbers`).textContent =
      seen && above() ? lens.words(row, springy(lane), bounce.x) : speed_words(ball);
    part(`${lane}-lens`).innerHTML = seen ? lens_of(lane, bounce, row, [x, foot]) : "";
  }

  const springy = (lane) => lane === "lower" && shown.given.groups.zeta2 > 0;
  const above = () => mode.hall || frame.width < 480; // then words stand above the ball

  // The magnifying glass beside the ball, where there is more room. In a hall it is as high as the
  // picture lets it be, and that of the upper ball stands beyond the other.
  function lens_of(lane, bounce, now, tip) {
    const side = tip[0] < frame.width / 2 ? 1 : -1;
    const room = (side > 0 ? frame.width - tip[0] : tip[0]) - frame.radius - 30;
    const large = HALL_LENS * (mode.lone ? 1.5 : 1);
    const size = mode.hall ? Math.min(large, (frame.floor - NAME) / 2 - 3, room / (2 * lanes().length) - 4)
      : Math.min(LENS, frame.sky / 2 - 3);
    const beyond = mode.hall && lane === "upper" ? 2 * size + 8 : 0;
    const x = tip[0] + side * (frame.radius + 14 + size + beyond);
    const middle = floor_of(lane) - frame.sky / 2 + 2;
    const y = Math.min(Math.max(middle, NAME + size + 3), frame.floor - size + 2);
    const up = bounce.wall === "table" ? -1 : 1;
    return lens.show({ lane, now, first: bounce.x, speed: bounce.unit / shown.fastest, sign: bounce.sign,
      up, springy: springy(lane), x, y, size, tip, side, worded: !above() });
  }

  function show(now) {
    const at_moment = moment(now);
    for (const lane of lanes()) show_lane(lane, now, at_moment);
    const { segment, share } = at_moment;
    const bounces = shown.segments.slice(0, segment.index + 1)
      .filter(({ kind }) => kind === "bounce").length;
    shown.bounces = bounces - (segment.kind === "bounce");
    part("moment").textContent = segment.kind === "bounce"
      ? mode.bare ? "" : `bounce ${bounces}, in slow motion`
      : now === 0 ? "" : now >= shown.end - 1e-3 ? "the end" : `in flight, ${slower()} times slower`;
    svg.classList.toggle("waiting", now === 0);
    shown.said = now === 0 ? "in the hand" : segment.kind === "flight" ? part("moment").textContent
      : `bounce ${bounces}, ${(100 * share).toFixed(0)} % of the contact is over`;
  }

  // ---- the hand -----------------------------------------------------------------------------

  function show_hand() {
    const ball = flight.start(shown.given);
    const [x, y] = place_of(ball, "lower");
    const { radius } = frame;
    const k = frame.aim;
    part("hand").setAttribute("transform", `translate(${x.toFixed(1)},${y.toFixed(1)})`);
    const reach = Math.max(radius + 8, 24);
    part("grasp").setAttribute("r", reach);
    const [back_x, back_y] = place_of(ball, "upper");
    part("other-grasp").setAttribute("cx", back_x - x);
    part("other-grasp").setAttribute("cy", back_y - y);
    part("other-grasp").setAttribute("r", reach);
    const [right, down] = [k * ball.along, -k * ball.up];
    part("aim").setAttribute("d", arrows.straight(0, 0, right, down));
    const turn = Math.max(-5.2, Math.min(5.2, shown.given.spin / RADIANS_A_SECOND));
    part("spin").setAttribute("d", arrows.round(0, 0, radius + 8, turn));
    part("knob").setAttribute("cx", ((radius + 8) * Math.sin(turn)).toFixed(1));
    part("knob").setAttribute("cy", (-(radius + 8) * Math.cos(turn)).toFixed(1));
    // Beside the arrow; where there is no room, below or above it.
    const words = part("aim-words");
    words.textContent = `${shown.given.speed.toFixed(1)} m/s at the floor`;
    const beside = Math.max(right, reach) + 8;
    const most = frame.width - x - words.getComputedTextLength() - 8;
    const low = frame.floor - y - 7;
    const near = beside < most ? Math.min(down + 5, low) : down > 20 ? low : -reach - 6;
    words.setAttribute("x", Math.min(beside, most));
    words.setAttribute("y", near);
  }

  const point_of = (event) => new DOMPoint(event.clientX, event.clientY)
    .matrixTransform(svg.getScreenCTM().inverse());

  // What a drag from one of the balls asks for. Pulled back, as a slingshot, the ball flies the other
  // way. A band shows the pull.
  function aim_at(event, lane) {
    const point = point_of(event);
    const ball = flight.start(shown.given);
    const [x, y] = place_of(ball, lane);
    let [right, down] = [point.x - x, point.y - y];
    part("band").setAttribute("d", `M${x},${y}L${point.x},${point.y}`);
    if (right < 0) [right, down] = [-right, -down];
    const k = frame.aim;
    const aimed = flight.aimed({ along: right / k, up: -Math.max(down, 0) / k, height: ball.height,
      gravity: shown.given.gravity });
    return { angle: Number(aimed.angle.toFixed(1)), speed: Number(aimed.speed.toFixed(1)) };
  }

  // Spin by the angle at which the knob stands round the ball.
  function spin_at(event) {
    const point = point_of(event);
    const [x, y] = place_of(flight.start(shown.given), "lower");
    const turn = Math.atan2(point.x - x, y - point.y);
    // More than half a turn goes on where it is.
    const whole = Math.round((shown.given.spin / RADIANS_A_SECOND - turn) / (2 * Math.PI));
    return RADIANS_A_SECOND * (turn + 2 * Math.PI * whole);
  }

  // Keeps the frame while the ball is aimed, and lets it go.
  function hold(on) {
    held = on ? frame : undefined;
    if (!on) part("band").setAttribute("d", "");
  }

  // A guess of the place where the ball will be, in m from the hand; without one the mark goes.
  function put_guess(place) {
    const x = (frame.origin + frame.scale * (place ?? 0)).toFixed(1);
    part("guess-line").setAttribute("d", place === undefined ? "" : `M${x},${NAME}V${frame.floor}`);
    part("guess-word").setAttribute("x", Math.min(Math.max(x, 46), frame.width - 46));
    part("guess-word").setAttribute("y", frame.floor - 8);
    part("guess-word").textContent = place === undefined ? "" : "your guess";
  }
  const place_at = (event) => (point_of(event).x - frame.origin) / frame.scale;
  const last_place = () => lane_at(shown.flights.lower, moment(shown.end)).ball.place;

  // Bounces that are over, whether the show is, and the moment in words.
  const progress = (now) => ({ bounces: shown.bounces, over: now >= shown.end - 1e-3, said: shown.said });

  return { progress, prepare, show, duration, moments, aim_at, spin_at, hold, part, put_guess, place_at, last_place };
})();
