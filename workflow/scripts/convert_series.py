"""Bring the series of one source into one table."""

from stronge1994.reference_data import conversion
from stronge1994.run import record

with record.recorded(snakemake) as source:
    conversion.convert(source, snakemake.output.table)
