# The measured pairs of figure `inelastic`: source and series.
PAIRS = config["figures"]["inelastic"]["points"].split("/")
LETTER_PARTS = sources("workflow/report/page.css", "workflow/report/letter.css")
LETTER_TEMPLATE = sources("workflow/report/letter.html")


rule letter:
    """A letter to the author of the paper: does his model apply below e = 1?"""
    input:
        modules=modules("write_letter"),
        template=LETTER_TEMPLATE,
        parts=LETTER_PARTS,
        shared=EVERY_PAGE,
        measures="results/in_nature.csv",
        curves="results/curves/inelastic.csv",
        series=f"results/series/{PAIRS[0]}.csv",
        picture="figures/inelastic.svg",
    output:
        report(
            "figures/below_e_1.html",
            caption="../report/letter.rst",
            category="Ledger",
            labels={"page": "a letter to the author: below e = 1"},
        ),
    params:
        name=PAIRS[1],
    log:
        "results/logs/letter.log",
    benchmark:
        "results/benchmarks/letter.tsv"
    message:
        "Writing the letter to the author"
    conda:
        "../envs/planarimpact.yaml"
    script:
        "../scripts/write_letter.py"
