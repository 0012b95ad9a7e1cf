"""Run one notebook and keep it twice: executed, and as a page that needs nothing else."""

from stronge1994 import one_thread  # noqa: F401  (one thread: before numpy)
from stronge1994.pages import lectures
from stronge1994.run import record

with record.recorded(snakemake):
    inputs, made = snakemake.input, snakemake.output
    lectures.run(inputs.notebook, inputs.template, made.executed, made.page)
