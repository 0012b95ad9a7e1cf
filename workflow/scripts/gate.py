"""The gate: pass only if every row is there and none fails, and all that was made is whole.

It runs last, so a failure loses nothing.
"""

import sys
from pathlib import Path

from stronge1994 import gate, job

with job.log_to(snakemake.log[0]):
    given, wanted = snakemake.input, snakemake.params
    found = gate.faults(
        (given.verdicts, given.ledger),
        given.residuals,
        given.page,
        given.problems,
        given.made,
        wanted.comparisons,
        wanted.entries,
    )
    print("\n".join(found))
    if not found:
        words = gate.words_of_pass(given.made, wanted.config)
        Path(snakemake.output[0]).write_text(words, encoding="utf-8")
sys.exit(bool(found))
