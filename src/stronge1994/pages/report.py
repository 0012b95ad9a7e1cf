"""Write the run as pages: the report here, and what others make of the same tables.

Nothing is solved here.
"""

import io
import re
import shutil
from collections import Counter
from collections.abc import Collection, Iterable, Mapping
from pathlib import Path
from typing import Any, TypeAlias

import pandas as pd
from markupsafe import Markup

from stronge1994 import figure_table, gate, tables, verdict_table, versions, words
from stronge1994.figures.shared.drawing import house_style
from stronge1994.figures.shared.drawing import residuals as draw_residuals
from stronge1994.formulas import mathematical, plain
from stronge1994.judging.verdicts import VISIBLE_SHIFT
from stronge1994.ledger import outcome
from stronge1994.names import is_of_paper
from stronge1994.pages import (
    key_numbers,
    ledger_page,
    note,
    sources_page,
    templates,
    which_model,
)
from stronge1994.tables import Row
from stronge1994.verdict_table import Verdict

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
    "as before": "as an earlier result of ours, or fitted to these points: no evidence",
}
TemplateValues: TypeAlias = dict[str, Any]  # of a figure, or of the page
# Tables with a section of the report; their captions stand in files of the same names.
SECTIONS = ("which_model", "trade")


def page(values: TemplateValues, template: Path) -> str:
    """The report, from `values` as `write` makes them."""
    verdicts, entries = values["verdicts"], {row["entry"] for row in values["ledger"]}

    def entry_of(row: Row) -> str | None:
        """Entry of the ledger that a row of the verdict table names."""
        name = row["note"].removeprefix(verdict_table.LEDGER)
        return name if name in entries else None

    environment = templates.environment(template.parent)
    environment.filters |= {
        "maths": ledger_page.linked_maths(entries, "ledger.html"),
        "bounds": bounds,
        "measured": measured,
    }
    environment.tests["in_paper"] = is_of_paper
    return environment.get_template(template.name).render(
        values,
        lapsed=outcome.failing(values["ledger"]),
        grave=[row for row in values["ledger"] if row["grade"] == next(iter(outcome.GRADES))],
        verdict_counts=Counter(row["verdict"] for row in verdicts),
        known=[row for row in verdicts if Verdict(row["verdict"]).differs],
        differences=[verdict for verdict in Verdict if verdict.differs],
        fails=[verdict for verdict in Verdict if verdict.fails],
        figure_table_rows=figure_table.of_run(verdicts),
        marks=MARKS,
        verdict_meaning=MEANING,
        entry_of=entry_of,
    )


def measured(row: Row) -> Markup:
    """How large the distance of a row of the verdict table is, its unit as a formula."""
    value, _, stated = row["stated"].partition(" ")
    shown = {"stated": f"{value}{words.unit(stated)}", "unit": words.unit(row["unit"]).strip()}
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
    residuals: tables.Table,
    verdicts: list[Row],
    has_slide: bool,
) -> TemplateValues:
    """Values of the template for one figure."""
    rows = [row for row in verdicts if row["figure"] == name]
    strips = draw_residuals.strips(residuals, rows)
    return {
        "title": words.figure(name),
        "picture": templates.embedded(svg),
        "caption": caption,
        "alt": plain(re.split(r"\.\s+(?=[A-Z])", caption)[0].rstrip(".")),
        "rows": rows,
        "has_residuals": len(residuals) > 0,
        "has_slide": has_slide,
        "strips": templates.embedded(_svg(strips)) if strips else None,
    }


def _svg(strips: list[tables.Table]) -> bytes:
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
    given: Any,
    made: Any,
    *,
    config: Mapping[str, Any],
    captions: Mapping[str, str],
    slides: Collection[str],
    sources: Mapping[str, Any],
    stated: Mapping[str, Mapping[str, Any]],
    symbols: str,
    impacts: Mapping[str, Any],
    rows: Collection[str],
    entries: Collection[str],
) -> None:
    """Write all pages and the tables that belong to them; files and settings are those of the rule.

    `captions` are those of the figures, `slides` names those that have one. `sources` holds
    data/*/source.yaml, `stated` the series of which the note states numbers. `symbols` and
    `impacts` are those of the ledger; `rows` and `entries` are as in `gate.faults`.
    """
    verdicts = verdict_table.gather(given.verdicts)
    tables.write_rows(made.verdicts, verdicts, verdict_table.COLUMNS)
    ledger, measures = map(tables.read_rows, (given.ledger, given.in_nature))
    curves = {Path(path).stem: path for path in given.curves}
    numbers = key_numbers.of_run(verdicts, ledger, measures, curves, stated)
    key_numbers.write(made.numbers, numbers)
    trade = tables.read(curves["trade"])
    answers = which_model.answers(trade)
    answers.to_csv(made.which_model, index=False, lineterminator="\n")
    copied = [made.verdicts, made.which_model, *given.curves, *given.residuals]
    copy_tables(made.tables, copied)
    pictures = {Path(path).stem: Path(path).read_bytes() for path in given.pictures}
    residuals = {Path(path).stem: pd.read_csv(path) for path in given.residuals}
    shown = [_with_formulas(row, config) for row in verdicts]
    figures = {
        name: figure(name, picture, captions[name], residuals[name], shown, name in slides)
        for name, picture in pictures.items()
    }
    folder, run = templates.SHARED, versions.of_run(given.versions)
    values = {
        "verdicts": shown,
        "ledger": ledger,
        "figures": figures,
        "captions": {
            name: (folder / f"{name}.rst").read_text("utf-8").strip() for name in SECTIONS
        },
        "cases": which_model.cases(answers, trade),
        "n": numbers,
        "significance": config["significance"],
        "run": run,
        "faults": gate.faults(verdicts, ledger, rows, entries),
    }
    pages = {
        made.report: page(values, folder / "report.html"),
        made.sources: sources_page.page(sources, config, run, folder / "sources.html"),
        made.note: note.page(numbers, verdicts, pictures, folder / "note.html"),
        made.ledger: ledger_page.page(ledger, symbols, impacts, folder / "ledger.html"),
    }
    for path, text in pages.items():
        Path(path).write_text(text, encoding="utf-8")
