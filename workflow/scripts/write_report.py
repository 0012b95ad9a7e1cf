"""Write the run as one page; always succeeds."""

from pathlib import Path

from stronge1994 import job
from stronge1994.pages import report, run_facts

with job.recorded(snakemake):
    files, given = snakemake.input, snakemake.params
    report.write(
        snakemake.output.page,
        snakemake.output.problems,
        {Path(path).stem: path for path in (files.verdicts, files.ledger, *files.tables)},
        dict(zip(given.figures, files.residuals, strict=True)),
        dict(zip(given.figures, files.pictures, strict=True)),
        files.captions,
        given.config,
        (given.comparisons, given.entries),
        sources=given.sources,
        run=run_facts.everything(),
        symbols=given.symbols,
        links=given.links,
        template=files.template,
    )
