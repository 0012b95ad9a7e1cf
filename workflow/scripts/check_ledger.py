"""Run every entry of the ledger against the paper's model; always succeeds."""

from stronge1994 import csv_tables, job
from stronge1994.ledger import checking, entries, in_nature, outcome

with job.recorded(snakemake):
    every = entries.load(snakemake.input.entries, snakemake.params.schema)
    measured = checking.measure(every)
    rows = checking.check(every, measured)
    csv_tables.write_table(snakemake.output.table, rows, outcome.COLUMNS)
    csv_tables.write_table(snakemake.output.measures, in_nature.rows(measured), in_nature.COLUMNS)
    print(outcome.summary(rows))
