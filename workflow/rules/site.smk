# All pages in one folder, for a web server or a stick: `snakemake --cores 2 site`, not part of `all`.

rule site:
    """All pages and the interface of the solver in one folder and as a zip file, for a web server or a stick."""
    input:
        plan=planned("site", "write_site", "pages/__init__.py", "pages/interface.py",
            "pages/names.py", "pages/site.py", "pages/templates.py", "plan", "printed",
            "reference_data"),
        # Pages and pictures of a whole run.
        pages=[path for path in MADE if path.startswith("figures/")],
        notebooks=expand("results/notebooks/{notebook}.ipynb", notebook=NOTEBOOKS)
        + ["workflow/notebooks/lecture.mplstyle"],
        texts=["LICENSE", "CITATION.cff"],
        parts=["workflow/report/index.html", "workflow/report/page.css", *EVERY_PAGE],
        style=expand("workflow/report/interface/{part}", part=["frame.html.jinja2", "custom.css"]),
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
