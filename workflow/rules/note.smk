# Figures that the note shows.
SHOWN = ["fig5", "inelastic", "rubber_sphere", "yielding"]


# Measured and computed series of which the note states numbers.
MEASURED = {
    "pairs": SOURCES["cornell1999"]["series"]["pairs"],
    "runs": SOURCES["finite_elements"]["series"]["spheres"],
}


rule note:
    """A note on the replication of the paper, and the table of the numbers that it states."""
    input:
        plan=planned("note", "write_note", "pages", "figures/inelastic/trials.py",
            "ledger", "printed", "plan", "reference_data", "run", "judging", "verdict_tables",
            settings=lambda _: MEASURED,
            reads=lambda _: [series["path"] for series in MEASURED.values()]),
        template="workflow/report/note.html",
        parts=expand("workflow/report/{part}",
            part=["page.css", "note.css", "figure_table.html", "summary.html"]),
        shared=EVERY_PAGE,
        tables=[
            "results/verdicts.csv",
            "results/ledger.csv",
            "results/in_nature.csv",
            *expand("results/curves/{figure}.csv", figure=SHOWN),
        ],
        pictures=expand("figures/{figure}.svg", figure=SHOWN),
    output:
        page="figures/note.html",
        numbers="results/key_numbers.csv",
        record="results/records/note.json",
    log:
        "results/logs/note.log",
    message:
        "Writing the note"
    conda:
        "../envs/planarimpact.yaml"
    script:
        "../scripts/write_note.py"
