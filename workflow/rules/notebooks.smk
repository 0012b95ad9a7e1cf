# Three lectures. A notebook that is put into workflow/notebooks/ is run and checked like them.


rule notebook:
    """Run one notebook: a lecture that checks the numbers that it states."""
    input:
        # Rooms that cells may import: the check of imports does not see their process.
        plan=planned("notebook_{notebook}", "run_notebook", "pages", "printed"),
        notebook="workflow/notebooks/{notebook}.ipynb",
        style="workflow/notebooks/lecture.mplstyle",
        page="workflow/report/notebook.html",
        slides="workflow/report/slides.html",
        cells="workflow/report/cells.html",
        drawing="workflow/report/model.svg",
        shared=EVERY_PAGE,
    output:
        executed="results/notebooks/{notebook}.ipynb",
        page=report(
            "figures/{notebook}.html",
            caption="../report/notebooks.rst",
            category="Teaching",
            labels={"lecture": "{notebook}"},
        ),
        slides="figures/slides_{notebook}.html",
        answers="figures/answers_{notebook}.html",
        record="results/records/notebook_{notebook}.json",
    log:
        "results/logs/notebook_{notebook}.log",
    message:
        "Running the notebook {wildcards.notebook}"
    conda:
        "../envs/planarimpact.yaml"
    script:
        "../scripts/run_notebook.py"
