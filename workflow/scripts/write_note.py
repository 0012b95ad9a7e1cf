"""Write the note on the replication, and the numbers that it states."""

from pathlib import Path

from stronge1994.run import record

with record.recorded(snakemake) as series:
    from stronge1994.pages import note

    files = snakemake.input
    note.write(
        snakemake.output.page,
        snakemake.output.numbers,
        {Path(path).stem: path for path in files.tables},
        series,
        {Path(path).stem: path for path in files.pictures},
        files.template,
    )
