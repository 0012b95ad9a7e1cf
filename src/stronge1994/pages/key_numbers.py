"""Numbers of a run that several pages state: each is computed once, for one table.

A number has a name such as `pairs.lumped.hysteretic.chi2`, made of what it is about, and a text
that says what it is. Pages round it; they never compute it again.
"""

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from planarimpact.ground.arrays import Array
from stronge1994 import csv_tables, reference_data
from stronge1994.csv_tables import Columns, Curves, Row
from stronge1994.figures.inelastic import trials as inelastic
from stronge1994.figures.shared.drawing.beside import MODELS
from stronge1994.ledger import in_nature, outcome
from stronge1994.ledger.in_nature import Values

COLUMNS = ["name", "value", "what"]
X, W = "incidence [mu v2(0)]", "velocity [mu v2(0)]"
E, BETA_0 = inelastic.E, inelastic.BETA_0
SOFT, HARD = inelastic.SOFT, inelastic.HARD
# Models are compared with the finite elements up to this friction, from this restitution on.
LARGEST_FRICTION, LEAST_RESTITUTION = 0.1, 0.45
NEAR_RESTITUTIONS = (0.62, 0.92)  # restitutions at which two Kelvin-Voigt elements are near


class Tables(NamedTuple):
    """Tables of a run of which pages state numbers."""

    verdicts: Sequence[Row]
    ledger: Sequence[Row]
    nature: Mapping[str, Values]
    fig5: Curves
    fig8: Curves
    inelastic: Curves
    yielding: Curves
    rubber: Curves
    rod: Curves
    trade: Sequence[Row]
    pairs: Columns
    runs: Columns


def read(paths: Mapping[str, str], series: Mapping[str, Mapping[str, Any]]) -> Tables:
    """Read the tables of a run, by the names of their files, and `series` of source.yaml."""
    rows, curves = csv_tables.read_rows, csv_tables.read
    return Tables(
        verdicts=rows(paths["verdicts"]),
        ledger=rows(paths["ledger"]),
        nature=in_nature.read(rows(paths["in_nature"])),
        fig5=curves(paths["fig5"]),
        fig8=curves(paths["fig8"]),
        inelastic=curves(paths["inelastic"]),
        yielding=curves(paths["yielding"]),
        rubber=curves(paths["rubber_sphere"]),
        rod=curves(paths["rod"]),
        trade=rows(paths["trade"]),
        pairs=reference_data.arrays("pairs", series["pairs"]),
        runs=reference_data.arrays("spheres", series["runs"]),
    )


def table_rows(tables: Tables) -> list[Row]:
    """All key numbers, as rows of their table; a number that is not finite is an error."""
    numbers = [
        *_counts(tables),
        *_elastic(tables.fig5),
        *_pairs(tables.inelastic, tables.pairs),
        *_finite_elements(tables.yielding, tables.runs),
        *_rubber(tables.rubber),
        *_others(tables),
    ]
    not_finite = [name for name, value, _ in numbers if not np.isfinite(value)]
    if not_finite:
        raise ArithmeticError(f"{', '.join(not_finite)}: not a finite number")
    return [{"name": name, "value": f"{value:.12g}", "what": what} for name, value, what in numbers]


def write(output: str, paths: Mapping[str, str], series: Mapping[str, Mapping[str, Any]]) -> None:
    """Write the table of key numbers."""
    csv_tables.write_table(output, table_rows(read(paths, series)), COLUMNS)


def by_name(table: Sequence[Row]) -> dict[str, float]:
    """Numbers by their names.

    >>> by_name([{"name": "ledger.wrong", "value": "25", "what": "wrong entries"}])
    {'ledger.wrong': 25.0}
    """
    return {row["name"]: float(row["value"]) for row in table}


_Numbers = Iterator[tuple[str, float, str]]


def _counts(tables: Tables) -> _Numbers:
    verdicts = Counter(row["verdict"] for row in tables.verdicts)
    for verdict in sorted(verdicts):
        yield f"rows.{verdict}", verdicts[verdict], f"comparisons with the verdict: {verdict}"
    published = Counter(row["verdict"] for row in tables.verdicts if row["p"])
    what = "comparisons with published points that agree"
    yield "rows.published.agrees", published["agrees"], what
    yield "ledger.entries", len(tables.ledger), "entries of the ledger"
    counts = Counter(row["verdict"] for row in tables.ledger)
    for verdict in sorted(counts):
        yield f"ledger.{verdict}", counts[verdict], f"entries of the ledger that are {verdict}"
    for grade, number in outcome.grades(tables.ledger).items():
        yield f"ledger.{grade}", number, f"wrong entries of the ledger with the grade: {grade}"
    causes = {row["cause"] for row in tables.ledger if row["cause"]}
    yield "ledger.causes", len(causes), "causes of the wrong entries"


def _elastic(curves: Curves) -> _Numbers:
    lumped, continuum = curves["lumped"], curves["continuum"]
    if not np.array_equal(lumped[X], continuum[X]):
        raise ValueError("Fig. 5: lumped model and continuum have other incidences")
    distance = np.abs(lumped[W] - continuum[W])
    what = "lumped model from the elastic continuum, e = 1, largest, mu v2(0)"
    yield "elastic.largest", distance.max(), what
    yield "elastic.at", lumped[X][distance.argmax()], "incidence at which it is largest"


def _pairs(curves: Curves, measured: Columns) -> _Numbers:
    yield "pairs.number", len(measured["pair"]), "measured pairs of materials"
    trials = inelastic.trials(curves)
    spreads = [trial for trial in trials.values() if not trial.without and trial.share == 1]
    yield "pairs.spreads", len(spreads), "spreads of impacts that were tried"
    for model in MODELS:
        for name, trial in trials.items():
            fit = inelastic.goodness(curves, model, measured, trial)
            suffix = "" if trial is inelastic.AS_JUDGED else f".{name}"
            yield f"pairs.{model}{suffix}.chi2", fit.value, f"chi^2 of the pairs, {name}"
            yield f"pairs.{model}{suffix}.p", fit.p, f"its probability, {name}"
        for suffix, without in (("", ()), (f".{SOFT}", [SOFT]), (".both", [SOFT, HARD])):
            fits = [
                inelastic.goodness(curves, model, measured, trial._replace(without=without))
                for trial in spreads
            ]
            failed = sum(fit.p <= inelastic.SIGNIFICANCE for fit in fits)
            what = f"spreads of impacts with which it fails, without {without or 'none'}"
            yield f"pairs.{model}{suffix}.failed", failed, what
            if not without:
                for end, value in (("least", min), ("most", max)):
                    number = value(fit.value for fit in fits)
                    yield f"pairs.{model}.{end}", number, f"{end} chi^2 over all spreads"
    others = [pair for pair in measured["pair"] if pair != SOFT]
    alone = inelastic.goodness(
        curves, "lumped.hysteretic", measured, inelastic.Trial(without=others)
    )
    what = f"what {SOFT} adds to chi^2 of the paper's model"
    yield f"pairs.lumped.hysteretic.{SOFT}.chi2", alone.value, what
    for name, without in (("", []), (".without", [SOFT])):
        slope, sigma = inelastic.slope(measured, without)
        what = f"slope of the measured beta_0 against e, without {without or 'none'}"
        yield f"pairs.slope{name}", slope, what
        yield f"pairs.slope{name}.sigma", sigma, "its standard deviation"
    least, second = np.sort(measured[E])[:2]
    yield "pairs.least_e", least, "smallest restitution of a pair"
    yield "pairs.second_e", second, "smallest restitution but one"
    for name, pair in (("soft", SOFT), ("hard", HARD)):
        (place,) = np.flatnonzero(measured["pair"] == pair)
        yield f"pairs.{name}.measured", measured[BETA_0][place], f"beta_0 of {pair}"
        yield f"pairs.{name}.sigma", measured[inelastic.SIGMA][place], "its uncertainty as stated"
        for model in MODELS:
            own = curves[f"{model}, pairs"]
            beta_0 = own[BETA_0][own["pair"] == pair][0]
            yield f"pairs.{name}.{model}", beta_0, "beta_0 computed for it"


def _finite_elements(curves: Curves, runs: Columns) -> _Numbers:
    e, friction = runs[E], runs["friction [1]"]
    # Runs to which the constant of the plastic law was fitted are no evidence.
    compared = (friction <= LARGEST_FRICTION + 1e-9) & (e >= LEAST_RESTITUTION)
    compared &= runs["set"] != "calibration"
    near = compared & (e >= NEAR_RESTITUTIONS[0]) & (e <= NEAR_RESTITUTIONS[1])
    yield "yielding.runs", len(e), "finite-element runs of spheres that yield"
    for model in MODELS:
        off = curves[f"{model}, runs"][W] - runs[W]
        limits = f"mu to {LARGEST_FRICTION}, e from {LEAST_RESTITUTION}"
        what = f"from our finite elements of yielding spheres, {limits}"
        yield f"yielding.{model}.rms", _rms(off[compared]), f"{what}, root mean square, mu v2(0)"
        yield f"yielding.{model}.max", np.abs(off[compared]).max(), f"{what}, largest"
        what = f"the same, e from {NEAR_RESTITUTIONS[0]} to {NEAR_RESTITUTIONS[1]}"
        yield f"yielding.{model}.near.rms", _rms(off[near]), f"{what}, root mean square"
        yield f"yielding.{model}.near.max", np.abs(off[near]).max(), f"{what}, largest"


def _rubber(curves: Curves) -> _Numbers:
    for name in (name for name in curves if name.endswith(", rms")):
        model, columns = name.removesuffix(", rms"), curves[name]
        low, high = columns["incidence_limit [mu v2(0)]"].argsort()
        for kind in ("distance", "from_velocity", "from_spin"):
            what = f"{kind} of e_t, root mean square over the rubber sphere's impacts"
            means = columns[f"rms_{kind} [1]"]
            yield f"rubber.{model}.{kind}", means[high], what
            yield f"rubber.{model}.{kind}.small", means[low], f"{what} at small incidence"


def _others(tables: Tables) -> _Numbers:
    normal = tables.fig8["normal"]["peak_force [N]"]
    yield "fig8.normal", normal.max(), "largest normal force on the pendulum ball, N"
    shares = [
        columns["kinetic_energy [K0]"].max()
        for name, columns in tables.rod.items()
        if name.startswith("rigid, Newton")
    ]
    yield "rod.newton", max(shares) - 1, "energy gained with Newton's coefficient, over K0"
    errors = {row["name"]: float(row["max_velocity [mu v2(0)]"]) for row in tables.trade}
    lossy = {name: error for name, error in errors.items() if ", e = 0.8" in name}
    paper = [error for name, error in lossy.items() if name.startswith("lumped.hysteretic, ")]
    yield "loss.paper", max(paper), "paper's model from the farther continuum, e = 0.8, largest"
    other = [error for name, error in lossy.items() if name.startswith("continuum.")]
    yield "loss.other", max(other), "viscous from plastic continuum, e = 0.8, largest"
    for name, values in tables.nature.items():
        for model, value in values._asdict().items():
            yield f"nature.{name}.{model}", value, f"measure in nature: {name}, {model}"


def _rms(values: Array) -> float:
    return float(np.sqrt(np.mean(np.square(values))))
