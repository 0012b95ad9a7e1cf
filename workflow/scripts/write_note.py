"""Write the note on the replication, as a page and as a PDF."""

from pathlib import Path

from stronge1994.run import record

with record.recorded(snakemake):
    from stronge1994.pages import note

    files = snakemake.input
    note.write(
        snakemake.output.page,
        snakemake.output.pdf,
        files.numbers,
        files.verdicts,
        {Path(path).stem: path for path in files.pictures},
        files.template,
    )
