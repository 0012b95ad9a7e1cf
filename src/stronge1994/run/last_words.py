"""What a run prints last: its verdicts, whether it passed, and what to do next."""

import logging
import shlex
import textwrap
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

from stronge1994 import csv_tables
from stronge1994.csv_tables import Row
from stronge1994.ledger import outcome
from stronge1994.run import record
from stronge1994.run.gate import REPORT, TABLES
from stronge1994.run.plans import ALONE, GATE_LOG
from stronge1994.run.record import PASSED
from stronge1994.verdict_tables import figure_table, verdict_table

# Number of faults that are named; the log has them all.
MOST_FAULTS = 8
NEXT = [
    f"Look:     {REPORT}, open it in a browser: the table above, with reasons",
    "Play:     figures/explorer.html",
    "Change:   workflow/config.yaml, and run again: only what depends on it is redone",
]
STOPPED = [
    "What it said is above, and in results/logs/. Mend it and type the same command again:",
    "finished work is kept. workflow/README.md, Troubleshooting, has the usual causes.",
]
KNOWN = (
    "Solved right: our own check only; largest difference in the axis' unit, and in sigmas,\n"
    "of which 1 is allowed. Beside others: the paper's model. A run also fails if one of the\n"
    f"{{}} known differences changes: {REPORT}#known has cause, size and bound of each."
)
INTERRUPTED = (
    "Interrupted. Nothing needs mending: type the same command again, finished work is kept."
)
WITHOUT = "On purpose? To draw without being judged:  "
# Help after Snakemake has reported that the folder is locked.
UNLOCK = "Does no other run work here? Then type:  snakemake --unlock  and the same command again."
# Snakemake's own log says one of these after Ctrl-C and SIGTERM.
ON_REQUEST = "Terminating processes on user request", "Will exit after finishing currently"


class Help(logging.Filter):
    """Put what helps behind some errors of Snakemake, and let every record pass."""

    def __init__(self, targets: Iterable[str]) -> None:
        super().__init__()
        names = textwrap.fill(", ".join(targets), 96, initial_indent="  ", subsequent_indent="  ")
        self.by_error = {
            "LockException": UNLOCK,
            "MissingRuleException": f"Targets are\n{names}\nor any file that one of them makes.",
        }

    def filter(self, record: logging.LogRecord) -> bool:
        """Add a line to a record that is one of these errors."""
        if help := self.by_error.get(getattr(record, "exception", None) or ""):
            record.msg = f"{record.msg}\n{help}"
        return True


def text(config: Sequence[str] = (), stopped: bool = False, logs: Iterable[str] = ()) -> str:
    """The last lines of a run. A gate that has judged leaves a log with its faults.

    `config` is the user's --config, to be repeated. `stopped` says that a job failed, or that the
    run was interrupted; Snakemake's `logs` tell which, and what was judged.
    """
    log_text = "".join(Path(log).read_text(encoding="utf-8", errors="replace") for log in logs)
    again = shlex.join(["snakemake", "--cores", "2", "figures", *_option(config)])
    faults = _faults(GATE_LOG)
    # A gate has not run, was stopped, or other jobs came after it.
    if faults or (faults is not None and Path(PASSED).exists()):
        parts = _of_all(faults, again)
        stopped = stopped and not faults  # by a job beside the verdict
    elif alone := list(_judged_alone()):
        parts = [part for name, faults in alone for part in _of_one(name, faults, again)]
        stopped = stopped and not any(faults for _, faults in alone)
    else:
        parts = ["No verdict in this run as a whole. Pictures: figures/"]
        judged = [job for job in record.ended() if job.startswith("judge_")]
        parts += [part for job in judged for part in _of_table(job.removeprefix("judge_"), config)]
        parts += record.all_errors()
    return "\n" + "\n".join(parts + (_stopped(log_text) if stopped else [])) + "\n"


def _option(config: Sequence[str]) -> list[str]:
    return ["--config", *config] if config else []


def _faults(log: str) -> list[str] | None:
    """Faults in the log of a gate; None if it has not judged."""
    path = Path(log)
    if not path.exists():
        return None
    return [line for line in path.read_text(encoding="utf-8").splitlines() if line]


def _judged_alone() -> Iterator[tuple[str, list[str]]]:
    """Figures and scenes that were targets of the run, with their faults."""
    before, after = Path(ALONE).name.split("{}")
    for log in sorted(Path(ALONE).parent.glob(f"{before}*{after}")):
        yield log.name.removeprefix(before).removesuffix(after), _faults(str(log)) or []


def _of_all(faults: Sequence[str], again: str) -> list[str]:
    """The verdict of a whole run."""
    rows = _rows(TABLES[0], verdict_table.COLUMNS)
    known = sum(row["verdict"] in verdict_table.DIFFERENCES for row in rows)
    try:
        table = figure_table.text(figure_table.of_run(rows))
    except ValueError as error:  # the table of verdicts was edited, which the gate has said
        table = f"{TABLES[0]}: {error}"
    parts = [
        table,
        f"\n{verdict_table.counts(rows)}",
        KNOWN.format(known),
        outcome.summary(_rows(TABLES[1], ("verdict", "holds", "entry", "where", "problem"))),
    ]
    where = f"Each comparison: {', '.join(TABLES)}"
    if not faults:
        return [*parts, f"PASSED. {where}; pictures: figures/", *NEXT]
    why = f"{where}. Why, row by row: {REPORT}, open it in a browser"
    return [*parts, why, f"{WITHOUT}{again}", _failed(faults, GATE_LOG)]


def _of_one(name: str, faults: Sequence[str], again: str) -> list[str]:
    """The verdict of one figure or scene."""
    table = f"results/verdicts/{name}.csv"
    parts = [verdict_table.text(_rows(table, verdict_table.COLUMNS)), f"All columns: {table}"]
    if faults:
        why = _failed(faults, ALONE.format(name))
        return [*parts, f"{WITHOUT}{again}", f"{name}: {why}"]
    return [*parts, f"{name}: no comparison fails. The verdict of all: snakemake --cores 2"]


def _of_table(name: str, config: Sequence[str]) -> Iterator[str]:
    """A table of verdicts that was made without a gate."""
    table = f"results/verdicts/{name}.csv"
    if Path(table).exists():  # else its job was stopped
        rows = _rows(table, verdict_table.COLUMNS)
        number = sum(row["verdict"] in verdict_table.FAILS for row in rows)
        judge = shlex.join(["snakemake", "--cores", "2", name, *_option(config)])
        yield f"{table}: {number} fail. To judge it:  {judge}"


def _failed(faults: Sequence[str], log: str) -> str:
    """Heading of a failed run, and its first faults; `log` has all of them."""
    lines = [f"  {fault}" for fault in faults[:MOST_FAULTS]]
    if len(faults) > MOST_FAULTS:
        lines.append(f"  and {len(faults) - MOST_FAULTS} more: {log}")
    return "\n".join([f"FAILED. Reasons: {len(faults)}", *lines])


def _rows(path: str, columns: Iterable[str]) -> list[Row]:
    """Rows of a table; none if it cannot be read, which the gate has said."""
    try:
        return csv_tables.read_rows(path, columns)
    except (OSError, ValueError, csv_tables.Failed):
        return []


def _stopped(log_text: str) -> list[str]:
    """Why a run ended early."""
    if any(words in log_text for words in ON_REQUEST):
        return [INTERRUPTED]
    jobs = [job for job in record.ended() if job.startswith(record.STOPPED)]
    names = ", ".join(job.removeprefix(record.STOPPED) for job in jobs)
    return [f"A job stopped: {names or 'see above'}.", *STOPPED]
