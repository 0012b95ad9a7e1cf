"""What a run prints last: the tables that it made, whether it was judged, and what to do next."""

import logging
import re
import shlex
import shutil
from collections.abc import Collection, Iterable, Mapping, Sequence
from pathlib import Path
from typing import TypeAlias

from stronge1994 import csv_tables, gate
from stronge1994.csv_tables import Row
from stronge1994.judging import verdict_table
from stronge1994.ledger import outcome

# When a file was written, and its number in the file system; None where there is no file.
Mark: TypeAlias = tuple[int, int] | None

VERDICTS, LEDGER = gate.TABLES
GATE_LOG = "results/logs/gate.log"
REPORT = "figures/report.html"
# So many faults are named; the log has them all.
SHOWN = 8
NEXT = [
    f"Look:     {REPORT}, open it in a browser; everything above, with its reasons",
    "Play:     figures/explorer.html",
    "Change:   workflow/config.yaml, and run again: only what depends on it is redone",
]
STOPPED = [
    "What it said is above, and in results/logs/. Mend it and type the same command again:",
    "finished work is kept. workflow/README.md, Troubleshooting, has the usual causes.",
]
INTERRUPTED = (
    "Interrupted. Nothing needs mending: type the same command again, finished work is kept."
)
# What helps after Snakemake has said that the folder is locked.
UNLOCK = "Does no other run work here? Then type:  snakemake --unlock  and the same command again."
# Snakemake's own log says this after Ctrl-C, and after a job has failed.
ON_REQUEST = "Terminating processes on user request"
FAILED_JOB = re.compile(r"^Error in rule (\w+):", flags=re.M)


def add_unlock(record: logging.LogRecord) -> bool:
    """Put what helps behind Snakemake's error of a locked folder, and let every record pass."""
    if getattr(record, "exception", None) == "LockException":
        record.msg = f"{record.msg}\n{UNLOCK}"
    return True


def state() -> dict[str, Mark]:
    """Marks of the tables and of the gate's log, to see later whether this run has written them.

    Whether a file is newer than the start of the run would not do: a clock may be wrong, and a copy
    of a folder has new times.
    """
    return {path: _mark(path) for path in (VERDICTS, LEDGER, GATE_LOG)}


def start(known: Collection[str]) -> None:
    """Remove what would mislead: the verdict of an earlier run, and logs of jobs that are gone.

    Also Python's bytecode: Python takes a source of the same size and date for the same source.

    Parameters
    ----------
    known : collection of str
        Logs and benchmarks of all jobs that the workflow has now.
    """
    gate.drop_pass()
    for folder in ("src", "workflow"):
        for path in Path(folder).rglob("__pycache__"):
            shutil.rmtree(path, ignore_errors=True)
    Path(GATE_LOG).unlink(missing_ok=True)
    for folder in ("benchmarks", "logs"):
        for path in Path("results", folder).glob("*"):
            if path.is_file() and str(path) not in known:
                path.unlink()


def words(
    before: Mapping[str, Mark],
    config: Sequence[str] = (),
    stopped: bool = False,
    logs: Iterable[str] = (),
) -> str:
    """What a run prints last. Tables of an earlier run would mislead, so they are left out.

    Parameters
    ----------
    before : dict
        What `state` gave when the run began.
    config : sequence of str
        What the user gave with --config, to be repeated.
    stopped : bool, optional
        A job failed, or the run was interrupted.
    logs : sequence of str, optional
        Snakemake's logs of the run.
    """
    new = {path for path, mark in before.items() if _mark(path) not in (mark, None)}
    parts, failing = [], []
    if new & {VERDICTS, GATE_LOG}:
        rows = _rows(VERDICTS, verdict_table.COLUMNS)
        parts.append(verdict_table.text(rows))
        failing += [row["comparison"] for row in verdict_table.failing(rows)]
    if new & {LEDGER, GATE_LOG}:
        rows = _rows(LEDGER, ("verdict", "holds", "entry", "where", "problem"))
        parts.append(outcome.summary(rows))
        failing += [row["entry"] for row in outcome.failing(rows)]
    where = f"All columns: {VERDICTS}, {LEDGER}"
    if GATE_LOG in new and Path(gate.PASSED).exists():
        parts += [f"PASSED. {where}; pictures: figures/", *NEXT]
        if stopped:  # what was asked for beside the verdict
            parts += _stopped(logs)
    elif GATE_LOG in new:
        again = ["snakemake", "--cores", "2", "figures", *(["--config", *config] if config else [])]
        parts += [
            f"{where}. Why, row by row: {REPORT}, open it in a browser",
            f"On purpose? To draw without being judged:  {shlex.join(again)}",
            _failed(Path(GATE_LOG).read_text(encoding="utf-8").splitlines()),
        ]
    else:
        parts.append("No verdict in this run as a whole. Pictures: figures/")
        if stopped:
            parts += _stopped(logs)
        if failing:
            parts.append(_failed(f"diverges or no longer holds: {name}" for name in failing))
    return "\n" + "\n".join(parts) + "\n"


def _failed(faults: Iterable[str]) -> str:
    """Heading of a failed run, and its first faults."""
    faults = list(faults)
    shown = [f"  {fault}" for fault in faults[:SHOWN]]
    if len(faults) > SHOWN:
        shown.append(f"  and {len(faults) - SHOWN} more: {GATE_LOG}")
    return "\n".join([f"FAILED. Reasons: {len(faults)}", *shown])


def _rows(path: str, columns: Iterable[str]) -> list[Row]:
    """Rows of a table; none if it cannot be read, which the gate has said."""
    try:
        return csv_tables.read_rows(path, columns)
    except (OSError, ValueError):
        return []


def _stopped(logs: Iterable[str]) -> list[str]:
    """Why a run ended early."""
    said = "".join(Path(log).read_text(encoding="utf-8", errors="replace") for log in logs)
    if ON_REQUEST in said:
        return [INTERRUPTED]
    names = ", ".join(dict.fromkeys(FAILED_JOB.findall(said)))
    return [f"A job stopped: {names or 'see above'}.", *STOPPED]


def _mark(path: str) -> Mark:
    """Changes whenever a file is written anew; None where there is none."""
    try:
        stat = Path(path).stat()
    except OSError:
        return None
    return stat.st_mtime_ns, stat.st_ino
