"""The smallest change of each group of the physics that a comparison catches.

The curves are solved with each group off by a little; the distances change in proportion, and so
they are extended until the verdict is `diverges`. Differences of curves do with fewer vertices.
"""

import one_thread  # noqa: F401

# isort: split
import functools
import importlib
import operator

import compare
import csv_tables
import job
import judged_tables
import numpy as np
import solve
import verdict_table

from planarimpact.comparison import Residuals, Verdict

# What is changed, by the keys under which settings have it.
KEYS = [("stiffness_ratio", "poisson_ratio"), ("mass_ratio",), ("restitution",), ("friction",)]
GROUPS = dict(zip(verdict_table.GROUPS, KEYS, strict=True))
PRINTED = "as printed"  # in the names of curves
# Their solvers take long, and what they solve is in other figures too.
UNTRIED = ("trade", "convergence")
COARSER, FEWEST = 20, 10  # vertices
STEP = 1e-4  # small enough for changes in proportion, large beside rounding
SIZES = 10.0 ** np.arange(-15, -0.25, 0.1)
# Parts of settings that hold physics of their own.
PARTS = ("experiment", "finite_elements", "rubber", "throw", "points")
# Its balances are laws; their contacts are not followed through.
SHORT = {"stability": {"most_phases": 2}}
LAWS = ("balance", "range", "contraction")  # they hold whatever the parameters
# Its digits are logarithms, which do not change in proportion: powers of ten are tried one by one,
# on one of so many points.
DIGITS, SPARSE = "stability", 40
TRIED = 10.0 ** np.arange(-15, -2)


def sensitivities(figure, settings, nodes, path, comparisons, references, series, significance):
    """Rows of the table: what each comparison of one figure catches.

    Parameters
    ----------
    figure : str
    settings, nodes : dict
        As `solve.solve` takes them.
    path : str
        The curves that were judged.
    comparisons, references, series, significance
        As `compare.compare` takes them.

    Returns
    -------
    list of list of str
        The name of the comparison, and sizes of the changes, see `GROUPS`: relative ones, of e an
        absolute one. `none` where even a change by half is not caught; empty where the figure does
        not depend on the group, or the comparison cannot be made.
    """
    settings = settings | solve.read_nodes(nodes) | SHORT.get(figure, {})
    if "samples" in settings:
        settings["samples"] = max(FEWEST, settings["samples"] // COARSER)
    if "as_printed" in settings:
        settings["as_printed"] = False
    try:
        curves = None if figure in UNTRIED else judged_tables.read(path)
    except Exception:  # the row `...-solved` says so
        curves = None
    if curves is None:
        return [[title, *[""] * len(GROUPS)] for title in comparisons]
    solve_once = _once(functools.partial(_solve, figure, curves), operator.eq)
    solved = {group: _solver(solve_once, figure, settings, group) for group in GROUPS}
    rows = []
    for title, entry in comparisons.items():
        known = references.get(entry.get("reference"))

        measure = _once(
            functools.partial(compare.measure, entry, known, series_paths=series), operator.is_
        )

        def caught(found, entry=entry, known=known):
            return compare.judge(entry, known, found, significance) == Verdict.DIVERGES

        if entry["metric"] in LAWS:
            sizes = ["none"] * len(GROUPS)
        elif figure != DIGITS:
            sizes = [
                _in_proportion(curves, solved[group], measure, caught, one_way=group == "e")
                for group in GROUPS
            ]
        elif entry["metric"] == "largest":
            sizes = [_by_trial(solved[group], measure, caught) for group in GROUPS]
        else:  # the impacts themselves, of which only some are tried
            sizes = [""] * len(GROUPS)
        rows.append([title, *sizes])
    return rows


def _once(function, same):
    """A function of one argument, called once for all arguments that are the same."""
    known = []

    def answer(argument):
        for before, found in known:
            if same(before, argument):
                return found
        known.append((argument, function(argument)))
        return known[-1][1]

    return answer


def _solve(figure, curves, settings):
    """Curves of other settings, under the names that `curves` have.

    What the printed equations give is left as it is.
    """
    module = importlib.import_module(f"planarimpact.curves.{figure}")
    own = [name for name in curves if "sigma" not in name and PRINTED not in name]
    changed_ones = dict(zip(own, module.curves(**settings).values(), strict=True))
    return {name: columns for name, columns in curves.items() if PRINTED in name} | changed_ones


def _solver(solve_once, figure, settings, group):
    """Curves by the size that a group is off by; None without the group."""
    if changed(settings, group, STEP) == settings:
        return None

    def solved(size):
        wrong = changed(settings, group, size)
        wrong.pop("uncertainty", None)
        if figure == DIGITS:
            wrong["points"] = {key: column[::SPARSE] for key, column in wrong["points"].items()}
        return solve_once(wrong)

    return solved


def changed(settings, group, size):
    """Settings with one group off: by that share of it, restitution by so much.

    Restitution is lowered, but 0 is raised. A stiffness ratio that follows from Poisson's ratio is
    lowered, as 1/2 is the largest of these.

    Examples
    --------
    >>> changed({"restitution": [1.0, 0.0], "samples": 9}, "e", 0.25)
    {'restitution': [0.75, 0.25], 'samples': 9}
    >>> changed({"throw": {"friction": 0.5}}, "mu", 0.5)
    {'throw': {'friction': 0.75}}
    """
    wrong = {}
    for key, value in settings.items():
        if key in PARTS:
            wrong[key] = changed(value, group, size)
        elif key in GROUPS[group]:
            several = [_off(key, number, size) for number in np.ravel(value).tolist()]
            wrong[key] = several if isinstance(value, list) else several[0]
        else:
            wrong[key] = value
    return wrong


def _off(key, number, size):
    if key == "restitution":
        return number - size if number > size else number + size
    if key == "poisson_ratio":
        ratio = (2 - number) / (2 * (1 - number)) * (1 - size)
        return 2 * (ratio - 1) / (2 * ratio - 1)
    return number * (1 + size)


def _in_proportion(curves, solved, measure, caught, one_way):
    """Size that is caught, from one change of the distances in proportion to it, either way."""
    try:
        found = measure(curves)
        if not solved or all(PRINTED in column for column in found.columns):
            return ""
        same, other = measure(solved(0.0)), measure(solved(STEP))
    except Exception:  # awaited, or failing for a reason that its own row gives
        return ""

    def off(size):
        share = size / STEP
        three = zip(found.residuals, same.residuals, other.residuals, strict=True)
        parts = [a + share * (c - b) for a, b, c in three]
        gap = None if found.gap is None else found.gap + share * (other.gap - same.gap)
        return found._replace(residuals=Residuals(*parts), gap=gap)

    ways = (1,) if one_way else (1, -1)
    return _words(size for size in SIZES if all(caught(off(way * size)) for way in ways))


def _by_trial(solved, measure, caught):
    """Size that is caught, each tried."""
    if not solved:
        return ""
    return _words(size for size in TRIED if caught(measure(solved(float(size)))))


def _words(sizes):
    return next((f"{size:.1g}" for size in sizes), "none")


if "snakemake" in globals():
    with job.recorded(snakemake):  # noqa: F821
        given = snakemake.params  # noqa: F821
        csv_tables.write_rows(
            snakemake.output[0],  # noqa: F821
            verdict_table.GATES,
            sensitivities(
                snakemake.wildcards.figure,  # noqa: F821
                given.settings,
                given.nodes,
                snakemake.input.curves,  # noqa: F821
                given.judged["comparisons"],
                given.judged["references"],
                dict(zip(given.judged["sources"], snakemake.input.series, strict=True)),  # noqa: F821
                given.significance,
            ),
        )
