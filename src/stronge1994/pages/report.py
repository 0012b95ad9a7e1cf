"""Write the run as pages: the report here, and what others make of the same tables.

Nothing is solved here.
"""

import io
import re
import shutil
from collections.abc import Collection, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, TypeAlias

import pandas as pd
from markupsafe import Markup

from stronge1994 import (
    accepted,
    answers,
    figure_table,
    gate,
    ledger_table,
    tables,
    verdict_table,
    versions,
    words,
)
from stronge1994.figure_table import FigureRow, Item
from stronge1994.figures.shared.drawing import house_style
from stronge1994.figures.shared.drawing import residuals as draw_residuals
from stronge1994.formulas import mathematical, plain
from stronge1994.judging.verdicts import DOUBT, LARGEST_ERROR
from stronge1994.names import home, is_of_paper
from stronge1994.pages import ledger_page, sources_page, templates, which_model
from stronge1994.tables import Row
from stronge1994.verdict_table import Group, Verdict, Why

# What stands first among the comparisons of a figure.
FIRST = (Verdict.FAILS, Verdict.NOT_COMPARED, Verdict.DIFFERS, Verdict.CANNOT_JUDGE)
TemplateValues: TypeAlias = dict[str, Any]  # of a figure, or of the page
# Tables with a section of the report; their captions stand in files of the same names.
SECTIONS = ("which_model", "trade")


def page(values: TemplateValues) -> str:
    """The report, from `values` as `write` makes them."""
    verdicts, ledger = values["verdicts"], values["ledger"]
    unmade, entries = gate.unmade(verdicts), {row["entry"] for row in ledger}
    passes = not values["faults"] and not unmade
    environment = templates.environment()
    environment.filters |= {
        "maths": ledger_page.linked_maths(entries, "ledger.html"),
        "numbers": numbers,
        "measured": verdict_table.measured,
        "chance": verdict_table.chance,
        "noticed": verdict_table.noticed,
    }
    environment.tests["in_paper"] = is_of_paper
    environment.filters["home"] = home
    table = values["table"]
    return environment.get_template("report.html").render(
        values,
        answers=answers.of_run(verdicts, ledger) if passes else [],
        lapsed=ledger_table.failing(ledger),
        grave=[row for row in ledger if row["quantity"]],
        unmade=unmade,
        in_paper=[row for row in table if is_of_paper(row.figure)],
        largest={row.figure: largest(row, verdicts) for row in table},
        rows={row["comparison"]: row for row in verdicts},
        beyond=[row for row in table if not is_of_paper(row.figure) and row.others],
        largest_error=LARGEST_ERROR,
        scenes=parts([row for row in verdicts if row["figure"] not in values["figures"]]),
        solver=Group.SOLVER,
    )


def largest(figure: FigureRow, verdicts: Sequence[Row]) -> Item | None:
    """What the paper says of a figure and is most wrong, else what others say of it.

    Of the items of the worst verdict it is the one with the largest distance.
    """
    distances = {row["comparison"]: float(row["max"] or 0) for row in verdicts}

    def rank(item: Item) -> tuple[int, float]:
        verdict = list(Verdict).index(Verdict(item.verdict))
        return -verdict, max(distances[name] for name in item.rows)

    compared = (
        [item for item in items if item.verdict != Verdict.NOT_COMPARED]
        for items in (figure.paper, figure.others)
    )
    return next((max(items, key=rank) for items in compared if items), None)


def numbers(text: str) -> Markup:
    """Sizes, bounds and tests of the verdict table, with formulas.

    >>> print(numbers("0.1 <= rms <= 0.2 rad/s"))
    0.1 ≤ rms ≤ 0.2 rad/s
    """
    return mathematical(words.with_units(text).replace("<=", "≤").replace("chi^2", "χ²"))


def figure(
    name: str,
    svg: bytes,
    caption: str,
    residuals: tables.Table,
    verdicts: list[Row],
    has_slide: bool,
    overlays: Mapping[str, str],
) -> TemplateValues:
    """Values of the template for one figure; `overlays` are pictures of prints, by series."""
    rows = [row for row in verdicts if row["figure"] == name]
    prints = [row["reference"] for row in rows if row["reference"] in overlays]
    strips = draw_residuals.strips(residuals, rows)
    return {
        "title": words.figure(name),
        "picture": templates.embedded(svg),
        "size": re.findall(r'viewBox="0 0 ([\d.]+) ([\d.]+)"', svg.decode("utf-8"))[0],
        "caption": caption,
        "alt": plain(re.split(r"\.\s+(?=[A-Z])", caption)[0].rstrip(".")),
        "comparisons": parts(rows),
        "has_residuals": len(residuals) > 0,
        "has_slide": has_slide,
        "strips": templates.embedded(_svg(strips)) if strips else None,
        "prints": {
            series: templates.embedded_png(Path(overlays[series]).read_bytes())
            for series in dict.fromkeys(prints)
        },
    }


def parts(rows: Sequence[Row]) -> TemplateValues:
    """Comparisons that stand first, as they fail, are not made or differ; the rest, and its counts.

    Differences of other models than the paper's, and of our own checks, are in the rest, and so are
    printed curves that are awaited.
    """

    def of_paper(row: Row) -> bool:
        if row["group"] == Group.PRINTED:
            return row["why"] != Why.AWAITED
        return row["model"] in figure_table.MODELS_OF_PAPER and row["group"] != Group.SOLVER

    first = [
        row
        for verdict in FIRST
        for row in rows
        if row["verdict"] == verdict and (verdict == Verdict.FAILS or of_paper(row))
    ]
    rest = [row for row in rows if row not in first]
    sides = (
        [row for row in rest if (row["group"] == Group.SOLVER) is solver]
        for solver in (False, True)
    )
    with_others, own = map(figure_table.counted, sides)
    counts = [with_others, f"solver checked: {own}" if own else ""]
    return {"first": first, "rest": rest, "counts": "; ".join(filter(None, counts))}


def _svg(strips: list[tables.Table]) -> bytes:
    file = io.BytesIO()
    house_style.save(draw_residuals.draw(strips), file)
    return file.getvalue()


def _with_formulas(row: Row, config: Mapping[str, Any]) -> Row:
    """A row with reason and note as the figure's folder has them, not plain as in the table."""
    entry = config["comparisons"].get(row["comparison"], {})
    written = [entry.get("reason", ""), entry.get("differs", {}).get("note", "")]
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
    shows: Mapping[str, str],
    captions: Mapping[str, str],
    slides: Collection[str],
    sources: Mapping[str, Any],
    overlays: Mapping[str, str],
    rows: Collection[str],
    grades: Mapping[str, str],
) -> None:
    """Write all pages and the tables that belong to them; files and settings are those of the rule.

    `shows` and `captions` are those of the figures, `slides` names those that have one. `sources`
    holds data/*/source.yaml, and `overlays` pictures of prints by series. `rows` and `grades` are
    as in `gate.faults` and `gate.summary`.
    """
    verdicts = verdict_table.gather([given.verdicts])
    ledger = tables.read_rows(given.ledger)
    curves = {Path(path).stem: path for path in given.curves}
    trade = tables.read(curves["trade"])
    fastest = which_model.answers(trade)
    fastest.to_csv(made.which_model, index=False, lineterminator="\n")
    copied = [given.verdicts, made.which_model, *given.curves, *given.residuals]
    copy_tables(made.tables, copied)
    pictures = {Path(path).stem: Path(path).read_bytes() for path in given.pictures}
    residuals = {Path(path).stem: pd.read_csv(path) for path in given.residuals}
    shown = [_with_formulas(row, config) for row in verdicts]
    table = figure_table.of_run(verdicts, shows, grades)
    figures = {
        name: figure(
            name, picture, captions[name], residuals[name], shown, name in slides, overlays
        )
        for name, picture in pictures.items()
    }
    known = accepted.read(given.accepted)
    values = {
        "verdicts": shown,
        "table": table,
        "ledger": ledger,
        "figures": figures,
        "captions": {
            name: (templates.SHARED / f"{name}.rst").read_text("utf-8").strip() for name in SECTIONS
        },
        "cases": which_model.cases(fastest, trade),
        "significance": config["significance"],
        "doubt": DOUBT * config["significance"],
        "commit": versions.commit("."),
        "new": accepted.new(verdicts, known),
        "faults": gate.faults(verdicts, ledger, rows, grades, known),
    }
    pages = {
        made.report: page(values),
        made.sources: sources_page.page(sources, config),
        made.ledger: ledger_page.page(ledger),
        made.run: versions.of_run(),
    }
    for path, text in pages.items():
        Path(path).write_text(text, encoding="utf-8")
