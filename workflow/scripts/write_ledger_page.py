"""Write the ledger as a page."""

from stronge1994 import csv_tables, job
from stronge1994.pages import ledger_page

with job.recorded(snakemake):
    rows = csv_tables.read_rows(snakemake.input.table)
    ledger_page.write(snakemake.output[0], rows, snakemake.params.symbols, snakemake.input.template)
