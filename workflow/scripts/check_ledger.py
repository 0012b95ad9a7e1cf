"""Run every entry of the ledger against the exact solver; always succeeds."""

from stronge1994 import job
from stronge1994.ledger import checking, entries, outcome

with job.recorded(snakemake):
    rows = checking.check(entries.load(snakemake.input.entries, snakemake.params.schema))
    outcome.write(snakemake.output[0], rows)
    print(outcome.summary(rows))
