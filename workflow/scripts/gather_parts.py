"""Count all tables of a scene together."""

from stronge1994 import job, scene_parts

with job.recorded(snakemake):
    scene_parts.gather(snakemake.input.tables, snakemake.input.accounts, *snakemake.output)
