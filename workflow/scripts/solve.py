"""Solve the curves of one figure."""

from stronge1994 import logs

logs.to(snakemake.log[0])

from stronge1994 import solving

solving.solve(snakemake.wildcards.figure, **snakemake.params.settings, output=snakemake.output[0])
