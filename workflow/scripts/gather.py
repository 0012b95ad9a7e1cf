"""Write all rows of the comparisons as one table, and for readers by figure."""

from pathlib import Path

from stronge1994 import logs

logs.to(snakemake.log[0])

from stronge1994 import figure_table, tables, verdict_table

rows = verdict_table.gather(snakemake.input.tables)
tables.write_rows(snakemake.output.table, rows, verdict_table.COLUMNS)
by_figure = figure_table.of_run(rows, snakemake.params.shows, snakemake.params.grades)
Path(snakemake.output.by_figure).write_text(f"{figure_table.text(by_figure)}\n", "utf-8")
