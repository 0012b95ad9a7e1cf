"""Run one notebook; keep it executed, as a page, as slides and as a sheet of answers."""

import sys

sys.stdout = sys.stderr = open(snakemake.log[0], "w", encoding="utf-8")

from stronge1994 import one_thread  # noqa: F401  (one thread: before numpy)
from stronge1994.pages import lectures

given = snakemake.input
lectures.run(given.notebook, {"page": given.page, "slides": given.slides}, snakemake.output)
