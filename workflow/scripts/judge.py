"""Compare one table of a run with reference data, and find which changes that catches."""

from stronge1994.run import record

with record.recorded(snakemake) as plan:
    from stronge1994 import csv_tables, judging, one_thread, verdict_table  # noqa: F401  (one thread: before numpy)
    from stronge1994.judging import sensitivity

    name, table, made = snakemake.wildcards.judged, snakemake.input.table, snakemake.output
    series = dict(zip(plan["sources"], snakemake.input.series, strict=True))
    comparisons, references = plan["comparisons"], plan["references"]
    significance = plan["significance"]
    rows = judging.compare(name, comparisons, references, table, series, significance)
    judging.write(rows, made.verdicts, made.residuals)
    caught = []
    if "curves" in plan:  # settings and nodes of a figure, which can be solved again
        judged = table, comparisons, references, series, significance
        caught = sensitivity.sensitivities(name, *plan["curves"], *judged, plan["sensitivity"])
    csv_tables.write_rows(made.sensitivity, verdict_table.SENSITIVITY, caught)
