"""Check every entry of the ledger against the paper's model."""

from stronge1994 import logs

logs.to(snakemake.log[0])

from stronge1994 import ledger_table, paper, reference_data, tables
from stronge1994.paper import checking

facts = reference_data.load_yaml(snakemake.input.facts)["facts"]
rows = checking.check(paper.entries(facts).values())
tables.write_rows(snakemake.output[0], rows, ledger_table.COLUMNS)
print(ledger_table.summary(rows))
