"""Findings of a run for the first screen of the report: numbers of its tables, small pictures.

The sentences stand in the template. A finding is left out where a table that it needs is missing,
or where the verdicts contradict its sentences; then its function raises `Unsupported`. `verdicts`
are rows by the names of their comparisons.
"""

from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import suppress
from typing import Any

import numpy as np
from markupsafe import Markup

from planarimpact.ground.arrays import Array
from stronge1994 import csv_tables, reference_data
from stronge1994.csv_tables import Columns, Curves, Row
from stronge1994.ledger import nature_models, outcome
from stronge1994.pages import ledger_page, note, which_model
from stronge1994.verdict_tables import verdict_table

Finding = dict[str, Any]
INCIDENCE, VELOCITY = "incidence [mu v2(0)]", "velocity [mu v2(0)]"
E, BETA_0 = "restitution [1]", "tangential_restitution [1]"
# Beyond this incidence all models of Fig. 5 have the same straight line.
LARGEST_INCIDENCE = 8.0
POINTS = 80  # of a curve in a small picture
WIDTH, HEIGHT, MARGIN = 200, 104, 6  # of a small picture
BAR = 80  # length of the longest bar
# Parts of the measured range of e = 1, as the names of their comparisons spell them.
PARTS = ("initial-stick", "slip-and-stick", "slip-throughout")


MARK = ledger_page.STYLE | ledger_page.GRADE_STYLE
CONFIRMED = "confirmed", "confirmed within rounding"
OPEN = "not testable"

# A finding is left out where a comparison of its figure fails.
FIGURE = {
    "restitution": "inelastic",
    "elastic": "fig5",
    "tolerance": "trade",
    "digits": "stability",
}


class Unsupported(Exception):
    """The verdicts or numbers of a run contradict the sentences of a finding."""


def paper(ledger: Sequence[Row]) -> Finding:
    """Errors of the paper: counts, and the entries that change a result."""
    grave = [row for row in ledger if row["grade"] == next(iter(outcome.GRADES))]
    _require(grave and not outcome.failing(ledger))
    verdicts, grades = Counter(row["verdict"] for row in ledger), outcome.grades(ledger)
    return {
        "entries": len(ledger),
        "verdicts": verdicts,
        "grades": grades,
        "grave": grave,
        "picture": bars(
            {word: verdicts[word] for word in CONFIRMED} | grades | {OPEN: verdicts[OPEN]}
        ),
    }


def restitution(
    verdicts: Mapping[str, Row], numbers: Mapping[str, float], curves: Curves, measured: Columns
) -> Finding:
    """Impacts below e = 1, from the key numbers, the curves of `inelastic` and the measured pairs.

    It raises `Unsupported` if the pairs do not contradict the paper's model, or contradict a
    continuum; if the paper's model is not the nearest to the rubber sphere; or if the reversed
    velocity does not grow in the paper's model and fall in the continua.
    """
    models = "lumped.hysteretic", "continuum.viscous", "continuum.plastic"
    rows = {model: verdicts[f"inelastic-{model}-pairs"] for model in models}
    _require(rows["lumped.hysteretic"]["verdict"] == "unexplained difference")
    _require(all(rows[model]["verdict"] == "agrees" for model in models[1:]))
    _require(numbers["pairs.continuum.viscous.failed"] == 0)
    _require(numbers["pairs.lumped.hysteretic.failed"] == numbers["pairs.spreads"])
    distances = {model: numbers[f"rubber.{model}.distance"] for model in note.MODELS}
    _require(min(distances, key=lambda model: distances[model]) == "lumped.hysteretic")
    grows = {
        model: numbers[f"nature.reversal_half.{model}"]
        - numbers[f"nature.reversal_elastic.{model}"]
        for model in nature_models.MODELS
    }
    _require(grows["paper"] > 0 > max(grows[loss] for loss in nature_models.LOSSES))
    lines = [
        (style, curves[name][E], curves[name][BETA_0])
        for style, model in (("theirs", "lumped.hysteretic"), ("ours", "continuum.viscous"))
        for name in curves
        if name.startswith(f"{model}, nu = ")
    ]
    sigma = measured["tangential_restitution_uncertainty [1]"]
    return {"picture": sketch(lines, (measured[E], measured[BETA_0], sigma))}


def elastic(verdicts: Mapping[str, Row], numbers: Mapping[str, float], curves: Curves) -> Finding:
    """How far the lumped model is from the elastic continuum, from the key numbers and Fig. 5.

    It raises `Unsupported` if the verdicts are others than the sentences say, or if the largest
    difference is not where initial stick ends.
    """
    rows = [verdicts[f"fig5-lumped-maw-{part}"] for part in PARTS]
    expected = "explained difference", "explained difference", "right"
    _require(tuple(row["verdict"] for row in rows) == expected)
    _require(verdicts["fig5-continuum-maw"]["verdict"] == "right")
    lumped, continuum = curves["lumped"], curves["continuum"]
    at = numbers["elastic.at"]
    sticks_first = np.isin(lumped["regime"], ["STICK", "STICK_SLIP"])
    _require(np.isclose(at, lumped[INCIDENCE][sticks_first].max()))
    near = lumped[INCIDENCE] <= LARGEST_INCIDENCE
    step = slice(None, None, -(-int(near.sum()) // POINTS))
    lines = [
        (style, curve[INCIDENCE][near][step], curve[VELOCITY][near][step])
        for style, curve in (("theirs", lumped), ("ours", continuum))
    ]
    return {"rms": [float(row["rms [axis units]"]) for row in rows[:2]], "picture": sketch(lines)}


def tolerance(answers: Sequence[Row], trade: Sequence[Row]) -> Finding:
    """Which model to choose for a tolerance.

    `steps` are the cheapest models for e = 1 in the middle batch, each with the smallest tolerance
    that it meets; `lossy` are the cases in which energy is lost.
    """
    cases = which_model.cases(answers)
    _require(cases and not cases[0]["loss"])
    batch = cases[0]["batches"][len(cases[0]["batches"]) // 2]
    steps = {}
    for row in cases[0]["rows"]:
        answer = row["answers"][batch]
        if answer["error"]:
            steps[answer["model"]] = row["least"]
    timed = [row for row in trade if row["loss"] == "" and row[f"time_{batch} [s]"]]
    x, y = (
        np.log10([float(row[key]) for row in timed])
        for key in (f"time_{batch} [s]", "max_velocity [mu v2(0)]")
    )
    return {
        "steps": steps,
        "batch": batch,
        "lossy": [case for case in cases if case["loss"]],
        "picture": sketch([], (x, y, np.zeros(x.size))),
    }


def digits(verdicts: Mapping[str, Row], stability: Sequence[Row]) -> Finding:
    """How exactly and how stably the paper's model is solved."""
    row = verdicts["stability-digits"]
    _require(row["verdict"] == "right")
    _require(all(row["verdict"] != "wrong" for row in verdicts.values()))
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
    pairs: Mapping[str, Any],
    numbers: Mapping[str, float],
) -> dict[str, Finding | None]:
    """All findings; None for one that the run does not support.

    `tables` are those of `which_model`, `trade` and `stability` as the report shows them. `paths`
    are the files of other tables: curves by figure. `pairs` is the series of the measured pairs of
    materials in its source.yaml, `numbers` are the key numbers.
    """
    rows = {row["comparison"]: row for row in verdicts}

    def measured() -> Columns:
        return reference_data.arrays(pairs)

    def curves(figure: str) -> Callable[[], Curves]:
        return lambda: csv_tables.read(paths[figure])

    def table(name: str) -> Callable[[], list[Row]]:
        return lambda: tables[name]["rows"]

    def judged() -> dict[str, Row]:
        return rows

    def key() -> Mapping[str, float]:
        return numbers

    findings = {
        "paper": if_supported(paper, lambda: ledger),
        "restitution": if_supported(restitution, judged, key, curves("inelastic"), measured),
        "elastic": if_supported(elastic, judged, key, curves("fig5")),
        "tolerance": if_supported(tolerance, table("which_model"), table("trade")),
        "digits": if_supported(digits, judged, table("stability")),
    }
    broken = {row["figure"] for row in rows.values() if row["verdict"] in verdict_table.FAILS}
    return {
        name: None if FIGURE.get(name) in broken else finding for name, finding in findings.items()
    }


def if_supported(finding: Callable[..., Finding], *arguments: Callable[[], Any]) -> Finding | None:
    """A finding of some arguments, or None where a table is missing or contradicts it.

    >>> print(if_supported(paper, list))
    None
    """
    with suppress(Unsupported, csv_tables.Failed, LookupError, ValueError, OSError):
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
            MARK[label],
            row * high + 1,
            BAR * count / max(counts.values()),
            high - 2,
            BAR * count / max(counts.values()) + 5,
            (row + 0.5) * high + 4,
            count,
            label,
        )
        for row, (label, count) in enumerate(counts.items())
    ]
    return _svg(parts)


def sketch(
    lines: Sequence[tuple[str, Array, Array]], points: tuple[Array, Array, Array] | None = None
) -> Markup:
    """Lines (class, x, y) and points (x, y, half a bar) without axes, as SVG.

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


def _require(condition: Any) -> None:
    if not condition:
        raise Unsupported
