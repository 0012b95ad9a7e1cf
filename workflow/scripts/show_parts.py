"""Show what the summary of a scene in many tables says, in the log and on the terminal."""

from stronge1994 import job, scene_parts

with job.recorded(snakemake):
    words = scene_parts.words(snakemake.input.summary)
    print(words)
print(words)
