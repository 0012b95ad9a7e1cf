"""Write the interface of the solver as pages."""

from stronge1994 import job
from stronge1994.pages import interface

with job.recorded(snakemake):
    interface.write(snakemake.output[0], snakemake.params.templates)
