"""Bring the series of one source into one table."""

from stronge1994.run import record

with record.recorded(snakemake) as source:
    from stronge1994.reference_data import conversion

    conversion.convert(source, snakemake.output.table)
