LEDGER_FACTS = sources("data/stronge1994/source.yaml")  # beside the ledger, which names some
PAGE_PARTS = sources("workflow/report/ledger.css")
PAGE_TEMPLATE = sources("workflow/report/ledger.html")


rule ledger:
    """Run every entry of the paper's ledger against the paper's model, solved to rounding; always succeeds."""
    input:
        modules=modules("check_ledger", *LEDGER_MODULES),
        entries=LEDGER,
        facts=LEDGER_FACTS,
    output:
        table="results/ledger.csv",
        measures="results/in_nature.csv",
    params:
        schema=LEDGER_SCHEMA,
    log:
        "results/logs/ledger.log",
    benchmark:
        "results/benchmarks/ledger.tsv"
    message:
        "Verifying the paper"
    conda:
        "../envs/planarimpact.yaml"
    script:
        "../scripts/check_ledger.py"


rule ledger_page:
    """The ledger as a page to read, with corrections and their derivations."""
    input:
        modules=modules("write_ledger_page"),
        template=PAGE_TEMPLATE,
        parts=PAGE_PARTS,
        shared=EVERY_PAGE,
        table="results/ledger.csv",
    output:
        report(
            "figures/ledger.html",
            caption="../report/ledger.rst",
            category="Ledger",
            labels={"page": "the paper verified"},
        ),
    params:
        symbols=SYMBOLS,
    log:
        "results/logs/ledger_page.log",
    benchmark:
        "results/benchmarks/ledger_page.tsv"
    message:
        "Writing the ledger's page"
    conda:
        "../envs/planarimpact.yaml"
    script:
        "../scripts/write_ledger_page.py"
