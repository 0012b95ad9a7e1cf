"use strict";

// Columns of numbers that another program has exported: WebPlotDigitizer (one data set or all), Engauge,
// PlotDigitizer, PlotTracer, or any table of two columns or more.
const exports_of_others = (() => {
  const NUMBER = /^[-+\u2212]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?$/i;
  const WITH_COMMA = /^[-+\u2212]?\d*,\d+(e[-+]?\d+)?$/i;
  const SEPARATORS = [/\t/, /;/, /,/, /\s+/];

  const cells_of = (line, separator) =>
    line.trim().split(separator).map((cell) => cell.trim().replace(/^"(.*)"$/, "$1").trim());
  const is_number = (cell) => NUMBER.test(cell) && Number.isFinite(Number(cell.replace("\u2212", "-")));
  // With decimal commas as points, where commas do not stand between cells.
  const with_points = (cells, separator) =>
    separator.source === "," ? cells : cells.map((cell) => (WITH_COMMA.test(cell) ? cell.replace(",", ".") : cell));
  const all_numbers = (cells) => cells.some(is_number) && cells.every((cell) => cell === "" || is_number(cell));

  // {columns: [{name, values}], said}, values null where a cell is empty; or {refused}.
  function read(text) {
    const lines = text.replace(/^\uFEFF/, "").split(/\r\n|\r|\n/)
      .map((line, i) => ({ line, number: i + 1 }))
      .filter(({ line }) => line.trim() && !line.trim().startsWith("#"));
    if (!lines.length) return { refused: "There is no text. Paste an export here, or open its file." };
    const tried = SEPARATORS.map((separator) => {
      const rows = lines.map(({ line, number }) => ({ number, cells: with_points(cells_of(line, separator), separator) }));
      return { separator, rows, count: rows.filter(({ cells }) => cells.length > 1 && all_numbers(cells)).length };
    });
    const best = tried.reduce((top, one) => (one.count > top.count ? one : top));
    if (!best.count) return { refused: `No two columns of numbers in “${lines[0].line.trim().slice(0, 40)}”.` };
    const first = best.rows.findIndex(({ cells }) => all_numbers(cells));
    const [head, rows] = [best.rows.slice(0, first), best.rows.slice(first)];
    // A line above the numbers has names; one that has a number too is a damaged row.
    const wrong = head.find(({ cells }) => cells.some(is_number)) ?? rows.find(({ cells }) => !all_numbers(cells));
    if (wrong) {
      const cell = wrong.cells.find((one) => one !== "" && !is_number(one));
      return { refused: `Line ${wrong.number}: “${cell}” is no number.` };
    }
    const width = Math.max(...rows.map(({ cells }) => cells.length));
    const names = head.at(-1)?.cells ?? [];
    const whole = rows.every(({ cells }) => cells.every((cell) => !cell.includes(".")));
    if (best.separator.source === "," && width === 4 && names.length !== width && whole) {
      return { refused: "These seem to be decimal commas, with commas between cells too. Export with decimal points." };
    }
    // WebPlotDigitizer has the names of data sets above X, Y, X, Y, each above the first of its two.
    const above = head.length > 1 ? head.at(-2).cells : [];
    const columns = Array.from({ length: width }, (_, i) => ({
      name: [above[i] || above[i - 1], names[i] || `column ${i + 1}`].filter(Boolean).join(" "),
      values: rows.map(({ cells }) => (cells[i] ? Number(cells[i].replace("\u2212", "-")) : null)),
    })).filter(({ values }) => values.some((value) => value !== null));
    if (columns.length < 2) return { refused: "There is one column of numbers; two are needed." };
    const commas = lines.some(({ line }) => cells_of(line, best.separator).some((cell) => WITH_COMMA.test(cell)));
    const read_as = commas && best.separator.source !== "," ? "; decimal commas read as points" : "";
    const said = `${rows.length} rows, ${columns.length} columns${read_as}.`;
    return { columns, said };
  }

  // Points of two of the columns.
  const points = (x, y) => x.values.map((value, i) => [value, y.values[i]])
    .filter(([a, b]) => a !== null && b !== null);

  return { read, points };
})();
