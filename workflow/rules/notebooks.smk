# Three lectures. A notebook that is put into workflow/notebooks/ is run and checked like them.

# Tables of the run that a lecture reads. On the site they are copies in tables/.
TABLES_OF_LECTURES = {"choosing_a_model": ["results/trade.csv"]}


rule lectures:
    """Run every notebook: a lecture that checks the numbers that it states."""
    input:
        # Cells import the solver alone, so that a notebook runs where only that is installed.
        plan=planned("lectures", "run_lectures", "pages",
            settings=lambda _: TABLES_OF_LECTURES),
        notebooks=expand("workflow/notebooks/{notebook}.ipynb", notebook=NOTEBOOKS),
        tables=[table for notebook in NOTEBOOKS for table in TABLES_OF_LECTURES.get(notebook, [])],
        style="workflow/notebooks/lecture.mplstyle",
        page="workflow/report/notebook.html",
        slides="workflow/report/slides.html",
        cells="workflow/report/cells.html",
        drawing="workflow/report/model.svg",
        shared=EVERY_PAGE,
    output:
        executed=expand("results/notebooks/{notebook}.ipynb", notebook=NOTEBOOKS),
        page=[
            report(
                f"figures/{notebook}.html",
                caption="../report/notebooks.rst",
                category="Teaching",
                labels={"lecture": notebook},
            )
            for notebook in NOTEBOOKS
        ],
        slides=expand("figures/slides_{notebook}.html", notebook=NOTEBOOKS),
        answers=expand("figures/answers_{notebook}.html", notebook=NOTEBOOKS),
        record="results/records/lectures.json",
    log:
        "results/logs/lectures.log",
    priority: 1  # as it is long
    message:
        "Running the lectures"
    conda:
        "../envs/planarimpact.yaml"
    script:
        "../scripts/run_lectures.py"
