"""Write the letter to the author of the paper: does his model apply below e = 1? One HTML file.

Every number in it is read from tables that the run has made.
"""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from markupsafe import Markup, escape

from stronge1994 import csv_tables
from stronge1994.csv_tables import Columns, Curves
from stronge1994.figures.inelastic import drawing as inelastic
from stronge1994.goodness import ChiSquared
from stronge1994.ledger import contact, in_nature, nature
from stronge1994.ledger.in_nature import Values
from stronge1994.pages import ledger_page, templates

# Models of the figure in the order of the letter, in the words of the letter.
MODELS = {
    "lumped": "your model",
    "lumped.plastic": "your model with e^2 zeta^2",
    "lumped.viscous": "two viscous elements",
    "continuum.viscous": "continuum, viscous",
    "continuum.plastic": "continuum, yields",
}
E, BETA_0 = "restitution", "tangential_restitution"


class Pair(NamedTuple):
    """A measured pair of materials, with what each of `MODELS` says of it."""

    name: str
    restitution: float
    measured: float
    uncertainty: float
    computed: Mapping[str, float]


class Fit(NamedTuple):
    """Chi-squared of a model over the pairs.

    All of them; the others than the least elastic one; and those of the others that are lossy.
    """

    model: str
    words: str
    every: ChiSquared
    others: ChiSquared
    lossy: ChiSquared


def pairs(curves: Curves, measured: Columns) -> list[Pair]:
    """Measured pairs, the least elastic first."""
    computed = {}
    for model in MODELS:
        columns = curves[f"{model}, pairs"]
        computed[model] = dict(zip(columns["pair"], columns[f"{BETA_0} [1]"], strict=True))
    keys = "pair", f"{E} [1]", f"{BETA_0} [1]", f"{BETA_0}_uncertainty [1]"
    found = [
        Pair(name, e, beta_0, sigma, {model: computed[model][name] for model in MODELS})
        for name, e, beta_0, sigma in zip(*(measured[key] for key in keys), strict=True)
    ]
    return sorted(found, key=lambda pair: pair.restitution)


def fits(curves: Curves, measured: Columns) -> list[Fit]:
    """How well each model fits the measured pairs."""
    e = measured[f"{E} [1]"]
    chosen = np.full(e.size, True), e > e.min(), (e > e.min()) & (e < 1)
    parts = [_series({key: cells[which] for key, cells in measured.items()}) for which in chosen]
    return [
        Fit(model, words, *(inelastic.goodness(curves, model, part) for part in parts))
        for model, words in MODELS.items()
    ]


def _series(measured: Columns) -> dict[str, Any]:
    """Measured pairs as the figure has them."""
    x, y = ((measured[f"{key} [1]"], measured[f"{key}_uncertainty [1]"]) for key in (E, BETA_0))
    return {"x": x[0], "y": y[0], "sigma": (x[1], y[1]), "columns": measured}


def probability(p: float) -> Markup:
    """A probability in a few figures.

    >>> print(probability(0.2234), probability(3.6e-26))
    0.22 4 × 10<sup>−26</sup>
    """
    if p >= 1e-3:
        return escape(f"{p:.2g}")
    digit, power = f"{p:.0e}".split("e")
    return Markup("{} × 10<sup>−{}</sup>").format(digit, abs(int(power)))


def page(
    found: Mapping[str, Values], curves: Curves, measured: Columns, svg: bytes, template: str
) -> str:
    """The letter; an `ArithmeticError` says that a number is missing.

    `found` is what the measures in nature found. `curves` are those of the figure `inelastic`, and
    `svg` is its picture.
    """
    every, of_models = pairs(curves, measured), fits(curves, measured)
    numbers = [*found.values(), *(list(pair.computed.values()) for pair in every)]
    if not np.all(np.isfinite(np.concatenate(numbers))):
        raise ArithmeticError("a number is missing in results/in_nature.csv or the figure")
    environment = templates.environment(Path(template).parent)
    environment.filters |= {"maths": ledger_page.mathematical, "probability": probability}
    return environment.get_template(Path(template).name).render(
        found=found,
        pairs=every,
        least=every[0],
        farthest=max(every, key=_distance),
        distance=_distance,
        fits=of_models,
        fit={fit.model: fit for fit in of_models},
        picture=templates.embedded(svg),
        sphere=contact.SPHERE,
        lossy=nature.RESTITUTIONS.min(),
        measured_down_to=nature.LEAST_MEASURED,
        incidence_below=nature.WITH_STICK,
    )


def _distance(pair: Pair) -> float:
    """How far a pair is from the nearest of both continua, in its own uncertainties."""
    continua = [value for model, value in pair.computed.items() if model.startswith("continuum")]
    return min(abs(pair.measured - value) for value in continua) / pair.uncertainty


def without_numbers(why: Exception) -> str:
    """What stands in place of the letter where a solver failed, which the gate reports."""
    return (
        '<!doctype html>\n<html lang="en"><head><meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width"><title>Failed</title></head>'
        f"<body><main><h1>Below e = 1</h1>\n<p>This page could not be written: {escape(why)}. "
        'The <a href="report.html">report</a> says more.</p></main></body></html>\n'
    )


def write(
    output: str, measures: str, curves: str, series: str, svg: str, template: str, name: str
) -> None:
    """Read what the run has made and write the letter.

    `name` is that of the measured pairs among the series; all else are files.
    """
    found = in_nature.read(csv_tables.read_rows(measures))
    try:
        tables: Sequence[Curves] = [csv_tables.read(path) for path in (curves, series)]
        text = page(found, tables[0], tables[1][name], Path(svg).read_bytes(), template)
    except (csv_tables.Failed, ArithmeticError) as error:
        text = without_numbers(error)
    Path(output).write_text(text, encoding="utf-8")
