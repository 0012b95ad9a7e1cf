"""Write the run as one page. What could not be shown is an error of the job, behind all else."""

from pathlib import Path

from stronge1994.run import record

with record.recorded(snakemake) as settings:
    from stronge1994 import csv_tables
    from stronge1994.pages import report

    files = snakemake.input
    tables = (files.verdicts, files.ledger, files.numbers, files.answers)
    report.copy_tables(snakemake.output.tables, files.linked)
    report.write(
        snakemake.output.page,
        snakemake.output.problems,
        {Path(path).stem: path for path in tables},
        {Path(path).stem: path for path in files.residuals},
        {Path(path).stem: path for path in files.pictures},
        files.records,
        files.template,
        settings,
    )
    if problems := [row["problem"] for row in csv_tables.read_rows(snakemake.output.problems)]:
        raise RuntimeError("; ".join(problems))
