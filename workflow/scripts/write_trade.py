"""Write error against time as two tables: every way sorted, and the cheapest to each tolerance."""

from stronge1994 import job
from stronge1994.trade import answers

with job.recorded(snakemake):
    answers.write(snakemake.input.curves, snakemake.output.table, snakemake.output.answers)
