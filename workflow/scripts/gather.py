"""Write all rows of the comparisons as one table."""

from stronge1994 import logs

logs.to(snakemake.log[0])

from stronge1994 import tables, verdict_table

rows = verdict_table.gather(snakemake.input.tables)
tables.write_rows(snakemake.output[0], rows, verdict_table.COLUMNS)
