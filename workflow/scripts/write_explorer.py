"""Write the page to throw a ball, whose solvers must answer as the package does."""

from pathlib import Path

from stronge1994.run import record

with record.recorded(snakemake) as settings:
    from stronge1994.explorer import page as explorer
    from stronge1994.explorer.answers import answers

    known = answers(explorer.LIMITS)
    paths = {Path(path).name: path for path in snakemake.input.sources}
    solvers = [paths[name] for name in ("solver.js", "continuum.js", "check.js")]
    print(explorer.refuse_other_answers(solvers, known))
    text = explorer.page(settings, snakemake.input.sources, known)
    Path(snakemake.output.page).write_text(text, encoding="utf-8")
