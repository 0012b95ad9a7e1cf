EXPLORER_PARTS = ["explorer.html", "superball.html", "challenge.html", "explorer.css", "play.css"]
EXPLORER_SCRIPTS = ["solver", "check", "base85", "models", "charts", "arrows", "ball", "diagram", "words"]
EXPLORER_SCRIPTS += ["files", "page", "superball", "challenge"]
EXPLORER_PARTS += [f"{part}.js" for part in EXPLORER_SCRIPTS]
EXPLORER_SOURCES = sources(*expand("workflow/explorer/{file}", file=EXPLORER_PARTS))


rule explorer:
    """A page to play with one impact; it solves the lumped model itself."""
    input:
        modules=modules("write_explorer"),
        sources=EXPLORER_SOURCES,
        shared=EVERY_PAGE,
    output:
        report(
            "figures/explorer.html",
            caption="../report/explorer.rst",
            category="Explorer",
            labels={"page": "an impact to play with"},
        ),
    params:
        settings=plan.settings_of_explorer(config),
    log:
        "results/logs/explorer.log",
    benchmark:
        "results/benchmarks/explorer.tsv"
    message:
        "Writing the explorer"
    conda:
        "../envs/planarimpact.yaml"
    script:
        "../scripts/write_explorer.py"
