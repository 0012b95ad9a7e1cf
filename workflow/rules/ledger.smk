rule ledger:
    """Run every entry of the paper's ledger against the paper's model, solved to rounding."""
    input:
        plan=planned("ledger", "check_ledger", "ledger", "printed", "reference_data", "judging", "verdict_tables",
            settings=lambda _: LEDGER_SCHEMA, reads=lambda _: [LEDGER, FACTS]),
        entries=LEDGER,
        facts=FACTS,
    output:
        table="results/ledger.csv",
        measures="results/in_nature.csv",
        record="results/records/ledger.json",
    log:
        "results/logs/ledger.log",
    priority: 1  # as it is long
    message:
        "Checking the paper"
    conda:
        "../envs/planarimpact.yaml"
    script:
        "../scripts/check_ledger.py"


rule ledger_page:
    """The ledger as a page to read, with corrections and their derivations."""
    input:
        plan=planned("ledger_page", "write_ledger_page", "pages", "ledger", "printed", "plan",
            "reference_data", settings=lambda _: SYMBOLS),
        template="workflow/report/ledger.html",
        parts=expand("workflow/report/{part}.css", part=["page", "ledger"]),
        shared=EVERY_PAGE,
        table="results/ledger.csv",
    output:
        page="figures/ledger.html",
        record="results/records/ledger_page.json",
    log:
        "results/logs/ledger_page.log",
    message:
        "Writing the ledger's page"
    conda:
        "../envs/planarimpact.yaml"
    script:
        "../scripts/write_ledger_page.py"
