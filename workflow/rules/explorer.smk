EXPLORER_PARTS = ["explorer.html", "superball.html", "challenge.html", "explorer.css", "play.css"]
EXPLORER_SCRIPTS = ["solver", "check", "base85", "models", "charts", "arrows", "ball", "diagram", "words"]
EXPLORER_SCRIPTS += ["files", "page", "superball", "challenge"]
EXPLORER_PARTS += [f"{part}.js" for part in EXPLORER_SCRIPTS]


rule explorer:
    """A page to explore one impact; it solves the lumped model itself."""
    input:
        plan=planned("explorer", "write_explorer", "explorer", "pages/__init__.py",
            "pages/templates.py", "plan", "reference_data",
            settings=lambda _: plan.settings_of_explorer(config)),
        sources=expand("workflow/explorer/{file}", file=EXPLORER_PARTS),
        shared=EVERY_PAGE,
    output:
        page=report(
            "figures/explorer.html",
            caption="../report/explorer.rst",
            category="Explorer",
            labels={"page": "an impact to play with"},
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
