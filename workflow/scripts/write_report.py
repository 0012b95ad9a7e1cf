"""Write the run as pages: the report, its sources and settings, the note, the ledger."""

import sys

sys.stdout = sys.stderr = open(snakemake.log[0], "w", encoding="utf-8")

from stronge1994.pages import report

report.write(snakemake.input, snakemake.output, **snakemake.params.settings)
