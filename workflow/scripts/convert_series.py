"""Bring the series of one source into one table."""

from stronge1994 import job
from stronge1994.reference_data import conversion

with job.recorded(snakemake):
    conversion.convert(snakemake.params.source, snakemake.output[0])
