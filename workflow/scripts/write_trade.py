"""Write error against time as two tables: every way sorted, and the cheapest to each tolerance."""

from stronge1994 import logs

logs.to(snakemake.log[0])

from stronge1994.figures.trade import answers

answers.write(snakemake.input[0], snakemake.output.table, snakemake.output.answers)
