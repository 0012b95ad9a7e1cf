"""Run one lecture; write its page, slides, sheet of answers and notebooks for students."""

from stronge1994 import logs

logs.to(snakemake.log[0])

from stronge1994.pages import lectures

given = snakemake.input
templates = {"page": given.page, "slides": given.slides}
lectures.run(given.notebook, templates, snakemake.output)
