"""Check every entry of the ledger against the paper's model."""

from stronge1994 import logs

logs.to(snakemake.log[0])

from stronge1994 import reference_data, tables
from stronge1994.ledger import checking, entries, outcome

every = entries.load(snakemake.input.entries, reference_data.load_yaml(snakemake.input.schema))
measured = checking.measure(every)
rows = checking.check(every, measured)
tables.write_rows(snakemake.output.table, rows, outcome.COLUMNS)
tables.write_rows(snakemake.output.measures, checking.table_of(measured), outcome.OF_NATURE)
print(outcome.summary(rows))
