"use strict";

// Columns of numbers that WebPlotDigitizer, Engauge, PlotDigitizer, PlotTracer or others have exported, or any table.
const exports_of_others = (() => {
  // What other programs save for themselves, and how each of them exports a CSV.
  const PROJECTS = [
    [/^\s*\{[^]*"(wpd|axesColl|datasetColl)"|^[^]{257}ustar/, "WebPlotDigitizer", "“View Data”, “Download .CSV”"],
    [/^\s*(<\?xml[^>]*>\s*)?<(!DOCTYPE engauge|Document)\b/, "Engauge", "“File”, “Export”"],
  ];
  const bare = (name) => name.replace(/\[.*/, "").trim().toLowerCase(); // of a column, without its unit
  const has_words = ({ cells }) => cells.some((cell) => cell && !numbers.is_one(cell));

  // Lines that are not empty, as cells between separators. Where blanks separate, many are as one.
  function rows_of(text, separator) {
    const even = separator === " " ? text.replace(/^ +| +$/gm, "").replace(/ +/g, " ")
      : text.replace(/([,;\t]) +"/g, '$1"');
    const rows = Papa.parse(even, { delimiter: separator, transform: (cell) => cell.trim() }).data
      .map((cells, i) => ({ cells, line: i + 1 })).filter(({ cells }) => cells.some(Boolean));
    const of_numbers = rows.filter((row) => !has_words(row) && row.cells.filter(Boolean).length > 1);
    return { separator, rows, count: of_numbers.length };
  }

  // What to do with a file that another program has saved for itself.
  function project(text) {
    const [, name, way] = PROJECTS.find(([pattern]) => pattern.test(text)) ?? [];
    return name && `This is a project of ${name}. Export it there as CSV: ${way}.`;
  }

  // {columns: [{name, values}], chosen: the places of x and y by their names, or by those `wanted`, said}; or
  // {refused}.
  function read(text, wanted) {
    if (project(text)) return { refused: project(text) };
    const plain = text.replace(/^\uFEFF/, "").replace(/\r\n?/g, "\n").replace(/^[^\S\n]*#.*$/gm, "");
    const tried = ["\t", ";", ",", " "].map((separator) => rows_of(plain, separator));
    const { separator, rows, count } = tried.reduce((top, one) => (one.count > top.count ? one : top));
    const beginning = plain.trim().split("\n")[0].slice(0, 40);
    if (!count) return { refused: `No two columns of numbers in “${beginning}”. Paste an export.` };
    const first = rows.findIndex((row) => !has_words(row));
    const [above, body] = [rows.slice(0, first), rows.slice(first)];
    const width = Math.max(...body.map(({ cells }) => cells.length));
    // A line of one cell is a title. Names that have blanks cannot be told apart where blanks separate them.
    const heads = above.filter(({ cells }) => cells.length > 1 && (separator !== " " || cells.length === width));
    const [sets, names] = [heads.at(-2)?.cells ?? [], heads.at(-1)?.cells ?? []];
    const fits = ({ cells }) => (names.length ? !cells.slice(names.length).some(Boolean) : cells.length === width);
    const commas = body.some(({ cells }) => cells.some((cell) => cell.includes(",") && !numbers.is_unclear(cell)));
    // Without names, two numbers with decimal commas look like four whole ones.
    const whole = !names.length && separator === "," && width === 4 &&
      !body.some(({ cells }) => cells.join().includes("."));
    const is_unclear = ({ cells }) => whole || (!commas && cells.some(numbers.is_unclear));
    const has_number = ({ cells }) => cells.some(numbers.is_one);
    const [row, words] = [
      // A line above the numbers has names; one that has a number too is a damaged row.
      [above.find(has_number) ?? body.find(has_words), "not all cells are numbers."],
      [heads.find(({ cells }) => cells.length > width),
        `more than ${width} names. Put one with a comma in quotation marks.`],
      [body.find((one) => !fits(one)),
        `not ${names.length || width} cells. If commas are decimal, export with points.`],
      [body.find(is_unclear), "are commas decimal? Export with points."],
    ].find(([one]) => one) ?? [];
    if (row) return { refused: `Line ${row.line}, “${row.cells.join(" | ")}”: ${words}` };
    // WebPlotDigitizer has the names of data sets above X, Y, X, Y, each above the first of its two.
    const columns = Array.from({ length: width }, (_, i) => ({
      own: bare(names[i] ?? ""),
      name: [sets[i] || sets[i - 1], names[i] || `column ${i + 1}`].filter(Boolean).join(" "),
      values: body.map(({ cells }) => (cells[i] ? numbers.read(cells[i], true) : null)),
    })).filter(({ values }) => values.some((value) => value !== null));
    const [x, y] = ["x", "y"].map((axis, i) => columns.findIndex(({ own }) => [axis, bare(wanted[i])].includes(own)));
    const said = `${body.length} rows, ${columns.length} columns${commas ? "; decimal commas read as points" : ""}.`;
    return { columns, chosen: [x < 0 ? Number(y === 0) : x, y < 0 ? Number(x < 1) : y], said };
  }

  // Points of two of the columns.
  const points = (x, y) => x.values.map((value, i) => [value, y.values[i]]).filter((pair) => !pair.includes(null));

  return { read, points, project };
})();
