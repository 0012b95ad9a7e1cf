"""Scenes: tables of impacts, one in each row, each solved as `planarimpact.collide` solves it.

`solve` takes and returns a pandas DataFrame, `solve_file` goes from file to file. `COLUMNS` are
those that a table may have, with the unit of each in its header, and `RESULT` those that are added.
A body is a solid sphere (radius and density), or anything with a mass, a radius of gyration and a
centre of mass on the contact normal. The other body is the same; if it has no mass, it is a wall of
infinite mass, flat unless it has a radius, and at rest unless it has a velocity or a spin.

A plane state stands in the plane of x (tangential) and z (normal): its normal velocity is positive
towards the surface and its spin, positive where it moves the contact point forward, turns about -y.
In space the spin is the right-handed vector of angular velocity.
"""

from __future__ import annotations

import csv
import difflib
import gzip
import os
import re
import warnings
import zlib
from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from contextlib import ExitStack, suppress
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from planarimpact import bodies
from planarimpact.bodies import Body, Material
from planarimpact.collision import RESTITUTION_FROM, TOLERANCE, Pair, mechanics, methods
from planarimpact.collision.facts import cautions, model_forms
from planarimpact.collision.mechanics import Impacts, State
from planarimpact.common import checks, files
from planarimpact.common.arrays import Array, Booleans, Integers
from planarimpact.common.cautions import Caution
from planarimpact.common.checks import LARGEST, LEAST, ConvergenceError, InputError
from planarimpact.common.losses import CODES, SPHERES, VISCOUS
from planarimpact.common.results import Regime

if TYPE_CHECKING:  # only who solves tables needs pandas
    import pandas as pd

__all__ = ["COLUMNS", "HELP", "RESULT", "Report", "header", "solve", "solve_file"]

LOSSES = tuple(SPHERES)
LAWS = [name for name, loss in RESTITUTION_FROM.items() if loss]  # they have a loss of their own
AXES = "xyz"
KINDS = CSV, GZIP, PARQUET = ".csv", ".csv.gz", ".parquet"
# Rows that are read and solved together. More take more memory, and no less time for each.
CHUNK = 2**15
# The column that is carried over without a word; other unknown ones are told.
LABEL = "id"
# A name as similar as this to one that is known is a misspelling.
CLOSE = 0.8
# Names of cautions by their sums.
CAUTIONS = ["none", *(str(Caution(code).name) for code in range(1, sum(Caution) + 1))]
# Of cells for which there is no header; headers have no line breaks.
MORE = "\n"
POINT = "; commas separate cells, and decimals have a point"


class Column(NamedTuple):
    """A column: unit, meaning, the text of what is allowed, and the range of its numbers."""

    unit: str
    meaning: str = ""
    allowed: str = "finite numbers"
    low: float = -LARGEST
    high: float = LARGEST


_above = partial(Column, allowed="finite numbers above 0", low=LEAST)
_from_0 = partial(Column, allowed="finite numbers from 0", low=0)
BODY = {
    "radius": _above("m", "distance from centre to contact point"),
    "density": _above("kg/m^3", "of a solid sphere; or else mass and gyration"),
    "mass": _above("kg"),
    "gyration": _above("m", "radius of gyration"),
    "young_modulus": _above("Pa"),
    "poisson_ratio": Column("", "", "numbers above -1, up to 0.5", np.nextafter(-1, 0), 0.5),
}
# Numbers of the other body may be infinite, but for its density and Poisson's ratio.
OTHER = {f"other_{name}": column for name, column in BODY.items()} | {
    f"other_{name}": Column(BODY[name].unit, "", "numbers above 0, or inf", LEAST, np.inf)
    for name in ("radius", "mass", "gyration", "young_modulus")
}
PAIR = {
    "friction": _from_0("", "coefficient of friction"),
    "restitution": Column("", "or else one of the next two", "numbers from 0 to 1", 0, 1),
    "relaxation_time": _from_0("s", "of viscous bodies: e by the speed"),
    "yield_pressure": _above("Pa", "the largest in the contact: e by the speed"),
    "loss": Column("", "what takes the energy; may be empty at e = 1", ", ".join(LOSSES)),
}
PLANE = {
    "velocity_tangential": Column("m/s"),
    "velocity_normal": Column("m/s", "positive towards the surface"),
    "spin": Column("rad/s", "positive if it moves the contact point forward"),
}
SPACE = {f"velocity_{axis}": Column("m/s") for axis in AXES}
SPACE |= {f"spin_{axis}": Column("rad/s") for axis in AXES}
NORMAL = {f"normal_{axis}": Column("", "from the surface to the body") for axis in AXES}
STATES = PLANE | SPACE | {f"other_{name}": column for name, column in (PLANE | SPACE).items()}
COLUMNS = BODY | OTHER | PAIR | STATES | NORMAL


class Solved(NamedTuple):
    """Impacts of a table and their answers: what the columns of `RESULT` are computed from."""

    impacts: Impacts
    peak_normal: Array  # [N]
    answers: methods.Answers
    form: Array  # [m/s]
    caution: Integers  # codes of `Caution`


class Result(NamedTuple):
    """A column of the result: unit, meaning, and the function that computes it."""

    unit: str
    meaning: str
    function: Callable[[Solved], Any]
    allowed: str = ""


def _words(codes: Any, words: Iterable[str]) -> Any:
    """Words by their places, -1 where there is none: a column of few words takes little memory."""
    import pandas as pd

    return pd.Categorical.from_codes(codes, list(words))


def _model(solved: Solved) -> Any:
    models = list(dict.fromkeys(method.model for method in methods.METHODS))
    places = np.array([models.index(method.model) for method in methods.METHODS])
    return _words(places[solved.answers.place], models)


def _peak_friction(solved: Solved) -> Array:
    """Without friction there is no force of it, also where the normal force is not known."""
    unit, peak = solved.impacts.unit, solved.answers.peak_friction
    force = unit / solved.impacts.v2 * peak * solved.peak_normal
    return np.where(peak * unit > 0, force, 0.0)


# In addition to the states after, and restitution and loss, where a table does not have them.
RESULT = {
    "contact_velocity_after": Result(
        "m/s", "of the contact point, in the direction of incidence", lambda s: s.answers.velocity
    ),
    "model": Result("", "which one solved the impact", _model),
    "error_bound": Result(
        "m/s",
        "of that velocity, against the continuum: tested, not proved",
        lambda s: s.answers.error,
    ),
    "model_form": Result(
        "m/s",
        "how far that velocity would move with the other loss, to about 0.01 mu v2(0); NaN where "
        "that is not known",
        lambda s: s.form,
    ),
    "regime": Result(
        "", "the order of stick and slip", lambda s: _words(s.answers.regime, Regime.__members__)
    ),
    "incidence": Result(
        "",
        "tangential over normal speed of the contact point, over friction; inf without friction",
        lambda s: s.impacts.incidence_of(np.arange(s.form.size)),
    ),
    "peak_normal_force": Result(
        "N", "by the loss; NaN where restitution is below 0.022", lambda s: s.peak_normal
    ),
    "peak_friction_force": Result("N", "", _peak_friction),
    "energy_lost": Result(
        "J", "", lambda s: sum(mechanics.energies_lost(s.impacts, s.answers.change))
    ),
    "caution": Result(
        "",
        "why the answer may not hold: --explain has the words",
        lambda s: _words(s.caution, CAUTIONS),
    ),
}


def header(name: str, ending: str = "") -> str:
    """Header of a column: its name, and an ending, with the unit in brackets if it has one.

    Examples
    --------
    >>> header("radius"), header("friction")
    ('radius [m]', 'friction')
    """
    unit = COLUMNS[name].unit if name in COLUMNS else RESULT[name].unit
    return f"{name}{ending} [{unit}]" if unit else name + ending


ADDED = {header(name, "_after") for name in STATES} | set(map(header, RESULT))


def _text(names: Iterable[str]) -> str:
    """Headers of columns, in their order."""
    return ", ".join(header(name) for name in COLUMNS if name in names)


def _lines(columns: dict[str, Any]) -> str:
    """A line of help for each column: header, meaning, and what is allowed."""
    meanings = {n: "; ".join(filter(None, [c.meaning, c.allowed])) for n, c in columns.items()}
    return "\n".join(f"  {header(n):<28}  {meaning}".rstrip() for n, meaning in meanings.items())


HELP = f"""\
Columns, with units in the header, separated by commas; the order is free. Row 1 is the first one
below the header; blank lines do not count. Needed are a body,
{_lines(BODY)}
the pair of bodies,
{_lines(PAIR)}
and the state before, in a plane,
{_lines(PLANE)}
or in space, for bodies that turn alike about every axis. The normal has the length 1; left out it
is 0, 0, 1. Then, with x along the surface and z up, a plane state has spin_y = -spin.
{_lines(SPACE | NORMAL)}
The other body has the same columns with other_ in front, and velocities and spins in the same
directions. Its radius, mass, gyration and Young's modulus may be inf. Without a material it is
rigid; without a mass it is a wall, round if it has other_radius; without a velocity it is at rest.
Columns of other names, such as id, are your own, and carried over: from CSV as text. A name that
is nearly one of those above is refused, and so is one below. Contacts that stick at some time need
a restitution of 0.1 or more; with restitution 0 a plastic contact always sticks at some time.
The result has all these columns and then the state after, named as before with _after,
restitution and loss, if they are not given, and
{_lines(RESULT)}
Example:
  radius [m],density [kg/m^3],young_modulus [Pa],poisson_ratio,friction,restitution,loss,\
velocity_tangential [m/s],velocity_normal [m/s],spin [rad/s]
  0.01,7800,207e9,0.3,0.2,0.8,plastic,0.5,1,0
"""


def solve(
    table: pd.DataFrame, tolerance: float = TOLERANCE, loss: str | None = None
) -> pd.DataFrame:
    """Solve every impact of a table, by a formula, the table of spheres or the continuum.

    Parameters
    ----------
    table : DataFrame
        One impact a row; `python -m planarimpact scene --help` lists the columns. Other columns,
        whose names are not similar to these, are carried over. A table without rows has an empty
        result.
    tolerance : float
        As in `planarimpact.collide`; it is also that of the peak friction, in mu times the peak
        normal force. Elastic pairs reach some 1e-8, others 1e-5. How far a continuum is from nature
        is not part of it; `model_form` is a first measure of that.
    loss : str, optional
        "viscous" or "plastic", as in a `Pair`, where restitution is below 1. A table may have a
        column of this name instead, with empty cells where restitution is 1, or a column
        relaxation_time or yield_pressure.

    Returns
    -------
    DataFrame
        `table` with its index and columns, and then: the state after, named as before with
        `_after`; restitution and loss, where the table does not have them; and the columns of
        `RESULT`, which says what they are.

    Raises
    ------
    InputError
        For what is no DataFrame, wrong columns, or a bad row, by its number from 1, such as one
        below restitution 1 without a loss.
    ConvergenceError
        If the continuum does not reach the tolerance, by the row. It takes milliseconds an impact,
        at mass ratios of hundreds up to seconds; above some 10 000 most impacts end like this.
    ImportError
        If pandas is not there; it says what to install.

    Examples
    --------
    >>> import pandas as pd
    >>> table = pd.DataFrame(
    ...     {
    ...         "radius [m]": [0.01, 0.01],
    ...         "density [kg/m^3]": 7800.0,
    ...         "young_modulus [Pa]": 207e9,
    ...         "poisson_ratio": 0.3,
    ...         "friction": 0.2,
    ...         "restitution": 0.8,
    ...         "velocity_tangential [m/s]": [0.5, 3.0],
    ...         "velocity_normal [m/s]": 1.0,
    ...         "spin [rad/s]": 0.0,
    ...     }
    ... )
    >>> after = solve(table, loss="plastic")
    >>> after[["velocity_tangential_after [m/s]", "regime"]].values.tolist()[1]
    [2.64, 'SLIP_THROUGHOUT']
    """
    pd = _packages()
    if not isinstance(table, pd.DataFrame):
        module, name = type(table).__module__.partition(".")[0], type(table).__name__
        kind = name if module == "builtins" else f"{module}.{name}"
        raise InputError(
            f"table = {kind}: allowed is a pandas DataFrame; "
            "`python -m planarimpact scene` reads files"
        )
    report = Report(tolerance, loss)
    blocks = [report._solved(*part, skip_bad=False) for part in _slices(table, CHUNK)]
    return pd.concat(blocks) if len(blocks) > 1 else blocks[0]


class Report:
    """What became of the rows of a table; `solve_file` makes it.

    Attributes
    ----------
    rows : int
        Rows that were read.
    bad : list of (int, str)
        Rows left out, and why. Row 1 is the first one.
    own : list of str
        Columns that are not known and were carried over, but for `id`.
    """

    def __init__(self, tolerance: float = TOLERANCE, loss: str | None = None) -> None:
        allowed = "numbers from 1e-10 to 1"
        self.tolerance = checks.number("tolerance", tolerance, allowed, 1e-10, 1)
        self._loss = loss if loss is None else checks.loss(loss, LOSSES)
        self.rows = 0
        self.bad: list[tuple[int, str]] = []
        self.own: list[str] = []
        self._counts: Counter[int] = Counter()  # by place in `methods.METHODS`
        self._cautions: Counter[Caution] = Counter()
        # Of continua: the differences to the other loss, mu v2(0).
        self._form = [np.zeros(0)]

    def explain(self) -> str:
        """Text: how many impacts each model solved and why, what cautions there are, and more."""
        lines = [f"{self.rows - len(self.bad)} impacts, tolerance {self.tolerance:g}"]
        for place, count in self._counts.most_common():
            method = methods.METHODS[place]
            lines.append(f"{count:>10}  {method.name:<27}  {method.why}")
        lines += [
            f"{count:>10}  caution {caution.name}: {caution.text}"
            for caution, count in sorted(self._cautions.items())
        ]
        form = np.concatenate(self._form)
        if form.size:
            known = form[np.isfinite(form)]
            typical = (np.sum(known**2) / max(known.size, 1)) ** 0.5
            more = f", not known for {form.size - known.size}" if known.size < form.size else ""
            lines.append(
                f"with the other loss the velocity would differ by {typical:.2g} mu v2(0) (root "
                f"mean square), {known.max(initial=0):.2g} at most: {form.size} impacts{more}"
            )
        return "\n".join(lines)

    @checks.default_errors
    def _solved(
        self, table: pd.DataFrame, problems: dict[int, str], skip_bad: bool
    ) -> pd.DataFrame:
        """The next part of a table, solved; `problems` of its rows are known by their positions."""
        names = _named(table.columns)
        given = next((names[n] for n in ("loss", *LAWS) if n in names), None)
        if self._loss is not None and given:
            raise InputError(f"loss = '{self._loss}': it does not apply, column '{given}' gives it")
        self.own = [ascii(text) for text in table if text not in {*names.values(), LABEL}]
        values = _numbers(table, names, self._loss, problems)
        impacts, peak_normal, good = _impacts(values, problems)
        self._refuse(problems, skip_bad, InputError)
        answers = methods.answers(impacts, self.tolerance, peaks=True)
        unsolved = {int(good[i]): message for i, message in answers.unsolved.items()}
        self._refuse(unsolved, skip_bad, ConvergenceError)
        form = model_forms(impacts, answers.place, answers.velocity)
        codes = cautions(impacts, answers.place, answers.regime)
        solved = Solved(impacts, peak_normal, answers, form, codes)
        result = table.iloc[good].assign(**_after(solved, names))
        has_answer = np.ones(good.size, dtype=bool)
        has_answer[[*answers.unsolved]] = False
        self._count(solved, has_answer)
        problems |= unsolved
        self.bad += [(self.rows + row + 1, problems[row]) for row in sorted(problems)]
        self.rows += len(table)
        return result[has_answer] if unsolved else result

    def _refuse(
        self, problems: dict[int, str], skip_bad: bool, kind: type[InputError | ConvergenceError]
    ) -> None:
        """Refuse the first bad row, unless bad rows are skipped."""
        if problems and not skip_bad:
            first = min(problems)
            more = f"; {len(problems) - 1} more rows are bad" if len(problems) > 1 else ""
            raise kind(f"row {self.rows + first + 1}: {problems[first]}{more}")

    def _count(self, solved: Solved, has_answer: Booleans) -> None:
        """Remember what `explain` says."""
        place = solved.answers.place
        self._counts.update(place[has_answer].tolist())
        continuum = methods.IS_CONTINUUM[place]
        for caution in Caution:
            count = np.count_nonzero(has_answer & ((solved.caution & caution) > 0))
            self._cautions += Counter({caution: count})
        lossy = continuum & has_answer & (solved.impacts.loss_code >= 0)
        self._form.append(solved.form[lossy] / solved.impacts.unit[lossy])


def solve_file(
    source: str | Path,
    target: str | Path,
    tolerance: float = TOLERANCE,
    loss: str | None = None,
    skip_bad: bool = False,
    chunk: int = CHUNK,
) -> Report:
    """Solve the table of one file into another, which appears whole or not at all.

    Parameters
    ----------
    source, target : str or Path
        Tables as `solve` takes and returns them: `.csv`, `.csv.gz` or `.parquet` by the ending of
        the name. NaN is an empty cell in CSV. Columns that are not known are carried over, from CSV
        as text.
    tolerance, loss : float, str
        As in `solve`.
    skip_bad : bool
        Leave bad rows out instead of refusing the table. They are in `bad` of the result, and in a
        file next to the target, `<its name>.bad.csv`, which is written also if no row is bad.
    chunk : int
        Rows of CSV that are in the memory at one time. Parquet is there as a whole.

    Returns
    -------
    Report
        With `rows`, `bad`, `own` and `explain()`.

    Raises
    ------
    InputError, ConvergenceError, ImportError
        As `solve`, or if a file is no table or has no rows; Parquet needs pyarrow, too.
    OSError
        If a file cannot be read or written.

    Examples
    --------
    >>> import tempfile
    >>> folder = Path(tempfile.mkdtemp())
    >>> _ = (folder / "in.csv").write_text(HELP.split("Example:")[1].replace("  ", "").strip())
    >>> report = solve_file(folder / "in.csv", folder / "out.csv")
    >>> report.rows, report.bad, (folder / "out.csv").read_text()[:10]
    (1, [], 'radius [m]')
    """
    source, target = os.fspath(source), os.fspath(target)
    for path in (source, target):
        if not path.lower().endswith(KINDS):
            shown = checks.in_ascii(path)
            raise InputError(f"{shown}: allowed are names that end in {', '.join(KINDS)}")
    _packages(parquet=any(path.lower().endswith(PARQUET) for path in (source, target)))
    report = Report(tolerance, loss)
    chunk = checks.count("chunk", chunk, 1)
    written = [target, f"{target}.bad.csv"] if skip_bad else [target]
    for path in written:
        if os.path.exists(path) and os.path.samefile(path, source):
            raise InputError(f"{path}: it is the table that is read; the result needs another name")

    def solved() -> Iterator[pd.DataFrame]:
        for table, problems in _parts(source, chunk):
            after = report._solved(table, problems, skip_bad)
            numbers = [text for name, text in _named(table.columns).items() if name != "loss"]
            # A column has one type in all parts, whatever a part has in it.
            yield after.astype(dict.fromkeys(numbers, float))
        if not report.rows:
            raise InputError("it has a header, but no rows")

    with ExitStack() as stack:
        partial, *lists = [stack.enter_context(files.written(path)) for path in written]
        try:
            _write(solved(), partial, target.lower())
        except InputError as error:
            raise InputError(f"{checks.in_ascii(source)}: {error}") from None
        for list_of_bad in lists:  # also an empty one: an old list is not about the new result
            with open(list_of_bad, "w", encoding="utf-8", newline="") as file:
                csv.writer(file, lineterminator="\n").writerows([("row", "problem"), *report.bad])
    return report


def _packages(parquet: bool = False) -> Any:
    """pandas; for Parquet it needs pyarrow."""
    try:
        import pandas as pd

        if parquet:
            import pyarrow.parquet  # noqa: F401
    except ImportError as error:
        extra = "parquet" if parquet else "scene"
        words = f"planarimpact.scene needs {error.name}: pip install 'planarimpact[{extra}]'"
        raise ImportError(words, name=error.name) from None
    return pd


def _slices(table: pd.DataFrame, chunk: int) -> Iterator[tuple[pd.DataFrame, dict[int, str]]]:
    for start in range(0, max(len(table), 1), chunk):
        yield table.iloc[start : start + chunk], {}


def _parts(source: str, chunk: int) -> Iterator[tuple[pd.DataFrame, dict[int, str]]]:
    """Parts of a table, and `{position: message}` of rows that have another number of cells."""
    pd, names = _packages(), list[str]()
    with open(source, "rb") as file:
        try:
            if source.lower().endswith(PARQUET):
                yield from _slices(pd.read_parquet(file), chunk)
                return
            given: dict[str, Any] = {"header": None, "keep_default_na": False}
            given["compression"] = "gzip" if source.lower().endswith(GZIP) else None
            cells = pd.read_csv(file, nrows=1, dtype=str, **given).iloc[0].tolist()
            if len(cells) == 1 and {";", "\t"} & {*cells[0]}:
                raise InputError(f"the header is one cell{POINT}")
            names = [" ".join(cell.split()) for cell in cells]
            own = set(names) - {text for name, text in _named(names).items() if name != "loss"}
            file.seek(0)
            # A column more than there are: only in rows with too many cells it has one.
            reader = pd.read_csv(
                file,
                names=[*names, MORE],
                skiprows=1,
                dtype=dict.fromkeys(own, str),
                na_values={MORE: [""]},
                index_col=False,
                low_memory=False,
                chunksize=chunk,
                **given,
            )
            while True:
                with warnings.catch_warnings():  # of a cell that is lost
                    warnings.simplefilter("error", pd.errors.ParserWarning)
                    part = next(reader, None)
                if part is None:
                    return
                wide = np.flatnonzero(part.pop(MORE).notna()).tolist()
                said = f"{len(names) + 1} cells where {len(names)} belong{POINT}"
                yield part, dict.fromkeys(wide, said)
        except InputError:
            raise
        except (ValueError, Warning, EOFError, zlib.error, OSError) as error:
            if isinstance(error, OSError) and error.errno:
                raise
            raise InputError(_said(error, len(names))) from None


def _said(error: Exception, cells: int) -> str:
    """What pandas says of a file that is no table, in one line."""
    if found := re.search(r"Expected \d+ fields in line (\d+), saw (\d+)", str(error)):
        return f"line {found[1]}: {found[2]} cells where {cells} belong{POINT}"
    if isinstance(error, Warning):
        return f"a row has more than the {cells} cells of the header{POINT}"
    words, *_ = str(error).splitlines() or [type(error).__name__]
    hint = "; save the file as UTF-8" if isinstance(error, UnicodeError) else ""
    return checks.in_ascii(words.removeprefix("Error tokenizing data. C error: ")) + hint


def _write(parts: Iterator[pd.DataFrame], path: Path, kind: str) -> None:
    """Write the parts of a table to a file of this kind."""
    import pandas as pd

    if kind.endswith(PARQUET):
        pd.concat([*parts]).to_parquet(path, index=False)
        return
    opener: Any = gzip.open if kind.endswith(GZIP) else open
    with opener(path, "wb") as file:
        plain = {"index": False, "lineterminator": "\n"}
        for number, part in enumerate(parts):
            if not number:
                part[:0].to_csv(file, **plain)
            try:  # Arrow is not needed, but writes text in a tenth of the time
                import pyarrow as pa
                import pyarrow.csv

                rows = pa.Table.from_pandas(part, preserve_index=False)
                pyarrow.csv.write_csv(rows, file, pyarrow.csv.WriteOptions(include_header=False))
            except (ImportError, ValueError, TypeError, NotImplementedError):  # or what it lacks
                part.to_csv(file, header=False, **plain)


def _named(headers: Iterable[object]) -> dict[str, str]:
    """`{name: header}` of the columns that are known.

    Refused are those that do not make up bodies and a state, that are there twice, that misspell a
    known one, or that the result has. Others are for the user alone.
    """
    header_of: dict[str, str] = {}
    others: list[str] = []
    for text in map(str, headers):
        name, bracket, unit = (part.strip() for part in text.partition("["))
        column = COLUMNS.get(name)
        if column and bracket + unit not in ([f"[{column.unit}]"] if column.unit else ["", "[1]"]):
            allowed = f"is [{column.unit}]" if column.unit else "is none: it is a number"
            raise InputError(f"column {text!a}: the unit of {name} {allowed}")
        if name in header_of or text in others:
            raise InputError(f"column {text!a} is there twice")
        if column:
            header_of[name] = text
            continue
        if text.strip() in ADDED:
            raise InputError(f"column {text!a}: the result has a column of this name; rename it")
        for close in difflib.get_close_matches(name.lower(), COLUMNS, n=1, cutoff=CLOSE):
            meant = f"did you mean '{header(close)}'? If it is your own, rename it"
            raise InputError(f"column {text!a}: unknown; {meant}")
        others.append(text)
    try:
        _refuse_incomplete(set(header_of))
    except InputError as error:
        unknown = ", ".join(ascii(text) for text in others if text != LABEL)
        raise InputError(f"{error}; unknown is {unknown}" if unknown else str(error)) from None
    return header_of


def _refuse_incomplete(names: set[str]) -> None:
    """Refuse a table whose columns do not make up bodies, a pair and a state."""
    needed = {"radius", "young_modulus", "poisson_ratio", "friction"}
    of_other = names & set(OTHER)
    material = {"other_young_modulus", "other_poisson_ratio"}
    whos = ["", "other_"] if of_other - material - {"other_radius"} else [""]
    for who in whos:
        single, several = f"{who}density", {f"{who}mass", f"{who}gyration"}
        if (single in names) == bool(names & several):
            raise InputError(f"columns: needed are either {header(single)} or {_text(several)}")
        needed |= {f"{who}radius"} | (several if names & several else set())
    laws = names & set(RESTITUTION_FROM)
    if len(laws) != 1:
        said = f" {_text(laws)}" if laws else ""
        raise InputError(f"columns{said}: needed is exactly one of {_text(RESTITUTION_FROM)}")
    if "loss" in names and "restitution" not in names:
        (law,) = laws
        only = f"as {header(law)} is always {RESTITUTION_FROM[law]}"
        raise InputError(f"column loss: allowed only with restitution, {only}")
    in_space = {name for name in (*STATES, *NORMAL) if name.removeprefix("other_") not in PLANE}
    plane, space = names & set(STATES) - in_space, names & in_space
    if plane and space:
        both = f"columns {_text(plane)} and {_text(space)}"
        raise InputError(f"{both}: states have two dimensions or three")
    needed |= set(SPACE if space else PLANE)
    groups = [material, set(NORMAL)]  # all of a group, or none
    for quantity in ("velocity", "spin"):  # what is left out is 0
        kind = f"other_{quantity}"
        groups.append({n for n in STATES if n.startswith(kind) and (n in in_space) == bool(space)})
    for group in groups:
        needed |= group if names & group else set()
    if needed - names:
        raise InputError(f"columns {_text(needed - names)}: missing")


def _numbers(
    table: pd.DataFrame, names: dict[str, str], loss: str | None, problems: dict[int, str]
) -> dict[str, Any]:
    """Columns of a table as float64 by name; what is wrong with rows is added to `problems`.

    Of several problems of a row the first one counts. Losses are words, empty where a row has none;
    `loss` is that of all rows of a table without the column.
    """
    values: dict[str, Any] = {}
    known = dict.fromkeys(checks.NO_LOSS, "") | {word: word for word in LOSSES}
    for name, text in names.items():
        column, cells = COLUMNS[name], table[text]
        if checks.has_unit(cells):
            raise InputError(f"column {text!a} {checks.UNIT}")
        if name == "loss":
            words = [known.get(str(cell).strip(), "?") for cell in cells.to_numpy(dtype=object)]
            values[name] = np.array(words, dtype=str)
            wrong = values[name] == "?"
        else:
            x = values[name] = _floats(cells)
            most = min(column.high, LARGEST)
            wrong = ~((x >= column.low) & ((x <= most) | (x == column.high)))
        for row in np.flatnonzero(wrong).tolist():
            cell = cells.iloc[row]
            shown = checks.brief(cell) if isinstance(cell, str) else checks.in_ascii(str(cell))
            number = np.nan if name == "loss" else values[name][row]
            bounds = column.low, min(column.high, LARGEST)
            said = checks.refusal(text, number, column.allowed, *bounds, shown)
            if checks.has_unit(cell):
                said = f"{text} = {shown} {checks.UNIT}"
            problems.setdefault(row, said + (POINT if "," in shown else ""))
    inertia = ("other_density", "other_mass", "other_gyration")
    moves = np.any([np.isfinite(values[name]) for name in inertia if name in values], axis=0)
    for row in np.flatnonzero(np.isinf(values.get("other_radius", 0.0)) & moves).tolist():
        allowed = "allowed are finite numbers where the other body can move or turn"
        problems.setdefault(row, f"{names['other_radius']} = inf: {allowed}")
    if "restitution" in names:
        values.setdefault("loss", np.full(len(table), loss or ""))
        for row in np.flatnonzero((values["restitution"] < 1) & (values["loss"] == "")).tolist():
            problems.setdefault(
                row,
                f"restitution = {values['restitution'][row]:g}: below 1 it needs a loss, "
                f"from a column loss or the argument loss (--loss): choose {', '.join(LOSSES)}",
            )
    return values


def _floats(cells: pd.Series) -> Array:
    """Numbers of a column; NaN where there is none, or one that is too large for float64.

    Text is a number in plain digits, and only the text inf is infinite.
    """
    from pandas.api import types

    is_number = types.is_integer_dtype(cells) or types.is_float_dtype(cells)
    if is_number and getattr(cells.dtype, "itemsize", 16) <= 8:
        return cells.to_numpy(dtype=float, na_value=np.nan)
    values = np.full(len(cells), np.nan)  # of words, long or sparse numbers, or other objects
    for row, cell in enumerate(cells):
        text, kind = str(cell), isinstance(cell, (bool, np.bool_, complex))
        if kind or checks.has_unit(cell) or "_" in text or not text.isascii():
            continue
        with suppress(TypeError, ValueError, OverflowError):
            values[row] = float(cell)
        if np.isinf(values[row]) and "inf" not in text.lower():
            values[row] = np.nan
    return values


def _impacts(values: dict[str, Any], problems: dict[int, str]) -> tuple[Impacts, Array, Integers]:
    """Impacts of rows without problems, peak normal forces, and positions of the rows.

    Problems of impacts are added to the others.
    """
    while True:
        good = np.delete(np.arange(values["radius"].size), list(problems))
        try:
            columns = {name: column[good] for name, column in values.items()}
            impacts, peak = _of_good(columns)
            found = mechanics.problems(impacts) | mechanics.problems_of_normals(impacts.normal)
        except bodies.OutOfRange as error:
            found = error.messages
        if not found:
            return impacts, peak, good
        problems |= {int(good[i]): message for i, message in found.items()}


def _of_good(values: dict[str, Any]) -> tuple[Impacts, Array]:
    """Impacts and peak normal forces; OutOfRange is that of `mechanics.impacts`."""
    zero = np.zeros(values["radius"].size)

    def body(who: str) -> Body:
        """A body; the other one is a wall of infinite mass where it has no mass."""
        radius = values.get(f"{who}radius", zero)
        if f"{who}density" in values:
            return bodies.solid_sphere(radius, density=values[f"{who}density"])
        mass, gyration = (
            values.get(f"{who}{name}", zero + np.inf) for name in ("mass", "gyration")
        )
        # The radius of a body that can neither move nor turn may be infinite: it is flat.
        return Body(mass, gyration, np.where(np.isinf(radius), 0.0, radius))

    def state(who: str) -> State:
        """A state; what is left out is 0."""
        if {f"{who}velocity_x", f"{who}spin_x"} & set(values):
            parts = [values.get(f"{who}{name}", zero) for name in SPACE]
            return State(np.stack(parts[:3]), np.stack(parts[3:]))
        along, towards, spin = (values.get(f"{who}{name}", zero) for name in PLANE)
        return State(np.stack([along, zero, -towards]), np.stack([zero, -spin, zero]))

    materials = [Material(values["young_modulus"], values["poisson_ratio"])]
    if "other_young_modulus" in values:
        # A rigid counterbody adds no compliance. The largest modulus of all has the same effect.
        young = np.minimum(values["other_young_modulus"], LARGEST)
        materials.append(Material(young, values["other_poisson_ratio"]))
    law = {name: values[name] for name in (*RESTITUTION_FROM, "loss") if name in values}
    pair = Pair(*materials, friction=values["friction"], **law)
    up = np.stack([values.get(f"normal_{axis}", zero + (axis == "z")) for axis in AXES])
    one, other = body(""), body("other_")
    impacts = mechanics.impacts(pair, up, one, state(""), other, state("other_"))
    radius = bodies.radius_of_two(one.radius, other.radius)
    return impacts, _peak_normal(impacts, pair.effective_modulus, radius)


def _peak_normal(impacts: Impacts, modulus: Array, radius: Array) -> Array:
    """Largest normal force by the law of the loss [N].

    Both laws have one from `bodies.LEAST_RESTITUTION` on. Below it they are NaN: a viscous one
    grows without a bound as e approaches 0, and a plastic one falls to 0.
    """
    known = impacts.restitution >= bodies.LEAST_RESTITUTION
    speed = np.where(impacts.v2 > 0, impacts.v2, 1.0)  # others are refused later
    peak = np.full(speed.size, np.nan)
    code = np.where(impacts.loss_code < 0, CODES[VISCOUS], impacts.loss_code)  # at e = 1 any
    for loss in SPHERES.values():
        which = known & (code == CODES[loss])
        if which.any():
            # All impacts are computed, so that a refusal has the index of its row.
            e = np.where(which, impacts.restitution, 1.0)
            force = bodies.peak_force(impacts.m2, radius, modulus, speed, e, loss.name)
            peak = np.where(which, force, peak)
    return peak


def _after(solved: Solved, names: dict[str, str]) -> dict[str, Any]:
    """The columns that are added to those of a table, by their headers."""
    impacts, result = solved.impacts, dict[str, Any]()
    body, other, _ = mechanics.after(impacts, solved.answers.change)
    states = {"": body}
    if {"other_density", "other_mass"} & set(names):
        states["other_"] = other
    for who, (velocity, spin) in states.items():
        plane = dict(zip(PLANE, (velocity[0], -velocity[2], -spin[1]), strict=True))
        columns = plane if "spin" in names else dict(zip(SPACE, [*velocity, *spin], strict=True))
        result |= {header(f"{who}{name}", "_after"): v for name, v in columns.items()}
    if "restitution" not in names:
        result["restitution"] = impacts.restitution
    if "loss" not in names:
        result["loss"] = _words(impacts.loss_code, LOSSES)
    return result | {header(name): column.function(solved) for name, column in RESULT.items()}
