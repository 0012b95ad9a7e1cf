"""Write the run as one page, and its sources and settings as another.

Nothing is solved here. The error of a job that failed stands on top, and in place of what it should
have made. What cannot be shown is left out and named on top; the gate fails on it.
"""

import io
import re
import shutil
import traceback
from collections import Counter
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any, TypeAlias

from markupsafe import Markup

from stronge1994 import csv_tables
from stronge1994.csv_tables import Row
from stronge1994.curve_names import is_of_paper, unit
from stronge1994.figures.shared.drawing import house_style
from stronge1994.figures.shared.drawing import residuals as draw_residuals
from stronge1994.formulas import mathematical, plain
from stronge1994.judging.verdicts import VISIBLE_SHIFT
from stronge1994.ledger import outcome
from stronge1994.pages import (
    key_numbers,
    ledger_page,
    names,
    run_facts,
    sources_page,
    templates,
    which_model,
)
from stronge1994.run import gate, record
from stronge1994.verdict_tables import figure_table, verdict_table

MARKS = {
    "wrong": "fails",
    "diverges": "fails",
    "unexplained difference": "judgement",
    "untested difference": "misprint",
    "explained difference": "rounding",
    "awaited": "not",
    "inconclusive": "not",
    "agrees": "confirmed",
    "right": "confirmed",
    "as before": "not",
}
MEANING = {
    "wrong": "our curve is not that of its model, by a second code or a law: the run fails",
    "diverges": "outside its tolerance, or a known difference has changed: the run fails",
    "unexplained difference": "as large as before; we do not know its cause",
    "untested difference": "how much the points scatter, or a computation errs, is not published: "
    "χ² tests nothing",
    "explained difference": "as large as before; we know its cause",
    "awaited": "we do not have the reference yet",
    "inconclusive": "the uncertainties are too large to decide: it would also agree if all points "
    f"lay {VISIBLE_SHIFT:g} sigmas beside the curve",
    "agrees": "with the paper or with others: p is large enough (published or measured points), or "
    "the distance is within its tolerance",
    "right": "our curve is that of its model: within the tolerance of our second code or of a law",
    "as before": "it was solved without error, or fitted to these points: no evidence",
}
TemplateValues: TypeAlias = dict[str, Any]  # of a figure, or of the page
# Tables with a section of the report; their captions stand in files of the same names.
SECTIONS = ("which_model", "trade")


class Salvage:
    """Call functions, go on where one fails, and keep a message.

    >>> salvage = Salvage()
    >>> salvage("Fig. 5", "nothing", lambda: {}["curve"])
    'nothing'
    >>> salvage.problems
    ["Fig. 5: KeyError: 'curve'"]
    """

    def __init__(self) -> None:
        self.problems: list[str] = []

    def __call__(
        self, what: str, otherwise: Any, function: Callable[..., Any], *arguments: Any
    ) -> Any:
        """What the function returns, or `otherwise`."""
        try:
            return function(*arguments)
        except csv_tables.Failed:  # the record of the job that failed has the error
            return otherwise
        except Exception as error:
            traceback.print_exc()  # into the log of the job
            self.problems.append(f"{what}: {type(error).__name__}: {error}")
            return otherwise


def page(values: TemplateValues, template: str | Path) -> str:
    """The report, from `values` as `write` makes them."""
    verdicts, entries = values["verdicts"], {row["entry"] for row in values["ledger"]}

    def entry_of(row: Row) -> str | None:
        """Entry of the ledger that a row of the verdict table names."""
        name = row["note"].removeprefix(verdict_table.LEDGER)
        return name if name in entries else None

    environment = templates.environment(Path(template).parent)
    environment.filters |= {
        "maths": ledger_page.linked_maths(entries, "ledger.html"),
        "bounds": bounds,
        "measured": measured,
    }
    environment.tests["in_paper"] = is_of_paper
    return environment.get_template(Path(template).name).render(
        values,
        lapsed=outcome.failing(values["ledger"]),
        grave=[row for row in values["ledger"] if row["grade"] == next(iter(outcome.GRADES))],
        verdict_counts=Counter(row["verdict"] for row in verdicts),
        known=[row for row in verdicts if row["verdict"] in verdict_table.DIFFERENCES],
        differences=verdict_table.DIFFERENCES,
        fails=list(verdict_table.FAILS),
        figure_table_rows=figure_table.of_run(verdicts),
        marks=MARKS,
        verdict_meaning=MEANING,
        entry_of=entry_of,
    )


def measured(row: Row) -> Markup:
    """How large the distance of a row of the verdict table is, its unit as a formula."""
    value, _, stated = row["stated"].partition(" ")
    shown = {"stated": f"{value}{unit(stated)}", "unit": unit(row["unit"]).strip()}
    return mathematical(verdict_table.measured(row | shown).replace("chi^2", "χ²"))


def bounds(text: str) -> Markup:
    """Bounds of a comparison.

    >>> print(bounds("133 <= chi2 <= 164"))
    133 ≤ χ² ≤ 164
    """
    return mathematical(text.replace("<=", "≤").replace("chi2", "χ²"))


def figure(
    name: str,
    svg: bytes,
    caption: str,
    residuals: list[Row],
    verdicts: list[Row],
    config: Mapping[str, Any],
) -> TemplateValues:
    """Values of the template for one figure."""
    rows = [row for row in verdicts if row["figure"] == name]
    strips = draw_residuals.strips(residuals, {row["comparison"]: row for row in rows})
    return {
        "title": names.figure(name),
        "picture": templates.embedded(svg),
        "caption": caption,
        "alt": plain(re.split(r"\.\s+(?=[A-Z])", caption)[0].rstrip(".")),
        "rows": rows,
        "has_residuals": bool(residuals),
        "has_slide": name in config["slides"],
        "strips": templates.embedded(_svg(strips)) if strips else None,
    }


def _svg(strips: Mapping[draw_residuals.Strip, draw_residuals.Points]) -> bytes:
    file = io.BytesIO()
    house_style.save(draw_residuals.draw(strips), file)
    return file.getvalue()


def _with_formulas(row: Row, config: Mapping[str, Any]) -> Row:
    """A row with reason and note as the figure's folder has them, not plain as in the table."""
    entry = config["comparisons"].get(row["comparison"], {})
    written = [entry.get("reason", ""), entry.get("documented", {}).get("note", "")]
    latex = {plain(text): text for text in written}
    return row | {key: latex.get(row[key], row[key]) for key in ("reason", "note")}


def copy_tables(folder: str | Path, paths: Iterable[str]) -> None:
    """Copy the tables that pages link to, so that their folder can be sent without results/."""
    for path in paths:
        copy = Path(folder, Path(path).relative_to("results"))
        copy.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(path, copy)


def write(
    output: str,
    problems: str,
    paths: Mapping[str, str],
    residuals: Mapping[str, str],
    svgs: Mapping[str, str],
    records: Iterable[str],
    template: str | Path,
    settings: Mapping[str, Any],
) -> None:
    """Read the tables and pictures of a run; write the report, its sources, and its own problems.

    `paths` are the files of the tables `verdicts`, `ledger`, `key_numbers` and `which_model`;
    captions of tables stand in files beside the template. `records` are those of the jobs that made
    all this. `settings` are those of the rule: `captions` of the figures, `config`, the contents of
    data/*/source.yaml as `sources`, and the rows that `gate.faults_of_tables` asks for. A page that
    cannot be made is not written.
    """
    salvage, read, config = Salvage(), csv_tables.read_rows, settings["config"]
    rows = salvage("verdicts", [], read, paths["verdicts"], verdict_table.COLUMNS)
    ledger = salvage("ledger", [], read, paths["ledger"], outcome.COLUMNS)
    faults = record.errors(records)
    faults += gate.faults_of_tables(rows, ledger, settings["comparisons"], settings["entries"])
    rows = [_with_formulas(row, config) for row in rows if row["verdict"] in MARKS]

    def section(name: str) -> TemplateValues:
        picture, caption = Path(svgs[name]).read_bytes(), settings["captions"][name]
        distances = salvage("residuals", [], read, residuals[name])
        return figure(name, picture, caption, distances, rows, config)

    def caption(name: str) -> str:
        return Path(template).with_name(f"{name}.rst").read_text(encoding="utf-8").strip()

    figures = {name: salvage(names.figure(name), None, section, name) for name in svgs}
    answers = salvage("which_model", [], read, paths["which_model"])
    run = run_facts.of_run()
    values = {
        "verdicts": rows,
        "ledger": [row for row in ledger if row["verdict"] in ledger_page.STYLE],
        "figures": {name: part for name, part in figures.items() if part},
        "captions": {name: caption(name) for name in SECTIONS},
        "cases": salvage("which_model", [], which_model.cases, answers),
        "n": salvage("key numbers", {}, key_numbers.read, paths["key_numbers"]),
        "significance": config["significance"],
        "run": run,
    }
    of_sources = Path(template).with_name("sources.html")
    pages = {
        Path(output).with_name("sources.html"): salvage(
            "sources of data", None, sources_page.page, settings["sources"], config, run, of_sources
        )
    }
    values["faults"] = faults + salvage.problems
    pages[Path(output)] = salvage("report", None, page, values, template)
    for path, text in pages.items():
        if text is not None:
            path.write_text(text, encoding="utf-8")
    csv_tables.write_rows(problems, ["problem"], [[problem] for problem in salvage.problems])
