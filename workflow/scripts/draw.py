"""Draw one figure from its curves, and its slide if it has one."""

from stronge1994 import logs

logs.to(snakemake.log[0])

from stronge1994 import versions
from stronge1994.figures.shared import drawing as drawings

given, made = snakemake.input, dict(snakemake.output.items())
source = versions.source()
drawings.draw(snakemake.wildcards.figure, snakemake.params.settings, given.curves, made, source)
