"""Write the run as pages: the report, its sources and settings, the ledger."""

from stronge1994 import logs

logs.to(snakemake.log[0])

from stronge1994.pages import report

report.write(snakemake.input, snakemake.output, **snakemake.params.settings)
