# Planar impact of rough compliant bodies: solve, draw, compare, judge.
#   snakemake --cores 2            everything
#   snakemake --cores 2 paper      Figs 2 to 9, drawn and judged
#   snakemake --cores 2 fig6       one figure: each has such a target
#   snakemake --cores 2 figures    pictures only, without judging
from snakemake.utils import min_version

min_version("9.0")


include: "workflow/rules/common.smk"
include: "workflow/rules/solving.smk"
include: "workflow/rules/drawing.smk"
include: "workflow/rules/judging.smk"
include: "workflow/rules/pages.smk"


rule all:
    """Everything. It has no output, so it always runs, and fails if a row of the tables does."""
    default_target: True
    input:
        verdicts=expand("results/verdicts/{judged}.csv", judged=JUDGED),
        ledger="results/ledger.csv",
        accepted="data/accepted/verdicts.csv",
        made=made(JUDGED),
        pages=PAGES,
    log:
        "results/logs/all.log",
    conda:
        "workflow/envs/planarimpact.yaml"
    params:
        rows=rows_of(JUDGED),
        entries=ENTRIES,
    script:
        "workflow/scripts/gate.py"


rule figures:
    """Pictures only, without judging, and without those that take long as they measure time."""
    input:
        made([figure for figure in FIGURES if figure not in TIMED]),


rule notebooks:
    """The lectures alone: notebooks run from the first cell to the last, as pages."""
    input:
        "results/curves/trade.csv",
        expand(rules.lecture.output, notebook=NOTEBOOKS),


# What can be asked for alone: Figs 2 to 9, each figure, each scene.
for target, names in [("paper", PAPER), *((name, [name]) for name in JUDGED)]:
    if workflow.is_rule(target):
        raise WorkflowError(f"{figures.folder_of(target)}: a rule has this name, give it another")

    rule:
        """Drawn, and judged as `all` is, by its own rows."""
        name:
            target
        input:
            verdicts=expand("results/verdicts/{judged}.csv", judged=names),
            accepted="data/accepted/verdicts.csv",
            made=made(names),
        log:
            f"results/logs/{target}.log",
        conda:
            "workflow/envs/planarimpact.yaml"
        params:
            rows=rows_of(names),
        script:
            "workflow/scripts/gate.py"


onstart:
    print(notice(), end="")


onsuccess:
    print(summary(stopped=False))


onerror:
    print(summary(stopped=True))
