"""Write the page to play with one impact, whose solver must answer as the package does."""

from pathlib import Path

from stronge1994 import job
from stronge1994.curves.explorer import answers
from stronge1994.pages import explorer

with job.recorded(snakemake):
    known = answers(explorer.LIMITS)
    paths = {Path(path).name: path for path in snakemake.input.sources}
    print(explorer.refuse_other_answers(paths["solver.js"], paths["check.js"], known))
    text = explorer.page(snakemake.params.settings, snakemake.input.sources, known)
    Path(snakemake.output[0]).write_text(text, encoding="utf-8")
