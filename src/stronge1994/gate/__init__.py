"""Is a run good? Its tables must say so, no row may be missing, and all files must be whole."""

import csv
import hashlib
import json
import shutil
import zipfile
import zlib
from collections import Counter
from collections.abc import Collection, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

from stronge1994 import csv_tables, records
from stronge1994.csv_tables import Row
from stronge1994.judging import verdict_table
from stronge1994.records import HOW_TO_MEND

PASSED = "results/PASSED"
TABLES = ("results/verdicts.csv", "results/ledger.csv")
# Tables that may be empty: a figure may have no points, and a good report has no problems.
MAY_HAVE_NO_ROWS = {"residuals", "sensitivity", "problems"}


def faults(
    tables: tuple[str, str],
    residuals: Iterable[str],
    page: str,
    problems: str,
    made: Sequence[str],
    comparisons: Mapping[str, bool],
    entries: Mapping[str, bool],
) -> list[str]:
    """Why the run must not pass, one line for each fault.

    Parameters
    ----------
    tables : (str, str)
        results/verdicts.csv and results/ledger.csv.
    residuals, made : list of str
        Tables of residuals; every file that the run makes, these tables among them.
    page, problems : str
        The report, and the table of what it could not show.
    comparisons, entries : dict
        As `faults_of_tables`.

    Returns
    -------
    list of str
    """
    found = faults_of_files(made)
    if found:  # rows of a damaged table cannot be counted
        return found
    verdicts, ledger = map(csv_tables.read_rows, tables)
    found = faults_of_tables(verdicts, ledger, comparisons, entries)
    found += [f"report: {row['problem']}" for row in csv_tables.read_rows(problems)]
    found += faults_of_report(page, comparisons)
    found = found or faults_of_residuals(verdicts, residuals)
    return found or records.faults(made)


def faults_of_tables(
    verdicts: Sequence[Row],
    ledger: Sequence[Row],
    comparisons: Mapping[str, bool],
    entries: Mapping[str, bool],
) -> list[str]:
    """Why a run must not pass, by its tables, one line for each fault.

    Parameters
    ----------
    verdicts, ledger : list of dict
        Rows of results/verdicts.csv and results/ledger.csv.
    comparisons : dict
        `{name: is its reference awaited}` of every row that the first must have.
    entries : dict
        `{name: has it a check}` of every row that the second must have.

    Returns
    -------
    list of str

    Examples
    --------
    >>> row = {"comparison": "fig6-rebound", "verdict": "agrees"}
    >>> faults_of_tables([row], [], {"fig6-rebound": False, "fig6-printed": False}, {})
    ['results/verdicts.csv: 0 rows of fig6-printed where 1 belongs: remove that file and run again']
    """
    found = _miscounted(TABLES[0], "comparison", verdicts, comparisons)
    found += _miscounted(TABLES[1], "entry", ledger, entries)
    for row in verdicts:
        name, verdict = row.get("comparison", ""), row.get("verdict")
        if verdict == "diverges":
            found.append(f"diverges: {name}: {verdict_table.why(row)}")
        elif verdict not in verdict_table.ORDER or (verdict == "awaited") != comparisons.get(name):
            found.append(f"{TABLES[0]}: {name} = {verdict!r} cannot be: {HOW_TO_MEND}")
    for row in ledger:
        name, holds = row.get("entry", ""), row.get("holds")
        if holds == "no":
            found.append(f"no longer holds: {name}: {row.get('problem')}")
        elif holds != ("yes" if entries.get(name) else ""):
            found.append(f"{TABLES[1]}: {name}, holds = {holds!r} cannot be: {HOW_TO_MEND}")
    return found


def _miscounted(
    table: str, column: str, rows: Iterable[Row], expected: Collection[str]
) -> list[str]:
    names = [row.get(column) for row in rows]
    return [
        f"{table}: {names.count(name)} rows of {name} where {int(name in expected)} belongs: "
        f"{HOW_TO_MEND}"
        for name in dict.fromkeys([*expected, *names])
        if names.count(name) != (name in expected)
    ]


def faults_of_residuals(verdicts: Sequence[Row], paths: Iterable[str]) -> list[str]:
    """Tables of residuals without the points on which verdicts rest, one line for each."""
    counts: Counter[str] = Counter()
    for path in paths:
        for row in csv_tables.read_rows(path):
            counts[row.get("comparison", "")] += 1
    return [
        f"results/residuals/{row['figure']}.csv: {counts[row['comparison']]} points of "
        f"{row['comparison']} where {row['points']} belong: {HOW_TO_MEND}"
        for row in verdicts
        if int(row.get("points") or 0) != counts[row["comparison"]]
    ]


def faults_of_report(page: str, comparisons: Mapping[str, bool]) -> list[str]:
    """Comparisons that the report does not show, one line for each."""
    text = Path(page).read_text(encoding="utf-8")
    return [
        f"{page}: it does not show {name}" for name in comparisons if f'id="{name}"' not in text
    ]


def faults_of_files(paths: Iterable[str]) -> list[str]:
    """Files that are missing, empty or cut, one line for each.

    Parameters
    ----------
    paths : iterable of str
        Tables, pictures, pages, notebooks and arrays, which their endings tell apart. What has no
        ending is a folder of pages.
    """
    found = []
    for path in paths:
        try:
            flaw = _LOOK[Path(path).suffix](Path(path))
        except _UNREADABLE as error:
            flaw = f"{error}" or type(error).__name__
        if flaw:
            found.append(f"{path}: not whole ({flaw}): {HOW_TO_MEND}")
    return found


_UNREADABLE = OSError, ValueError, SyntaxError, csv.Error, zipfile.BadZipFile, zlib.error


def _table(path: Path) -> str:
    with open(path, newline="", encoding="utf-8") as file:
        header, *rows = list(csv.reader(file)) or [[]]
    ragged = [number for number, row in enumerate(rows, 2) if len(row) != len(header)]
    if not header or not path.read_bytes().endswith(b"\n"):
        return "it ends too early"
    if not rows and not {path.stem, path.parent.name} & MAY_HAVE_NO_ROWS:
        return "no rows"
    return f"line {ragged[0]} is not as wide as the header" if ragged else ""


def _vector_picture(path: Path) -> str:
    return "" if ElementTree.parse(path).getroot().tag.endswith("svg") else "no SVG"


def _raster_picture(path: Path) -> str:
    data = path.read_bytes()
    whole = data.startswith(b"\x89PNG\r\n\x1a\n") and data.endswith(b"IEND\xaeB`\x82")
    return "" if whole else "no whole PNG"


def _page(path: Path) -> str:
    return "" if path.read_bytes().rstrip().endswith(b"</html>") else "it ends too early"


def _folder(path: Path) -> str:
    cut = [page.name for page in path.rglob("*.html") if _page(page)]
    if not any(path.iterdir()):
        return "no pages"
    return f"{cut[0]} ends too early" if cut else ""


def _notebook(path: Path) -> str:
    return "" if json.loads(path.read_bytes()).get("cells") else "no cells"


def _arrays(path: Path) -> str:
    with zipfile.ZipFile(path) as file:
        return file.testzip() or ""


_LOOK = {
    ".csv": _table,
    ".svg": _vector_picture,
    ".png": _raster_picture,
    ".html": _page,
    ".ipynb": _notebook,
    "": _folder,
    ".npz": _arrays,
}


def words_of_pass(made: Sequence[str], config: Mapping[str, Any]) -> str:
    """What results/PASSED says: fingerprints of the run that it belongs to.

    Parameters
    ----------
    made : sequence of str
        Every file that a run makes.
    config : dict
        As the run has it, with what the command line changed.
    """
    physics = hashlib.sha256(json.dumps(config, sort_keys=True).encode()).hexdigest()
    return (
        "no comparison diverges, every entry of the ledger holds\n"
        f"config  {physics}\n"
        f"sources {records.fingerprint_of_all(records.files_of_repository())}\n"
        f"made    {records.fingerprint_of_all(made)}\n"
    )


def drop_false_pass(made: Sequence[str], config: Mapping[str, Any]) -> None:
    """Remove a results/PASSED that the gate did not write for what is there now."""
    try:
        if Path(PASSED).read_text(encoding="utf-8") == words_of_pass(made, config):
            return
    except (OSError, ValueError):
        pass
    drop_pass()


def drop_pass() -> None:
    """Remove results/PASSED, whatever it is."""
    if Path(PASSED).is_dir() and not Path(PASSED).is_symlink():
        shutil.rmtree(PASSED)
    Path(PASSED).unlink(missing_ok=True)


def refuse_unknown_results(made: Sequence[str]) -> None:
    """Refuse results of which Snakemake has no records: it would not notice a change.

    Raises
    ------
    RuntimeError
        If files of a run are there without what Snakemake keeps of it, as in a copy of a folder
        that left hidden files out.
    """
    unknown = records.unknown(made)
    if unknown:
        more = f" (and {len(unknown) - 1} more files)" if len(unknown) > 1 else ""
        raise RuntimeError(
            f"{unknown[0]}{more}: there, but how it was made is not known; remove it, or all of "
            "results/ and the pictures and pages in figures/, and run again"
        )
