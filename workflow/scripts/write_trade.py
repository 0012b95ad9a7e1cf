"""Write error against time as two tables: every way sorted, and the cheapest to each tolerance."""

import sys

sys.stdout = sys.stderr = open(snakemake.log[0], "w", encoding="utf-8")

from stronge1994.figures.trade import answers

answers.write(snakemake.input[0], snakemake.output.table, snakemake.output.answers)
