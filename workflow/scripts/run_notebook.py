"""Run one notebook and keep it twice: executed, and as a page that needs nothing else."""

from stronge1994 import one_thread  # noqa: F401  (one thread: before numpy)
from stronge1994.pages import lectures
from stronge1994.run import record

with record.recorded(snakemake):
    given, made = snakemake.input, snakemake.output
    lectures.run(given.notebook, given.template, made.executed, made.page)
