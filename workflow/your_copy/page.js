"use strict";

// What the reader has done stands in `state`, which undo takes back; all else is drawn from it.
const page = (() => {
  const get = (id) => document.getElementById(id);
  const [sheet, stage, picture] = ["sheet", "stage", "picture-of-copy"].map(get);
  const SAME_POINT = 0.03; // share of the picture in which two readings of one point lie
  const PLACEHOLDER = /^(your name|name|who|me|test|todo|xxx+|[.?\s-]*|<.*>)$/i;
  const round = (value, digits = 5) => Number(value.toPrecision(digits));
  const unit_of = (column) => column.match(/\[(.*)\]/)[1].replace(/^1$/, "");
  const name_of = (column) => column.replace(/ \[.*/, "").replaceAll("_", " ");
  const said = (value, column, digits = 3) => `${round(value, digits)} ${unit_of(column)}`.trim().replace("-", "\u2212").replace(/\bmu\b/, "µ");

  let state = null;
  const past = [];
  let dark = null; // darkness of the picture, once a line is followed
  let imported = null; // columns of an export
  let mode = "marks";

  const panel = () => DATA.panels[state.panel];
  const placed = () => state.marks.filter((mark) => mark.u !== null && Number.isFinite(mark.x) && Number.isFinite(mark.y));
  const fitted = () => maps.fit(placed());
  const reading = () => state.readings[state.second ? 1 : 0];
  const lost = () => state.picture === null;

  function fresh(name) {
    const { marks, series } = DATA.panels[name];
    return {
      panel: name, marks: marks.map(([x, y]) => ({ x, y, u: null, v: null })), next: 0, off: [],
      series: series[0]?.id ?? "", second: false, clicks: [], by: "",
      readings: [[], []], widths: [0, 0], chosen: null, cursor: null, picture: state?.picture ?? null,
    };
  }

  // Change the state, so that it can be undone.
  function change(action) {
    past.push(JSON.stringify(state));
    action();
    draw();
  }
  function undo() {
    if (past.length) state = { ...JSON.parse(past.pop()), picture: state.picture };
    draw();
  }

  // Curves of the panel as they are drawn: forces of an unknown scale are multiplied.
  const factor = () => (panel().scale ? Number(get("scale").value) || 1 : 1);
  const shown = () => panel().curves.map((curve, i) => ({ ...curve, i, y: curve.y.map((y) => y * factor()) }))
    .filter(({ i }) => !state.off.includes(i));

  // Distance of a point from a chain of points if both axes have these scales, and how far it lies above.
  function distance({ x, y }, [px, py], [sx, sy]) {
    const chain = x.map((value, i) => [value / sx, y[i] / sy]);
    const order = x.map((value, i) => [value, y[i]]).sort((a, b) => a[0] - b[0]);
    const k = order.findIndex(([value]) => value >= px);
    const [high, low] = [order[k < 0 ? order.length - 1 : k], order[Math.max(0, (k < 0 ? order.length : k) - 1)]];
    const share = high[0] > low[0] && px > low[0] ? Math.min(1, (px - low[0]) / (high[0] - low[0])) : 1;
    return { near: trace.beside([px / sx, py / sy], chain), above: py - low[1] - share * (high[1] - low[1]) };
  }
  const spans = ({ range }) => range.map(([low, high]) => high - low);

  function nearest(point) {
    const all = shown().map((curve) => ({ curve, ...distance(curve, point, spans(panel())) }));
    return all.reduce((best, one) => (!best || one.near < best.near ? one : best), null);
  }

  // --- drawing ---

  function draw() {
    const map = fitted();
    sheet.classList.toggle("reading", mode === "read");
    draw_marks(map);
    draw_curves(map);
    draw_points(map);
    draw_loupe();
    const usable = !lost() && !map.refused;
    for (const id of ["second", "trace", "save", "export-take"]) get(id).disabled = !usable || !state.series;
    get("picture").disabled = lost();
    get("second").textContent = state.second ? "Back to the first reading" : "Read a second time";
    get("second").disabled ||= !state.readings[0].length;
    get("undo").disabled = !past.length;
    get("trace").hidden = !get("follow").checked;
    get(`mode-${mode}`).checked = true;
    get("task").textContent = lost() ? "" : task(map);
  }

  // What a click does now.
  function task(map) {
    if (mode === "marks") {
      const { x = null, y = null } = state.marks[state.next] ?? {};
      return `Click where ${x === null ? "a further mark" : `${name_of(panel().x)} ${x}, ${name_of(panel().y)} ${y}`} stands.`;
    }
    if (map.refused) return map.refused;
    if (mode === "look") return "Our curves lie over your copy. To read points, go to step 4.";
    const what = get("series").selectedOptions[0]?.textContent ?? "";
    return `${state.second ? "Second" : "First"} reading of: ${what}. ` + (get("follow").checked
      ? "Click along the line, then “Follow it”." : "Click the middle of each marker.");
  }

  function draw_marks(map) {
    const rows = state.marks.map((mark, i) => {
      const off = map.off && placed().includes(mark) ? map.off[placed().indexOf(mark)] : null;
      const place = mark.u === null ? "not set" : `${mark.u.toFixed(1)}, ${mark.v.toFixed(1)}`;
      return `<tr${i === state.next && mode === "marks" ? ' class="next"' : ""}><td><button type="button" class="mark-pick" data-mark="${i}"
        aria-label="Mark ${i + 1}: set it with the next click">${i + 1}</button></td>
        <td><input class="mark-x" data-mark="${i}" inputmode="decimal" aria-label="x of mark ${i + 1}" value="${mark.x ?? ""}"></td>
        <td><input class="mark-y" data-mark="${i}" inputmode="decimal" aria-label="y of mark ${i + 1}" value="${mark.y ?? ""}"></td>
        <td>${place}</td><td>${off ? Math.hypot(off.u, off.v).toFixed(2) : ""}</td>
        <td><button type="button" class="mark-drop" data-mark="${i}" aria-label="Remove mark ${i + 1}">×</button></td></tr>`;
    });
    const focused = document.activeElement?.matches?.("#marks input, #marks button") ? document.activeElement : null;
    const key = focused && `.${focused.className}[data-mark="${focused.dataset.mark}"]`;
    get("marks").tBodies[0].innerHTML = rows.join("");
    if (key) document.querySelector(`#marks ${key}`)?.focus();
    const { x, y } = panel();
    get("fit").classList.toggle("bad", Boolean(map.refused) && placed().length > 2);
    get("fit").textContent = map.refused ?? `${map.kind === "affine" ? "Affine map" : "Perspective map"} from ${placed().length} marks` +
      (map.of_freedom === null || placed().length === 3 ? ". A further mark would show how good it is."
        : `; residual ${map.residual.pixels.toFixed(2)} px: ${said(map.residual.x, x, 2)} along x, ${said(map.residual.y, y, 2)} along y.`);
  }

  const zoom = () => sheet.getBoundingClientRect().width / (picture.naturalWidth || 1) || 1;
  const cross = (u, v, size, style) =>
    `<path class="${style}" d="M${u - size},${v}H${u + size}M${u},${v - size}V${v + size}"/>`;
  const path = (points) => (points.length ? `M${points.map(([u, v]) => `${u.toFixed(2)},${v.toFixed(2)}`).join("L")}` : "");

  function draw_curves(map) {
    const { curves, range } = panel();
    get("curves").innerHTML = curves.map(({ name, line }, i) =>
      `<label><input type="checkbox" data-curve="${i}"${state.off.includes(i) ? "" : " checked"}>
      <svg viewBox="0 0 34 8" aria-hidden="true"><path class="curve c${i % 6} ${line}" d="M0,4H34"/></svg> ${name}</label>`).join("");
    if (map.refused || lost()) return get("lines").replaceChildren();
    const inside = ([x, y]) => [x, y].every((value, i) => {
      const margin = 0.1 * (range[i][1] - range[i][0]);
      return value >= range[i][0] - margin && value <= range[i][1] + margin;
    });
    get("lines").innerHTML = shown().map(({ x, y, line, i }) => {
      const points = x.map((value, k) => [value, y[k]]).filter(inside);
      return `<path class="curve c${i % 6} ${line}" d="${path(points.map(map.to_pixels))}"/>`;
    }).join("");
  }

  function draw_points() {
    const size = 6 / zoom();
    const signs = state.marks.map((mark, i) => (mark.u === null ? ""
      : cross(mark.u, mark.v, size * 1.6, `sign mark${state.chosen?.list === "marks" && state.chosen.i === i ? " chosen" : ""}`)));
    const points = reading().map(([u, v], i) =>
      `<circle class="sign point${state.chosen?.list === "points" && state.chosen.i === i ? " chosen" : ""}" cx="${u}" cy="${v}" r="${size}"/>`);
    const clicks = state.clicks.map(([u, v]) => cross(u, v, size, "sign click"));
    const cursor = state.cursor && document.activeElement === sheet ? [cross(...state.cursor, size * 2, "sign cursor")] : [];
    get("signs").innerHTML = [...signs, ...points, ...clicks, ...cursor].join("");
    const count = state.readings.map((one) => one.length);
    get("points").textContent = `First reading: ${count[0]} points. Second: ${count[1]}.`;
    const found = sigmas();
    get("sigmas").textContent = found.refused ?? `Uncertainty (sigma): ${said(found.x, panel().x, 2)} along x, ${said(found.y, panel().y, 2)} along y.`;
  }

  function draw_loupe() {
    const at = place_of_chosen() ?? state.cursor;
    get("close-up").hidden = lost() || !at;
    if (at) get("loupe").setAttribute("viewBox", `${at[0] - 10} ${at[1] - 10} 20 20`);
  }

  const place_of_chosen = () => {
    const { chosen } = state;
    if (!chosen) return null;
    const mark = state.marks[chosen.i];
    return chosen.list === "marks" ? (mark?.u != null ? [mark.u, mark.v] : null) : reading()[chosen.i] ?? null;
  };

  function tell(place) {
    const map = fitted();
    if (map.refused || !place) return;
    const point = map.to_axes(place);
    const { x, y } = panel();
    const near = nearest(point);
    const beside = near ? `; ${said(Math.abs(near.above), y, 2)} ${near.above < 0 ? "below" : "above"} “${near.curve.name}”` : "";
    get("pointer").textContent = `${name_of(x)} ${said(point[0], x)}, ${name_of(y)} ${said(point[1], y)}${beside}`;
  }

  // --- actions on the picture ---

  const in_picture = (event) => {
    const box = sheet.getBoundingClientRect();
    return [((event.clientX - box.left) / box.width) * picture.naturalWidth, ((event.clientY - box.top) / box.height) * picture.naturalHeight];
  };

  function put([u, v]) {
    if (lost()) return;
    if (mode === "marks") {
      change(() => {
        if (state.next >= state.marks.length) state.marks.push({ x: null, y: null, u, v });
        Object.assign(state.marks[state.next], { u, v });
        state.chosen = { list: "marks", i: state.next };
        const unset = state.marks.findIndex((mark) => mark.u === null);
        state.next = unset < 0 ? state.marks.length : unset;
        if (unset < 0) mode = "look";
      });
    } else if (mode === "read" && state.series && !fitted().refused) {
      change(() => {
        if (get("follow").checked) state.clicks.push([u, v]);
        else {
          reading().push([u, v]);
          state.chosen = { list: "points", i: reading().length - 1 };
        }
      });
    }
    tell([u, v]);
  }

  function nudge([du, dv]) {
    if (!place_of_chosen()) {
      state.cursor = (state.cursor ?? [picture.naturalWidth / 2, picture.naturalHeight / 2]).map((one, i) => one + [du, dv][i]);
      tell(state.cursor);
      return draw();
    }
    change(() => {
      if (state.chosen.list === "marks") {
        const mark = state.marks[state.chosen.i];
        Object.assign(mark, { u: mark.u + du, v: mark.v + dv });
      } else reading()[state.chosen.i] = reading()[state.chosen.i].map((one, i) => one + [du, dv][i]);
    });
    tell(place_of_chosen());
  }

  const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
  function key(event) {
    if ((event.ctrlKey || event.metaKey) && event.key.toLowerCase() === "z") return undo(), event.preventDefault();
    if (event.target !== sheet || lost()) return undefined;
    if (event.key in ARROWS) {
      nudge(ARROWS[event.key].map((one) => one * (event.shiftKey ? 10 : 0.1)));
    } else if (event.key === "Enter") {
      put(state.cursor ?? [picture.naturalWidth / 2, picture.naturalHeight / 2]);
    } else if (event.key === "Escape") {
      state.chosen = null;
      draw();
    } else if (event.key === "Delete" || event.key === "Backspace") remove_chosen();
    else return undefined;
    return event.preventDefault();
  }

  const remove_chosen = () => state.chosen && change(() => {
    if (state.chosen.list === "points") reading().splice(state.chosen.i, 1);
    else Object.assign(state.marks[state.chosen.i], { u: null, v: null });
    state.chosen = null;
  });

  // --- readings ---

  // Both sigmas in units of the axes: of two readings, of the marks, and of a line half its width.
  function sigmas() {
    const [map, [first, second]] = [fitted(), state.readings];
    if (map.refused) return { refused: map.refused };
    if (!first.length || !second.length) return { refused: "The uncertainty is known once you have read the points twice." };
    const half = Math.max(...state.widths) / 2;
    const pairs = half ? second.map((point) => [point, point]) : paired(first, second);
    if (!half && (pairs.length !== first.length || first.length !== second.length)) {
      return { refused: `The readings have ${first.length} and ${second.length} points, of which ${pairs.length} are the same.` };
    }
    const scales = first.map(map.scale);
    const [x, y] = [0, 1].map((i) => {
      const pixel = maps.rms(scales.map((scale) => scale[i]));
      const twice = half ? pixel * maps.rms(second.map((point) => trace.beside(point, first)))
        : maps.rms(pairs.map(([a, b]) => map.to_axes(a)[i] - map.to_axes(b)[i]));
      return Math.hypot(twice / Math.SQRT2, pixel * map.sigma, pixel * half);
    });
    const origin = "two readings, root mean square of their difference over the square root of 2" +
      `${half ? "; half the width of the line" : ""}; residual of the marks`;
    return { x, y, origin, values: half ? null : pairs.length };
  }

  // Points of two readings that are the same, nearest first.
  function paired(first, second) {
    const most = SAME_POINT * Math.hypot(picture.naturalWidth, picture.naturalHeight);
    const near = first.flatMap((a, i) => second.map((b, k) => ({ i, k, far: Math.hypot(a[0] - b[0], a[1] - b[1]) })))
      .filter(({ far }) => far < most).sort((a, b) => a.far - b.far);
    const [is, ks, found] = [new Set(), new Set(), []];
    for (const { i, k } of near) {
      if (is.has(i) || ks.has(k)) continue;
      is.add(i).add(i);
      ks.add(k);
      found.push([first[i], second[k]]);
    }
    return found;
  }

  function follow_line() {
    if (state.clicks.length < 2) return refuse("Click the beginning and the end of the line first, and points between where it bends.");
    dark ??= trace.darkness(picture);
    const { points, width, lost: end } = trace.follow(dark, state.clicks);
    if (end) return refuse(`The line is lost at pixel ${end.map((one) => one.toFixed(0)).join(", ")}. Click more points along it.`);
    refuse("");
    return change(() => {
      state.readings[state.second ? 1 : 0] = points;
      state.widths[state.second ? 1 : 0] = width;
      Object.assign(state, { clicks: [], chosen: null, by: "followed along the line" });
    });
  }

  function take_text(text) {
    imported = exports_of_others.read(text);
    const { columns = [], refused, said: words } = imported;
    get("export-said").textContent = refused ?? words;
    get("export-said").classList.toggle("bad", Boolean(refused));
    ["export-x", "export-y"].forEach((id, i) => {
      get(id).innerHTML = columns.map(({ name }, k) => `<option value="${k}"${k === i ? " selected" : ""}>${name.replace(/[<&]/g, "")}</option>`).join("");
    });
    get("export-columns").hidden = Boolean(refused);
  }

  function take_columns() {
    const map = fitted();
    if (!imported?.columns || map.refused) return;
    const [x, y] = ["export-x", "export-y"].map((id) => imported.columns[get(id).value]);
    change(() => {
      state.readings[state.second ? 1 : 0] = exports_of_others.points(x, y).map(map.to_pixels);
      Object.assign(state, { by: "exported from another program", chosen: null });
    });
    set_mode("read");
  }

  // --- files ---

  const refuse = (text) => { get("refused").textContent = text; };

  function open_picture(blob) {
    const url = URL.createObjectURL(blob);
    picture.onload = () => {
      const [width, height] = [picture.naturalWidth, picture.naturalHeight];
      Object.assign(state, { picture: blob.name || "a picture from the clipboard", cursor: null });
      dark = null;
      sheet.setAttribute("viewBox", `0 0 ${width} ${height}`);
      for (const [name, value] of Object.entries({ href: url, width, height })) get("copy").setAttribute(name, value);
      document.body.classList.add("opened");
      refuse("");
      set_zoom();
      set_mode("marks");
    };
    picture.onerror = () => refuse("This file is no picture that the browser can show. Take a screenshot of the page of the PDF, and paste it.");
    picture.src = url;
  }

  async function open_file(file) {
    if (!file) return;
    if (file.type.startsWith("image/")) open_picture(file);
    else if (/\.pdf$/i.test(file.name)) refuse("A browser page cannot draw a PDF. Take a screenshot of the figure, and paste it here.");
    else get("export").value = await file.text(), take_text(get("export").value), get("others").open = true;
  }

  function set_zoom() {
    const centre = [stage.scrollLeft + stage.clientWidth / 2, stage.scrollTop + stage.clientHeight / 2].map((one) => one / zoom());
    stage.style.height = "";
    const fit = Math.min(stage.clientWidth / picture.naturalWidth, Math.max(0.1, (stage.clientHeight - 4) / picture.naturalHeight));
    const size = fit * Number(get("zoom").value);
    Object.assign(sheet.style, { width: `${size * picture.naturalWidth}px`, height: `${size * picture.naturalHeight}px` });
    stage.style.height = `${Math.min(stage.clientHeight, size * picture.naturalHeight) + 2}px`;
    stage.scrollTo(centre[0] * size - stage.clientWidth / 2, centre[1] * size - stage.clientHeight / 2);
    draw();
  }

  function set_mode(wanted) {
    mode = wanted;
    if (mode === "marks" && state.chosen?.list === "points") state.chosen = null;
    draw();
  }

  // What the file says: who, when, from what, how, both sigmas; then the first reading.
  function csv() {
    const [who, when, from] = ["who", "when", "from"].map((id) => get(id).value.trim());
    if (who.length < 3 || PLACEHOLDER.test(who)) return { refused: "Who read the points? Give a name." };
    if (!/^\d{4}-\d\d-\d\d$/.test(when)) return { refused: "When were they read? Give the date." };
    if (from.length < 3 || PLACEHOLDER.test(from)) return { refused: "From what were they read? Say figure, page, and which copy." };
    const { asks, series, x, y } = panel();
    const asked = asks && series.find(({ id }) => id === state.series).open;
    if (asked && !(Number(get("incidence").value) > 0)) return { refused: "The paper does not state the incidence. Give that of the print: its velocity at time 0." };
    const [map, found] = [fitted(), sigmas()];
    if (found.refused) return found;
    const own = series.find(({ id }) => id === state.series);
    const marks = placed().map((m) => `(${m.x}, ${m.y}) at ${m.u.toFixed(1)}, ${m.v.toFixed(1)}`).join("; ");
    const how = `planarimpact ${DATA.version}, your_copy.html; picture of ${picture.naturalWidth} x ${picture.naturalHeight} px, ` +
      `${placed().length} marks, ${map.kind} map, residual ${map.residual.pixels.toFixed(2)} px: ${round(map.residual.x, 2)} ${unit_of(x)} along x, ` +
      `${round(map.residual.y, 2)} ${unit_of(y)} along y${state.by ? `; ${state.by}` : ""}; marks ${marks}`;
    const head = { series: state.series, who, when, from, how, sigma_x: round(found.x, 3), sigma_y: round(found.y, 3),
      sigma_origin: found.origin, ...(found.values ? { sigma_values: found.values } : {}), ...(asked ? { incidence: get("incidence").value } : {}) };
    const rows = state.readings[0].map((place) => map.to_axes(place).map((value) => round(value, 6)))
      .sort((a, b) => a[0] - b[0]);
    const lines = Object.entries(head).map(([name, value]) => `# ${name}: ${`${value}`.replace(/\s+/g, " ")}`);
    return { name: own.id.split("/")[1], source: own.id.split("/")[0], text: [...lines, own.columns.join(","), ...rows.map((row) => row.join(","))].join("\n") + "\n" };
  }

  function save() {
    const found = csv();
    refuse(found.refused ?? "");
    if (found.refused) return;
    files.save(`${found.name}.csv`, new Blob([found.text], { type: "text/csv" }));
    get("saved").textContent = `Put ${found.name}.csv into the folder data/${found.source}/ of the project, and run: snakemake --cores 2 ${panel().figure}`;
  }

  // Picture and curves as they lie, for one's own use.
  function overlay() {
    const canvas = document.createElement("canvas");
    Object.assign(canvas, { width: picture.naturalWidth, height: picture.naturalHeight });
    const pen = canvas.getContext("2d");
    pen.fillStyle = "#fff";
    pen.fillRect(0, 0, canvas.width, canvas.height);
    pen.globalAlpha = Number(get("opacity").value);
    pen.drawImage(picture, 0, 0);
    pen.globalAlpha = 1;
    for (const line of sheet.querySelectorAll("#lines path, #signs .point")) {
      const { stroke, strokeDasharray } = getComputedStyle(line);
      pen.strokeStyle = stroke;
      pen.lineWidth = canvas.width / 500;
      pen.setLineDash(strokeDasharray === "none" ? [] : strokeDasharray.split(",").map((part) => parseFloat(part) * canvas.width / 800));
      const circle = new Path2D();
      if (line.localName === "circle") circle.arc(...["cx", "cy", "r"].map((name) => line.getAttribute(name)), 0, 7);
      pen.stroke(line.localName === "circle" ? circle : new Path2D(line.getAttribute("d")));
    }
    canvas.toBlob((blob) => files.save(`${state.panel}_overlay.png`, blob), "image/png");
  }

  // --- controls ---

  function choose_panel(name) {
    state = fresh(name);
    const { series, scale, asks } = panel();
    get("panel").value = name;
    get("series").innerHTML = series.map(({ id, name: title }) => `<option value="${id}">${title}</option>`).join("");
    get("no-series").hidden = series.length > 0;
    get("with-scale").hidden = !scale;
    get("with-incidence").hidden = !asks;
    choose_series();
  }
  function choose_series() {
    state.series = get("series").value;
    const own = panel().series.find(({ id }) => id === state.series);
    get("follow").checked = own?.line ?? false;
    draw();
  }

  const on = (id, event, action) => get(id).addEventListener(event, action);
  const clear_points = () => change(() => Object.assign(state, { readings: [[], []], widths: [0, 0], clicks: [], second: false, chosen: null, by: "" }));

  function listen() {
    on("file", "change", (event) => open_file(event.target.files[0]));
    on("panel", "change", (event) => change(() => choose_panel(event.target.value)));
    on("series", "change", () => { choose_series(); clear_points(); set_mode("read"); });
    on("sheet", "click", (event) => { sheet.focus({ preventScroll: true }); put(in_picture(event)); });
    on("sheet", "pointermove", (event) => {
      if (event.pointerType !== "mouse" || lost()) return;
      tell(in_picture(event));
      get("close-up").hidden = false;
      const [u, v] = in_picture(event);
      get("loupe").setAttribute("viewBox", `${u - 10} ${v - 10} 20 20`);
    });
    on("sheet", "pointerleave", draw_loupe);
    for (const event of ["focus", "blur"]) on("sheet", event, draw);
    document.addEventListener("keydown", key);
    for (const name of ["marks", "look", "read"]) on(`mode-${name}`, "change", () => set_mode(name));
    on("marks", "click", ({ target }) => {
      const i = Number(target.dataset.mark);
      if (target.matches(".mark-pick")) change(() => Object.assign(state, { next: i, chosen: { list: "marks", i } })), set_mode("marks");
      if (target.matches(".mark-drop")) change(() => Object.assign(state, { marks: state.marks.filter((_, k) => k !== i), next: Math.max(0, state.next - (i < state.next)), chosen: null }));
    });
    on("marks", "change", ({ target }) => {
      const value = target.value.trim() === "" ? NaN : Number(target.value.replace("\u2212", "-"));
      refuse(Number.isFinite(value) ? "" : `“${target.value}” is no number such as -0.5.`);
      change(() => { state.marks[target.dataset.mark][target.className === "mark-x" ? "x" : "y"] = Number.isFinite(value) ? value : null; });
    });
    on("mark-add", "click", () => change(() => { state.next = state.marks.push({ x: null, y: null, u: null, v: null }) - 1; }));
    on("curves", "change", ({ target }) => change(() => {
      const i = Number(target.dataset.curve);
      state.off = target.checked ? state.off.filter((one) => one !== i) : [...state.off, i];
    }));
    on("scale", "input", draw);
    on("follow", "change", () => set_mode("read"));
    on("opacity", "input", ({ target }) => sheet.style.setProperty("--opacity", target.value));
    on("zoom", "input", set_zoom);
    window.addEventListener("resize", () => !lost() && set_zoom());
    const hold = (is) => () => sheet.classList.toggle("print-only", is);
    for (const event of ["pointerdown", "keydown"]) on("hold", event, hold(true));
    for (const event of ["pointerup", "pointerleave", "keyup", "blur"]) on("hold", event, hold(false));
    const held = (is) => ({ key: pressed, target }) => pressed.toLowerCase() === "h" && !target.matches("input, textarea, select") && hold(is)();
    document.addEventListener("keydown", held(true));
    document.addEventListener("keyup", held(false));
    on("second", "click", () => change(() => Object.assign(state, { second: !state.second, clicks: [], chosen: null }), set_mode("read")));
    on("trace", "click", follow_line);
    on("clear", "click", clear_points);
    on("undo", "click", undo);
    for (const [id, step] of Object.entries({ left: [-0.1, 0], right: [0.1, 0], up: [0, -0.1], down: [0, 0.1] })) on(`nudge-${id}`, "click", () => nudge(step));
    on("export", "input", ({ target }) => take_text(target.value));
    on("exchange", "click", () => { [get("export-x").value, get("export-y").value] = [get("export-y").value, get("export-x").value]; });
    on("export-take", "click", take_columns);
    on("save", "click", save);
    on("picture", "click", overlay);
    document.addEventListener("dragover", (event) => event.preventDefault());
    document.addEventListener("drop", (event) => { event.preventDefault(); open_file(event.dataTransfer.files[0]); });
    document.addEventListener("paste", ({ clipboardData, target }) => {
      const image = [...clipboardData.items].find(({ type }) => type.startsWith("image/"));
      if (image) return open_picture(image.getAsFile());
      if (!target.matches("input, textarea")) get("export").value = clipboardData.getData("text"), take_text(get("export").value), get("others").open = true;
      return undefined;
    });
  }

  // Distances of this page against those of the package.
  function check() {
    const wrong = Object.values(DATA.panels).flatMap((one) => one.check.filter(({ curve, point, near, above }) => {
      const found = distance(one.curves[curve], point, spans(one));
      return Math.abs(found.near - near) > 1e-6 || Math.abs(found.above - above) > 1e-6 * spans(one)[1];
    }));
    if (wrong.length) refuse(`Do not trust this page: ${wrong.length} of its distances differ from those of the package.`);
  }

  function start() {
    listen();
    get("when").value = new Date().toISOString().slice(0, 10);
    choose_panel(location.hash.slice(1) in DATA.panels ? location.hash.slice(1) : "fig5");
    check();
  }

  return { start, csv };
})();
page.start();
