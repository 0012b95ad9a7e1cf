"""Write the run as one page; always succeeds."""

from pathlib import Path

from stronge1994.pages import report, run_facts
from stronge1994.run import record

with record.recorded(snakemake) as given:
    files = snakemake.input
    report.write(
        snakemake.output.page,
        snakemake.output.problems,
        {Path(path).stem: path for path in (files.verdicts, files.ledger, *files.tables)},
        dict(zip(given["figures"], files.residuals, strict=True)),
        dict(zip(given["figures"], files.pictures, strict=True)),
        given["captions"],
        given["config"],
        (given["comparisons"], given["entries"]),
        sources=given["sources"],
        run=run_facts.everything(),
        symbols=given["symbols"],
        links=given["links"],
        template=files.template,
    )
