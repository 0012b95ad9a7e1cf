"""Run every entry of the ledger against the paper's model."""

from stronge1994.run import record

with record.recorded(snakemake) as schema:
    from stronge1994 import csv_tables
    from stronge1994.ledger import checking, entries, outcome

    every = entries.load(snakemake.input.entries, schema)
    measured = checking.measure(every)
    rows = checking.check(every, measured)
    csv_tables.write_table(snakemake.output.table, rows, outcome.COLUMNS)
    measures = checking.table_of(measured)
    csv_tables.write_table(snakemake.output.measures, measures, outcome.OF_NATURE)
    print(outcome.summary(rows))
