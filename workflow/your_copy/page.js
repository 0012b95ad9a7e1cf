"use strict";

// What the reader has done stands in `state`, which undo takes back; all else is drawn from it.
(() => {
  const get = (id) => document.getElementById(id);
  const [sheet, stage] = ["sheet", "stage"].map(get);
  const TEXTS = ["who", "when", "from", "incidence", "scale"];
  const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
  const MOST_NOTICED = 10; // per cent; above, the run cannot tell

  let panels = {}; // the state of each that was visited
  let state = null; // that of the panel that is seen
  const pictures = []; // all that were opened
  let shown = null; // number of the one that is seen
  const past = []; // all this before, as text
  let map = null; // that of the marks, as it is drawn
  let imported = null; // columns of an export

  const panel = () => DATA.panels[state.panel];
  const picture = () => pictures[shown];
  const reading = () => state.readings[state.turn];
  const chosen_series = () => panel().series.find(({ id }) => id === state.series);
  const is_line = () => Boolean(chosen_series()?.line);
  const texts = () => Object.fromEntries(TEXTS.map((id) => [id, get(id).value]));
  const name_of = (column) => column.replace(/ \[.*/, "").replaceAll("_", " ");
  const spans = ({ range }) => range.map(([low, high]) => high - low);
  const zoom = () => sheet.getBoundingClientRect().width / picture()?.naturalWidth || 1;
  const refuse = (text) => { get("refused").textContent = text; };

  // Marks that have numbers and a place.
  const placed = () => state.marks.flatMap(({ x, y, at }, i) =>
    (at && x !== null && y !== null ? [{ i, x, y, u: at[0], v: at[1] }] : []));

  // The mark that a click sets: one that was picked, or the first that has no place, or a further one.
  function next_mark() {
    const unset = state.marks.findIndex(({ at }) => !at);
    return state.picked ?? (unset < 0 ? state.marks.length : unset);
  }

  function chosen_place() {
    const { list, i } = state.chosen ?? {};
    return { marks: state.marks[i]?.at, points: reading()[i], clicks: state.clicks[i] }[list];
  }

  const judged = () => readings.judged(map, state, is_line(), picture()?.naturalWidth);

  // A value on an axis, to a thousandth of it, with its unit.
  function said(value, i) {
    const unit = [panel().x, panel().y][i].match(/\[(.*)\]/)[1].replace(/^1$/, "").replace(/\bmu\b/, "µ");
    const digits = Math.max(0, Math.ceil(3 - Math.log10(spans(panel())[i])));
    return `${value.toFixed(digits).replace("-", "\u2212")} ${unit}`.trim();
  }

  const nothing_read = () => ({ readings: [[], []], width: 0, clicks: [], turn: 0, chosen: null, by: "", saved: "" });

  function enter(name) {
    const { marks, series: [first] } = DATA.panels[name];
    state = panels[name] ??= {
      panel: name, mode: "marks", marks: marks.map(([x, y]) => ({ x, y, at: null })), picked: null, cursor: null,
      flat: state?.flat ?? false, off: [], series: first?.id ?? "", follow: first?.line ?? false, ...nothing_read(),
    };
  }

  const whole = () => ({ name: state.panel, panels, shown });

  function restore({ name, ...given }) {
    ({ panels, shown } = given);
    state = panels[name];
  }

  // Change the state, so that it can be undone.
  function change(action) {
    past.push(JSON.stringify(whole()));
    refuse("");
    action();
    get("saved").textContent = "";
    draw();
  }

  function undo() {
    if (past.length) restore(JSON.parse(past.pop()));
    draw();
  }

  // Curves of the panel as they are drawn: forces of an unknown scale are multiplied.
  function curves_here() {
    const factor = panel().scale ? numbers.read(get("scale").value) || 1 : 1;
    return panel().curves.map((curve, i) => ({ ...curve, i, y: curve.y.map((y) => y * factor) }));
  }

  const drawn = () => curves_here().filter(({ i }) => !state.off.includes(i));

  // --- what is seen ---

  function set(property, values) {
    for (const [id, value] of Object.entries(values)) get(id)[property] = value;
  }

  function draw() {
    map = maps.fit(placed(), panel().range, state.flat);
    draw_picture();
    draw_panel();
    draw_marks();
    draw_curves();
    draw_signs();
    draw_loupe();
    const closed = !picture();
    const [first, second] = state.readings.map(({ length }) => length);
    const [unread, line] = [Boolean(closed || map.refused || !state.series), is_line()];
    set("disabled", {
      trace: unread || state.clicks.length < 2, save: unread, "export-take": unread, second: !first, picture: closed,
      "save-all": closed, undo: !past.length,
    });
    set("hidden", {
      second: line, "with-follow": !line, "with-width": !line, trace: !state.follow, "with-scale": !panel().scale,
      "no-series": panel().series.length > 0, "with-incidence": !chosen_series()?.open.includes("incidence"),
    });
    set("checked", { flat: state.flat, follow: state.follow, [`mode-${state.mode}`]: true });
    set("value", { panel: state.panel, series: state.series, width: state.width ? state.width.toFixed(1) : "" });
    set("textContent", {
      task: closed ? "" : task(),
      points: line ? `${first} points.` : `First reading: ${first} points. Second: ${second}.`,
      sigmas: state.series && uncertainty(judged()),
      second: state.turn ? "Back to the first reading" : "Read a second time",
    });
  }

  // Sigma of a point, and what the run would notice with it.
  function uncertainty(found) {
    if (found.refused) return found.refused;
    const { allowance, id } = chosen_series();
    // That of measured points is the last one.
    const curve = curves_here().find(({ series }) => series === id) ?? curves_here().at(-1);
    const noticed = 100 * readings.noticed(map, found, curve, allowance, panel().scale);
    const words = noticed > MOST_NOTICED
      ? `The run could not tell: only errors above ${MOST_NOTICED} % would be noticed.`
      : `A curve ${readings.round(noticed, 2)} % ${panel().scale ? "wider" : "larger"} than ours would fail.`;
    return `Uncertainty (sigma): ${said(found.sigmas[0], 0)} along x, ${said(found.sigmas[1], 1)} along y. ${words}`;
  }

  // A mark that does not fit the others, in words.
  function worst() {
    if (!map.worst) return "";
    const [number, off] = [placed()[map.worst.i].i + 1, map.worst.off.toFixed(0)];
    return `Mark ${number} is ${off} px off where the others put it: set it again, or correct its numbers.`;
  }

  // What a click does now.
  function task() {
    if (state.mode === "marks") {
      const { x = null, y = null } = state.marks[next_mark()] ?? {};
      const place = `${name_of(panel().x)} ${x}, ${name_of(panel().y)} ${y}`;
      return `${worst()} Click where ${x === null || y === null ? "a further mark" : place} stands.`;
    }
    if (map.refused || map.worst) return `${map.refused ?? ""} ${worst()}`;
    if (state.mode === "look" || !state.series) {
      const moves = state.chosen?.list === "marks" ? " Arrow keys move the chosen mark; Escape lets it go." : "";
      return `Our curves lie over your copy. To read points, go to step 4.${moves}`;
    }
    const again = state.turn || !state.readings[0].length ? "." : ", then “Read a second time”.";
    const how = state.follow ? "Click along the line, then “Follow it”." : `Click the middle of each marker${again}`;
    const which = is_line() ? "Reading" : `${state.turn ? "Second" : "First"} reading`;
    return `${which} of: ${chosen_series().name}. ${how}`;
  }

  function draw_picture() {
    document.body.classList.toggle("opened", Boolean(picture()));
    if (!picture() || sheet.dataset.shown === `${shown}`) return;
    sheet.dataset.shown = shown;
    const { naturalWidth: width, naturalHeight: height, src: href } = picture();
    sheet.setAttribute("viewBox", `0 0 ${width} ${height}`);
    sheet.style.setProperty("--ratio", width / height);
    for (const [name, value] of Object.entries({ href, width, height })) get("copy").setAttribute(name, value);
  }

  const style_of = ({ line }, i) => `curve c${i % 6} ${line}`;

  function draw_panel() {
    const { curves, series } = panel();
    if (get("curves").dataset.panel === state.panel) return;
    get("curves").dataset.panel = state.panel;
    get("curves").innerHTML = curves.map((curve, i) => `<label><input type="checkbox" data-curve="${i}">
      <svg viewBox="0 0 34 8" aria-hidden="true"><path class="${style_of(curve, i)}" d="M0,4H34"/></svg>
      ${curve.name}</label>`).join("");
    get("series").replaceChildren(...series.map(({ id, name }) => new Option(name, id)));
  }

  function draw_marks() {
    const [body] = get("marks").tBodies;
    const field = (axis, i) => `<td><input class="mark-${axis}" data-mark="${i}" inputmode="decimal"
      aria-label="${axis} of mark ${i + 1}"></td>`;
    // Rows are kept while their number is the same: who types would lose the field.
    if (body.rows.length !== state.marks.length) {
      body.innerHTML = state.marks.map((_, i) => `<tr><td><button type="button" class="mark-pick" data-mark="${i}"
        aria-label="Set mark ${i + 1} with the next click">${i + 1}</button></td>${field("x", i)}${field("y", i)}
        <td></td><td></td><td><button type="button" class="mark-drop" data-mark="${i}"
        aria-label="Remove mark ${i + 1}">×</button></td></tr>`).join("");
    }
    const set_ones = placed();
    state.marks.forEach(({ x, y, at }, i) => {
      const { cells } = body.rows[i];
      body.rows[i].className = i === next_mark() && state.mode === "marks" ? "next" : "";
      [x, y].forEach((value, k) => { cells[k + 1].firstChild.value = value ?? ""; });
      cells[3].textContent = at ? at.map((one) => one.toFixed(1)).join(", ") : "not set";
      cells[4].textContent = map.off?.[set_ones.findIndex((one) => one.i === i)]?.toFixed(2) ?? "";
    });
    const quality = () => (map.freedom ? `residual ${map.residual.toFixed(2)} px.`
      : "a further one would show how good they are.");
    get("fit").className = map.worst || (map.refused && set_ones.length > 2) ? "bad" : "";
    get("fit").textContent = map.refused ?? `${set_ones.length} marks, ${quality()}`;
  }

  function draw_curves() {
    get("curves").querySelectorAll("input").forEach((box, i) => { box.checked = !state.off.includes(i); });
    get("lines").classList.toggle("unread", state.mode === "read"); // nobody shall read the model
    get("lines").innerHTML = map.refused ? "" : drawn().map((curve) => {
      const places = curve.x.map((x, k) => map.to_pixels([x, curve.y[k]]).map((one) => one.toFixed(2)).join(","));
      return `<polyline class="${style_of(curve, curve.i)}" points="${places.join(" ")}"/>`;
    }).join("");
  }

  // Lines of the map at round values, with their numbers, to be seen beside those of the print.
  function grid() {
    const { range } = panel();
    const size = 13 / zoom();
    return range.flatMap(([low, high], i) => {
      const step = 10 ** Math.floor(Math.log10(0.9 * (high - low)));
      const at = (value, other) => map.to_pixels(i ? [other, value] : [value, other]);
      return Array.from({ length: Math.floor((high - low) / step + 1.001) }, (_, k) => {
        const value = low + k * step;
        const [start, end] = range[1 - i].map((other) => at(value, other));
        const [u, v] = at(value, 0);
        return `<path d="M${start}L${end}"/><text x="${u + size / 4}" y="${v - size / 4}" font-size="${size}">` +
          `${readings.round(value, 6)}</text>`;
      });
    }).join("");
  }

  function draw_signs() {
    const far = 6 / zoom();
    const cross = ([u, v]) => `<path d="M${u - far},${v}H${u + far}M${u},${v - far}V${v + far}"`;
    const circle = ([u, v]) => `<circle cx="${u}" cy="${v}" r="${far}"`;
    const signs = (places, style, form) => places.map((place) => place && `${form(place)} class="sign ${style} ${
      place === chosen_place() ? "chosen" : ""}"/>`);
    get("signs").innerHTML = [
      map.refused || state.mode === "read" ? "" : `<g class="grid invitation">${grid()}</g>`, // not in a saved picture
      ...signs(state.marks.map(({ at }) => at), "mark", cross), ...signs(reading(), "point", circle),
      ...signs(state.clicks, "click", cross), ...signs([state.cursor], "cursor", cross),
    ].join("");
  }

  // The magnifier, in the other corner if it would hide the place.
  function draw_loupe(at = chosen_place() ?? state.cursor) {
    const box = get("close-up");
    box.hidden = !at || !get("magnifier").checked;
    if (box.hidden) return;
    get("loupe").setAttribute("viewBox", `${at[0] - 10} ${at[1] - 10} 20 20`);
    const [{ left, top }, own] = [sheet, get("loupe")].map((one) => one.getBoundingClientRect());
    const [x, y] = [left + zoom() * at[0], top + zoom() * at[1]];
    if (x > own.left && x < own.right && y > own.top && y < own.bottom) box.classList.toggle("left");
  }

  // Values of the axes at a place, and how far it is from the nearest curve.
  function tell(place) {
    if (map.refused) return;
    const point = map.to_axes(place);
    const all = (state.mode === "read" ? [] : drawn())
      .map((curve) => ({ name: curve.name, far: readings.nearest(curve, point, map.scale(place)).far }));
    const [nearest] = all.sort((a, b) => a.far - b.far);
    const beside = nearest ? `; ${nearest.far.toFixed(1)} px from “${nearest.name}”` : "";
    const [x, y] = [panel().x, panel().y].map((column, i) => `${name_of(column)} ${said(point[i], i)}`);
    get("pointer").textContent = `${x}, ${y}${beside}`;
  }

  // --- actions on the picture ---

  function place_of({ clientX, clientY }) {
    const { left, top } = sheet.getBoundingClientRect();
    return [(clientX - left) / zoom(), (clientY - top) / zoom()];
  }

  function put(place) {
    if (state.mode === "marks") {
      change(() => {
        const i = next_mark();
        state.marks[i] = { x: null, y: null, ...state.marks[i], at: [...place] };
        Object.assign(state, { picked: null, chosen: { list: "marks", i } });
        if (state.marks.every(({ at }) => at)) state.mode = "look";
      });
    } else if (state.mode === "read" && state.series && !map.refused) {
      change(() => {
        const [list, places] = state.follow ? ["clicks", state.clicks] : ["points", reading()];
        // A click on one chooses it; else it is new, and behind the chosen one.
        let i = places.findIndex((one) => maps.far(one, place) < 6 / zoom());
        if (i < 0) {
          i = state.chosen?.list === list ? state.chosen.i + 1 : places.length;
          places.splice(i, 0, [...place]);
          if (!state.follow) state.by = "";
        }
        state.chosen = { list, i };
      });
    }
    tell(place);
  }

  // The cursor of who has no mouse.
  const cursor = () => state.cursor ??= [picture().naturalWidth / 2, picture().naturalHeight / 2];

  // Move what is chosen, or the cursor.
  function nudge(step) {
    change(() => {
      const place = chosen_place() ?? cursor();
      Object.assign(place, place.map((one, i) => one + step[i]));
    });
    tell(chosen_place() ?? cursor());
  }

  function remove_chosen() {
    change(() => {
      const { list, i } = state.chosen ?? {};
      if (list === "marks") state.marks[i].at = null;
      else if (list) (list === "clicks" ? state.clicks : reading()).splice(i, 1);
      state.chosen = null;
    });
  }

  const writes = (target) => target.matches("input:not([type]), [type=date], textarea");

  function press(event) {
    const is_z = /^[a-z]$/i.test(event.key) ? event.key.toLowerCase() === "z" : event.code === "KeyZ";
    if ((event.ctrlKey || event.metaKey) && is_z && !writes(event.target)) undo();
    else if (!picture() || event.target.matches("input, select, textarea")) return;
    else if (event.key in ARROWS) {
      const far = chosen_place() ? 1 : 10; // with Shift; without anything chosen the cursor goes
      nudge(ARROWS[event.key].map((one) => one * (event.shiftKey ? far : 0.1)));
    } else if (event.target !== sheet) return;
    else if (event.key === "Enter") put(cursor());
    else if (event.key === "Escape") change(() => { state.chosen = null; });
    else if (["Delete", "Backspace"].includes(event.key)) remove_chosen();
    else return;
    event.preventDefault();
  }

  // --- points ---

  function follow_line() {
    picture().colour ??= colours_of(picture());
    const { points, width, length, left_out, lost, leg, move } = trace.follow(picture().colour, state.clicks);
    if (lost) {
      state.chosen = { list: "clicks", i: move - 1 };
      draw();
      const where = `at pixel ${lost.map(Math.round).join(", ")}, between clicks ${leg} and ${leg + 1}`;
      return refuse(`The line is lost ${where}: move click ${move} nearer to the middle of the line; it is chosen. ` +
        `Or click on click ${leg}, and add one behind it.`);
    }
    refuse("");
    take(points, width, "followed along the line");
    get("task").textContent = `${points.length} points of a line of ${Math.round(length)} pixels; ` +
      `${Math.round(left_out)} of these are left out: crossings, markers, gaps between dashes.`;
  }

  const take = (points, width, by) => change(() => {
    state.readings[state.turn] = points;
    Object.assign(state, { mode: "read", width, clicks: [], chosen: null, by });
  });

  function read_export(text) {
    imported = exports_of_others.read(text, [panel().x, panel().y]);
    const { columns = [], chosen, refused, said: words } = imported;
    get("others").open = true;
    get("export-said").textContent = refused ?? words;
    get("export-said").className = refused ? "bad" : "";
    get("export-columns").hidden = Boolean(refused);
    for (const [i, id] of ["export-x", "export-y"].entries()) {
      get(id).replaceChildren(...columns.map(({ name }, k) => new Option(name, k, k === chosen[i], k === chosen[i])));
    }
  }

  function take_export() {
    const [x, y] = ["export-x", "export-y"].map((id) => imported.columns[get(id).value]);
    take(exports_of_others.points(x, y).map(map.to_pixels), 0, "exported from another program");
  }

  // --- files ---

  async function open_file(file) {
    if (!file) return;
    if (/\.pdf$/i.test(file.name)) refuse("This page cannot draw a PDF. Paste a screenshot of the figure.");
    else if (file.type.startsWith("image/")) open_picture(file);
    else if (/\.json$/i.test(file.name)) open_saved(await file.text());
    else read_export(get("export").value = await file.text());
  }

  function open_picture(blob) {
    const reader = new FileReader();
    reader.onload = () => show(reader.result, () => {
      // Marks and points are places in the picture before.
      const { panel: name, series, follow, off } = state;
      panels = {};
      enter(name);
      Object.assign(state, { series, follow, off });
    });
    reader.readAsDataURL(blob);
  }

  // Another picture, if the browser can show it, and what `action` changes with it.
  async function show(address, action) {
    const image = Object.assign(new Image(), { src: address });
    try {
      await image.decode();
    } catch {
      return refuse("The browser cannot show this file. Paste a screenshot of the figure.");
    }
    refuse("");
    change(() => {
      action();
      shown = pictures.push(image) - 1;
    });
  }

  // Everything, to go on another day.
  function save_all() {
    for (const one of Object.values(panels)) one.saved = JSON.stringify(one.readings);
    const all = JSON.stringify({ ...whole(), picture: picture().src, texts: texts() });
    files.save(`${state.panel}_reading.json`, new Blob([all], { type: "application/json" }));
  }

  function open_saved(text) {
    let given = null;
    try {
      // Nothing of it may become a part of the page.
      given = JSON.parse(text, (_, value) => (typeof value === "string" ? value.replace(/[<>"]/g, "") : value));
    } catch { /* said below */ }
    if (!DATA.panels[given?.name] || !given.panels?.[given.name] || !`${given.picture}`.startsWith("data:image/")) {
      return refuse(exports_of_others.project(text) ?? "This file holds no readings that this page has saved.");
    }
    show(given.picture, () => {
      restore(given);
      set("value", given.texts);
    });
  }

  function save() {
    const said_of = { series: chosen_series(), ...texts() };
    const found = judged();
    const unfit = found.refused ? "" : readings.unfit(said_of.series, map, found);
    const problem = found.refused ?? (readings.missing(said_of) || (unfit && worst()) || unfit);
    refuse(problem);
    get("saved").textContent = "";
    if (problem) return;
    const { naturalWidth: width, naturalHeight: height } = picture();
    const how = `planarimpact ${DATA.version}, your_copy.html; picture of ${width} x ${height} px`;
    const by = state.by ? `; ${state.by}` : "";
    const text = readings.csv(said_of, panel().range, map, placed(), found, how + by);
    const [source, name] = state.series.split("/");
    files.save(`${name}.csv`, new Blob([text], { type: "text/csv" }));
    state.saved = JSON.stringify(state.readings);
    get("saved").textContent = `Put ${name}.csv into the folder data/${source}/ of the project, and run: ` +
      `.venv/bin/snakemake --cores 2. The report shows ${name}.png (“Save picture”) if it lies beside it.`;
  }

  // Picture and curves as they lie, with the names of the curves, for one's own use.
  async function save_picture() {
    const names = [...get("curves").querySelectorAll("label:has(:checked)")];
    const below = names.map((label) => [label.querySelector("path"), label.textContent.trim()]);
    const name = state.readings[0].length ? state.series.split("/")[1] : `${state.panel}_overlay`;
    files.save(`${name}.png`, await files.picture(sheet, [panel().title], below));
  }

  // --- controls ---

  // What is chosen, or lies in the middle, stays there.
  function set_zoom() {
    const size = [stage.clientWidth, stage.clientHeight];
    const corner = [stage.scrollLeft, stage.scrollTop];
    const middle = chosen_place() ?? size.map((one, i) => (corner[i] + one / 2) / zoom());
    sheet.style.setProperty("--zoom", get("zoom").value);
    stage.scrollTo(...middle.map((one, i) => one * zoom() - size[i] / 2));
    draw();
  }

  // Another panel of the picture; marks of an x axis that both share stay.
  function go_to(name) {
    const { panel: before, marks } = state;
    change(() => {
      enter(name);
      get("pointer").textContent = "";
      if (panel().figure !== DATA.panels[before].figure) get("from").value = ""; // it says of which figure
      if (!panel().box || panel().box !== DATA.panels[before].box) return;
      for (const mark of state.marks.filter(({ y, at }) => y === 0 && !at)) {
        mark.at = structuredClone(marks.find(({ x, y }) => y === 0 && x === mark.x)?.at ?? null);
      }
    });
  }

  // What the number in a field changes, if it is one.
  function type_number(value, action) {
    const number = numbers.read(value);
    const why = numbers.is_unclear(value) ? "its comma may be decimal or stand between thousands" : "write it as -0.5";
    refuse(Number.isNaN(number) ? `“${value}” is no number: ${why}. The old one is kept.` : "");
    if (Number.isNaN(number)) draw();
    else change(() => action(number));
  }

  const on = (id, event, action) => get(id).addEventListener(event, (happened) => action(happened.target, happened));

  const BUTTONS = {
    undo, save, picture: save_picture, trace: follow_line, "export-take": take_export, "save-all": save_all,
    "mark-add": () => change(() => {
      state.picked = state.marks.push({ x: null, y: null, at: null }) - 1;
      state.mode = "marks";
    }),
    second: () => change(() => Object.assign(state, { mode: "read", turn: 1 - state.turn, chosen: null })),
    clear: () => change(() => {
      const { turn, readings: [first] } = state;
      Object.assign(state, nothing_read(), turn ? { turn, readings: [first, []] } : {});
    }),
    exchange: () => {
      const [x, y] = ["export-x", "export-y"].map(get);
      [x.value, y.value] = [y.value, x.value];
    },
    "close-loupe": () => get("magnifier").click(),
  };

  for (const [id, action] of Object.entries(BUTTONS)) on(id, "click", action);
  for (const arrow of Object.keys(ARROWS)) on(arrow, "click", () => nudge(ARROWS[arrow].map((one) => 0.1 * one)));
  for (const mode of ["marks", "look", "read"]) {
    on(`mode-${mode}`, "change", () => change(() => Object.assign(state, { mode, picked: null, chosen: null })));
  }
  on("file", "change", ({ files: [file] }) => open_file(file));
  on("panel", "change", ({ value }) => go_to(value));
  on("series", "change", ({ value }) => change(() => {
    const { id, line } = panel().series.find((one) => one.id === value);
    Object.assign(state, nothing_read(), { mode: "read", series: id, follow: line });
  }));
  on("sheet", "click", (_, event) => {
    sheet.focus({ preventScroll: true });
    state.cursor = null;
    put(place_of(event));
  });
  on("sheet", "pointermove", (_, event) => {
    if (event.pointerType !== "mouse") return;
    tell(place_of(event));
    draw_loupe(place_of(event));
  });
  on("sheet", "pointerleave", () => draw_loupe());
  on("marks", "click", ({ className, dataset }) => {
    const i = Number(dataset.mark);
    if (className === "mark-pick") {
      change(() => Object.assign(state, { picked: i, mode: "marks", chosen: { list: "marks", i } }));
      set_zoom();
    }
    if (className === "mark-drop") {
      change(() => {
        state.marks.splice(i, 1);
        Object.assign(state, { picked: null, chosen: null });
      });
      get("mark-add").focus();
    }
  });
  on("marks", "change", ({ className, value, dataset }) =>
    type_number(value, (number) => { state.marks[dataset.mark][className.at(-1)] = number; }));
  on("width", "change", ({ value }) => type_number(value, (number) => { state.width = number; }));
  on("curves", "change", ({ checked, dataset }) => change(() => {
    const i = Number(dataset.curve);
    state.off = checked ? state.off.filter((one) => one !== i) : [...state.off, i];
  }));
  on("scale", "input", draw);
  on("flat", "change", ({ checked }) => change(() => { state.flat = checked; }));
  on("follow", "change", ({ checked }) => change(() => Object.assign(state, { mode: "read", follow: checked })));
  on("magnifier", "change", () => draw_loupe());
  on("opacity", "input", ({ value }) => sheet.style.setProperty("--opacity", value));
  on("zoom", "input", set_zoom);
  on("export", "input", ({ value }) => read_export(value));
  for (const type of ["pointerdown", "pointerup", "keydown", "keyup", "blur"]) {
    window.addEventListener(type, ({ key = " ", target }) => {
      const held = key.toLowerCase() === "h" ? !writes(target) : target.id === "hold" && [" ", "Enter"].includes(key);
      sheet.classList.toggle("print-only", held && type.endsWith("down"));
    });
  }
  document.addEventListener("keydown", press);
  document.addEventListener("dragover", (event) => event.preventDefault());
  document.addEventListener("drop", (event) => {
    event.preventDefault();
    open_file(event.dataTransfer.files[0]);
  });
  document.addEventListener("paste", ({ clipboardData, target }) => {
    if (writes(target)) return;
    // Cells of a table come as a picture, too.
    const image = [...clipboardData.items].find(({ type }) => type.startsWith("image/"));
    const text = clipboardData.getData("text");
    if (image && exports_of_others.read(text, [panel().x, panel().y]).refused) open_picture(image.getAsFile());
    else read_export(get("export").value = text);
  });
  window.addEventListener("beforeunload", (event) => {
    const is_new = ({ readings: own, saved }) => own[0].length && JSON.stringify(own) !== saved;
    if (Object.values(panels).some(is_new)) event.preventDefault();
  });
  window.addEventListener("resize", () => {
    draw_signs();
    draw_loupe();
  });

  const asked = location.hash.slice(1); // a figure, of which the first panel is shown
  enter(Object.keys(DATA.panels).find((name) => asked && name.startsWith(asked)) ?? "fig5");
  get("when").value = new Date().toISOString().slice(0, 10);
  draw();
})();
