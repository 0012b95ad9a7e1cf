"use strict";

// What the reader has done stands in `state`, which undo takes back; all else is drawn from it.
(() => {
  const get = (id) => document.getElementById(id);
  const [sheet, stage, picture] = ["sheet", "stage", "picture-of-copy"].map(get);
  const TEXTS = ["who", "when", "from", "incidence", "scale"];
  const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
  const MOST_NOTICED = 0.1; // above, the run cannot tell
  const name_of = (column) => column.replace(/ \[.*/, "").replaceAll("_", " ");

  let state = null;
  let kept = {}; // the last states of other panels
  const pictures = []; // all that were opened
  let shown = null; // number of the one that is seen
  const past = []; // all this before, as text
  let colour = null; // of the picture at each place, once a line is followed
  let imported = null; // columns of an export

  const panel = () => DATA.panels[state.panel];
  const placed = () => state.marks.filter((m) => m.u !== null && m.x !== null && m.y !== null);
  const fitted = () => maps.fit(placed(), panel().range, state.flat);
  const reading = () => state.readings[state.second ? 1 : 0];
  const is_line = () => Boolean(chosen_series()?.line);
  const judged = (map) => readings.judged(map, state, is_line(), Math.hypot(picture.naturalWidth, picture.naturalHeight));
  const chosen_series = () => panel().series.find(({ id }) => id === state.series);
  const texts = () => Object.fromEntries(TEXTS.map((id) => [id, get(id).value]));
  const whole = () => JSON.stringify({ state, kept, shown });
  const spans = ({ range }) => range.map(([low, high]) => high - low);

  // A value on an axis, to a thousandth of it, with its unit.
  function said(value, i) {
    const column = [panel().x, panel().y][i];
    const digits = Math.max(0, Math.ceil(3 - Math.log10(spans(panel())[i])));
    return `${value.toFixed(digits).replace("-", "\u2212")} ${readings.unit_of(column).replace(/\bmu\b/, "µ")}`.trim();
  }

  const NOTHING_READ = { readings: [[], []], widths: [0, 0], clicks: [], second: false, chosen: null, by: "", saved: "" };

  function fresh(name) {
    const { marks, series } = DATA.panels[name];
    return {
      panel: name, mode: "marks", marks: marks.map(([x, y]) => ({ x, y, u: null, v: null })), next: 0, off: [], cursor: null,
      flat: state?.flat ?? false, series: series[0]?.id ?? "", follow: series[0]?.line ?? false,
      ...structuredClone(NOTHING_READ),
    };
  }

  // Change the state, so that it can be undone.
  function change(action) {
    past.push(whole());
    action();
    get("saved").textContent = "";
    draw();
  }

  function undo() {
    const before = shown;
    if (past.length) ({ state, kept, shown } = JSON.parse(past.pop()));
    if (shown !== before) show_picture();
    show_panel();
  }

  // Curves of the panel as they are drawn: forces of an unknown scale are multiplied.
  function curves_here() {
    const factor = panel().scale ? typed(get("scale").value) || 1 : 1;
    return panel().curves.map((curve, i) => ({ ...curve, i, y: curve.y.map((y) => y * factor) }));
  }

  const drawn = () => curves_here().filter(({ i }) => !state.off.includes(i));

  // Distance of a point from a curve if both axes have these scales; units for a pixel give pixels.
  const distance = ({ x, y }, [px, py], [sx, sy]) =>
    trace.beside([px / sx, py / sy], x.map((value, i) => [value / sx, y[i] / sy]));

  // --- what is seen ---

  function set(property, values) {
    for (const [id, value] of Object.entries(values)) get(id)[property] = value;
  }

  function draw() {
    const map = fitted();
    const closed = shown === null;
    draw_marks(map);
    draw_curves(map);
    draw_signs(map);
    draw_loupe();
    const [first, second] = state.readings.map(({ length }) => length);
    const [unread, line] = [Boolean(closed || map.refused || !state.series), is_line()];
    set("disabled", {
      trace: unread, save: unread, "export-take": unread, second: !first, picture: closed, "save-all": closed, undo: !past.length,
    });
    set("hidden", {
      second: line, "with-follow": !line, "with-width": !line, trace: !state.follow,
      "with-incidence": !chosen_series()?.open.includes("incidence"),
    });
    set("checked", { flat: state.flat, follow: state.follow, [`mode-${state.mode}`]: true });
    set("textContent", {
      task: closed ? "" : task(map),
      points: line ? `${first} points.` : `First reading: ${first} points. Second: ${second}.`,
      sigmas: state.series && uncertainty(map, judged(map)),
      second: state.second ? "Back to the first reading" : "Read a second time",
    });
    if (document.activeElement !== get("width")) get("width").value = state.widths[0] ? state.widths[0].toFixed(1) : "";
  }

  // Sigma of a point, and what the run would notice with it.
  function uncertainty(map, found) {
    if (found.refused) return found.refused;
    const { allowance, id } = chosen_series();
    // That of measured points is the last one.
    const curve = curves_here().find(({ series }) => series === id) ?? curves_here().at(-1);
    const noticed = readings.noticed(map, found, curve, allowance, panel().scale);
    const words = noticed > MOST_NOTICED ? `The run could not tell: it would notice only errors above ${100 * MOST_NOTICED} %.`
      : `A curve ${readings.round(100 * noticed, 2)} % ${panel().scale ? "wider" : "larger"} than ours would fail.`;
    return `Uncertainty (sigma): ${said(found.sigmas[0], 0)} along x, ${said(found.sigmas[1], 1)} along y. ${words}`;
  }

  // A mark that does not fit the others, in words.
  const worst = ({ worst: found }) => (found ? `Mark ${state.marks.indexOf(placed()[found.i]) + 1} is ${found.off.toFixed(0)} px ` +
    "off where the others put it: set it again, or correct its numbers." : "");

  // What a click does now.
  function task(map) {
    if (state.mode === "marks") {
      const { x = null, y = null } = state.marks[state.next] ?? {};
      const where = x === null || y === null ? "a further mark" : `${name_of(panel().x)} ${x}, ${name_of(panel().y)} ${y}`;
      return `${worst(map)} Click where ${where} stands.`;
    }
    if (map.refused || map.worst) return `${map.refused ?? ""} ${worst(map)}`;
    if (state.mode === "look" || !state.series) return "Our curves lie over your copy. To read points, go to step 4.";
    const how = state.follow ? "Click along the line, then “Follow it”." : "Click the middle of each marker.";
    const which = is_line() ? "Reading" : `${state.second ? "Second" : "First"} reading`;
    return `${which} of: ${chosen_series().name}. ${how}`;
  }

  function draw_marks(map) {
    const [body] = get("marks").tBodies;
    const field = (axis, i) => `<td><input class="mark-${axis}" data-mark="${i}" inputmode="decimal"
      aria-label="${axis} of mark ${i + 1}"></td>`;
    // Rows are kept while their number is the same: who types would lose the field.
    if (body.rows.length !== state.marks.length) {
      body.innerHTML = state.marks.map((_, i) => `<tr><td><button type="button" class="mark-pick" data-mark="${i}"
        aria-label="Set mark ${i + 1} with the next click">${i + 1}</button></td>${field("x", i)}${field("y", i)}<td></td>
        <td></td><td><button type="button" class="mark-drop" data-mark="${i}" aria-label="Remove mark ${i + 1}">×</button></td>
        </tr>`).join("");
    }
    state.marks.forEach((mark, i) => {
      const [, x, y, place, beside] = body.rows[i].cells;
      const off = map.off?.[placed().indexOf(mark)];
      body.rows[i].className = i === state.next && state.mode === "marks" ? "next" : "";
      for (const [cell, value] of [[x, mark.x], [y, mark.y]]) {
        if (document.activeElement !== cell.firstChild) cell.firstChild.value = value ?? "";
      }
      place.textContent = mark.u === null ? "not set" : `${mark.u.toFixed(1)}, ${mark.v.toFixed(1)}`;
      beside.textContent = off?.toFixed(2) ?? "";
    });
    const count = placed().length;
    get("fit").className = map.worst || (map.refused && count > 2) ? "bad" : "";
    const quality = () => (map.freedom ? `${count} marks, residual ${map.residual.toFixed(2)} px.`
      : `${count} marks. A further one would show how good they are.`);
    get("fit").textContent = `${map.refused ?? quality()} ${worst(map)}`;
  }

  const style_of = ({ line }, i) => `curve c${i % 6} ${line}`;

  function draw_curves(map) {
    const { curves } = panel();
    const list = get("curves");
    if (list.dataset.panel !== state.panel) {
      list.dataset.panel = state.panel;
      list.innerHTML = curves.map((curve, i) => `<label><input type="checkbox" data-curve="${i}"> <svg viewBox="0 0 34 8"
        aria-hidden="true"><path class="${style_of(curve, i)}" d="M0,4H34"/></svg> ${curve.name}</label>`).join("");
    }
    list.querySelectorAll("input").forEach((box, i) => { box.checked = !state.off.includes(i); });
    get("lines").classList.toggle("unread", state.mode === "read"); // nobody shall read the model
    get("lines").innerHTML = map.refused ? "" : drawn().map((curve) => {
      const places = curve.x.map((x, k) => map.to_pixels([x, curve.y[k]]).map((one) => one.toFixed(2)).join(","));
      return `<polyline class="${style_of(curve, curve.i)}" points="${places.join(" ")}"/>`;
    }).join("");
  }

  const zoom = () => sheet.getBoundingClientRect().width / picture.naturalWidth || 1;

  // Lines of the map at round values, with their numbers, to be seen beside those of the print.
  function grid(map) {
    const { range } = panel();
    const size = 13 / zoom();
    return range.flatMap(([low, high], i) => {
      const step = 10 ** Math.floor(Math.log10(0.9 * (high - low)));
      const at = (value, other) => map.to_pixels(i ? [other, value] : [value, other]);
      const values = Array.from({ length: Math.floor((high - low) / step + 1.001) }, (_, k) => low + k * step);
      return values.map((value) => {
        const [start, end] = range[1 - i].map((other) => at(value, other));
        const [u, v] = at(value, 0);
        return `<path d="M${start}L${end}"/><text x="${u + size / 4}" y="${v - size / 4}" font-size="${size}">` +
          `${readings.round(value, 6)}</text>`;
      });
    }).join("");
  }

  function draw_signs(map) {
    const far = 6 / zoom();
    const cross = ([u, v], style) =>
      `<path class="sign ${style}" d="M${u - far},${v}H${u + far}M${u},${v - far}V${v + far}"/>`;
    const is_chosen = (list, i) => (state.chosen?.list === list && state.chosen.i === i ? "chosen" : "");
    get("signs").innerHTML = [
      map.refused || state.mode === "read" ? "" : `<g class="grid invitation">${grid(map)}</g>`, // not in a saved picture
      ...state.marks.map(({ u, v }, i) => (u === null ? "" : cross([u, v], `mark ${is_chosen("marks", i)}`))),
      ...reading().map(([u, v], i) =>
        `<circle class="sign point ${is_chosen("points", i)}" cx="${u}" cy="${v}" r="${far}"/>`),
      ...state.clicks.map((place) => cross(place, "click")),
      ...(state.cursor ? [cross(state.cursor, "cursor")] : []),
    ].join("");
  }

  function chosen_place() {
    const { list, i } = state.chosen ?? {};
    const mark = list === "marks" ? state.marks[i] : null;
    if (mark) return mark.u === null ? null : [mark.u, mark.v];
    return list === "points" ? reading()[i] ?? null : null;
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
    const map = fitted();
    if (map.refused) return;
    const point = map.to_axes(place);
    const all = (state.mode === "read" ? [] : drawn()).map((curve) => ({ ...curve, near: distance(curve, point, map.scale(place)) }));
    const nearest = all.sort((a, b) => a.near - b.near)[0];
    const beside = nearest ? `; ${nearest.near.toFixed(1)} px from “${nearest.name}”` : "";
    const [x, y] = [panel().x, panel().y].map((column, i) => `${name_of(column)} ${said(point[i], i)}`);
    get("pointer").textContent = `${x}, ${y}${beside}`;
  }

  // --- actions on the picture ---

  function place_of({ clientX, clientY }) {
    const { left, top } = sheet.getBoundingClientRect();
    return [(clientX - left) / zoom(), (clientY - top) / zoom()];
  }

  // The first mark that is not set, or a further one.
  function next_mark() {
    const unset = state.marks.findIndex((mark) => mark.u === null);
    return unset < 0 ? state.marks.length : unset;
  }

  function put([u, v]) {
    if (state.mode === "marks") {
      change(() => {
        if (state.next >= state.marks.length) state.marks.push({ x: null, y: null });
        Object.assign(state.marks[state.next], { u, v });
        state.chosen = { list: "marks", i: state.next };
        state.next = next_mark();
        if (state.next === state.marks.length) state.mode = "look";
      });
    } else if (state.mode === "read" && state.series && !fitted().refused) {
      change(() => {
        if (state.follow) return void state.clicks.push([u, v]);
        // A click on a point that was read chooses it.
        const there = reading().findIndex(([a, b]) => Math.hypot(a - u, b - v) < 6 / zoom());
        if (there < 0) state.by = "";
        state.chosen = { list: "points", i: there < 0 ? reading().push([u, v]) - 1 : there };
      });
    }
    tell([u, v]);
  }

  // Move the chosen mark or point, or the cursor of who has no mouse.
  function nudge([du, dv]) {
    const [u, v] = chosen_place() ?? state.cursor ?? [picture.naturalWidth / 2, picture.naturalHeight / 2];
    const place = [u + du, v + dv];
    change(() => {
      if (!chosen_place()) state.cursor = place;
      else if (state.chosen.list === "points") reading()[state.chosen.i] = place;
      else Object.assign(state.marks[state.chosen.i], { u: place[0], v: place[1] });
    });
    tell(place);
  }

  function remove_chosen() {
    change(() => {
      if (state.chosen?.list === "points") reading().splice(state.chosen.i, 1);
      if (state.chosen?.list === "marks") Object.assign(state.marks[state.chosen.i], { u: null, v: null });
      Object.assign(state, { chosen: null, next: next_mark() });
    });
  }

  const writes = (target) => target.matches("input:not([type=checkbox], [type=radio], [type=range], [type=file]), textarea");
  const typed = (text) => numbers.read(text);

  function press(event) {
    const is_z = /^[a-z]$/i.test(event.key) ? event.key.toLowerCase() === "z" : event.code === "KeyZ";
    if ((event.ctrlKey || event.metaKey) && is_z && !writes(event.target)) undo();
    else if (!picture.naturalWidth || event.target.matches("input, select, textarea")) return;
    else if (event.key in ARROWS) {
      const far = chosen_place() ? 1 : 10; // with Shift; without anything chosen the cursor goes
      nudge(ARROWS[event.key].map((one) => one * (event.shiftKey ? far : 0.1)));
    } else if (event.target !== sheet) return;
    else if (event.key === "Enter") put(state.cursor ??= [picture.naturalWidth / 2, picture.naturalHeight / 2]);
    else if (event.key === "Escape") change(() => { state.chosen = null; });
    else if (["Delete", "Backspace"].includes(event.key)) remove_chosen();
    else return;
    event.preventDefault();
  }

  // --- points ---

  function follow_line() {
    if (state.clicks.length < 2) {
      return refuse("Click the beginning and the end of the line first, and between where it bends.");
    }
    colour ??= colours_of(picture);
    const { points, width, length, left_out, lost, leg, move } = trace.follow(colour, state.clicks);
    if (lost) {
      return refuse(`The line is lost at pixel ${lost.map(Math.round).join(", ")}, between clicks ${leg} and ${leg + 1}: ` +
        `move click ${move} nearer to the middle of the line, or add one between.`);
    }
    refuse("");
    take(points, width, "followed along the line");
    get("task").textContent = `${points.length} points of a line of ${Math.round(length)} pixels; ` +
      `${Math.round(left_out)} of these are left out: crossings, markers, gaps between dashes.`;
  }

  const take = (points, width, by) => change(() => {
    state.readings[state.second ? 1 : 0] = points;
    state.widths[state.second ? 1 : 0] = width;
    Object.assign(state, { clicks: [], chosen: null, by });
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
    take(exports_of_others.points(x, y).map(fitted().to_pixels), 0, "exported from another program");
    set_mode("read");
  }

  // --- files ---

  const refuse = (text) => { get("refused").textContent = text; };

  async function open_file(file) {
    if (!file) return;
    if (/\.pdf$/i.test(file.name)) refuse("This page cannot draw a PDF. Paste a screenshot of the figure.");
    else if (file.type.startsWith("image/")) open_picture(file);
    else if (/\.json$/i.test(file.name)) open_saved(await file.text());
    else read_export(get("export").value = await file.text());
  }

  function open_picture(blob) {
    const [reader, trial] = [new FileReader(), new Image()]; // else what cannot be shown would replace the picture
    trial.onload = () => change(() => {
      // Marks and points are places in the picture before.
      const { panel: name, series, follow, off } = state;
      state = { ...fresh(name), series, follow, off };
      show_new(trial.src, {});
    });
    trial.onerror = () => refuse("The browser cannot show this file. Paste a screenshot of the figure.");
    reader.onload = () => { trial.src = reader.result; };
    reader.readAsDataURL(blob);
  }

  function show_new(address, others) {
    kept = others;
    shown = pictures.push(address) - 1;
    refuse("");
    show_picture();
  }

  function show_picture() {
    document.body.classList.toggle("opened", shown !== null);
    picture.src = pictures[shown] ?? "";
  }

  function on_picture() {
    const { naturalWidth: width, naturalHeight: height, src: href } = picture;
    sheet.setAttribute("viewBox", `0 0 ${width} ${height}`);
    for (const [name, value] of Object.entries({ href, width, height })) get("copy").setAttribute(name, value);
    colour = null;
    set_zoom();
  }

  // Everything, to go on another day.
  function save_all() {
    for (const one of [state, ...Object.values(kept)]) one.saved = JSON.stringify(one.readings);
    const all = JSON.stringify({ state, kept, picture: pictures[shown], texts: texts() });
    files.save(`${state.panel}_reading.json`, new Blob([all], { type: "application/json" }));
  }

  function open_saved(text) {
    let given = null;
    try {
      // Nothing of it may become a part of the page.
      given = JSON.parse(text, (_, value) => (typeof value === "string" ? value.replace(/[<>"]/g, "") : value));
    } catch { /* said below */ }
    if (!DATA.panels[given?.state?.panel] || !`${given.picture}`.startsWith("data:image/")) {
      return refuse("This file holds no readings that this page has saved.");
    }
    set("value", given.texts);
    change(() => {
      state = given.state;
      show_new(given.picture, given.kept);
    });
    return show_panel();
  }

  // At the smallest size the whole picture is seen; what is chosen, or lies in the middle, stays there.
  function set_zoom() {
    if (!picture.naturalWidth) return draw();
    const { naturalWidth: width, naturalHeight: height } = picture;
    const middle = chosen_place() ??
      [stage.scrollLeft + stage.clientWidth / 2, stage.scrollTop + stage.clientHeight / 2].map((one) => one / zoom());
    stage.style.height = sheet.style.height = ""; // and no bars to scroll with
    sheet.style.width = "0";
    const scale = get("zoom").value * Math.min(stage.clientWidth / width, (stage.clientHeight - 4) / height);
    Object.assign(sheet.style, { width: `${scale * width}px`, height: `${scale * height}px` });
    stage.style.height = `${Math.min(stage.clientHeight, scale * height) + 2}px`;
    stage.scrollTo(middle[0] * scale - stage.clientWidth / 2, middle[1] * scale - stage.clientHeight / 2);
    draw();
  }

  function save() {
    const said_of = { series: chosen_series(), ...texts() };
    const map = fitted();
    const found = judged(map);
    const unfit = found.refused ?? readings.unfit(said_of.series, map, found);
    const problem = found.refused ?? (readings.missing(said_of) || (unfit && worst(map)) || unfit);
    refuse(problem);
    get("saved").textContent = "";
    if (problem) return;
    const how = `planarimpact ${DATA.version}, your_copy.html; picture of ${picture.naturalWidth} x ` +
      `${picture.naturalHeight} px${state.by ? `; ${state.by}` : ""}`;
    const text = readings.csv(said_of, panel().range, map, placed(), found, how);
    const [source, name] = state.series.split("/");
    files.save(`${name}.csv`, new Blob([text], { type: "text/csv" }));
    state.saved = JSON.stringify(state.readings);
    get("saved").textContent = `Put ${name}.csv into the folder data/${source}/ of the project, and run: ` +
      `snakemake --cores 2 ${panel().figure}. The report shows ${name}.png (“Save picture”) if it lies beside it.`;
  }

  // Picture and curves as they lie, with the names of the curves, for one's own use.
  async function save_picture() {
    const names = [...get("curves").querySelectorAll("label")].filter((label) => label.firstChild.checked);
    const below = names.map((label) => [label.querySelector("path"), label.textContent.trim()]);
    const name = state.readings[0].length ? state.series.split("/")[1] : `${state.panel}_overlay`;
    files.save(`${name}.png`, await files.picture(sheet, [panel().title], below));
  }

  // --- controls ---

  // What a click does: it sets marks, only looks, or reads points.
  function set_mode(mode) {
    const other = { marks: "points", read: "marks" }[mode];
    if (state.chosen?.list === other) state.chosen = null;
    Object.assign(state, { mode, next: next_mark() });
    draw();
  }

  // Another panel of the picture; marks of an x axis that both share stay.
  function go_to(name) {
    const { box } = panel();
    const marks = box && DATA.panels[name].box === box ? state.marks.filter(({ y, u }) => y === 0 && u !== null) : [];
    change(() => {
      kept[state.panel] = state;
      state = kept[name] ?? fresh(name);
      for (const mark of state.marks.filter(({ y, u }) => y === 0 && u === null)) {
        Object.assign(mark, marks.find(({ x }) => x === mark.x));
      }
      state.next = next_mark();
    });
    show_panel();
  }

  function show_panel() {
    const { series, scale } = panel();
    get("panel").value = state.panel;
    get("series").replaceChildren(...series.map(({ id, name }) => new Option(name, id, false, id === state.series)));
    get("no-series").hidden = series.length > 0;
    get("with-scale").hidden = !scale;
    draw();
  }

  function choose_series(id) {
    const { line } = panel().series.find((one) => one.id === id);
    change(() => Object.assign(state, structuredClone(NOTHING_READ), { series: id, follow: line }));
  }

  const on = (id, event, action) => get(id).addEventListener(event, (happened) => action(happened.target, happened));

  function listen() {
    on("file", "change", ({ files: [file] }) => open_file(file));
    on("panel", "change", ({ value }) => go_to(value));
    on("series", "change", ({ value }) => { choose_series(value); set_mode("read"); });
    on("sheet", "click", (_, event) => { sheet.focus({ preventScroll: true }); state.cursor = null; put(place_of(event)); });
    on("sheet", "pointermove", (_, event) => {
      if (event.pointerType !== "mouse") return;
      tell(place_of(event));
      draw_loupe(place_of(event));
    });
    on("sheet", "pointerleave", () => draw_loupe());
    for (const name of ["marks", "look", "read"]) on(`mode-${name}`, "change", () => set_mode(name));
    on("marks", "click", ({ className, dataset }) => {
      const i = Number(dataset.mark);
      if (className === "mark-pick") {
        change(() => Object.assign(state, { next: i, mode: "marks", chosen: { list: "marks", i } }));
        set_zoom();
      }
      if (className === "mark-drop") {
        change(() => {
          state.marks.splice(i, 1);
          Object.assign(state, { next: next_mark(), chosen: null });
        });
        get("mark-add").focus();
      }
    });
    on("marks", "change", ({ className, value, dataset }) => {
      const number = typed(value);
      refuse(Number.isFinite(number) ? "" : `“${value}” is no number such as -0.5: the old one is kept.`);
      if (Number.isFinite(number)) change(() => { state.marks[dataset.mark][className.at(-1)] = number; });
      draw();
    });
    on("mark-add", "click", () => change(() => {
      state.next = state.marks.push({ x: null, y: null, u: null, v: null }) - 1;
      state.mode = "marks";
    }));
    on("curves", "change", ({ checked, dataset }) => change(() => {
      const i = Number(dataset.curve);
      state.off = checked ? state.off.filter((one) => one !== i) : [...state.off, i];
    }));
    on("scale", "input", draw);
    on("flat", "change", ({ checked }) => change(() => { state.flat = checked; }));
    on("width", "change", ({ value }) => change(() => { state.widths[0] = Math.max(0, typed(value)) || 0; }));
    on("magnifier", "change", () => draw_loupe());
    on("close-loupe", "click", () => get("magnifier").click());
    on("follow", "change", ({ checked }) => { change(() => { state.follow = checked; }); set_mode("read"); });
    on("opacity", "input", ({ value }) => sheet.style.setProperty("--opacity", value));
    on("zoom", "input", set_zoom);
    on("second", "click", () => {
      change(() => Object.assign(state, { second: !state.second, clicks: [], chosen: null }));
      set_mode("read");
    });
    on("trace", "click", follow_line);
    on("clear", "click", () => change(() => {
      const { second, readings: [first] } = state;
      Object.assign(state, structuredClone(NOTHING_READ), second ? { second, readings: [first, []] } : {});
    }));
    on("undo", "click", undo);
    for (const arrow of Object.keys(ARROWS)) on(arrow, "click", () => nudge(ARROWS[arrow].map((one) => 0.1 * one)));
    on("export", "input", ({ value }) => read_export(value));
    on("exchange", "click", () => {
      const [x, y] = ["export-x", "export-y"].map(get);
      [x.value, y.value] = [y.value, x.value];
    });
    on("export-take", "click", take_export);
    on("save", "click", save);
    on("save-all", "click", save_all);
    picture.addEventListener("load", on_picture);
    on("picture", "click", save_picture);
    for (const type of ["pointerdown", "pointerup", "keydown", "keyup", "blur"]) {
      window.addEventListener(type, ({ key = " ", target }) => {
        const held = key.toLowerCase() === "h" ? !writes(target) : target.id === "hold" && [" ", "Enter"].includes(key);
        sheet.classList.toggle("print-only", held && type.endsWith("down"));
      });
    }
    document.addEventListener("keydown", press);
    document.addEventListener("dragover", (event) => event.preventDefault());
    document.addEventListener("drop", (event) => { event.preventDefault(); open_file(event.dataTransfer.files[0]); });
    document.addEventListener("paste", ({ clipboardData, target }) => {
      if (writes(target)) return;
      // Cells of a table come as a picture, too.
      const [image, text] = [[...clipboardData.items].find(({ type }) => type.startsWith("image/")), clipboardData.getData("text")];
      if (image && exports_of_others.read(text, [panel().x, panel().y]).refused) open_picture(image.getAsFile());
      else read_export(get("export").value = text);
    });
    window.addEventListener("beforeunload", (event) => {
      const every = Object.values({ ...kept, [state.panel]: state });
      if (every.some(({ readings: own, saved }) => own[0].length && JSON.stringify(own) !== saved)) event.preventDefault();
    });
    window.addEventListener("resize", set_zoom);
  }

  // Distances of this page against those of the package.
  function check() {
    const wrong = Object.values(DATA.panels).flatMap((one) => one.check.filter(({ curve, point, near }) =>
      !(Math.abs(distance(one.curves[curve], point, spans(one)) - near) < 1e-6)));
    if (wrong.length) refuse(`Do not trust this page: ${wrong.length} of its distances differ from those of the package.`);
  }

  const asked = location.hash.slice(1); // a figure, of which the first panel is shown
  state = fresh(Object.keys(DATA.panels).find((name) => asked && name.startsWith(asked)) ?? "fig5");
  get("when").value = new Date().toISOString().slice(0, 10);
  listen();
  show_panel();
  check();
})();
