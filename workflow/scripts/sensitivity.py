"""Find the smallest change of each group that the comparisons of one figure catch."""

from stronge1994 import csv_tables, job, one_thread  # noqa: F401  (one thread: before numpy)
from stronge1994.judging import sensitivity, verdict_table

with job.recorded(snakemake):
    judged = snakemake.params.judged
    rows = sensitivity.sensitivities(
        snakemake.wildcards.figure,
        snakemake.params.settings,
        snakemake.params.nodes,
        snakemake.input.curves,
        judged["comparisons"],
        judged["references"],
        dict(zip(judged["sources"], snakemake.input.series, strict=True)),
        snakemake.params.significance,
    )
    csv_tables.write_rows(snakemake.output[0], verdict_table.SENSITIVITY, rows)
