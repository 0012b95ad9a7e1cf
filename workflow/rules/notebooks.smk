# Three lectures. A notebook that is put into workflow/notebooks/ is run and checked like them.

# Tables of the run that a lecture reads. On the site they are copies in tables/.
TABLES_OF_LECTURES = {"choosing_a_model": ["results/trade.csv"]}


rule lecture:
    """Run one notebook: a lecture that checks the numbers that it states."""
    input:
        # Cells import the solver alone, so that a notebook runs where only that is installed.
        plan=planned("lecture_{notebook}", "run_lecture", "pages/__init__.py", "pages/lectures.py"),
        notebook="workflow/notebooks/{notebook}.ipynb",
        tables=lambda wildcards: TABLES_OF_LECTURES.get(wildcards.notebook, []),
        style="workflow/notebooks/lecture.mplstyle",
        page="workflow/report/notebook.html",
        slides="workflow/report/slides.html",
        drawing="workflow/report/model.svg",
        shared=EVERY_PAGE,
    output:
        executed="results/notebooks/{notebook}.ipynb",
        page="figures/{notebook}.html",
        slides="figures/slides_{notebook}.html",
        answers="figures/answers_{notebook}.html",
        record="results/records/lecture_{notebook}.json",
    log:
        "results/logs/lecture_{notebook}.log",
    priority: 1  # as it is long
    message:
        "Running the lecture {wildcards.notebook}"
    conda:
        "../envs/planarimpact.yaml"
    script:
        "../scripts/run_lecture.py"
