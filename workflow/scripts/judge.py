"""Compare one table of a run with reference data, and find which changes that catches."""

from stronge1994 import csv_tables, judging, one_thread, verdict_table  # noqa: F401  (one thread: before numpy)
from stronge1994.judging import sensitivity
from stronge1994.run import record

with record.recorded(snakemake) as told:
    name, table, made = snakemake.wildcards.judged, snakemake.input.table, snakemake.output
    series = dict(zip(told["sources"], snakemake.input.series, strict=True))
    entries, significance = (told["comparisons"], told["references"]), told["significance"]
    rows = judging.compare(name, *entries, table, series, significance)
    judging.write(rows, made.verdicts, made.residuals)
    caught = []
    if "curves" in told:  # settings and nodes of a figure, which can be solved again
        found = name, *told["curves"], table, *entries, series, significance, told["sensitivity"]
        caught = sensitivity.sensitivities(*found)
    csv_tables.write_rows(made.sensitivity, verdict_table.SENSITIVITY, caught)
