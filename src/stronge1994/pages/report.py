"""Write the run as one page, findings first, and its sources and settings as another.

Nothing is solved here. The error of a job that failed stands on top, and in place of what it should
have made. What cannot be shown is left out and named on top, with file and line; the gate fails on
it.
"""

import io
import re
import shutil
import traceback
from collections import Counter
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, TypeAlias

from markupsafe import Markup, escape

from stronge1994 import csv_tables
from stronge1994.csv_tables import Row
from stronge1994.curve_names import is_of_paper
from stronge1994.figures.shared.drawing import house_style
from stronge1994.figures.shared.drawing import residuals as draw_residuals
from stronge1994.judging.verdicts import VISIBLE_SHIFT
from stronge1994.ledger import outcome
from stronge1994.pages import (
    findings,
    headers,
    impact_times,
    key_numbers,
    ledger_page,
    names,
    note,
    run_facts,
    sources_page,
    templates,
    which_model,
)
from stronge1994.pages.formulas import mathematical, number
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
TemplateValues: TypeAlias = dict[str, Any]  # of a figure or a table
# Tables that have a section of the report; captions stand in files of the same names.
SECTIONS = ("which_model", "trade", "stability")
ROOT = Path(__file__).parents[3]


class Salvage:
    """Call functions, go on where one fails, and keep a message with file and line.

    >>> salvage = Salvage()
    >>> salvage("Fig. 5", "nothing", lambda: {}["curve"])
    'nothing'
    >>> salvage.problems[0].split(" (")[0]
    "Fig. 5: KeyError: 'curve'"
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
            traceback.print_exc()
            self.problems.append(f"{what}: {type(error).__name__}: {error}{_place(error)}")
            return otherwise


def _place(error: Exception) -> str:
    """File and line of this repository where an error arose, to stand behind its message."""
    frames = traceback.extract_tb(error.__traceback__)
    ours = [f for f in frames if f.filename.startswith((str(ROOT / "workflow"), str(ROOT / "src")))]
    return f" ({Path(ours[-1].filename).relative_to(ROOT)}, line {ours[-1].lineno})" if ours else ""


def page(
    verdicts: list[Row],
    ledger: list[Row],
    figures: Mapping[str, TemplateValues],
    tables: Mapping[str, TemplateValues],
    significance: float,
    run: Mapping[str, Any],
    symbols: str,
    links: Mapping[str, str],
    template: str | Path,
    faults: list[str],
    salvage: Salvage,
    run_findings: Mapping[str, findings.Finding | None],
    numbers: Mapping[str, float],
    peers: Sequence[Row] = (),
) -> str:
    """The report.

    `tables` has the rows and captions of `SECTIONS`, `figures` the values of `figure`,
    `run_findings` those of `findings.all_of`, `numbers` the key numbers. `symbols` explains the
    ledger's formulas; `links` are the names of lectures by their files. `faults` say why the run
    does not pass, as `gate.faults_of_tables` does. `salvage` calls what may fail, and its problems
    so far are shown too. `peers` is empty where other codes were not measured.
    """
    entries = {row["entry"] for row in ledger}
    nothing: TemplateValues = {"rows": [], "absent": []}
    times = salvage("times", nothing, impact_times.section, tables["trade"]["rows"], peers)
    cases = salvage("which_model", [], which_model.cases, tables["which_model"]["rows"])
    environment = templates.environment(Path(template).parent)
    environment.filters |= {
        "maths": ledger_page.linked_maths(entries, "ledger.html"),
        "bounds": _bounds,
        "comparison_name": names.comparison,
        "series_name": names.series,
        "source_name": names.source,
        "entry_name": names.entry,
        "number": number,
        "probability": note.probability,
        "microseconds": lambda seconds: number(f"{1e6 * float(seconds)}"),
        "header": headers.header,
        "short": run_facts.short,
        "sentence": names.sentence,
        "title_of": templates.title,
    }
    environment.tests["in_paper"] = is_of_paper
    return environment.get_template(Path(template).name).render(
        ledger_page.template_values(ledger, symbols),
        verdicts=verdicts,
        significance=significance,
        faults=faults + salvage.problems,
        verdict_counts=Counter(row["verdict"] for row in verdicts),
        known=[row for row in verdicts if row["verdict"] in verdict_table.DIFFERENCES],
        differences=verdict_table.DIFFERENCES,
        fails=list(verdict_table.FAILS),
        figure_table_rows=figure_table.of_run(verdicts),
        marks=MARKS,
        verdict_meaning=MEANING,
        entry_of=_entry_of(entries),
        figures=figures,
        tables=tables,
        cases=cases,
        times=times,
        run=run,
        links=links,
        found=run_findings,
        n=numbers,
    )


def _bounds(text: str) -> Markup:
    """Bounds of a comparison.

    >>> print(_bounds("133 <= chi2 <= 164"))
    133 ≤ χ² ≤ 164
    """
    return mathematical(text.replace("<=", "≤").replace("chi2", "χ²"))


def without_details(faults: Iterable[str]) -> str:
    """A page of faults alone, where the report itself cannot be written."""
    items = "\n".join(f"<li>{escape(fault)}</li>" for fault in faults)
    return (
        '<!doctype html>\n<html lang="en"><head><meta charset="utf-8"><title>Failed</title></head>'
        "<body><main><h1>Planar impact of rough compliant bodies: report of a run</h1>\n"
        "<p><b>FAILED</b> The report could not be written. The tables in results/ and the pictures "
        f"beside this page are there.</p>\n<ul>\n{items}\n</ul></main></body></html>\n"
    )


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
        "title": templates.title(name),
        "picture": templates.embedded(svg),
        "caption": caption,
        "alt": re.split(r"\.\s+(?=[A-Z])", caption)[0].rstrip("."),
        "rows": rows,
        "has_residuals": bool(residuals),
        "has_slide": name in config["slides"],
        "strips": templates.embedded(_svg(strips)) if strips else None,
    }


def _entry_of(names: Collection[str]) -> Callable[[Row], str | None]:
    """Entry of the ledger that a row of the verdict table names, or None."""

    def entry_of(row: Row) -> str | None:
        name = row["note"].removeprefix(verdict_table.LEDGER)
        return name if name in names else None

    return entry_of


def copy_tables(folder: str | Path, paths: Iterable[str]) -> None:
    """Copy the tables that pages link to, so that their folder can be sent without results/."""
    for path in paths:
        copy = Path(folder, Path(path).relative_to("results"))
        copy.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(path, copy)


def _svg(strips: Mapping[draw_residuals.Strip, draw_residuals.Points]) -> bytes:
    file = io.BytesIO()
    house_style.save(draw_residuals.draw(strips), file)
    return file.getvalue()


def write(
    output: str,
    problems: str,
    paths: Mapping[str, str],
    residuals: Mapping[str, str],
    svgs: Mapping[str, str],
    captions: Mapping[str, str],
    config: Mapping[str, Any],
    expected: tuple[Mapping[str, bool], Mapping[str, bool]],
    records: Iterable[str],
    **parts: Any,
) -> None:
    """Read the tables and pictures of a run; write the report, its sources, and its own problems.

    `paths` are the files of the tables: `verdicts`, `ledger`, those of `SECTIONS`, those that only
    the findings need, and `peers` where other codes were measured. `captions` are those of the
    figures; those of tables stand in files beside the template. `expected` are the rows that
    `gate.faults_of_tables` asks for, `records` those of the jobs that made all this. `parts` are
    `symbols`, `links` and `template` as for `page`; `sources`, the contents of data/*/source.yaml;
    and `run`, functions of `run_facts` by name, each with its value after a failure.
    """
    salvage = Salvage()
    read = csv_tables.read_rows
    rows = salvage("verdicts", [], read, paths["verdicts"], verdict_table.COLUMNS)
    ledger = salvage("ledger", [], read, paths["ledger"], outcome.COLUMNS)
    faults = record.errors(records) + gate.faults_of_tables(rows, ledger, *expected)
    rows = [row for row in rows if row["verdict"] in MARKS]
    ledger = [row for row in ledger if row["verdict"] in ledger_page.STYLE]

    def section(name: str) -> TemplateValues:
        picture = Path(svgs[name]).read_bytes()
        distances = salvage("residuals", [], read, residuals[name])
        return figure(name, picture, captions[name], distances, rows, config)

    def table(name: str) -> TemplateValues:
        text = Path(parts["template"]).with_name(f"{name}.rst").read_text(encoding="utf-8")
        return {"rows": read(paths[name]), "caption": text.strip()}

    figures = {name: salvage(templates.title(name), None, section, name) for name in svgs}
    figures = {name: section_values for name, section_values in figures.items() if section_values}
    tables = {name: salvage(name, {"rows": [], "caption": ""}, table, name) for name in SECTIONS}
    peers = salvage("peers", [], read, paths["peers"], ("model",)) if "peers" in paths else []
    path = paths["key_numbers"]
    numbers = salvage("key numbers", {}, lambda: key_numbers.by_name(read(path)))
    run = parts.pop("run")
    run = {name: salvage(name, missing, function) for name, (missing, function) in run.items()}
    template = Path(parts["template"]).with_name("sources.html")
    sources = parts.pop("sources")
    provenance = salvage("sources of data", None, sources_page.page, sources, config, run, template)
    source, series = config["figures"]["inelastic"]["points"].split("/")
    pairs = sources[source]["series"][series]
    text = salvage(
        "report",
        None,
        lambda: page(
            rows,
            ledger,
            figures,
            tables,
            config["significance"],
            run=run,
            faults=faults,
            salvage=salvage,
            run_findings=findings.all_of(rows, ledger, tables, paths, pairs, numbers),
            numbers=numbers,
            peers=peers,
            **parts,
        ),
    )
    short = without_details(faults + salvage.problems)
    Path(output).write_text(short if text is None else text, encoding="utf-8")
    Path(output).with_name("sources.html").write_text(provenance or short, encoding="utf-8")
    csv_tables.write_rows(problems, ["problem"], [[problem] for problem in salvage.problems])
