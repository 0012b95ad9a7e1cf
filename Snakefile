# Planar impact of rough compliant bodies: solve, draw, compare, judge.
#   snakemake --cores 2            everything, up to the verdict
#   snakemake --cores 2 figures    pictures only, without judging
from snakemake.utils import min_version

min_version("9.0")


configfile: "workflow/config.yaml"


include: "workflow/rules/common.smk"


# Seconds each: on a cluster they run where snakemake does, not in the queue.
localrules:
    all,
    figures,
    notebooks,
    series,
    draw,
    compare,
    verdicts,
    ledger_page,
    trade,
    stability,
    gather_chunks,
    study,
    explorer,
    report,
    gate,


rule all:
    """Everything, up to the verdict: what runs if no target is named."""
    input:
        "results/PASSED",


rule figures:
    """Pictures only, without judging."""
    input:
        expand("figures/{figure}.{kind}", figure=run_plan.FIGURES, kind=["svg", "png"]),


rule notebooks:
    """The lectures alone: notebooks run from the first cell to the last, as pages."""
    input:
        notebook_pages,


include: "workflow/rules/curves.smk"
include: "workflow/rules/reference.smk"
include: "workflow/rules/drawing.smk"
include: "workflow/rules/ledger.smk"
include: "workflow/rules/trade.smk"
include: "workflow/rules/stability.smk"
include: "workflow/rules/scene.smk"
include: "workflow/rules/study.smk"
include: "workflow/rules/report.smk"
include: "workflow/rules/explorer.smk"
include: "workflow/rules/notebooks.smk"
include: "workflow/rules/judgement.smk"
include: "workflow/rules/peers.smk"


onsuccess:
    print(closing.words(STARTED))


onerror:
    print(closing.words(STARTED, stopped=True))
    # What an earlier run passed need not hold for what this one has left.
    Path("results/PASSED").unlink(missing_ok=True)
