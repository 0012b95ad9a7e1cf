"""Draw error against time with the points of LAMMPS and pooltool, and errors below e = 1."""

from stronge1994.run import record

with record.recorded(snakemake) as settings:
    from stronge1994.figures.trade import draw_peers as peers

    inputs, made = snakemake.input, snakemake.output
    pictures, errors = (made.svg, made.png), (made.errors_svg, made.errors_png)
    peers.write(inputs.curves, inputs.peers, settings, pictures, errors)
