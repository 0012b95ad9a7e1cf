"""Write the digits of the lumped model by decades of each parameter."""

from stronge1994 import job
from stronge1994.pages import stability_table

with job.recorded(snakemake):
    stability_table.write(snakemake.input.curves, snakemake.output[0])
