"""Write the ledger as a page."""

from pathlib import Path

from stronge1994.run import record

with record.recorded(snakemake) as symbols:
    from stronge1994 import csv_tables
    from stronge1994.pages import ledger_page

    rows = csv_tables.read_rows(snakemake.input.table)
    text = ledger_page.page(rows, symbols, snakemake.input.template)
    Path(snakemake.output.page).write_text(text, encoding="utf-8")
