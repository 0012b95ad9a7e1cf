# Planar impact of rough compliant bodies: solve, draw, compare, judge.
#   snakemake --cores 2            everything, up to the verdict
#   snakemake --cores 2 figures    pictures only, without judging
from snakemake.io import strip_wildcard_constraints
from snakemake.logging import logger
from snakemake.utils import min_version

min_version("9.0")


include: "workflow/rules/start.smk"


configfile: "workflow/config.yaml"
configfile: "workflow/comparisons.yaml"


include: "workflow/rules/common.smk"


# Seconds each: on a cluster they run where snakemake does, not in the queue.
localrules:
    all,
    figures,
    measurements,
    notebooks,
    study,
    peers,
    sphere_tables,
    series,
    draw,
    compare,
    verdicts,
    ledger_page,
    letter,
    trade,
    stability,
    gather_chunks,
    draw_study,
    explorer,
    interface,
    report,
    gate,


# What can be asked for; `all` stands below. Each target names the files on the way to it too: after a
# job has failed, Snakemake makes a missing one anew only if it is asked for.
rule figures:
    """Pictures only, without judging, and without those that take long as they measure time."""
    input:
        expand("results/curves/{figure}.csv", figure=UNTIMED),
        expand("figures/{figure}.{kind}", figure=UNTIMED, kind=["svg", "png"]),


rule measurements:
    """Pictures of error against time, measured on this machine, without judging."""
    input:
        expand("results/curves/{figure}.csv", figure=plan.TIMED),
        expand("figures/{figure}.{kind}", figure=plan.TIMED, kind=["svg", "png"]),


rule notebooks:
    """The lectures alone: notebooks run from the first cell to the last, as pages."""
    input:
        expand("results/notebooks/{notebook}.ipynb", notebook=NOTEBOOKS),
        expand("figures/{notebook}.html", notebook=NOTEBOOKS),


rule study:
    """The parameter study alone: its grid solved and drawn."""
    input:
        gather.study("results/study/{scatteritem}.npz"),
        "results/study.npz",
        expand("figures/study.{kind}", kind=["svg", "png"]),


rule peers:
    """Error against time with LAMMPS and pooltool, where they are installed."""
    input:
        "results/curves/trade.csv",
        "results/peers.csv",
        expand("figures/{figure}.{kind}", figure=["trade_with_peers", "peers"], kind=["svg", "png"]),


rule sphere_tables:
    """The tables of spheres that the package brings along, made anew."""
    input:
        expand("results/spheres/{table}.npz", table=["fine", "coarse"]),


include: "workflow/rules/curves.smk"
include: "workflow/rules/reference.smk"
include: "workflow/rules/drawing.smk"
include: "workflow/rules/ledger.smk"
include: "workflow/rules/letter.smk"
include: "workflow/rules/trade.smk"
include: "workflow/rules/stability.smk"
include: "workflow/rules/scene.smk"
include: "workflow/rules/study.smk"
include: "workflow/rules/notebooks.smk"
include: "workflow/rules/explorer.smk"
include: "workflow/rules/report.smk"
include: "workflow/rules/judging.smk"
include: "workflow/rules/peers.smk"
include: "workflow/rules/spheres.smk"


rule all:
    """Everything, up to the verdict: what runs if no target is named."""
    default_target: True
    input:
        "results/PASSED",
        MADE,


# Snakemake runs a job again if an input is newer than its output. Files from an archive or a backup
# may be other ones and yet older, so what they hold is a parameter of every rule.
for maker in workflow.rules:
    if maker.output:
        maker.set_params(content=content_of(maker))


if workflow.is_main_process:
    try:
        gate.refuse_unknown_results(MADE)
    except RuntimeError as error:
        raise refused(error)
if STARTED_HERE:
    gate.drop_false_pass(MADE, config)
    BEFORE = closing.state()
    logger.addFilter(closing.add_unlock)


# Logs and benchmarks of every job that there can be.
WORDS_OF_JOBS = expand(
    [
        strip_wildcard_constraints(path)
        for rule in workflow.rules
        for path in [*rule.log, rule.benchmark]
        if path
    ],
    **VALUES,
)


onstart:
    closing.start(set(WORDS_OF_JOBS))


onsuccess:
    print(closing.words(BEFORE, workflow.config_settings.config_args or ()))


onerror:
    print(closing.words(BEFORE, workflow.config_settings.config_args or (), stopped=True, logs=log))
