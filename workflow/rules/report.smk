# Templates of both pages, what they include, and captions.
REPORT_PARTS = [
    "workflow/report/sources.html",
    "workflow/report/figure_table.html",
    "workflow/report/summary.html",
    "workflow/report/model.svg",
    *expand("workflow/report/{part}.css", part=["page", "report"]),
    *expand("workflow/report/{part}.rst", part=["trade", "which_model"]),
]


REPORT_SETTINGS = {
    "captions": CAPTIONS,
    "config": {
        key: config[key]
        for key in ("mass_ratio", "stiffness_ratio", "figures", "significance", "comparisons")
    } | {"slides": SLIDES},
    "sources": SOURCES,
    **EXPECTED,
}


rule report:
    """The run as one page, its sources and settings as another; written after failures, too."""
    input:
        plan=planned("report", "write_report", "pages", "figures/inelastic/trials.py",
            "figures/shared/drawing", "judging", "verdict_tables", "ledger", "printed", "plan",
            "reference_data", "run", settings=lambda _: REPORT_SETTINGS),
        template="workflow/report/report.html",
        parts=REPORT_PARTS,
        shared=EVERY_PAGE,
        verdicts="results/verdicts.csv",
        residuals=expand("results/residuals/{figure}.csv", figure=FIGURES),
        pictures=expand("figures/{figure}.svg", figure=FIGURES),
        ledger="results/ledger.csv",
        numbers=rules.note.output.numbers,
        answers=rules.trade_tables.output.answers,
        linked=[
            "results/verdicts.csv",
            "results/trade.csv",
            "results/which_model.csv",
            *expand("results/{kind}/{figure}.csv", kind=["curves", "residuals"], figure=FIGURES),
        ],
        records=[expand(rule.output.record, **VALUES) for rule in (rules.curves, rules.draw,
            rules.judge, rules.gather, rules.scene, rules.ledger, rules.trade_tables, rules.note)],
    output:
        page="figures/report.html",
        sources="figures/sources.html",
        tables=directory("figures/tables"),  # copies, so that figures/ can be sent alone
        problems="results/problems.csv",
        record="results/records/report.json",
    log:
        "results/logs/report.log",
    message:
        "Writing the report"
    conda:
        "../envs/planarimpact.yaml"
    script:
        "../scripts/write_report.py"
