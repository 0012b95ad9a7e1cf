from stronge1994.explorer.page import SCRIPTS as EXPLORER_SCRIPTS


EXPLORER_PARTS = ["explorer.html", "challenge.html", "explorer.css", "materials.yaml"]
EXPLORER_PARTS += [f"{script}.js" for script in [*EXPLORER_SCRIPTS, "check"]]


rule explorer:
    """A page to throw balls and explore impacts, and the page to begin with, which shows its stage."""
    input:
        plan=planned("explorer", "write_explorer", "explorer", "pages/__init__.py",
            "pages/names.py", "pages/templates.py", "plan", "reference_data",
            settings=lambda _: plan.settings_of_explorer(config)),
        sources=expand("workflow/explorer/{file}", file=EXPLORER_PARTS),
        start="workflow/report/index.html",
        parts="workflow/report/page.css",
        shared=EVERY_PAGE,
    output:
        page="figures/explorer.html",
        start="figures/index.html",
        record="results/records/explorer.json",
    log:
        "results/logs/explorer.log",
    message:
        "Writing the explorer"
    conda:
        "../envs/planarimpact.yaml"
    script:
        "../scripts/write_explorer.py"
