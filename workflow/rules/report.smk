# What else the run leaves beside the report, in figures/.
BESIDE = {
    "explorer.html": "Explorer: an impact to play with",
    **{f"{notebook}.html": f"Lecture: {notebook.replace('_', ' ')}" for notebook in NOTEBOOKS},
    "study.svg": "Parameter study",
    "ledger.html": "The paper verified, as a page of its own",
}


rule report:
    """The run as one page; always succeeds, whatever its verdicts, tables and modules."""
    input:
        modules=run_plan.modules("write_report"),
        interface=sorted(str(path) for path in Path("src/planarimpact").rglob("*.py")),
        template=sources("workflow/report/report.html"),
        parts=sources(
            *expand(
                "workflow/report/{part}", part=["ledger_parts.html", "page.css", "report.css"]
            )
        ),
        captions=sources("workflow/report/figures.rst"),
        table_captions=sources(
            *expand("workflow/report/{table}.rst", table=["trade", "which_model", "stability"])
        ),
        verdicts="results/verdicts.csv",
        residuals=expand("results/residuals/{figure}.csv", figure=FIGURES),
        pictures=expand("figures/{figure}.svg", figure=FIGURES),
        ledger="results/ledger.csv",
        tables=[*rules.trade.output, *rules.stability.output],
    output:
        page="figures/report.html",
        problems="results/problems.csv",
    params:
        figures=list(FIGURES),
        config={
            key: config[key]
            for key in ("mass_ratio", "stiffness_ratio", "figures", "comparisons")
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
