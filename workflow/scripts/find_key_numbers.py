"""Compute the numbers that several pages state."""

from pathlib import Path

from stronge1994.run import record

with record.recorded(snakemake) as series:
    from stronge1994.pages import key_numbers

    files = {Path(path).stem: path for path in snakemake.input.tables}
    key_numbers.write(snakemake.output.table, files, series)
