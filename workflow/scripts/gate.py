"""Say what a run has found, and fail if it is not what somebody has accepted."""

import sys
from pathlib import Path

from stronge1994 import logs

logs.to(snakemake.log[0])

from stronge1994 import accepted, gate, ledger_table, tables, verdict_table

given, asked = snakemake.input, snakemake.params
verdicts = verdict_table.gather(given.verdicts)
ledger = tables.read_rows(given.ledger, ledger_table.COLUMNS) if asked.entries else []
known = accepted.read(given.accepted)
faults = gate.faults(verdicts, ledger, asked.rows, asked.entries, known)
new = accepted.new(verdicts, known)
told = gate.summary(verdicts, ledger, faults, asked.shows, asked.grades, new)
print(told)
if faults or gate.unmade(verdicts):
    sys.exit(1)
Path(snakemake.output[0]).write_text(told, encoding="utf-8")
