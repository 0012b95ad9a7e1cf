"""Make a table of spheres."""

from stronge1994.run import record

with record.recorded(snakemake):
    from planarimpact.spheres import making, table

    made = making.make(snakemake.wildcards.table)
    with open(snakemake.output.table, "wb") as file:
        table.write(file, made)
