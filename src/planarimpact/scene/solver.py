"""Solves tables of impacts, block by block, and counts what it did."""

import reprlib
from collections import Counter
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from planarimpact import bodies, collision
from planarimpact.collision import model_form, rungs
from planarimpact.ground import checks
from planarimpact.ground.arrays import Array, Booleans, Integers
from planarimpact.ground.checks import ConvergenceError, InputError
from planarimpact.ground.results import Regime
from planarimpact.scene import columns, states

if TYPE_CHECKING:
    import pandas as pd

# Rows that are solved together: this bounds the memory.
BLOCK = 2**17
# Time that it takes to solve an impact, by rung, over that below e = 1; others take next to none.
_COSTS = np.array(
    [
        0.0 if rung.way != "solved" else 0.05 if rung.model == "continuum" else 1.0
        for rung in rungs.RUNGS
    ]
)


class Block(NamedTuple):
    """Rows of a table that are read and checked, and not answered yet."""

    table: "pd.DataFrame"
    names: dict[str, str]
    good: Booleans
    problems: dict[int, str]
    rows: states.Rows  # the good ones
    of_rungs: tuple[Integers, Array]

    def cuts(self, most: int) -> list[int]:
        """Where to cut the table into parts that take about as long as `most` impacts, solved.

        Parameters
        ----------
        most : int

        Returns
        -------
        list of int
            Positions of the first rows of all parts but the first one.
        """
        costs = np.zeros(len(self.table))
        costs[self.good] = _COSTS[self.of_rungs[0]]
        sums = np.cumsum(costs)
        total = float(sums[-1]) if sums.size else 0.0
        edges = np.linspace(0.0, total, int(np.ceil(total / most)) + 1)[1:-1]
        return np.unique(np.searchsorted(sums, edges) + 1).tolist()

    def leave_the_table(self) -> str:
        """Text: how many impacts the table of spheres does not answer, and why.

        Returns
        -------
        str
        """
        place, _ = self.of_rungs
        too_coarse = int(np.isin(place, rungs.TOO_COARSE_RUNGS).sum())
        count = int(np.count_nonzero(_COSTS[place]))
        reasons = []
        if too_coarse:
            least = _rounded_up(rungs.tolerance_of_table(self.rows.impacts, place))
            reasons.append(f"is too coarse for {too_coarse:,} (with tolerance {least} it is not)")
        if count > too_coarse:
            reasons.append(f"does not cover {count - too_coarse:,} at any tolerance")
        why = " and ".join(reasons)
        return f"the continuum is solved for {count:,} impacts, as the table of spheres {why}"


class Solver:
    """Solves one table after another, and counts what it did.

    Parameters
    ----------
    tolerance : float
    loss : str, optional
        Both as in `solve`.

    Attributes
    ----------
    bad : list of (int, str)
        Rows left out with `skip_bad`, and why. Row 1 is the first one, of the first table.
    rows : int
        Rows read so far.
    """

    def __init__(self, tolerance: float = collision.TOLERANCE, loss: str | None = None) -> None:
        allowed = "numbers from 1e-10 to 1"
        self.tolerance = checks.number("tolerance", tolerance, allowed, 1e-10, 1)
        self._loss = loss if loss is None else checks.loss(loss, columns.LOSSES)
        self.bad: list[tuple[int, str]] = []
        self.rows = 0
        self._count_by_rung: Counter[int] = Counter()  # by place in `rungs.RUNGS`
        self._differences = model_form.Summary()
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
        import pandas as pd  # here, as only who solves tables needs it

        if not isinstance(table, pd.DataFrame):
            raise InputError(
                f"table = {' '.join(reprlib.repr(table).split())}: allowed is a pandas DataFrame; "
                "`python -m planarimpact scene` reads files"
            )
        blocks = [
            self.answer(self.read(table.iloc[start : start + BLOCK], skip_bad), skip_bad)
            for start in range(0, max(len(table), 1), BLOCK)
        ]
        return pd.concat(blocks) if len(blocks) > 1 else blocks[0]

    def join(self, following: "Solver") -> None:
        """Add the counts of a solver of the rows that follow.

        Parameters
        ----------
        following : Solver
        """
        self.rows = following.rows
        self.bad += following.bad
        self._count_by_rung += following._count_by_rung
        self._differences = self._differences.joined(following._differences)
        self._coupled += following._coupled
        self._largest_coupling = max(self._largest_coupling, following._largest_coupling)

    def explain(self) -> str:
        """Text that says how many impacts each model solved and why, a line for each.

        Returns
        -------
        str
        """
        lines = [f"{self.rows - len(self.bad)} impacts, tolerance {self.tolerance:g}"]
        for place, count in self._count_by_rung.most_common():
            rung = rungs.RUNGS[place]
            lines.append(f"{count:>10}  {rung.name:<27}  {rung.why}")
        if self._coupled:
            lines.append(
                "the bodies spread differently under pressure, which no model here has: "
                f"{self._coupled} impacts may be off by more than 0.1 mu v2(0) (Dundurs' constant "
                f"over friction up to {self._largest_coupling:.2g}, allowed is {bodies.COUPLING:g})"
            )
        return "\n".join(lines + self._differences.lines())

    @checks.default_errors
    def read(self, table: "pd.DataFrame", skip_bad: bool = False) -> Block:
        """Rows of a table read and checked, for `answer`.

        Parameters
        ----------
        table : DataFrame
        skip_bad : bool
            Both as in `solve`.

        Returns
        -------
        Block
        """
        names = columns.named(table.columns)
        self._refuse_two_losses(names)
        values, problems = columns.numbers(table, names)
        if "restitution" in names and "loss" not in names:
            code = columns.LOSSES.index(self._loss) if self._loss else columns.NO_LOSS
            values["loss"] = np.full(len(table), float(code))
        columns.refuse_missing_loss(values, problems)
        good = np.ones(len(table), dtype=bool)
        good[list(problems)] = False
        rows = _rows(values, good, problems)
        bad_impacts = collision.problems(rows.impacts)
        bad_impacts |= collision.problems_of_normals(rows.impacts.normal)
        problems |= _by_position(good, bad_impacts)
        self._refuse(problems, skip_bad, InputError)
        if bad_impacts:
            good[list(problems)] = False
            rows = _rows(values, good, problems)
        of_rungs = rungs.of_each(rows.impacts, self.tolerance)
        return Block(table, names, good, problems, rows, of_rungs)

    @checks.default_errors
    def answer(self, block: Block, skip_bad: bool = False) -> "pd.DataFrame":
        """The result for rows that `read` has returned; it counts them.

        Parameters
        ----------
        block : Block
        skip_bad : bool
            As in `solve`.

        Returns
        -------
        DataFrame
        """
        table, names, good, problems, rows, of_rungs = block
        answers = collision.answers(rows.impacts, self.tolerance, peaks=True, of_rungs=of_rungs)
        unsolved = _by_position(good, answers.unsolved)
        self._refuse(unsolved, skip_bad, ConvergenceError)
        form = collision.model_forms(rows.impacts, answers)
        self._count(rows, answers, form)
        problems = problems | unsolved
        self.bad += [(self.rows + row + 1, problems[row]) for row in sorted(problems)]
        self.rows += len(table)
        result = table[good].assign(**_result(rows, answers, form, names))
        return result[_solved(answers)] if unsolved else result

    def _refuse_two_losses(self, names: dict[str, str]) -> None:
        for name in names.keys() & {"loss", *collision.RESTITUTION_FROM} - {"restitution"}:
            if self._loss is not None:
                raise InputError(
                    f"loss = {self._loss!r}: it does not apply, as the column {names[name]!r} says "
                    "what takes the energy"
                )

    def _refuse(
        self, problems: dict[int, str], skip_bad: bool, kind: type[InputError | ConvergenceError]
    ) -> None:
        """Refuse the first bad row, unless bad rows are skipped."""
        if problems and not skip_bad:
            first = min(problems)
            more = f"; {len(problems) - 1} more rows are bad" if len(problems) > 1 else ""
            raise kind(f"row {self.rows + first + 1}: {problems[first]}{more}")

    def _count(self, rows: states.Rows, answers: rungs.Answers, form: Array) -> None:
        """Count the impacts of each rung, and what `explain` says of the models."""
        place, solved = answers.place, _solved(answers)
        counts = np.bincount(place[solved], minlength=len(rungs.RUNGS)).tolist()
        self._count_by_rung += Counter(dict(enumerate(counts)))
        lossy = [rung.model.startswith("continuum.") for rung in rungs.RUNGS]
        which = np.flatnonzero(np.array(lossy)[place] & solved)
        differences = form[which] / rows.impacts.unit[which]
        self._differences = self._differences.joined(model_form.summary(differences))
        coupling = rows.coupling[place >= rungs.FIRST_OF_CONTINUA]
        large = coupling[coupling > bodies.COUPLING]
        self._coupled += large.size
        self._largest_coupling = max(self._largest_coupling, float(np.max(large, initial=0.0)))


def _rounded_up(number: float) -> str:
    """A positive number with two digits.

    >>> _rounded_up(4.0001e-3)
    '0.0041'
    """
    unit = 10.0 ** (np.floor(np.log10(number)) - 1)
    return f"{np.ceil(number / unit) * unit:.2g}"


def _rows(values: dict[str, Array], good: Booleans, problems: dict[int, str]) -> states.Rows:
    """The good rows; those whose physical quantities are out of range become bad."""
    while True:
        try:
            return states.rows({name: column[good] for name, column in values.items()})
        except bodies.OutOfRange as error:
            for position in np.flatnonzero(good)[error.where].tolist():
                problems[position], good[position] = str(error), False


def _by_position(good: Booleans, messages: dict[int, str]) -> dict[int, str]:
    """Messages by the positions of rows in the table, from those by the index among good rows."""
    positions = np.flatnonzero(good)
    return {int(positions[i]): message for i, message in messages.items()}


def _solved(answers: rungs.Answers) -> Booleans:
    """Which impacts have an answer."""
    solved = np.ones(answers.place.size, dtype=bool)
    solved[list(answers.unsolved)] = False
    return solved


def _result(
    rows: states.Rows, answers: rungs.Answers, form: Array, names: dict[str, str]
) -> dict[str, Any]:
    """The columns that are added to those of the table."""
    import pandas as pd

    impacts, plane, peak = rows.impacts, "spin" in names, answers.peak_friction
    body, other, _ = collision.after(impacts, answers.change)
    after = states.columns_of(body, plane)
    if {"other_density", "other_mass"} & set(names):
        after |= {f"other_{k}": v for k, v in states.columns_of(other, plane).items()}
    result: dict[str, Any] = {
        columns.header(name, "_after"): values for name, values in after.items()
    }
    if "restitution" not in names:
        result |= {"restitution": impacts.restitution}
    if "loss" not in names:
        code = np.where(impacts.restitution < 1, impacts.plastic, -1)
        result |= {"loss": pd.Categorical.from_codes(code, columns.LOSSES)}
    models = list(dict.fromkeys(rung.model for rung in rungs.RUNGS))
    model = np.array([models.index(rung.model) for rung in rungs.RUNGS])[answers.place]
    return result | {
        "contact_velocity_after [m/s]": answers.velocity,
        "model": pd.Categorical.from_codes(model, models),
        "error_bound [m/s]": answers.error,
        "model_form [m/s]": form,
        "regime": pd.Categorical.from_codes(answers.regime, list(Regime.__members__)),
        "incidence": impacts.incidence_of(np.arange(model.size)),
        "peak_normal_force [N]": rows.peak_normal,
        # Without friction there is none, also where the normal force is not known.
        "peak_friction_force [N]": np.where(
            peak > 0, impacts.unit / impacts.v2 * peak * rows.peak_normal, 0.0
        ),
        "energy_lost [J]": collision.energy_lost(impacts, answers.change),
    }
