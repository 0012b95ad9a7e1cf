"""Put the chunks of the parameter study together."""

from stronge1994.figures.study import files as study_files
from stronge1994.run import record

with record.recorded(snakemake) as told:
    study_files.gather(snakemake.input.chunks, **told, path=snakemake.output.table)
