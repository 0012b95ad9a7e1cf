"""Show what the summary of a scene in many tables says, in the log and on the terminal."""

from stronge1994 import scene_parts
from stronge1994.run import record

with record.log_to(snakemake.log[0]):
    summary = scene_parts.words(snakemake.input.summary)
    print(summary)
print(summary)
