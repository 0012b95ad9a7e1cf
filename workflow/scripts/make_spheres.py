"""Make a table of spheres."""

from planarimpact.spheres import making, table
from stronge1994 import job

with job.recorded(snakemake):
    made = making.make(snakemake.wildcards.table)
    with open(snakemake.output[0], "wb") as file:
        table.write(file, made)
