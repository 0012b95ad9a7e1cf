"""Write the interface of the solver as pages."""

from pathlib import Path

from stronge1994.run import record

with record.recorded(snakemake):
    from stronge1994.pages import interface

    interface.write(snakemake.output.pages, Path(snakemake.input.parts[0]).parent)
