"""Compare one table of a run with reference data."""

from stronge1994.run import record

with record.recorded(snakemake) as plan:
    from stronge1994 import judging, one_thread  # noqa: F401  (one thread: before numpy)

    name, table, made = snakemake.wildcards.judged, snakemake.input.table, snakemake.output
    comparisons, references = plan["comparisons"], plan["references"]
    significance = plan["significance"]
    rows = judging.compare(name, comparisons, references, table, significance)
    judging.write(rows, made.verdicts, made.residuals)
