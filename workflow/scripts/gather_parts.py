"""Count all tables of a scene together."""

from stronge1994 import scene_parts
from stronge1994.run import record

with record.recorded(snakemake):
    given, made = snakemake.input, snakemake.output
    scene_parts.gather(given.tables, given.accounts, made.summary, made.bad_rows)
