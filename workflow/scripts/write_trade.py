"""Write error against time as two tables: every way sorted, and the cheapest to each tolerance."""

from stronge1994.run import record
from stronge1994.trade import answers

with record.recorded(snakemake):
    answers.write(snakemake.input.curves, snakemake.output.table, snakemake.output.answers)
