"""Put as src/sitecustomize.py into a project that is tried: Python reads it when a job starts.

It notes in imported/ what a job imports of this project. A file of the job's name in broken/ stops
the job, once: by a kill or a failure, before the job has done its work or behind it. Or the job
waits until that file is taken away.
"""

import atexit
import os
import re
import signal
import sys
import time
from pathlib import Path

PROJECT = Path(__file__).parents[1]


def _name():
    """The name of the log of this job, or of the job that started this kernel of a notebook."""
    script = Path(sys.orig_argv[-1])
    if script.parent.match(".snakemake/scripts"):
        log = re.search(rb"results/logs/([\w.-]+)\.log", script.read_bytes())
        os.environ["JOB_OF_TESTS"] = log[1].decode()
    return os.environ.get("JOB_OF_TESTS")


def _note(event, arguments):
    """Python tells of each code that it executes: the body of a module has its file's name."""
    path = Path(getattr(arguments[0], "co_filename", "")) if event == "exec" else Path()
    if path.is_relative_to(PROJECT / "src"):
        with open(PROJECT / "imported" / JOB, "a", encoding="utf-8") as file:
            file.write(f"{path.relative_to(PROJECT)}\n")


def _stop(how):
    if how == "killed":
        os.kill(os.getpid(), signal.SIGKILL)
    os._exit(1)


JOB = _name()
if JOB:
    (PROJECT / "imported").mkdir(exist_ok=True)
    (PROJECT / "imported" / JOB).touch()
    sys.addaudithook(_note)
    plan = PROJECT / "broken" / JOB
    if plan.exists():
        how, when = plan.read_text().split()
        while how == "waits" and plan.exists():
            time.sleep(0.05)
        plan.unlink(missing_ok=True)
        if when == "before":
            _stop(how)
        elif when == "behind":
            atexit.register(_stop, how)
