# Planar impact of rough compliant bodies: solve, draw, compare, judge.
#   snakemake --cores 2            everything, up to the verdict
#   snakemake --cores 2 fig6       one figure, drawn and judged: each has its target
#   snakemake --cores 2 figures    pictures only, without judging
from snakemake.logging import logger
from snakemake.utils import min_version

min_version("9.0")


include: "workflow/rules/start.smk"


configfile: "workflow/config.yaml"


include: "workflow/rules/common.smk"


# Seconds each: on a cluster they run where snakemake does, not in the queue.
localrules:
    all,
    figures,
    notebooks,
    draw,
    draw_with_slide,
    judge,
    gather,
    ledger_page,
    note,
    trade_tables,
    explorer,
    report,
    site,


# What can be asked for; `all` stands below. Each target names the files on the way to it too: after a
# job has failed, Snakemake makes a missing one anew only if it is asked for.
rule figures:
    """Pictures only, without judging, and without those that take long as they measure time."""
    input:
        expand("results/curves/{figure}.csv", figure=UNTIMED),
        expand("figures/{figure}.{kind}", figure=UNTIMED, kind=["svg", "png"]),
        slides_of(UNTIMED),


rule notebooks:
    """The lectures alone: notebooks run from the first cell to the last, as pages."""
    input:
        expand("results/notebooks/{notebook}.ipynb", notebook=NOTEBOOKS),
        expand("figures/{notebook}.html", notebook=NOTEBOOKS),


include: "workflow/rules/curves.smk"
include: "workflow/rules/drawing.smk"
include: "workflow/rules/scene.smk"
include: "workflow/rules/judging.smk"
include: "workflow/rules/ledger.smk"
include: "workflow/rules/note.smk"
include: "workflow/rules/trade.smk"
include: "workflow/rules/notebooks.smk"
include: "workflow/rules/explorer.smk"
include: "workflow/rules/report.smk"


# Every rule whose files a run makes: the gate asks for all of them, wanted by others or not.
MAKERS = [
    rules.curves,
    rules.draw,
    rules.judge,
    rules.gather,
    rules.ledger,
    rules.ledger_page,
    rules.note,
    rules.trade_tables,
    rules.scene,
    rules.lecture,
    rules.explorer,
    rules.report,
]
MADE = expand([f"{path}" for maker in MAKERS for path in maker.output], **VALUES) + slides_of(FIGURES)


include: "workflow/rules/site.smk"


# One target a figure or scene: it is drawn and judged, its rows are printed, and it fails alone.
for name in JUDGED:

    rule:
        name:
            name
        input:
            plan=planned(f"judged_{name}", "gate", "run", "judging", "verdict_tables", "ledger", "reference_data",
                settings=lambda _: {"table": f"results/verdicts/{name}.csv", "comparisons": JUDGED[name]["rows"]}),
            made=files_of_one(name),
        params:
            plans=plans.digest(PLANNED),
            jobs=list(PLANNED),
        localrule: True
        log:
            plans.ALONE.format(name),
        message:
            f"Judging {name} alone"
        conda:
            "workflow/envs/planarimpact.yaml"
        script:
            "workflow/scripts/gate.py"


rule all:
    """Everything, up to the verdict: what runs if no target is named.

    This is the gate. It has no output, so each such run ends with it: it reads all records and tables
    anew, and fails if a file is not as its job left it, or a row diverges or is missing.
    """
    default_target: True
    input:
        plan=planned("all", "gate", "run", "judging", "verdict_tables", "ledger", "reference_data",
            settings=lambda _: EXPECTED),
        made=MADE,
    params:
        plans=plans.digest(PLANNED),
        jobs=PLANNED,
    log:
        plans.GATE_LOG,
    message:
        "Judging"
    conda:
        "workflow/envs/planarimpact.yaml"
    script:
        "workflow/scripts/gate.py"


TARGETS = ["all", *JUDGED, "figures", "notebooks", "site"]
if workflow.is_main_process:
    logger.addFilter(last_words.Help(TARGETS))


onstart:
    record.begin(sum(1 for job in workflow.dag.needrun_jobs() if job.output))


onsuccess:
    print(last_words.text(workflow.config_settings.config_args or (), logs=log))
    if record.all_errors():  # no gate was asked for
        raise WorkflowError("a job has failed")


onerror:
    print(last_words.text(workflow.config_settings.config_args or (), stopped=True, logs=log))
