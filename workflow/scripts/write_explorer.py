"""Write the page to play with one impact, whose solver must answer as the package does."""

from pathlib import Path

from stronge1994.explorer import page as explorer
from stronge1994.explorer.answers import answers
from stronge1994.run import record

with record.recorded(snakemake) as settings:
    known = answers(explorer.LIMITS)
    paths = {Path(path).name: path for path in snakemake.input.sources}
    print(explorer.refuse_other_answers(paths["solver.js"], paths["check.js"], known))
    text = explorer.page(settings, snakemake.input.sources, known)
    Path(snakemake.output.page).write_text(text, encoding="utf-8")
