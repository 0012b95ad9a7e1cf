"""Write the run as one page. What could not be shown is an error of the job, behind all else."""

from pathlib import Path

from stronge1994.run import record

with record.recorded(snakemake) as settings:
    from stronge1994 import csv_tables
    from stronge1994.pages import report, run_facts

    files = snakemake.input
    report.copy_tables(snakemake.output.tables, files.linked)
    report.write(
        snakemake.output.page,
        snakemake.output.problems,
        {Path(path).stem: path for path in (files.verdicts, files.ledger, *files.tables)},
        dict(zip(settings["figures"], files.residuals, strict=True)),
        dict(zip(settings["figures"], files.pictures, strict=True)),
        settings["captions"],
        settings["config"],
        (settings["comparisons"], settings["entries"]),
        sources=settings["sources"],
        records=files.records,
        run=run_facts.everything(),
        symbols=settings["symbols"],
        links=settings["links"],
        template=files.template,
    )
    if problems := [row["problem"] for row in csv_tables.read_rows(snakemake.output.problems)]:
        raise RuntimeError("; ".join(problems))
