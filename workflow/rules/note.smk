# Figures that the note shows.
SHOWN = ["fig5", "inelastic", "rubber_sphere", "yielding"]


# Series of which pages state numbers.
MEASURED = {
    "pairs": SOURCES["cornell1999"]["series"]["pairs"],
    "runs": SOURCES["finite_elements"]["series"]["spheres"],
}
MEASURED_FILES = [series["path"] for series in MEASURED.values()]


rule key_numbers:
    """The numbers that several pages state, each computed once."""
    input:
        plan=planned("key_numbers", "find_key_numbers", "pages", "figures/inelastic/drawing.py",
            "figures/shared/drawing", "ledger", "printed", "plan", "reference_data", "run",
            "judging", "verdict_tables", settings=lambda _: MEASURED, reads=lambda _: MEASURED_FILES),
        tables=[
            "results/verdicts.csv",
            "results/ledger.csv",
            "results/in_nature.csv",
            "results/trade.csv",
            *expand("results/curves/{figure}.csv", figure=["fig5", "fig8", "inelastic", "yielding", "rubber_sphere", "rod"]),
            *MEASURED_FILES,
        ],
    output:
        table="results/key_numbers.csv",
        record="results/records/key_numbers.json",
    log:
        "results/logs/key_numbers.log",
    message:
        "Computing the numbers that pages state"
    conda:
        "../envs/planarimpact.yaml"
    script:
        "../scripts/find_key_numbers.py"


rule note:
    """A note on the replication of the paper, as a page and as a PDF."""
    input:
        plan=planned("note", "write_note", "pages", "figures/inelastic/drawing.py",
            "figures/shared/drawing", "ledger", "printed", "plan", "reference_data", "run",
            "judging", "verdict_tables"),
        template="workflow/report/note.html",
        parts=expand("workflow/report/{part}", part=["page.css", "note.css", "figure_table.html"]),
        shared=EVERY_PAGE,
        numbers=rules.key_numbers.output.table,
        verdicts="results/verdicts.csv",
        pictures=expand("figures/{figure}.png", figure=SHOWN),
        svgs=expand("figures/{figure}.svg", figure=SHOWN),
    output:
        page=report(
            "figures/note.html",
            caption="../report/note.rst",
            category="Ledger",
            labels={"page": "a note on the replication"},
        ),
        pdf="figures/note.pdf",
        record="results/records/note.json",
    log:
        "results/logs/note.log",
    message:
        "Writing the note"
    conda:
        "../envs/planarimpact.yaml"
    script:
        "../scripts/write_note.py"
