"""Solve one chunk of the parameter study."""

from stronge1994 import one_thread  # noqa: F401  (one thread: before numpy)
from stronge1994.figures.study import files as study_files
from stronge1994.run import record

with record.recorded(snakemake) as settings:
    study_files.solve(snakemake.wildcards.scatteritem, **settings, path=snakemake.output.chunk)
