# Three lectures. A notebook that is put into workflow/notebooks/ is run and checked like them.


rule notebook:
    """Run one notebook: a lecture whose numbers are checked beside the words that state them."""
    input:
        modules=notebook_modules,
        notebook="workflow/notebooks/{notebook}.ipynb",
        style=sources("workflow/notebooks/lecture.mplstyle"),
        template=sources("workflow/report/notebook.html"),
        shared=EVERY_PAGE,
    output:
        executed="results/notebooks/{notebook}.ipynb",
        page=report(
            "figures/{notebook}.html",
            caption="../report/notebooks.rst",
            category="Teaching",
            labels={"lecture": "{notebook}"},
        ),
    log:
        "results/logs/notebook_{notebook}.log",
    benchmark:
        "results/benchmarks/notebook_{notebook}.tsv"
    message:
        "Running the notebook {wildcards.notebook}"
    conda:
        "../envs/planarimpact.yaml"
    script:
        "../scripts/run_notebook.py"
