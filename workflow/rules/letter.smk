# The measured pairs of figure `inelastic`: source and series.
PAIRS = config["figures"]["inelastic"]["points"].split("/")


rule letter:
    """A letter to the author of the paper: does his model apply below e = 1?"""
    input:
        plan=planned("letter", "write_letter", "pages", "figures/inelastic/drawing.py",
            "figures/shared/drawing", "ledger", "printed", "plan",
            "reference_data", settings=lambda _: PAIRS[1]),
        template="workflow/report/letter.html",
        parts=["workflow/report/page.css", "workflow/report/letter.css"],
        shared=EVERY_PAGE,
        measures="results/in_nature.csv",
        curves="results/curves/inelastic.csv",
        series=f"results/series/{PAIRS[0]}.csv",
        picture="figures/inelastic.svg",
    output:
        page=report(
            "figures/below_e_1.html",
            caption="../report/letter.rst",
            category="Ledger",
            labels={"page": "a letter to the author: below e = 1"},
        ),
        record="results/records/letter.json",
    log:
        "results/logs/letter.log",
    message:
        "Writing the letter to the author"
    conda:
        "../envs/planarimpact.yaml"
    script:
        "../scripts/write_letter.py"
