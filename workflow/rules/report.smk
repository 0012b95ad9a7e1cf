# What else the run leaves beside the report, in figures/.
BESIDE = {
    "explorer.html": "Explorer: an impact to play with",
    **{f"{notebook}.html": f"Lecture: {notebook.replace('_', ' ')}" for notebook in NOTEBOOKS},
    "study.svg": "Parameter study",
    "ledger.html": "The paper verified, as a page of its own",
    "below_e_1.html": "A letter to the author: does his model apply below e = 1?",
    "interface/planarimpact.html": "Interface of the solver: what each function takes and returns",
}


# The template, what it includes, and captions.
REPORT_PARTS = sources(
    *expand("workflow/report/{part}.html", part=["report", "ledger_parts"]),
    *expand("workflow/report/{part}.css", part=["page", "report"]),
    *expand("workflow/report/{part}.rst", part=["figures", "trade", "which_model", "stability", "sensitivity"]),
)


# Times of LAMMPS and pooltool, once `snakemake peers` has measured them.
PEERS = ["results/peers.csv"] if Path("results/peers.csv").exists() else []


rule interface:
    """What the functions of the solver take and return, as pages made from their docstrings."""
    input:
        modules=modules("write_interface", *interface.documented()),
        names="src/planarimpact/__init__.pyi",
    output:
        directory("figures/interface"),
    log:
        "results/logs/interface.log",
    benchmark:
        "results/benchmarks/interface.tsv"
    message:
        "Writing the interface of the solver"
    conda:
        "../envs/planarimpact.yaml"
    script:
        "../scripts/write_interface.py"


rule report:
    """The run as one page; always succeeds, whatever its verdicts, tables and modules."""
    input:
        modules=modules("write_report"),
        template="workflow/report/report.html",
        captions="workflow/report/figures.rst",
        parts=REPORT_PARTS,
        shared=EVERY_PAGE,
        verdicts="results/verdicts.csv",
        residuals=expand("results/residuals/{figure}.csv", figure=FIGURES),
        pictures=expand("figures/{figure}.svg", figure=FIGURES),
        ledger="results/ledger.csv",
        tables=[*rules.trade.output, *rules.stability.output, "results/sensitivity.csv", *PEERS],
    output:
        page="figures/report.html",
        problems="results/problems.csv",
    params:
        figures=list(FIGURES),
        config={
            key: config[key]
            for key in ("mass_ratio", "stiffness_ratio", "figures", "significance", "comparisons")
        },
        sources=SOURCES,
        symbols=SYMBOLS,
        links=BESIDE,
        comparisons=EXPECTED_ROWS,
        entries=EXPECTED_ENTRIES,
    log:
        "results/logs/report.log",
    benchmark:
        "results/benchmarks/report.tsv"
    message:
        "Writing the report"
    conda:
        "../envs/planarimpact.yaml"
    script:
        "../scripts/write_report.py"
