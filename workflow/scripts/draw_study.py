"""Draw maps of the rebound over the grid of the parameter study."""

from stronge1994 import job, study_files
from stronge1994.drawings import house_style, study

with job.recorded(snakemake):
    axes, outputs = study_files.read(snakemake.input.study, "velocity", "regime")
    drawn, made = study.draw(axes, **outputs), snakemake.output
    house_style.save(drawn, made.svg, made.png)
