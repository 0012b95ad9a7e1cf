"""Draw maps of the rebound over the grid of the parameter study."""

from stronge1994.figures.shared.drawing import checked, words
from stronge1994.figures.study import drawing as study
from stronge1994.figures.study import files as study_files
from stronge1994.run import record

with record.recorded(snakemake):
    axes, outputs = study_files.read(snakemake.input.study, "velocity", "regime")
    made = snakemake.output
    checked.save(*study.draw(axes, **outputs), "study", made.svg, made.png, words.of(study))
