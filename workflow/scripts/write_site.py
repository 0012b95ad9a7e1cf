"""Put all pages of a run and those of the interface into one folder, and pack it."""

from stronge1994.run import record

with record.recorded(snakemake):
    from stronge1994.pages import interface, site

    given, folder = snakemake.input, snakemake.output.folder
    site.write(folder, given.pages, given.notebooks, given.texts)
    interface.write(f"{folder}/interface")
    site.pack(folder, snakemake.output.archive)
