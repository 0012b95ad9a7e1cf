"""Write the page that lays a copy of the paper under the curves of the run."""

from stronge1994 import logs

logs.to(snakemake.log[0])

from pathlib import Path

import planarimpact
from stronge1994.pages import your_copy

curves = dict(zip(snakemake.params.figures, snakemake.input.curves, strict=True))
version = planarimpact.__version__
text = your_copy.page(
    snakemake.input.sources,
    curves,
    snakemake.params.series,
    version,
    snakemake.params.allowances,
    snakemake.params.significance,
)
Path(snakemake.output.page).write_text(text, encoding="utf-8")
