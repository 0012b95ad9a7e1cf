"""Solve one chunk of the parameter study."""

from stronge1994 import job, one_thread, study_files  # noqa: F401  (one thread: before numpy)

with job.recorded(snakemake):
    chunk, wanted = snakemake.wildcards.scatteritem, snakemake.params.settings
    study_files.solve(chunk, **wanted, path=snakemake.output[0])
