"""Write the page to throw a ball, with answers by which it checks itself, and the start page."""

from stronge1994 import logs

logs.to(snakemake.log[0])

from pathlib import Path

from stronge1994 import versions
from stronge1994.explorer import page as explorer
from stronge1994.explorer.answers import answers
from stronge1994.pages import templates

text = explorer.page(snakemake.params.settings, snakemake.input.sources, answers(explorer.LIMITS))
Path(snakemake.output.page).write_text(text, encoding="utf-8")
start = templates.environment().get_template("index.html")
Path(snakemake.output.start).write_text(start.render(wheel=versions.WHEEL), encoding="utf-8")
