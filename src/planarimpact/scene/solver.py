"""Solves tables of impacts, block by block, and remembers what it did."""

import reprlib
from collections import Counter
from functools import partial
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from planarimpact import bodies, continuum
from planarimpact.ground import checks, sliding
from planarimpact.ground.arrays import Array, Booleans, Integers, Numbers
from planarimpact.ground.checks import ConvergenceError, InputError
from planarimpact.ground.results import Rebound, Regime
from planarimpact.scene import choice, columns, model_form, motion

# Rows that are solved together: this bounds the memory.
BLOCK = 2**17
# What takes the energy below e = 1 where a table does not say.
LOSS = "viscous"


# Columns from which the loss is known.
SAYS_LOSS = ("loss", *(name for name, loss in columns.LOSS_OF.items() if loss))
ASSUMED = f"restitution below 1: the loss is taken to be {LOSS}, as none was given"


class Report(NamedTuple):
    """What a solver did: as the attributes of `Solver`, impacts by model, model forms, coupling."""

    rows: int
    bad: list[tuple[int, str]]
    assumed: bool
    taken: Counter[tuple[choice.Rung, str]]
    differences: model_form.Summary
    coupled: tuple[int, float]


class Solver:
    """Solves one table after another, and remembers compiled responses and what it did.

    Parameters
    ----------
    tolerance : float
    loss : str, optional
        Both as in `solve`.

    Attributes
    ----------
    assumed : bool
        Whether there was an impact below e = 1 whose loss was not given: it was taken as viscous.
    bad : list of (int, str)
        Rows left out with `skip_bad`, by number from 1 over all tables, and why.
    rows : int
        Rows read so far.
    """

    def __init__(self, tolerance: float = 1e-3, loss: str | None = None) -> None:
        allowed = "numbers from 1e-10 to 1"
        self.tolerance = checks.number("tolerance", tolerance, allowed, 1e-10, 1)
        self._loss = loss if loss is None else checks.loss(loss, columns.LOSSES)
        self.assumed = False
        self.bad: list[tuple[int, str]] = []
        self.rows = 0
        self._responses: choice.Responses = {}
        self._seen: Counter[tuple[str, tuple[float, ...]]] = Counter()
        self._taken: Counter[tuple[choice.Rung, str]] = Counter()
        self._curves: model_form.Curves = {}
        self._differences = model_form.Summary()
        # Impacts of bodies that are too dissimilar, and the largest coupling.
        self._coupled = 0, 0.0

    @checks.default_errors
    def solve(self, table: pd.DataFrame, skip_bad: bool = False) -> pd.DataFrame:
        """State after each impact of a table, as the function `solve`; bad rows may be left out.

        Parameters
        ----------
        table : DataFrame
        skip_bad : bool
            Leave bad rows out, and those without an answer, and keep them in `bad`.

        Returns
        -------
        DataFrame
        """
        if not isinstance(table, pd.DataFrame):
            raise InputError(
                f"table = {' '.join(reprlib.repr(table).split())}: allowed is a pandas DataFrame; "
                "`python -m planarimpact scene` reads files"
            )
        names = columns.named(table.columns)
        blocks = [
            self._block(table.iloc[start : start + BLOCK], names, skip_bad)
            for start in range(0, max(len(table), 1), BLOCK)
        ]
        return pd.concat(blocks) if len(blocks) > 1 else blocks[0]

    def report(self) -> Report:
        """What it did, for another solver to `join`.

        Returns
        -------
        Report
        """
        return Report(
            self.rows, self.bad, self.assumed, self._taken, self._differences, self._coupled
        )

    def join(self, other: Report) -> None:
        """Take in what a solver of other rows of the same table did.

        Parameters
        ----------
        other : Report
        """
        self.rows = max(self.rows, other.rows)
        self.bad += other.bad
        self.assumed |= other.assumed
        self._taken += other.taken
        self._differences.join(other.differences)
        self._count_coupled(*other.coupled)

    def explain(self) -> str:
        """How many impacts each model solved and why, in words, a line for each.

        Returns
        -------
        str
        """
        lines = [f"{self.rows - len(self.bad)} impacts, tolerance {self.tolerance:g}"]
        for (rung, pair), count in self._taken.most_common():
            lines.append(f"{count:>10}  {rung.name:<27}  {pair}: {rung.why}")
        count, largest = self._coupled
        if count:
            lines.append(
                f"the bodies spread differently under pressure, which no model here has: {count} "
                f"impacts may be off by more than 0.1 mu v2(0) (Dundurs' constant over friction up "
                f"to {largest:.2g}, allowed is {bodies.COUPLING:g})"
            )
        if self.assumed:
            lines.append(ASSUMED)
        return "\n".join(lines + self._differences.words())

    def _count_coupled(self, count: int, largest: float) -> None:
        self._coupled = self._coupled[0] + count, max(self._coupled[1], largest)

    def _block(self, table: pd.DataFrame, names: dict[str, str], skip_bad: bool) -> pd.DataFrame:
        self._refuse_two_losses(names)
        values, problems = columns.numbers(table, names)
        if "restitution" in names and "loss" not in names:
            code = columns.LOSSES.index(self._loss or LOSS)
            values["loss"] = np.full(len(table), float(code))
        good = np.ones(len(table), dtype=bool)
        good[list(problems)] = False
        impacts = self._impacts(values, good, problems)
        positions = np.flatnonzero(good)
        wrong = motion.problems(impacts)
        problems |= {int(positions[i]): words for i, words in wrong.items()}
        self._refuse(problems, skip_bad, InputError)
        if wrong:
            good[list(problems)] = False
            impacts = self._impacts(values, good, problems)
        result, unsolved = self._after(impacts, names)
        positions = np.flatnonzero(good)
        unsolved = {int(positions[i]): words for i, words in unsolved.items()}
        self._refuse(unsolved, skip_bad, ConvergenceError)
        problems |= unsolved
        self.bad += [
            (self.rows + position + 1, problems[position]) for position in sorted(problems)
        ]
        self.rows += len(table)
        found = table[good].assign(**result)
        return found[~np.isin(positions, list(unsolved))] if unsolved else found

    def _refuse_two_losses(self, names: dict[str, str]) -> None:
        for name in SAYS_LOSS:
            if self._loss is not None and name in names:
                raise InputError(
                    f"loss = {self._loss!r}: it does not apply, as the column {names[name]!r} says "
                    "what takes the energy"
                )

    def _impacts(
        self, values: dict[str, Array], good: Booleans, problems: dict[int, str]
    ) -> motion.Impacts:
        """Impacts of the good rows; those whose physical quantities are no numbers become bad."""
        while True:
            try:
                return motion.impacts({name: column[good] for name, column in values.items()})
            except bodies.OutOfRange as error:
                for position in np.flatnonzero(good)[error.where].tolist():
                    problems[position], good[position] = str(error), False

    def _refuse(
        self, problems: dict[int, str], skip_bad: bool, kind: type[InputError | ConvergenceError]
    ) -> None:
        """Refuse the first bad row, unless bad rows are skipped."""
        if problems and not skip_bad:
            first = min(problems)
            more = f"; {len(problems) - 1} more rows are bad" if len(problems) > 1 else ""
            raise kind(f"row {self.rows + first + 1}: {problems[first]}{more}")

    def _after(
        self, impacts: motion.Impacts, names: dict[str, str]
    ) -> tuple[dict[str, Any], dict[int, str]]:
        """Columns of the result, and what has none: `{position: words}`."""
        unit = impacts.friction * impacts.v2
        groups = impacts.mass_ratio, impacts.stiffness_ratio, impacts.restitution
        slides = motion.slides_throughout(impacts)
        head_on = ~slides & (impacts.v1 == 0)
        with np.errstate(over="ignore"):
            lost = sliding.change(impacts.mass_ratio, impacts.restitution) * unit
        unsolved: dict[int, str] = {}
        velocity = impacts.v1 - np.where(slides, lost, 0.0)
        peak, error, form = slides.astype(float), np.zeros(unit.size), np.zeros(unit.size)
        regime = np.where(slides, Regime.SLIP_THROUGHOUT, Regime.STICK).astype(np.uint8)
        model = np.where(slides, 0, 1)
        for rung, impact in ((choice.SLIDING, slides), (choice.HEAD_ON, head_on)):
            if impact.any():
                self._taken[rung, "all pairs"] += int(np.sum(impact))
        lossy = (groups[2] < 1) & (groups[2] >= continuum.LEAST_RESTITUTION)
        viscous = np.flatnonzero(slides & ~impacts.plastic & lossy)
        with np.errstate(over="ignore", divide="ignore", invalid="ignore"):
            x = impacts.v1[viscous] / unit[viscous]
        moved = model_form.of_sliding(x, *(group[viscous] for group in groups))
        form[viscous] = np.where(moved != 0, np.abs(moved) * unit[viscous], 0.0)
        stick = np.flatnonzero(~slides & ~head_on)
        coupled = impacts.coupling[stick][impacts.coupling[stick] > bodies.COUPLING]
        self._count_coupled(coupled.size, float(np.max(coupled, initial=0.0)))
        jobs = choice.jobs(
            *groups, impacts.plastic, stick, self.tolerance, self._responses, self._seen
        )
        for job in jobs:
            x = impacts.v1[job.rows] / unit[job.rows]
            rung, (found, known), left, without = self._answers(job, x)
            unsolved |= {int(job.rows[i]): words for i, words in without.items()}
            part = job.of(left)._replace(rung=rung)
            rows = part.rows
            velocity[rows] = found.velocity * unit[rows]
            peak[rows], regime[rows] = found.peak_friction, found.regime
            error[rows] = known * unit[rows]
            difference = model_form.difference(part, x[left], found.velocity, self._curves)
            form[rows] = np.abs(difference) * unit[rows]
            model[rows] = 2 + choice.MODELS.index(rung.model)
            self._taken[rung, job.pair] += rows.size
            if rung.model in choice.REFERENCES[1:]:
                self._differences.add(difference)
        # Peak normal forces depend on the loss, whatever model takes the tangential motion.
        unsaid = self._loss is None and not set(SAYS_LOSS) & set(names)
        self.assumed |= unsaid and bool((impacts.restitution < 1).any())
        found_columns = velocity, peak, error, form, regime, model
        return self._columns(impacts, names, *found_columns), unsolved

    def _answers(
        self, job: choice.Job, x: Array
    ) -> tuple[choice.Rung, tuple[Rebound, Numbers], Integers, dict[int, str]]:
        """The rung, results and errors, which impacts they belong to, and why others have none."""

        def solve(rung: choice.Rung, left: Integers) -> tuple[Rebound, Numbers]:
            beta, zeta2, e = job.of(left).groups
            return choice.solve(rung, x[left], beta, zeta2, e, self.tolerance, self._responses)

        rung = job.rung
        if rung.way == "compiled":
            every = np.arange(x.size)
            try:
                return rung, solve(rung, every), every, {}
            except ConvergenceError:  # some of its impacts may have an answer
                rung = rung._replace(way="solved")
        return rung, *choice.without_unsolved(partial(solve, rung), x.size)

    def _columns(
        self,
        impacts: motion.Impacts,
        names: dict[str, str],
        velocity: Array,
        peak: Array,
        error: Array,
        form: Array,
        regime: Integers,
        model: Integers,
    ) -> dict[str, Any]:
        body, other = motion.after(impacts, velocity)
        plane = "spin" in names
        states = motion.columns_of(body, plane)
        if {"other_density", "other_mass"} & set(names):
            states |= {f"other_{k}": v for k, v in motion.columns_of(other, plane).items()}
        after = {columns.header(name, "_after"): values for name, values in states.items()}
        # Without friction there is no incidence, with very little it is larger than any number.
        with np.errstate(divide="ignore", over="ignore", invalid="ignore"):
            incidence = impacts.v1 / (impacts.friction * impacts.v2)
        models = [choice.SLIDING.model, choice.HEAD_ON.model, *choice.MODELS]
        if "restitution" not in names:
            after |= {"restitution": impacts.restitution}
        if "loss" not in names:
            code = np.where(impacts.restitution < 1, impacts.plastic, -1)
            after |= {"loss": pd.Categorical.from_codes(code, columns.LOSSES)}
        return after | {
            "contact_velocity_after [m/s]": velocity,
            "model": pd.Categorical.from_codes(model, models),
            "error_bound [m/s]": error,
            "model_form [m/s]": form,
            "regime": pd.Categorical.from_codes(regime, list(Regime.__members__)),
            "incidence": incidence,
            "peak_normal_force [N]": impacts.peak_normal,
            # Without friction there is none, also where the normal force is not known.
            "peak_friction_force [N]": np.where(
                peak > 0, impacts.friction * peak * impacts.peak_normal, 0.0
            ),
            "energy_lost [J]": motion.energy_lost(impacts, velocity),
        }
