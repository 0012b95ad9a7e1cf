"""Write the page to play with one impact."""

from pathlib import Path

from stronge1994 import job
from stronge1994.pages import explorer

with job.recorded(snakemake):
    text = explorer.page(snakemake.params.settings, snakemake.input.sources)
    Path(snakemake.output[0]).write_text(text, encoding="utf-8")
