"""Write the page to play with one impact."""

from stronge1994 import job
from stronge1994.pages import explorer

with job.recorded(snakemake):
    explorer.write(snakemake.output[0], snakemake.params.settings, snakemake.input.sources)
