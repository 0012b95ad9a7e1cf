"""Draw maps of the rebound over the grid of the parameter study."""

from stronge1994 import job, study_files
from stronge1994.drawings import checked, study

with job.recorded(snakemake):
    axes, outputs = study_files.read(snakemake.input.study, "velocity", "regime")
    made = snakemake.output
    checked.save(*study.draw(axes, **outputs), "study", made.svg, made.png)
