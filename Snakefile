# Planar impact of rough compliant bodies: solve, draw, compare, judge.
#   snakemake --cores 2            everything
#   snakemake --cores 2 paper      Figs 2 to 9, drawn and judged
#   snakemake --cores 2 fig6       one figure: each has such a target
#   snakemake --cores 2 figures    pictures only, without judging
#   snakemake --cores 2 accept     accept what the run has found: writes data/accepted/verdicts.csv
from snakemake.utils import min_version

min_version("9.0")


include: "workflow/rules/common.smk"
include: "workflow/rules/solving.smk"
include: "workflow/rules/drawing.smk"
include: "workflow/rules/pages.smk"
include: "workflow/rules/judging.smk"


rule all:
    """Everything, if it passes the gate."""
    default_target: True
    input:
        rules.gate.output,
        # What is missing is made again only if it is asked for here.
        EVERYTHING,
        rules.report.output.tables,
        expand("results/verdicts/{judged}.csv", judged=JUDGED),
        "results/verdicts.csv",
        "results/ledger.csv",


rule figures:
    """Pictures only, without judging, and without those that take long as they measure time."""
    input:
        made([figure for figure in FIGURES if figure not in TIMED]),


rule notebooks:
    """The lectures alone: notebooks run from the first cell to the last, as pages."""
    input:
        "results/curves/trade.csv",
        rules.wheel.output,
        expand(rules.lecture.output, notebook=NOTEBOOKS),


for target, names in TARGETS.items():
    if workflow.is_rule(target):
        raise WorkflowError(f"{figures.folder_of(target)}: a rule has this name, give it another")

    rule:
        """Drawn, and judged as `all` is, by its own rows."""
        name:
            target
        input:
            f"results/gates/{target}.txt",
            made(names),


# In one piece, as Snakemake writes to the same terminal at the same time.
STOPPED = """
Stopped before the end, or a check has failed: it says so above. What was finished
is kept; the same command goes on. Usual causes: workflow/README.md, Troubleshooting.
"""


onstart:
    # What a gate said in an earlier run is not said of this one.
    for path in Path("results/logs").glob("gate*.log"):
        path.unlink()


onsuccess:
    for path in sorted(Path("results/logs").glob("gate*.log")):
        print(path.read_text(encoding="utf-8"), end="")


onerror:
    print(STOPPED, end="")
