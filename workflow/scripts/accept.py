"""Write the accepted table from the tables of a run."""

from stronge1994 import logs

logs.to(snakemake.log[0])

from stronge1994 import accepted, ledger_table, tables, verdict_table

verdicts = verdict_table.gather(snakemake.input.verdicts)
accepted.write(verdicts, tables.read_rows(snakemake.input.ledger, ledger_table.COLUMNS))
