"""Make a table of spheres."""

from planarimpact.spheres import making, table
from stronge1994.run import record

with record.recorded(snakemake):
    made = making.make(snakemake.wildcards.table)
    with open(snakemake.output.table, "wb") as file:
        table.write(file, made)
