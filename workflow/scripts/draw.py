"""Draw one figure from its curves, and its slide if it has one."""

import sys

sys.stdout = sys.stderr = open(snakemake.log[0], "w", encoding="utf-8")

from stronge1994 import versions
from stronge1994.figures.shared import drawing as drawings

given, made = snakemake.input, dict(snakemake.output.items())
source = versions.source(given.versions)
drawings.draw(snakemake.wildcards.figure, snakemake.params.settings, given.curves, made, source)
