# Pages show what the tables of a run say. Each includes these beside its own template.
EVERY_PAGE = ["workflow/report/theme.css", "workflow/report/site.html", "workflow/report/page.css"]
NAMED = [f"{source}/{name}" for source in SOURCES for name in SOURCES[source].get("series", {})]
SERIES = {name: reference_data.reference(SOURCES, name) for name in NAMED}
# Pictures of prints under our curves, saved beside what was read there.
OVERLAYS = {name: series.overlay for name, series in SERIES.items() if series.overlay}


rule report:
    """The run as pages: the report, its sources and settings, the ledger of the paper."""
    input:
        code=["workflow/scripts/write_report.py", *SOLVER, *WRITING],
        ledger="results/ledger.csv",
        accepted=ACCEPTED,
        verdicts="results/verdicts.csv",
        residuals=expand("results/residuals/{judged}.csv", judged=FIGURES),
        curves=expand("results/curves/{figure}.csv", figure=FIGURES),
        pictures=expand("figures/{figure}.svg", figure=FIGURES),
        overlays=list(OVERLAYS.values()),
        parts=files("workflow/report/*.*"),
    output:
        report="figures/report.html",
        sources="figures/sources.html",
        ledger="figures/ledger.html",
        run="figures/run.txt",
        tables=directory("figures/tables"),  # copies, so that figures/ can be sent alone
        which_model=report("results/which_model.csv", category="Tables", caption="../report/which_model.rst"),
    log:
        "results/logs/report.log",
    conda:
        "../envs/planarimpact.yaml"
    params:
        # A function, as Snakemake takes braces in a text for a wildcard: those of formulas.
        settings=lambda _: {
            "config": config,
            "shows": SHOWS,
            "captions": {name: stated["caption"] for name, stated in figures.stated().items()},
            "slides": SLIDES,
            "sources": SOURCES,
            "overlays": OVERLAYS,
            "rows": rows_of(JUDGED),
            "grades": GRADES,
        },
    script:
        "../scripts/write_report.py"


# What a lecture, or a check of its texts, reads.
READ_BY = {
    "choosing_a_model": "results/curves/trade.csv",
    "why_a_superball_comes_back": "data/cross2014/impacts.csv",
}


rule lecture:
    """Run one lecture, with the checks of what its texts state, and write its pages."""
    input:
        code=["workflow/scripts/run_lecture.py", *SOLVER, *WRITING],
        notebook="workflow/notebooks/{notebook}.ipynb",
        tables=lambda wildcards: READ_BY.get(wildcards.notebook, []),
        style="workflow/notebooks/lecture.mplstyle",
        page="workflow/report/notebook.html",
        slides="workflow/report/slides.html",
        parts=[*EVERY_PAGE, "workflow/report/model.svg"],
    output:
        page="figures/{notebook}.html",
        slides="figures/slides_{notebook}.html",
        student="figures/student_{notebook}.ipynb",
        after="figures/after_{notebook}.ipynb",
        answers="figures/answers_{notebook}.html",
    log:
        "results/logs/lecture_{notebook}.log",
    priority: 1  # as it is long
    conda:
        "../envs/planarimpact.yaml"
    script:
        "../scripts/run_lecture.py"


rule explorer:
    """A page to throw balls and explore impacts, and the page to begin with, which shows its stage."""
    input:
        code=["workflow/scripts/write_explorer.py", *SOLVER, *WRITING],
        sources=files("workflow/explorer/*.*"),
        start="workflow/report/index.html",
        parts=EVERY_PAGE,
    output:
        page="figures/explorer.html",
        start="figures/index.html",
    log:
        "results/logs/explorer.log",
    conda:
        "../envs/planarimpact.yaml"
    params:
        settings=lambda _: settings.of_explorer(config),
    script:
        "../scripts/write_explorer.py"


rule your_copy:
    """The page to lay a copy of the paper under the curves of the run, and to read its points."""
    input:
        code=["workflow/scripts/write_your_copy.py", *WRITING],
        sources=files("workflow/your_copy/**/*.*", "workflow/explorer/files.js"),
        curves=expand("results/curves/{figure}.csv", figure=PAPER),
        parts=EVERY_PAGE,
    output:
        page="figures/your_copy.html",
    log:
        "results/logs/your_copy.log",
    conda:
        "../envs/planarimpact.yaml"
    params:
        settings=lambda _: {
            "series": SERIES,
            "allowances": {
                one.reference.name: [one.allowed("x"), one.allowed("y")]
                for one in COMPARISONS.values()
                if one.allowance
            },
            "significance": config["significance"],
        },
    script:
        "../scripts/write_your_copy.py"


# All that a job of these takes from the project.
LOGGING = files("src/stronge1994/__init__.py", "src/stronge1994/logs.py")


rule wheel:
    """The solver as one file, which lies beside the notebooks of students, who install it."""
    input:
        code=["workflow/scripts/build_wheel.py", *LOGGING],
        packages="environment.txt",
        source=[*PACKAGE, "src/planarimpact/README.md", "pyproject.toml", "LICENSE"],
    output:
        f"figures/{WHEEL}",
    log:
        "results/logs/wheel.log",
    conda:
        "../envs/planarimpact.yaml"
    script:
        "../scripts/build_wheel.py"


rule lite:
    """A web site on which the notebooks of students run in the browser. No part of `all`: it needs JupyterLite."""
    input:
        code=["workflow/scripts/build_lite.py", *LOGGING],
        packages="workflow/envs/lite.txt",
        files=[
            *rules.wheel.output,
            rules.explorer.output.page,  # which a cell shows
            *expand(rules.lecture.output.student, notebook=NOTEBOOKS),
            *expand(rules.lecture.output.after, notebook=NOTEBOOKS),
        ],
    output:
        directory("results/lite"),
    log:
        "results/logs/lite.log",
    conda:
        "../envs/planarimpact.yaml"
    params:
        pyodide_url=config["lite"]["pyodide_url"],
    script:
        "../scripts/build_lite.py"


PAGES = [
    *rules.report.output,
    *rules.explorer.output,
    *rules.your_copy.output,
    *rules.wheel.output,
    *expand(rules.lecture.output, notebook=NOTEBOOKS),
]


# All that `all` makes, but for a folder, whose date would count.
EVERYTHING = [*made(JUDGED), *(path for path in PAGES if path != rules.report.output.tables)]
