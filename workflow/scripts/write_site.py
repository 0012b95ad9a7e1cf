"""Put all pages of a run and those of the interface into one folder, and pack it."""

from stronge1994 import logs

logs.to(snakemake.log[0])

from stronge1994.pages import interface, site

given, folder = snakemake.input, snakemake.output.folder
pages = [path for path in given.made if path.startswith("figures/")]
site.write(folder, pages, given.texts)
interface.write(f"{folder}/interface")
site.pack(folder, snakemake.output.archive)
