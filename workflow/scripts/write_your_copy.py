"""Write the page that lays a copy of the paper under the curves of the run."""

from stronge1994 import logs

logs.to(snakemake.log[0])

from pathlib import Path

from stronge1994.pages import your_copy

given = snakemake.input
text = your_copy.page(given.sources, given.curves, **snakemake.params.settings)
Path(snakemake.output.page).write_text(text, encoding="utf-8")
