from stronge1994.explorer.page import SCRIPTS as EXPLORER_SCRIPTS


EXPLORER_PARTS = ["explorer.html", "challenge.html", "explorer.css", "materials.yaml"]
EXPLORER_PARTS += [f"{script}.js" for script in [*EXPLORER_SCRIPTS, "check"]]


rule explorer:
    """A page to throw balls and explore impacts; it solves both models itself."""
    input:
        plan=planned("explorer", "write_explorer", "explorer", "pages/__init__.py",
            "pages/names.py", "pages/templates.py", "plan", "reference_data",
            settings=lambda _: plan.settings_of_explorer(config)),
        sources=expand("workflow/explorer/{file}", file=EXPLORER_PARTS),
        shared=EVERY_PAGE,
    output:
        page=report(
            "figures/explorer.html",
            caption="../report/explorer.rst",
            category="Explorer",
            labels={"page": "a ball to throw"},
        ),
        record="results/records/explorer.json",
    log:
        "results/logs/explorer.log",
    message:
        "Writing the explorer"
    conda:
        "../envs/planarimpact.yaml"
    script:
        "../scripts/write_explorer.py"
