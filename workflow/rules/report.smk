# What else the run leaves beside the report, in figures/.
BESIDE = {
    "explorer.html": "Explorer: an impact to play with",
    **{f"{notebook}.html": f"Lecture: {notebook.replace('_', ' ')}" for notebook in NOTEBOOKS},
    "study.svg": "Parameter study",
    "ledger.html": "The paper verified, as a page of its own",
}


rule report:
    """The run as one page; always succeeds, whatever its verdicts."""
    input:
        modules=run_plan.modules("write_report"),
        interface=sorted(str(path) for path in Path("src/planarimpact").rglob("*.py")),
        template="workflow/report/report.html",
        parts=expand(
            "workflow/report/{part}", part=["ledger_parts.html", "page.css", "report.css"]
        ),
        captions="workflow/report/figures.rst",
        table_captions=expand(
            "workflow/report/{table}.rst", table=["trade", "which_model", "stability"]
        ),
        verdicts="results/verdicts.csv",
        residuals=expand("results/residuals/{figure}.csv", figure=run_plan.FIGURES),
        pictures=expand("figures/{figure}.svg", figure=run_plan.FIGURES),
        ledger="results/ledger.csv",
        tables=[*rules.trade.output, *rules.stability.output],
    output:
        "figures/report.html",
    params:
        figures=run_plan.FIGURES,
        config={
            key: config[key]
            for key in ("mass_ratio", "stiffness_ratio", "figures", "comparisons")
        },
        sources=SOURCES,
        symbols=SYMBOLS,
        links=BESIDE,
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
