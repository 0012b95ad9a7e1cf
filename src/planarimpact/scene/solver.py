"""Solves tables of impacts, block by block, and counts what it did."""

from collections import Counter
from typing import TYPE_CHECKING, Any

import numpy as np

from planarimpact import bodies
from planarimpact.collision import (
    RESTITUTION_FROM,
    TOLERANCE,
    mechanics,
    methods,
    model_form,
)
from planarimpact.common import checks
from planarimpact.common.arrays import Array, Booleans, Integers
from planarimpact.common.checks import ConvergenceError, InputError
from planarimpact.common.results import Regime
from planarimpact.scene import columns, states

if TYPE_CHECKING:
    import pandas as pd

# Rows that are solved together. More take more memory, and no less time for each.
BLOCK = 2**15


class Solver:
    """Solves one table after another, and counts what it did.

    Parameters
    ----------
    tolerance, loss : float, str
        As in the function `solve`.

    Attributes
    ----------
    bad : list of (int, str)
        Rows left out with `skip_bad`, and why. Row 1 is the first one, of the first table.
    rows : int
        Rows read so far.
    """

    def __init__(self, tolerance: float = TOLERANCE, loss: str | None = None) -> None:
        allowed = "numbers from 1e-10 to 1"
        self.tolerance = checks.number("tolerance", tolerance, allowed, 1e-10, 1)
        self._loss = loss if loss is None else checks.loss(loss, columns.LOSSES)
        self.bad: list[tuple[int, str]] = []
        self.rows = 0
        self._count_by_method: Counter[int] = Counter()  # by place in `methods.METHODS`
        # Differences to the other loss, mu v2(0): how many, known or not; and those that are known,
        # their squares, and the largest.
        self._lossy, self._known, self._squares, self._largest = 0, 0, 0.0, 0.0
        # Impacts of bodies that are too dissimilar, and the largest coupling.
        self._coupled, self._largest_coupling = 0, 0.0

    @checks.default_errors
    def solve(self, table: "pd.DataFrame", skip_bad: bool = False) -> "pd.DataFrame":
        """State after each impact of a table, as the function `solve`.

        Parameters
        ----------
        table : DataFrame
        skip_bad : bool
            Leave out bad rows, and rows without an answer, and list them in `bad`.

        Returns
        -------
        DataFrame
        """
        import pandas as pd

        if not isinstance(table, pd.DataFrame):
            raise InputError(
                f"table = {checks.brief(table)}: allowed is a pandas DataFrame; "
                "`python -m planarimpact scene` reads files"
            )
        names = columns.named(table.columns)
        self._refuse_two_losses(names)
        starts = range(0, max(len(table), 1), BLOCK)
        blocks = [self._solved(table.iloc[k : k + BLOCK], names, skip_bad) for k in starts]
        return pd.concat(blocks) if len(blocks) > 1 else blocks[0]

    def insert_bad(self, skipped: dict[int, str]) -> None:
        """Add rows that were left out before `solve`, by number, to `bad`: later ones move on."""
        places = np.sort(np.array(list(skipped), dtype=int)) - np.arange(len(skipped))
        rows = [row for row, _ in self.bad]
        moved = rows + np.searchsorted(places, rows, side="right")
        problems = dict(zip(moved.tolist(), (problem for _, problem in self.bad), strict=True))
        self.bad = sorted((problems | skipped).items())
        self.rows += len(skipped)

    def explain(self) -> str:
        """Text that says how many impacts each model solved and why, a line for each.

        Returns
        -------
        str
        """
        lines = [f"{self.rows - len(self.bad)} impacts, tolerance {self.tolerance:g}"]
        for place, count in self._count_by_method.most_common():
            method = methods.METHODS[place]
            lines.append(f"{count:>10}  {method.name:<27}  {method.why}")
        if self._coupled:
            lines.append(
                "the bodies spread differently under pressure, which no model here has: "
                f"{self._coupled} impacts may be off by more than 0.1 mu v2(0) (Dundurs' constant "
                f"over friction up to {self._largest_coupling:.2g}, allowed is {bodies.COUPLING:g})"
            )
        if self._lossy:
            typical = (self._squares / max(self._known, 1)) ** 0.5
            unknown = self._lossy - self._known
            more = f", not known for {unknown}" if unknown else ""
            lines.append(
                f"with the other loss the velocity would differ by {typical:.2g} mu v2(0) (root "
                f"mean square), {self._largest:.2g} at most: {self._lossy} impacts{more}"
            )
        return "\n".join(lines)

    def _solved(
        self, table: "pd.DataFrame", names: dict[str, str], skip_bad: bool
    ) -> "pd.DataFrame":
        """State after each impact of a block."""
        values, problems = columns.numbers(table, names, self._loss)
        rows, good = _good_rows(values, problems)
        self._refuse(problems, skip_bad, InputError)
        answers = methods.answers(rows.impacts, self.tolerance, peaks=True)
        unsolved = {int(good[i]): message for i, message in answers.unsolved.items()}
        self._refuse(unsolved, skip_bad, ConvergenceError)
        form = model_form.model_forms(rows.impacts, answers.place, answers.velocity)
        self._count(rows, answers, form)
        problems |= unsolved
        self.bad += [(self.rows + row + 1, problems[row]) for row in sorted(problems)]
        self.rows += len(table)
        result = table.iloc[good].assign(**_result(rows, answers, form, names))
        return result[_has_answer(answers)] if unsolved else result

    def _refuse_two_losses(self, names: dict[str, str]) -> None:
        for name in names.keys() & {"loss", *RESTITUTION_FROM} - {"restitution"}:
            if self._loss is not None:
                raise InputError(
                    f"loss = '{self._loss}': it does not apply, column '{names[name]}' gives it"
                )

    def _refuse(
        self, problems: dict[int, str], skip_bad: bool, kind: type[InputError | ConvergenceError]
    ) -> None:
        """Refuse the first bad row, unless bad rows are skipped."""
        if problems and not skip_bad:
            first = min(problems)
            more = f"; {len(problems) - 1} more rows are bad" if len(problems) > 1 else ""
            raise kind(f"row {self.rows + first + 1}: {problems[first]}{more}")

    def _count(self, rows: states.Rows, answers: methods.Answers, form: Array) -> None:
        """Count the impacts of each method, and what `explain` says of the models."""
        place, solved = answers.place, _has_answer(answers)
        counts = np.bincount(place[solved], minlength=len(methods.METHODS)).tolist()
        self._count_by_method += Counter(dict(enumerate(counts)))
        has_loss = rows.impacts.loss_code >= 0
        lossy = np.flatnonzero(methods.IS_CONTINUUM[place] & has_loss & solved)
        differences = form[lossy] / rows.impacts.unit[lossy]
        known = differences[np.isfinite(differences)]
        self._lossy += lossy.size
        self._known += known.size
        self._squares += float(np.sum(known**2))
        self._largest = max(self._largest, float(np.max(known, initial=0.0)))
        coupling = rows.coupling[methods.IS_CONTINUUM[place]]
        large = coupling[coupling > bodies.COUPLING]
        self._coupled += large.size
        self._largest_coupling = max(self._largest_coupling, float(np.max(large, initial=0.0)))


def _good_rows(values: dict[str, Array], problems: dict[int, str]) -> tuple[states.Rows, Integers]:
    """Rows without problems, and their positions; problems of impacts are added to the others."""
    while True:
        good = np.delete(np.arange(values["radius"].size), list(problems))
        try:
            rows = states.rows({name: column[good] for name, column in values.items()})
            found = mechanics.problems(rows.impacts)
            found |= mechanics.problems_of_normals(rows.impacts.normal)
        except bodies.OutOfRange as error:
            found = error.messages
        if not found:
            return rows, good
        problems |= {int(good[i]): message for i, message in found.items()}


def _has_answer(answers: methods.Answers) -> Booleans:
    """Which impacts have an answer."""
    solved = np.ones(answers.place.size, dtype=bool)
    solved[list(answers.unsolved)] = False
    return solved


def _result(
    rows: states.Rows, answers: methods.Answers, form: Array, names: dict[str, str]
) -> dict[str, Any]:
    """The columns that are added to those of the table."""
    import pandas as pd

    impacts, plane, peak = rows.impacts, "spin" in names, answers.peak_friction
    body, other, _ = mechanics.after(impacts, answers.change)
    after = states.columns_of(body, plane)
    if {"other_density", "other_mass"} & set(names):
        after |= {f"other_{k}": v for k, v in states.columns_of(other, plane).items()}
    result: dict[str, Any] = {
        columns.header(name, "_after"): values for name, values in after.items()
    }
    if "restitution" not in names:
        result |= {"restitution": impacts.restitution}
    if "loss" not in names:
        result |= {"loss": pd.Categorical.from_codes(impacts.loss_code, columns.LOSSES)}
    models = list(dict.fromkeys(method.model for method in methods.METHODS))
    model = np.array([models.index(method.model) for method in methods.METHODS])[answers.place]
    # Without friction there is no force of it, also where the normal force is not known.
    friction = np.where(
        peak * impacts.unit > 0, impacts.unit / impacts.v2 * peak * rows.peak_normal, 0.0
    )
    added = [
        answers.velocity,
        pd.Categorical.from_codes(model, models),
        answers.error,
        form,
        pd.Categorical.from_codes(answers.regime, list(Regime.__members__)),
        impacts.incidence_of(np.arange(model.size)),
        rows.peak_normal,
        friction,
        mechanics.energy_lost(impacts, answers.change),
    ]
    return result | dict(zip(map(columns.header, columns.RESULT), added, strict=True))
