"""Write the ledger as a page."""

from pathlib import Path

from stronge1994 import csv_tables, job
from stronge1994.pages import ledger_page

with job.recorded(snakemake):
    rows = csv_tables.read_rows(snakemake.input.table)
    text = ledger_page.page(rows, snakemake.params.symbols, snakemake.input.template)
    Path(snakemake.output[0]).write_text(text, encoding="utf-8")
