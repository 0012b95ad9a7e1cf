"""Fail if a row of the tables fails, or is missing."""

import sys

from stronge1994 import logs

logs.to(snakemake.log[0])

from stronge1994 import accepted, gate, tables, verdict_table

table = snakemake.input.get("ledger")
ledger = tables.read_rows(table) if table else []
verdicts = verdict_table.gather(snakemake.input.verdicts)
known = tables.read_rows(snakemake.input.accepted, accepted.COLUMNS)
entries = snakemake.params.get("entries", [])
faults = gate.faults(verdicts, ledger, snakemake.params.rows, entries, known)
unmade = gate.unmade(verdicts)
if faults or unmade:
    rows = f"{len(faults)} rows of the tables fail or are missing"
    others = f"{len(unmade)} comparisons cannot be made with these settings"
    sys.exit(f"{rows}, {others}: the end of the run names them")
