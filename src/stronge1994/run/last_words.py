"""What a run prints last: its verdicts, whether it passed, and what to do next."""

import logging
import re
import shlex
from collections.abc import Iterable, Sequence
from pathlib import Path

from stronge1994 import csv_tables, verdict_table
from stronge1994.csv_tables import Row
from stronge1994.ledger import outcome
from stronge1994.run.gate import REPORT, TABLES
from stronge1994.run.plans import GATE_LOG
from stronge1994.run.record import PASSED

# Number of faults that are named; the log has them all.
MOST_FAULTS = 8
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
# Help after Snakemake has reported that the folder is locked.
UNLOCK = "Does no other run work here? Then type:  snakemake --unlock  and the same command again."
# Snakemake's own log says this after Ctrl-C, and after a job has failed.
ON_REQUEST = "Terminating processes on user request"
FAILED_JOB = re.compile(r"^Error in rule (\w+):", flags=re.M)
JUDGED = re.compile(r"Comparing (\w+) with references$", flags=re.M)


def add_unlock(record: logging.LogRecord) -> bool:
    """Put what helps behind Snakemake's error of a locked folder, and let every record pass."""
    if getattr(record, "exception", None) == "LockException":
        record.msg = f"{record.msg}\n{UNLOCK}"
    return True


def text(config: Sequence[str] = (), stopped: bool = False, logs: Iterable[str] = ()) -> str:
    """The last lines of a run. The gate's log holds its faults, and exists only if it has judged.

    `config` is the user's --config, to be repeated. `stopped` says that a job failed, or that the
    run was interrupted; Snakemake's `logs` tell which, and what was judged.
    """
    log_text = "".join(Path(log).read_text(encoding="utf-8", errors="replace") for log in logs)
    passed, path = Path(PASSED).exists(), Path(GATE_LOG)
    gate_log = path.read_text(encoding="utf-8") if path.exists() else ""
    faults = [line for line in gate_log.splitlines() if line]
    # The gate has not run, was stopped, or other jobs came after it.
    if not (faults or (passed and path.exists())):
        made = [f"results/verdicts/{name}.csv" for name in JUDGED.findall(log_text)]
        verdicts = ", ".join(path for path in made if Path(path).exists())
        parts = ["No verdict in this run as a whole. Pictures: figures/"]
        parts += [f"Verdicts: {verdicts}"] if verdicts else []
        return "\n" + "\n".join(parts + (_stopped(log_text) if stopped else [])) + "\n"
    parts = [
        verdict_table.text(_rows(TABLES[0], verdict_table.COLUMNS)),
        outcome.summary(_rows(TABLES[1], ("verdict", "holds", "entry", "where", "problem"))),
    ]
    where = f"All columns: {', '.join(TABLES)}"
    if not faults:
        parts += [f"PASSED. {where}; pictures: figures/", *NEXT]
        if stopped:  # a job beside the verdict
            parts += _stopped(log_text)
    else:
        again = ["snakemake", "--cores", "2", "figures", *(["--config", *config] if config else [])]
        parts += [
            f"{where}. Why, row by row: {REPORT}, open it in a browser",
            f"On purpose? To draw without being judged:  {shlex.join(again)}",
            _failed(faults),
        ]
    return "\n" + "\n".join(parts) + "\n"


def _failed(faults: Sequence[str]) -> str:
    """Heading of a failed run, and its first faults."""
    lines = [f"  {fault}" for fault in faults[:MOST_FAULTS]]
    if len(faults) > MOST_FAULTS:
        lines.append(f"  and {len(faults) - MOST_FAULTS} more: {GATE_LOG}")
    return "\n".join([f"FAILED. Reasons: {len(faults)}", *lines])


def _rows(path: str, columns: Iterable[str]) -> list[Row]:
    """Rows of a table; none if it cannot be read, which the gate has said."""
    try:
        return csv_tables.read_rows(path, columns)
    except (OSError, ValueError):
        return []


def _stopped(log_text: str) -> list[str]:
    """Why a run ended early."""
    if ON_REQUEST in log_text:
        return [INTERRUPTED]
    names = ", ".join(dict.fromkeys(FAILED_JOB.findall(log_text)))
    return [f"A job stopped: {names or 'see above'}.", *STOPPED]
