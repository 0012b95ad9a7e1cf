# All pages in one folder, for a web server or a stick: `snakemake --cores 2 site`, not part of `all`.

# Pages and pictures of a whole run.
PAGES = [
    path
    for maker in MAKERS
    for path in expand([f"{output}" for output in maker.output], **VALUES)
    if path.startswith("figures/")
] + slides_of(FIGURES) + [rules.interface.output.pages]


rule site:
    """All pages in one folder and as a zip file, for a web server or a stick."""
    input:
        plan=planned("site", "write_site", "pages/__init__.py", "pages/run_facts.py", "pages/site.py",
            "pages/names.py", "pages/templates.py", "plan", "reference_data"),
        pages=sorted(set(PAGES)),
        notebooks=expand("results/notebooks/{notebook}.ipynb", notebook=NOTEBOOKS)
        + ["workflow/notebooks/lecture.mplstyle"],
        texts=["LICENSE", "CITATION.cff"],
        readme="workflow/report/site_readme.txt",
        start="workflow/report/index.html",
        parts=["workflow/report/page.css", *EVERY_PAGE],
    output:
        folder=directory("results/site"),
        archive="results/site.zip",
        record="results/records/site.json",
    log:
        "results/logs/site.log",
    message:
        "Copying all pages into one folder"
    conda:
        "../envs/planarimpact.yaml"
    script:
        "../scripts/write_site.py"
