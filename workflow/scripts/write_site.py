"""Copy all pages of a run into one folder, and pack it."""

from stronge1994.run import record

with record.recorded(snakemake):
    from stronge1994.pages import site

    given = snakemake.input
    site.write(
        snakemake.output.folder,
        given.pages,
        given.notebooks,
        given.texts,
        given.readme,
        given.start,
    )
    site.pack(snakemake.output.folder, snakemake.output.archive)
