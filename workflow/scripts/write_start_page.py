"""Write the page to begin with."""

from pathlib import Path

from stronge1994.run import record

with record.recorded(snakemake):
    from stronge1994.pages import templates

    template = Path(snakemake.input.template)
    page = templates.environment(template.parent).get_template(template.name)
    Path(snakemake.output.page).write_text(page.render(interface=""), encoding="utf-8")
