"""Solve the curves of one figure."""

import sys

sys.stdout = sys.stderr = open(snakemake.log[0], "w", encoding="utf-8")

from stronge1994 import one_thread  # noqa: F401  (one thread: before numpy)
from stronge1994.figures.shared.curves import solving

solving.solve(snakemake.wildcards.figure, **snakemake.params.settings, output=snakemake.output[0])
