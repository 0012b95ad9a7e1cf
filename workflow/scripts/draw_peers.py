"""Draw error against time with the points of LAMMPS and pooltool, and errors below e = 1."""

from stronge1994 import job
from stronge1994.drawings import peers

with job.recorded(snakemake):
    given, made = snakemake.input, snakemake.output
    pictures, errors = (made.svg, made.png), (made.errors_svg, made.errors_png)
    peers.write(given.curves, given.peers, snakemake.params.settings, pictures, errors)
