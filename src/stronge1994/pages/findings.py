"""What a run found, for the first screen of the report: numbers of its tables, small pictures.

The words stand in the template. A finding is left out where a table that it needs is missing, or
where its verdicts no longer say what its words say. In the second case it raises `Untold`. Here
`verdicts` are rows by the names of their comparisons.
"""

from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import suppress
from typing import Any

import numpy as np
from markupsafe import Markup

from planarimpact.ground.arrays import Array
from stronge1994 import csv_tables
from stronge1994.csv_tables import Columns, Curves, Row
from stronge1994.ledger import nature_models, outcome
from stronge1994.pages import ledger_page, note, which_model

Finding = dict[str, Any]
INCIDENCE, VELOCITY = "incidence [mu v2(0)]", "velocity [mu v2(0)]"
E, BETA_0 = "restitution [1]", "tangential_restitution [1]"
# Beyond it all models of Fig. 5 have the same straight line.
FARTHEST = 8.0
POINTS = 80  # of a curve in a small picture
WIDTH, HEIGHT, MARGIN = 200, 104, 6  # of a small picture
BAR = 80  # length of the longest bar
# Parts of the measured range of e = 1, in the words of the names of their comparisons.
PARTS = ("initial-stick", "slip-and-stick", "slip-throughout")


MARK = ledger_page.STYLE | ledger_page.GRADE_STYLE
SOUND = "confirmed", "confirmed within rounding"
OPEN = "not testable"

# A finding is left out where a comparison of its figure diverges.
FIGURE = {
    "restitution": "inelastic",
    "elastic": "fig5",
    "tolerance": "trade",
    "digits": "stability",
}


class Untold(Exception):
    """The run does not say what the words of a finding say."""


def paper(ledger: Sequence[Row]) -> Finding:
    """What is wrong in the paper: counts, and the entries that change a result.

    It raises `Untold` if an entry no longer holds, or none changes a result.
    """
    grave = [row for row in ledger if row["grade"] == next(iter(outcome.GRADES))]
    _need(grave and not outcome.failing(ledger))
    verdicts, grades = Counter(row["verdict"] for row in ledger), outcome.grades(ledger)
    return {
        "entries": len(ledger),
        "verdicts": verdicts,
        "grades": grades,
        "grave": grave,
        "picture": bars({word: verdicts[word] for word in SOUND} | grades | {OPEN: verdicts[OPEN]}),
    }


def restitution(
    verdicts: Mapping[str, Row], numbers: Mapping[str, float], curves: Curves, measured: Columns
) -> Finding:
    """What happens below e = 1.

    `numbers` are the key numbers, `curves` those of the figure `inelastic`, and `measured` has the
    measured pairs of materials. It raises `Untold` if the pairs do not contradict the paper's
    model, or contradict a continuum; if the paper's model is not the nearest to the rubber sphere;
    or if the reversed velocity does not grow in the paper's model and fall in the continua.
    """
    models = "lumped", "continuum.viscous", "continuum.plastic"
    rows = {model: verdicts[f"inelastic-{model}-pairs"] for model in models}
    _need(rows["lumped"]["verdict"] == "unexplained difference")
    _need(all(rows[model]["verdict"] == "agrees" for model in models[1:]))
    _need(numbers["pairs.continuum.viscous.failed"] == 0)
    _need(numbers["pairs.lumped.failed"] == numbers["pairs.spreads"])
    distances = {model: numbers[f"rubber.{model}.distance"] for model in note.MODELS}
    _need(min(distances, key=lambda model: distances[model]) == "lumped")
    grows = {
        model: numbers[f"nature.reversal_half.{model}"]
        - numbers[f"nature.reversal_elastic.{model}"]
        for model in nature_models.MODELS
    }
    _need(grows["paper"] > 0 > max(grows[loss] for loss in nature_models.LOSSES))
    lines = [
        (style, curves[name][E], curves[name][BETA_0])
        for style, model in (("theirs", "lumped"), ("ours", "continuum.viscous"))
        for name in curves
        if name.startswith(f"{model}, nu = ")
    ]
    sigma = measured["tangential_restitution_uncertainty [1]"]
    return {"picture": sketch(lines, (measured[E], measured[BETA_0], sigma))}


def elastic(verdicts: Mapping[str, Row], numbers: Mapping[str, float], curves: Curves) -> Finding:
    """How far the lumped model is from the elastic continuum, and where.

    `numbers` are the key numbers, `curves` those of Fig. 5. It raises `Untold` if the verdicts are
    others than the words say, or the largest difference is elsewhere than where initial stick ends.
    """
    rows = [verdicts[f"fig5-lumped-maw-{part}"] for part in PARTS]
    expected = "explained difference", "explained difference", "agrees"
    _need(tuple(row["verdict"] for row in rows) == expected)
    _need(verdicts["fig5-continuum-maw"]["verdict"] == "agrees")
    lumped, continuum = curves["lumped"], curves["continuum"]
    at = numbers["elastic.at"]
    sticks_first = np.isin(lumped["regime"], ["STICK", "STICK_SLIP"])
    _need(np.isclose(at, lumped[INCIDENCE][sticks_first].max()))
    near = lumped[INCIDENCE] <= FARTHEST
    step = slice(None, None, -(-int(near.sum()) // POINTS))
    lines = [
        (style, curve[INCIDENCE][near][step], curve[VELOCITY][near][step])
        for style, curve in (("theirs", lumped), ("ours", continuum))
    ]
    return {"rms": [float(row["rms [axis units]"]) for row in rows[:2]], "picture": sketch(lines)}


def tolerance(answers: Sequence[Row], trade: Sequence[Row]) -> Finding:
    """Which model to take.

    The answers begin with those of e = 1. `steps` are the cheapest models there in the middle
    batch, each with the smallest tolerance that it meets; `lossy` are the cases in which energy is
    lost.
    """
    cases = which_model.cases(answers)
    _need(cases and not cases[0]["loss"])
    batch = cases[0]["batches"][len(cases[0]["batches"]) // 2]
    steps = {}
    for row in cases[0]["rows"]:
        answer = row["answers"][batch]
        if answer["error"]:
            steps[answer["model"]] = row["tolerance"]
    shown = [row for row in trade if row["loss"] == "" and row[f"time_{batch} [s]"]]
    x, y = (
        np.log10([float(row[key]) for row in shown])
        for key in (f"time_{batch} [s]", "max_velocity [mu v2(0)]")
    )
    return {
        "steps": steps,
        "batch": batch,
        "lossy": [case for case in cases if case["loss"]],
        "picture": sketch([], (x, y, np.zeros(x.size))),
    }


def digits(verdicts: Mapping[str, Row], stability: Sequence[Row]) -> Finding:
    """How exact and how stable the solution of the paper's model is.

    It raises `Untold` if more digits are lost than the comparison allows.
    """
    row = verdicts["stability-digits"]
    _need(row["verdict"] == "agrees")
    of_second_codes = [r for r in verdicts.values() if r["evidence"] == "independent computation"]
    _need(all(row["verdict"] != "diverges" for row in of_second_codes))
    low = "from [unit of quantity]"
    part = [row for row in stability if row["quantity"] == "stiffness_ratio [1]"]
    part = [row for row in part if float(row[low]) > 0]
    x = np.log10([float(row[low]) for row in part])
    lines = [
        (style, x, np.array([float(row[f"{kind}_median [1]"]) for row in part]))
        for style, kind in (("ours", "digits"), ("theirs", "digits_allowed"))
    ]
    return {
        "impacts": int(row["points"]),
        "lost": float(row["max [sigma]"]),
        "picture": sketch(lines),
    }


def all_of(
    verdicts: Iterable[Row],
    ledger: Sequence[Row],
    tables: Mapping[str, Mapping[str, Any]],
    paths: Mapping[str, str],
    config: Mapping[str, Any],
    numbers: Mapping[str, float],
) -> dict[str, Finding | None]:
    """All findings; None for one that the run does not tell.

    `tables` are those of `which_model`, `trade` and `stability` as the report shows them. `paths`
    are the files of other tables: curves by figure, series by source. `numbers` are the key
    numbers.
    """
    rows = {row["comparison"]: row for row in verdicts}

    def measured() -> Columns:
        source, series = config["figures"]["inelastic"]["points"].split("/")
        return csv_tables.read(paths[source])[series]

    def curves(figure: str) -> Callable[[], Curves]:
        return lambda: csv_tables.read(paths[figure])

    def table(name: str) -> Callable[[], list[Row]]:
        return lambda: tables[name]["rows"]

    def judged() -> dict[str, Row]:
        return rows

    def key() -> Mapping[str, float]:
        return numbers

    found = {
        "paper": told(paper, lambda: ledger),
        "restitution": told(restitution, judged, key, curves("inelastic"), measured),
        "elastic": told(elastic, judged, key, curves("fig5")),
        "tolerance": told(tolerance, table("which_model"), table("trade")),
        "digits": told(digits, judged, table("stability")),
    }
    broken = {row["figure"] for row in rows.values() if row["verdict"] == "diverges"}
    return {name: None if FIGURE.get(name) in broken else told for name, told in found.items()}


def told(finding: Callable[..., Finding], *arguments: Callable[[], Any]) -> Finding | None:
    """A finding, or None where what it needs is missing or says something else.

    Each of `arguments` is called for one argument of the finding.

    >>> print(told(paper, list))
    None
    """
    with suppress(Untold, csv_tables.Failed, LookupError, ValueError, OSError):
        return finding(*(argument() for argument in arguments))
    return None


def bars(counts: Mapping[str, int]) -> Markup:
    """Counts as bars with their names, as SVG. Their classes are those of the ledger's marks.

    >>> print(bars({"wrong": 3}).count("<rect"))
    1
    """
    high = HEIGHT / len(counts)
    parts = [
        Markup(
            '<rect class="{}" y="{:.1f}" width="{:.1f}" height="{:.1f}"></rect>'
            '<text x="{:.1f}" y="{:.1f}">{} {}</text>'
        ).format(
            MARK[words],
            row * high + 1,
            BAR * count / max(counts.values()),
            high - 2,
            BAR * count / max(counts.values()) + 5,
            (row + 0.5) * high + 4,
            count,
            words,
        )
        for row, (words, count) in enumerate(counts.items())
    ]
    return _svg(parts)


def sketch(
    lines: Sequence[tuple[str, Array, Array]], points: tuple[Array, Array, Array] | None = None
) -> Markup:
    """Curves without axes, as SVG, for a first look.

    A line is its class, x and y. Points are x, y, and half the length of the bar of each.

    >>> print(sketch([("ours", np.array([0, 1]), np.array([0, 1]))]).count("polyline"))
    2
    """
    more = [("", points[0], points[1] + sign * points[2]) for sign in (-1, 1)] if points else []
    x, y = (np.concatenate([part[axis] for part in [*lines, *more]]) for axis in (1, 2))

    def across(at: float) -> float:
        return MARGIN + (WIDTH - 2 * MARGIN) * float((at - x.min()) / np.ptp(x))

    def up(at: float) -> float:
        return HEIGHT - MARGIN - (HEIGHT - 2 * MARGIN) * float((at - y.min()) / np.ptp(y))

    parts = []
    if lines and y.min() < 0 < y.max():
        parts.append(Markup('<path class="zero" d="M0 {0:.1f}H{1}"></path>').format(up(0), WIDTH))
    for style, at, value in lines:
        corners = " ".join(f"{across(a):.1f},{up(b):.1f}" for a, b in zip(at, value, strict=True))
        parts.append(Markup('<polyline class="{}" points="{}"></polyline>').format(style, corners))
    for at, value, half in zip(*points, strict=True) if points else ():
        parts.append(
            Markup(
                '<path class="bar" d="M{0:.1f} {1:.1f}V{2:.1f}"></path>'
                '<circle cx="{0:.1f}" cy="{3:.1f}" r="2.5"></circle>'
            ).format(across(at), up(value - half), up(value + half), up(value))
        )
    return _svg(parts)


def _svg(parts: Iterable[Markup]) -> Markup:
    start = '<svg class="sketch" viewBox="0 0 {} {}" aria-hidden="true">{}</svg>'
    return Markup(start).format(WIDTH, HEIGHT, Markup("").join(parts))


def _need(condition: Any) -> None:
    if not condition:
        raise Untold
