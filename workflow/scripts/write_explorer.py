"""Write the page to throw a ball, with answers of the package against which it checks itself."""

from pathlib import Path

from stronge1994.run import record

with record.recorded(snakemake) as settings:
    from stronge1994.explorer import page as explorer
    from stronge1994.explorer.answers import answers

    text = explorer.page(settings, snakemake.input.sources, answers(explorer.LIMITS))
    Path(snakemake.output.page).write_text(text, encoding="utf-8")
