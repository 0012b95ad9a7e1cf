"""Count all tables of a scene together."""

from stronge1994 import scene_parts
from stronge1994.run import record

with record.recorded(snakemake):
    inputs, made = snakemake.input, snakemake.output
    scene_parts.gather(inputs.tables, inputs.accounts, made.summary, made.bad_rows)
