"""A job of the toy: it may be told, once, to wait, to fail or to kill itself on its way."""

import os
import signal
import sys
import time
from pathlib import Path

from stronge1994.run import record

from stronge1994 import csv_tables

JOB = Path(snakemake.log[0]).stem


def stop(moment):
    plan = Path(f"{JOB}.{moment}")
    if plan.exists():
        Path(f"{JOB}.reached").touch()
        how = plan.read_text()
        while how == "wait" and plan.exists():
            time.sleep(0.01)
        plan.unlink(missing_ok=True)
        if how == "kill":
            os.kill(os.getpid(), signal.SIGKILL)
        if how == "fail":
            sys.exit(1)


stop("before")
with record.recorded(snakemake) as settings:
    made = snakemake.output
    if JOB == "curves":
        sys.path.insert(0, ".")
        import law

        value = law.law(float(Path("data.csv").read_text()), settings)
        Path(made.table).write_text(f"curve\n{value}\n")
    elif JOB == "draw":
        text = csv_tables.read_rows(snakemake.input.curves)[0]["curve"]
        Path(made.picture).write_text(f"<svg>{text}</svg>\n")
    else:
        right = float(csv_tables.read_rows(snakemake.input.curves)[0]["curve"]) < 10
        verdict = "agrees" if right else "diverges"
        Path(made.verdicts).write_text(
            f"comparison,verdict,note,found,p,points,allowed,regression\nrow,{verdict},,,,,,\n"
        )
        Path(made.ledger).write_text("entry,holds,verdict\n")
        Path(made.problems).write_text("problem\n")
        Path(made.report).write_text('<html id="row"></html>\n')
    stop("within")
stop("behind")
