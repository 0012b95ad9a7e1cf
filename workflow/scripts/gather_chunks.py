"""Put the chunks of the parameter study together."""

from stronge1994.figures.study import files as study_files
from stronge1994.run import record

with record.recorded(snakemake) as settings:
    study_files.gather(snakemake.input.chunks, **settings, path=snakemake.output.table)
