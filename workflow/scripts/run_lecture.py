"""Run one notebook; keep it executed, as a page, as slides and as a sheet of answers."""

from stronge1994 import logs

logs.to(snakemake.log[0])

from stronge1994 import one_thread  # noqa: F401  (one thread: before numpy)
from stronge1994.pages import lectures

given = snakemake.input
lectures.run(given.notebook, {"page": given.page, "slides": given.slides}, snakemake.output)
