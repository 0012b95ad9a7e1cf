"""Check every entry of the ledger against the paper's model."""

from stronge1994 import logs

logs.to(snakemake.log[0])

from stronge1994 import csv_tables, reference_data
from stronge1994.ledger import checking, entries, outcome

every = entries.load(snakemake.input.entries, reference_data.load_yaml(snakemake.input.schema))
measured = checking.measure(every)
rows = checking.check(every, measured)
csv_tables.write_table(snakemake.output.table, rows, outcome.COLUMNS)
csv_tables.write_table(snakemake.output.measures, checking.table_of(measured), outcome.OF_NATURE)
print(outcome.summary(rows))
