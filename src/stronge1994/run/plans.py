"""The plan of a job: its settings, and the hashes of the files of this repository that it reads.

A plan is a file and an input of its job, and it is written only where its content has changed. So
Snakemake runs a job again if its settings or sources have changed, whatever their dates are.
"""

import functools
import json
import re
import shutil
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from stronge1994.run import record

FOLDER = "results/plans"
GATE_LOG = "results/logs/all.log"
ALONE = "results/logs/judged_{}.log"  # of the gate of one figure or scene
# Options that only ask. One that is missing here would remove a verdict until the next run.
ONLY_ASKS = {"--dry-run", "--dryrun", "--lint", "--report", "--summary", "--detailed-summary"}
ONLY_ASKS |= {"--list-rules", "-l", "--list-target-rules", "--rulegraph", "--dag", "--filegraph"}
DRY = re.compile("-[npqFk]*n[npqFk]*")  # -n, also among other letters, as in -np


def path(job: str) -> str:
    """File with the plan of a job, or of all jobs of a rule if the name has a wildcard."""
    return f"{FOLDER}/{job}.json"


def write(job: str, sources: Iterable[str], settings: Any) -> None:
    """Write the plan of a job, if it has changed, and withdraw the verdict of an earlier run."""
    hashes = {source: _hash(source) for source in sorted(sources)}
    text = json.dumps({"settings": settings, "sources": hashes}, indent=1)
    file = Path(path(job))
    if not file.is_file() or file.read_bytes() != text.encode():
        withdraw()
        _remove_bytecode()
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")


_hash = functools.cache(record.fingerprint)  # most jobs have most sources


def digest(jobs: Iterable[str]) -> str:
    """One hash of the plans of all jobs."""
    return record.digest(path(job) for job in jobs)


@functools.cache  # once a run
def _remove_bytecode() -> None:
    """Remove compiled code: Python does not notice a changed source of the same size and date."""
    for folder in ("src", "workflow"):
        for cache in Path(folder).rglob("__pycache__"):
            shutil.rmtree(cache, ignore_errors=True)


def start(arguments: Iterable[str]) -> None:
    """Begin a run: withdraw an earlier verdict, and what failed, unless the command only asks."""
    options = [option.partition("=")[0] for option in arguments]
    asks = any(option in ONLY_ASKS or DRY.fullmatch(option) for option in options)
    # The one option that begins like a question and lets jobs run.
    if not asks or any(option.startswith("--report-") for option in options):
        withdraw()
        # Else another run is at work in this folder, and Snakemake will refuse this one.
        if not any(Path(".snakemake/locks").glob("*")):
            record.remove_failed()


def withdraw() -> None:
    """Remove the verdict of an earlier run, and the logs of its gates."""
    record.withdraw()
    for log in [Path(GATE_LOG), *Path(".").glob(ALONE.format("*"))]:
        log.unlink(missing_ok=True)
