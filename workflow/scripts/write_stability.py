"""Write the digits of the lumped model by decades of each parameter."""

from stronge1994.run import record

with record.recorded(snakemake):
    from stronge1994.pages import stability_table

    stability_table.write(snakemake.input.curves, snakemake.output.table)
