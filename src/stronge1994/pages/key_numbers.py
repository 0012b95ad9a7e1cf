"""Numbers of a run that the note and the report state: each is computed once, for one table.

A number has a name made of what it is about, such as `pairs.lumped.hysteretic.chi2`. Pages round
it; they never compute it again.
"""

from collections import Counter
from collections.abc import Mapping, Sequence
from functools import partial
from typing import Any

import numpy as np

from stronge1994 import tables
from stronge1994.ledger import finding, outcome
from stronge1994.names import MODELS, PAPER
from stronge1994.pages import ledger_page
from stronge1994.reference_data import Series
from stronge1994.studies.inelastic import trials as inelastic
from stronge1994.tables import Row, Table
from stronge1994.verdict_table import Group, Verdict, Why

Numbers = dict[str, float]
X, W = "incidence [mu v2(0)]", "velocity [mu v2(0)]"
E, BETA_0 = inelastic.E, inelastic.BETA_0
# The pairs of materials that decide most.
SOFT, HARD = inelastic.SOFT, inelastic.HARD


def of_run(
    verdicts: Sequence[Row],
    ledger: Sequence[Row],
    measures: Sequence[Row],
    curves: Mapping[str, str],
    series: Mapping[str, Mapping[str, Any]],
) -> Numbers:
    """All key numbers by name; one that is not finite is an error.

    `measures` are those of the ledger in nature, `curves` the tables of curves by their figures.
    `series` has the entry in source.yaml of the measured `pairs` of materials.
    """
    read = tables.read
    numbers = (
        _counts(verdicts, ledger)
        | _elastic(read(curves["fig5"]))
        | _pairs(read(curves["inelastic"]), Series(**series["pairs"]).points())
        | _rubber(read(curves["rubber_sphere"]))
        | _nature(measures)
    )
    if not_finite := [name for name, value in numbers.items() if not np.isfinite(value)]:
        raise ArithmeticError(f"{', '.join(not_finite)}: not a finite number")
    return numbers


def write(path: str, numbers: Numbers) -> None:
    """Write the numbers as a table."""
    rows = [{"name": name, "value": f"{value:.12g}"} for name, value in numbers.items()]
    tables.write_rows(path, rows, ["name", "value"])


def _counts(verdicts: Sequence[Row], ledger: Sequence[Row]) -> Numbers:
    """How many rows have each verdict, those that check our solver apart, or each grade.

    `published` are compared with published points. Printed curves do not count.
    """
    verdicts = [row for row in verdicts if row["group"] != Group.PRINTED]
    rows = Counter(
        (row["group"] == Group.SOLVER, part)
        for row in verdicts
        for part in {row["verdict"], row["why"]} - {""}
    )
    published = Counter(row["verdict"] for row in verdicts if row["p"])
    entries, grades = Counter(row["verdict"] for row in ledger), outcome.grades(ledger)
    numbers: Numbers = {f"rows.{part}": rows[False, part] for part in [*Verdict, *Why]}
    numbers |= {f"rows.solver.{part}": rows[True, part] for part in [*Verdict, *Why]}
    numbers |= {"rows.solver": sum(rows[True, verdict] for verdict in Verdict)}
    numbers |= {"rows.others": sum(rows[False, verdict] for verdict in Verdict)}
    numbers |= {"rows.published.agrees": published["agrees"], "ledger.entries": len(ledger)}
    numbers |= {f"ledger.{verdict}": entries[verdict] for verdict in ledger_page.STYLE}
    numbers |= {f"ledger.{grade}": grades.get(grade, 0) for grade in outcome.GRADES}
    numbers["ledger.causes"] = len({row["cause"] for row in ledger if row["cause"]})
    return numbers


def _elastic(curves: Table) -> Numbers:
    """Largest distance of the lumped model from the continuum at e = 1, and its incidence."""
    lumped, continuum = (tables.select(curves, model=model) for model in ("lumped", "continuum"))
    if not lumped[X].equals(continuum[X]):
        raise ValueError("Fig. 5: lumped model and continuum have other incidences")
    distance = (lumped[W] - continuum[W]).abs()
    return {"elastic.largest": distance.max(), "elastic.at": lumped[X][distance.idxmax()]}


def _pairs(curves: Table, measured: Table) -> Numbers:
    """The measured pairs of materials, and chi-squared of each model in each trial of the figure.

    `failed` is the number of spreads of impacts with which a model fails; `least` and `most` are
    its smallest and largest chi-squared over them. `soft` is beta_0 of one pair.
    """
    trials = inelastic.trials(curves)
    spreads = [trial for trial in trials.values() if not trial.without and trial.share == 1]
    least, second = measured[E].nsmallest(2)
    numbers: Numbers = {"pairs.number": len(measured["pair"]), "pairs.spreads": len(spreads)}
    numbers |= {"pairs.least_e": least, "pairs.second_e": second}
    for model in MODELS:
        fit, name = partial(inelastic.goodness, curves, model, measured), f"pairs.{model}"
        for title, trial in trials.items():
            of_trial = name if trial is inelastic.AS_JUDGED else f"{name}.{title}"
            found = fit(trial)
            numbers |= {f"{of_trial}.chi2": found.value, f"{of_trial}.p": found.p}
        values = [fit(trial).value for trial in spreads]
        numbers |= {f"{name}.least": min(values), f"{name}.most": max(values)}
        for part, without in (("", []), (f".{SOFT}", [SOFT]), (".both", [SOFT, HARD])):
            p = [fit(trial._replace(without=without)).p for trial in spreads]
            numbers[f"{name}{part}.failed"] = sum(value <= inelastic.SIGNIFICANCE for value in p)
    alone = inelastic.Trial(without=[pair for pair in measured["pair"] if pair != SOFT])
    share = inelastic.goodness(curves, PAPER, measured, alone)
    numbers[f"pairs.{PAPER}.{SOFT}.chi2"] = share.value
    soft = measured[measured["pair"] == SOFT].iloc[0]
    numbers["pairs.soft.measured"] = soft[BETA_0]
    numbers["pairs.soft.sigma"] = soft[inelastic.SIGMA]
    for model in MODELS:
        of_soft = {"variant": "pairs", "spread": inelastic.WHOLE, "pair": SOFT}
        numbers[f"pairs.soft.{model}"] = tables.select(curves, model=model, **of_soft)[BETA_0][0]
    return numbers


def _rubber(curves: Table) -> Numbers:
    """Distances of e_t from the rubber sphere, root mean square; `small` are small incidences."""
    numbers: Numbers = {}
    for model, own in tables.each(curves, "model", variant="rms"):
        small, all_impacts = own["incidence_limit [mu v2(0)]"].argsort()
        for kind in ("distance", "from_velocity", "from_spin"):
            means = own[f"rms_{kind} [1]"]
            numbers[f"rubber.{model}.{kind}"] = means[all_impacts]
            numbers[f"rubber.{model}.{kind}.small"] = means[small]
    return numbers


def _nature(measures: Sequence[Row]) -> Numbers:
    """What the ledger's checks of restitution find, by model."""
    return {
        f"nature.{row['measure']}.{model}": float(row[model])
        for row in measures
        for model in finding.MODELS
    }
