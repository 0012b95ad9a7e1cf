"""Put the chunks of the parameter study together."""

from stronge1994 import job, study_files

with job.recorded(snakemake):
    study_files.gather(
        snakemake.input.chunks, **snakemake.params.settings, path=snakemake.output[0]
    )
