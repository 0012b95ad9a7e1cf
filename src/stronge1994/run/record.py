"""The record of a job: hashes of all that it read and of all that it wrote, and its log."""

import contextlib
import hashlib
import json
import shutil
import sys
import time
import traceback
from collections.abc import Iterable, Iterator, Mapping
from functools import cache
from pathlib import Path
from typing import Any

FOLDER = "results/records"
PASSED = "results/PASSED"
# The jobs of this run: their number, and the name of each that has ended, or `stopped` and it.
JOBS = "results/logs/jobs.txt"
STOPPED = "stopped "
SRC = Path(__file__).parents[2]
MACHINE = (OSError, MemoryError)  # errors without which the same command may work


def withdraw() -> None:
    """Remove the verdict of an earlier run."""
    Path(PASSED).unlink(missing_ok=True)


def path(job: str) -> str:
    """File with the record of a job."""
    return f"{FOLDER}/{job}.json"


def fingerprint(path: str | Path) -> str:
    """Hash of the content of a file or a folder."""
    if Path(path).is_dir():
        # Snakemake puts a file of its own into a folder that a job has made.
        return digest(str(p) for p in Path(path).rglob("*") if p.is_file() and p.name[0] != ".")
    with open(path, "rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def digest(paths: Iterable[str]) -> str:
    """One hash of many files, and of their names."""
    lines = "".join(f"{fingerprint(path)} {path}\n" for path in sorted(paths))
    return hashlib.sha256(lines.encode()).hexdigest()


def begin(number: int) -> None:
    """Begin the list of the jobs of this run, of which there are a `number`."""
    Path(JOBS).parent.mkdir(parents=True, exist_ok=True)
    Path(JOBS).write_text(f"{number}\n", encoding="utf-8")


def ended() -> list[str]:
    """Names of the jobs of this run that have ended; before those that stopped, `stopped`."""
    return Path(JOBS).read_text(encoding="utf-8").splitlines()[1:] if Path(JOBS).exists() else []


def _place(entry: str) -> str:
    """Add to the list of jobs, and give the place, `7 of 60`; empty if no run began the list."""
    if not Path(JOBS).exists():
        return ""
    with open(JOBS, "a+", encoding="utf-8") as file:
        file.write(f"{entry}\n")
        file.flush()
        file.seek(0)
        number, *entries = file.read().splitlines()
    return f"{len(entries):>{len(number)}} of {number}"


@contextlib.contextmanager
def log_to(log: str) -> Iterator[None]:
    """Send output and errors of a block to a log file. An error ends the process with one line."""
    terminal = sys.stderr
    with open(log, "w", encoding="utf-8") as file:
        try:
            with contextlib.redirect_stdout(file), contextlib.redirect_stderr(file):
                yield
        except Exception as error:
            traceback.print_exc(file=file)
            _place(f"{STOPPED}{Path(log).stem}")
            print(f"{type(error).__name__}: {error} (log: {log})", file=terminal)
            sys.exit(1)


@contextlib.contextmanager
def recorded(snakemake: Any) -> Iterator[Any]:
    """Do a job of Snakemake by its plan, log it, and record what it read and wrote.

    Yields the settings of the plan. `snakemake.input.plan` and `snakemake.output.record` are files.
    If the job raises an error, within its imports too, the record holds it, and each file that it
    has not written says it: the rest of the run goes on, and the gate fails. An error of the
    machine, such as a full disk, stops the job.

    It is an error if an input or a source was edited since the run began, because then the record
    is wrong, or if the job imports a module that its plan does not name.
    """
    # Another run may have passed meanwhile; its verdict does not hold for this job.
    withdraw()
    began = time.monotonic()
    job = Path(snakemake.output.record).stem
    with log_to(snakemake.log[0]):
        plan = json.loads(Path(snakemake.input.plan).read_text(encoding="utf-8"))
        _refuse_edited(plan["sources"])
        read = plan["sources"] | {path: fingerprint(path) for path in snakemake.input}
        outputs = set(snakemake.output) - {snakemake.output.record}
        outcome: dict[str, str] = {}
        try:
            yield plan["settings"]
        except Exception as error:
            if isinstance(error, MACHINE) and not isinstance(error, FileNotFoundError):
                raise
            outcome = _failed(error, job, outputs)
        _refuse_edited(read)
        unnamed = sorted(_imported() - set(read))
        if unnamed:
            raise RuntimeError(f"{job} imports {unnamed[0]}, which its rule does not plan for")
        wrote = {path: fingerprint(path) for path in sorted(outputs)}
        seconds = round(time.monotonic() - began, 2)
        text = json.dumps({"seconds": seconds, "read": read, "wrote": wrote} | outcome, indent=1)
        Path(snakemake.output.record).write_text(text, encoding="utf-8")
    said = f", failed: {next(iter(outcome.values()))} (log: {snakemake.log[0]})" if outcome else ""
    print(f"{_place(job)}  {job}  {seconds:.1f} s{said}", flush=True)


def _failed(error: Exception, job: str, outputs: Iterable[str]) -> dict[str, str]:
    """Entry of a record: an `error` of the job itself, or one that it `inherited` by a table."""
    from stronge1994 import csv_tables  # needs numpy
    from stronge1994.run import failures

    traceback.print_exc()
    inherited = isinstance(error, csv_tables.Failed)
    words = " ".join(f"{error}".split())  # a fault is one line
    why = words if inherited else f"{job}: {type(error).__name__}: {words}"
    for path in outputs:
        if not Path(path).exists():
            failures.write(path, why)
    return {"inherited" if inherited else "error": why}


def _refuse_edited(hashes: Mapping[str, str]) -> None:
    for path, before in hashes.items():
        if not Path(path).exists() or fingerprint(path) != before:
            raise RuntimeError(f"{path} was edited after the run began: run again")


def _imported() -> set[str]:
    """Modules of this project that this process has imported, from the top folder."""
    files = (getattr(module, "__file__", None) for module in list(sys.modules.values()))
    paths = (Path(file) for file in files if file)
    return {str(path.relative_to(SRC.parent)) for path in paths if path.is_relative_to(SRC)}


def read(path: str) -> dict[str, Any] | None:
    """A record; None if it is missing or damaged."""
    try:
        content = json.loads(Path(path).read_text(encoding="utf-8"))
        return content if {"seconds", "read", "wrote"} <= set(content) else None
    except (OSError, ValueError, TypeError):
        return None


def errors(made: Iterable[str]) -> list[str]:
    """Errors of the jobs whose records are among the files `made`, each told once."""
    return [
        f"failed: {record['error']} (log: results/logs/{Path(path).stem}.log)"
        for path, record in _failed_jobs(made)
        if "error" in record
    ]


def all_errors() -> list[str]:
    """Errors of all jobs of this run."""
    return errors(_every())


def remove_failed() -> None:
    """Remove what jobs that failed have left, so that this run does them again."""
    for path, record in _failed_jobs(_every()):
        for made in [*record["wrote"], path]:
            if Path(made).is_dir():
                shutil.rmtree(made)
            else:
                Path(made).unlink(missing_ok=True)


def _every() -> list[str]:
    return sorted(str(path) for path in Path(FOLDER).glob("*.json"))


def _failed_jobs(made: Iterable[str]) -> Iterator[tuple[str, dict[str, Any]]]:
    """Records of jobs that failed, themselves or by a table that they read."""
    for path in made:
        record = read(path) if path.startswith(f"{FOLDER}/") else None
        if record and {"error", "inherited"} & set(record):
            yield path, record


def faults(made: Iterable[str]) -> list[str]:
    """Faults of the files `made`: not as their job wrote them, or made from other inputs."""
    made = list(made)
    records = [path for path in made if path.startswith(f"{FOLDER}/")]
    messages, wrote = [], set(records)

    @cache
    def now(path: str) -> str | None:
        return fingerprint(path) if Path(path).exists() else None

    for path in records:
        mend = f"remove {path} and run again"
        record = read(path)
        if record is None:
            messages.append(f"{path}: no record of its job: {mend}")
            continue
        wrote |= set(record["wrote"])
        changed = [file for file, before in record["wrote"].items() if now(file) != before]
        messages += [f"{file}: not as its job left it: {mend}" for file in changed]
        other = [file for file, before in record["read"].items() if now(file) != before]
        messages += [f"{Path(path).stem}: made from another {file}: {mend}" for file in other[:1]]
    return messages + [
        f"{path}: no job has recorded it: remove {FOLDER} and run again"
        for path in made
        if path not in wrote
    ]
