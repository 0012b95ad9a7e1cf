"""Write the interface of the solver as pages."""

from pathlib import Path

from stronge1994 import job
from stronge1994.pages import interface

with job.recorded(snakemake):
    interface.write(snakemake.output[0], Path(snakemake.input.parts[0]).parent)
