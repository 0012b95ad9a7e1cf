"""Write error against time as two tables: every way sorted, and the cheapest to each tolerance."""

from stronge1994.run import record

with record.recorded(snakemake):
    from stronge1994.figures.trade import answers

    answers.write(snakemake.input.curves, snakemake.output.table, snakemake.output.answers)
