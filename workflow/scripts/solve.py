"""Solve the curves of one figure."""

from stronge1994.run import record

with record.recorded(snakemake) as settings:
    from stronge1994 import one_thread  # noqa: F401  (one thread: before numpy)
    from stronge1994.figures.shared.curves import solving

    solving.solve(snakemake.wildcards.figure, **settings, output=snakemake.output.table)
