"""The page that lays a copy of the paper under the curves of a run, and reads its points."""

import json
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, TypeAlias

from markupsafe import Markup

import planarimpact
from stronge1994 import goodness, tables
from stronge1994.pages import templates
from stronge1994.reference_data import LARGEST_SIGMA, Series, strict_yaml
from stronge1994.reference_data.reading import PLACEHOLDER, SLACK
from stronge1994.tables import Table

Panel: TypeAlias = dict[str, Any]
# Scripts of the page, each after those that it uses; the first is the explorer's.
SCRIPTS = ["files.js", "map.js", "colours.js", "trace.js", "papaparse.min.js", "numbers.js"]
SCRIPTS += ["exports.js", "readings.js", "page.js"]
WORDS = ("name", "line", "series")  # of a curve
DIGITS = 6  # of the curves, more than a print has
# Of the table that tells which error a reading would show: points of a line, as many as the page
# saves, and of markers; and degrees of freedom that marks have left over.
OF_LINE, OF_MARKERS, LEFT_OVER = 15, 60, range(0, 17, 2)
# What the run refuses, and so the page: texts, sigmas as a share of their range, points outside it.
REFUSED = {
    "placeholder": PLACEHOLDER.pattern,
    "largest_sigma": LARGEST_SIGMA,
    "slack": SLACK,
}


def page(
    paths: Sequence[str],
    curves: Sequence[str],
    series: Mapping[str, Series],
    allowances: Mapping[str, list[float]],
    significance: float,
) -> str:
    """The page as text, from its sources, tables of curves, and all series.

    `allowances` are those of comparisons by their series. Without the curve that a setting of the
    run takes away, the page has the others.
    """
    texts = {Path(path).name: Markup(Path(path).read_text(encoding="utf-8")) for path in paths}
    library = "papaparse.min.js"  # its licence goes wherever it goes
    texts[library] = (
        Markup("/*\n") + texts["LICENSE.papaparse.txt"] + Markup("*/\n") + texts[library]
    )
    stated = strict_yaml.load(str(texts["panels.yaml"]))["panels"]
    read = {Path(path).stem: tables.read(path) for path in curves}
    panels = {name: _panel(panel, read[panel["figure"]], series) for name, panel in stated.items()}
    for one in (one for panel in panels.values() for one in panel["series"]):
        one["allowance"] = allowances.get(one["id"], [0.0, 0.0])
    folder = next(Path(path).parent for path in paths if path.endswith("your_copy.html"))
    limits = noncentrality(significance)
    told = {"version": planarimpact.__version__, "refused": REFUSED}
    told |= {"noncentrality": limits, "panels": panels}
    data = json.dumps(told, ensure_ascii=False)
    template = templates.environment(folder).get_template("your_copy.html")
    return template.render(
        sources=texts, panels=panels, scripts=SCRIPTS, data=Markup(data.replace("</", "<\\/"))
    )


def noncentrality(significance: float) -> dict[str, Any]:
    """What chi-squared must have for 9 of 10 refusals: by points, and degrees left over by marks.

    The sigmas of markers rest on a prior worth 4 values, two for each point, and what the marks
    leave over.
    """

    def of(points: int, of_sigma: int | None) -> float:
        return round(goodness.noncentrality(points, of_sigma, significance), 2)

    return {
        "of_line": [of(n, None) for n in range(1, OF_LINE + 1)],
        "of_points": [
            [of(n, 4 + 2 * n + left) for left in LEFT_OVER] for n in range(1, OF_MARKERS + 1)
        ],
    }


def _panel(panel: Panel, table: Table, series: Mapping[str, Series]) -> Panel:
    """A panel with the points of its curves, and the series that can be read in it."""
    markers = panel.get("points", [])
    curves = [own for stated in panel["curves"] for own in _curves(stated, panel, table)]
    named = [*markers, *(one["series"] for one in curves if "series" in one)]
    found = [_readable(series[full], full not in markers) for full in named]
    return panel | {"curves": curves, "series": found}


def _readable(own: Series, line: bool) -> dict[str, Any]:
    """A series that the page can read: its columns, and whether it is a line or markers."""
    axes = own.x, own.ordinates[0]
    return {
        "id": own.name,
        "name": f"{own.figure}{'' if own.path is None else ' (at hand)'}",
        "line": line,
        "columns": [axis.name for axis in axes],
        "ranges": [list(axis.range) for axis in axes],
        "open": list(own.open),
    }


def _curves(stated: Panel, panel: Panel, table: Table) -> Iterator[Panel]:
    """Curves of an entry of panels.yaml, one for each case; none that the run does not have."""
    low, high = panel["range"][0]
    ((key, values),) = stated.get("each", {"": [""]}).items()
    for value in values:
        words = {one: stated[one].replace("{}", f"{value}") for one in WORDS if one in stated}
        try:
            own = tables.select(table, **stated["select"], **({key: value} if key else {}))
        except ValueError:
            continue
        x, y = (own[stated.get(axis, panel[axis])].to_numpy() for axis in ("x", "y"))
        kept = (x >= low - 0.1 * (high - low)) & (x <= high + 0.1 * (high - low))
        yield words | {"x": _short(x[kept]), "y": _short(y[kept])}


def _short(values: Any) -> list[float]:
    return [float(f"{value:.{DIGITS}g}") for value in values]
