"""Run every entry of the ledger against the exact solver; always succeeds."""

from stronge1994 import csv_tables, job
from stronge1994.ledger import checking, entries, outcome

with job.recorded(snakemake):
    rows = checking.check(entries.load(snakemake.input.entries, snakemake.params.schema))
    csv_tables.write_table(snakemake.output[0], rows, outcome.COLUMNS)
    print(outcome.summary(rows))
