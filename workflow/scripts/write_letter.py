"""Write the letter to the author of the paper."""

from stronge1994.pages import letter
from stronge1994.run import record

with record.recorded(snakemake) as name:
    files = snakemake.input
    letter.write(
        snakemake.output.page,
        files.measures,
        files.curves,
        files.series,
        files.picture,
        files.template,
        name,
    )
