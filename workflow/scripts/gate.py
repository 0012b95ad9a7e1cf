"""The gate, the last job of every run: do all files belong together, and does no row fail?

The gate of one figure asks this of its files alone, and says nothing of the run as a whole.
"""

import json
import sys
from pathlib import Path

from stronge1994.run import gate, plans, record

with record.log_to(snakemake.log[0]):
    record.withdraw()
    expected = json.loads(Path(snakemake.input.plan).read_text(encoding="utf-8"))["settings"]
    alone = "table" in expected
    judge = gate.faults_of_one if alone else gate.faults
    messages = judge(snakemake.input.made, **expected)
    if plans.digest(snakemake.params.jobs) != snakemake.params.plans:
        messages = [f"{plans.FOLDER}: another command has changed the plans of this run: run again"]
    print("\n".join(messages))
    if not messages and not alone:
        text = "no comparison fails, every entry of the ledger holds\n"
        Path(record.PASSED).write_text(text, encoding="utf-8")
sys.exit(bool(messages))
