"""The gate: pass only if every row is there and none fails, and all that was made is whole.

Runs last, so nothing else is lost.
"""

import sys
from pathlib import Path

import csv_tables
import job
import judgement
import records


def faults(tables, residuals, page, problems, made, comparisons, entries):
    """Why the run must not pass, in words, one line a fault.

    Parameters
    ----------
    tables : (str, str)
        results/verdicts.csv and results/ledger.csv.
    residuals, made : list of str
        Tables of residuals; every file that the run makes, these tables among them.
    page, problems : str
        The report, and the table of what it could not show.
    comparisons, entries : dict
        As `judgement.faults_of_tables`.

    Returns
    -------
    list of str
    """
    found = judgement.faults_of_files(made)
    if found:  # what is cut cannot be counted
        return found
    verdicts, ledger = map(csv_tables.read_rows, tables)
    found = judgement.faults_of_tables(verdicts, ledger, comparisons, entries)
    found += [f"report: {row['problem']}" for row in csv_tables.read_rows(problems)]
    found += judgement.faults_of_report(page, comparisons)
    found = found or judgement.faults_of_residuals(verdicts, residuals)
    return found or records.faults(made)


if "snakemake" in globals():
    with job.log_to(snakemake.log[0]):  # noqa: F821
        given = snakemake.input  # noqa: F821
        found = faults(
            (given.verdicts, given.ledger),
            given.residuals,
            given.page,
            given.problems,
            given.made,
            snakemake.params.comparisons,  # noqa: F821
            snakemake.params.entries,  # noqa: F821
        )
        print("\n".join(found))
        if not found:
            words = judgement.words_of_pass(given.made, snakemake.params.config)  # noqa: F821
            Path(snakemake.output[0]).write_text(words, encoding="utf-8")  # noqa: F821
    sys.exit(bool(found))
