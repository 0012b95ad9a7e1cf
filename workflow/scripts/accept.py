"""Write the accepted table from the tables of a run."""

from stronge1994 import logs

logs.to(snakemake.log[0])

from stronge1994 import accepted, tables, verdict_table
from stronge1994.ledger import outcome

verdicts = verdict_table.gather(snakemake.input.verdicts)
accepted.write(verdicts, tables.read_rows(snakemake.input.ledger, outcome.COLUMNS))
