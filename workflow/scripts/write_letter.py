"""Write the letter to the author of the paper."""

from stronge1994 import job
from stronge1994.pages import letter

with job.recorded(snakemake):
    files = snakemake.input
    letter.write(
        snakemake.output[0],
        files.measures,
        files.curves,
        files.series,
        files.picture,
        files.template,
        snakemake.params.name,
    )
