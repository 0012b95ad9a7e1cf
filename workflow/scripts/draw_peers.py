"""Draw error against time with the points of LAMMPS and pooltool."""

from stronge1994 import job
from stronge1994.drawings import peers

with job.recorded(snakemake):
    given, made = snakemake.input, snakemake.output
    peers.write(given.curves, given.peers, snakemake.params.settings, made.svg, made.png)
