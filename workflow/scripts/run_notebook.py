"""Run one notebook and keep it executed, as a page, as slides and as a sheet of answers."""

from stronge1994.run import record

with record.recorded(snakemake):
    from stronge1994 import one_thread  # noqa: F401  (one thread: before numpy)
    from stronge1994.pages import lectures

    inputs = snakemake.input
    templates = {"page": inputs.page, "slides": inputs.slides}
    lectures.run(inputs.notebook, templates, dict(snakemake.output.items()))
