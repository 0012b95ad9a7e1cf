"""Put the chunks of the parameter study together."""

from stronge1994 import study_files
from stronge1994.run import record

with record.recorded(snakemake) as told:
    study_files.gather(snakemake.input.chunks, **told, path=snakemake.output.table)
