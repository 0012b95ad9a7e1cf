"""Run the notebooks; keep each executed, as a page, as slides and as a sheet of answers."""

from stronge1994.run import record

with record.recorded(snakemake) as tables:
    from stronge1994 import one_thread  # noqa: F401  (one thread: before numpy)
    from stronge1994.pages import lectures

    given, made = snakemake.input, snakemake.output
    templates = {"page": given.page, "slides": given.slides}
    kinds = ("executed", "page", "slides", "answers")
    files = zip(*(made[kind] for kind in kinds), strict=True)
    results = [dict(zip(kinds, paths, strict=True)) for paths in files]
    lectures.run_all(given.notebooks, templates, results, tables)
