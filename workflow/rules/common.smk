# What the rules share: settings, checked before any work, values of wildcards, and functions for inputs.
import json
import logging
import os
import shlex
import sys
import time
from pathlib import Path

from snakemake.exceptions import WorkflowError

# Every job takes the packages from this folder, wherever else they may be installed.
sys.path.insert(0, f"{workflow.basedir}/src")
os.environ.update(PYTHONPATH=sys.path[0])
# Snakemake puts this path into the command of a script without quotes (its issue 2645): the blanks of a
# folder `OneDrive - NTNU` would break it.
sys.executable = shlex.quote(sys.executable)
# Where a job could not begin its log, on a full disk, the logger of the profile would show its own traceback.
logging.raiseExceptions = False
# Ctrl-C ends a job once it has its log, see `stronge1994.logs`; before that it would fill the terminal.
shell.prefix("set -euo pipefail; trap '' INT; ")
import planarimpact
from stronge1994 import gate, imports, reference_data, settings, versions
from stronge1994.names import is_of_paper
from stronge1994.ledger import entries
from stronge1994.settings import config as configuration
from stronge1994.settings import figures

if set("{}") & set(workflow.basedir):
    raise WorkflowError(f"{workflow.basedir}: Snakemake takes braces for a wildcard: rename the folder")
# Snakemake would end the first job that reads such a file, and remove what the job has made.
FOLDERS = ["data", "figures", "results", "src", "workflow"]
LATER = [
    path
    for folder in FOLDERS
    for path in Path(folder).rglob("*.*")
    if path.is_file() and path.stat().st_mtime > time.time()
]
if LATER:
    mend = f"find {' '.join(FOLDERS)} -newermt now -exec touch {{}} +" if LATER[1:] else f"touch {LATER[0]}"
    others = f", so do those of {len(LATER) - 1} others" if LATER[1:] else ""
    raise WorkflowError(f"{LATER[0]}: its date lies in the future{others}. Give today's date: {mend}")
LEDGER = "data/stronge1994/ledger.yaml"
try:
    # In place of `configfile:`: workflow/config.yaml over each figure.yaml, --configfile and --config over
    # both. They are read as strict YAML; what Snakemake makes of --config is not used.
    config = configuration.load(
        [configuration.FILE, *workflow.config_settings.configfiles],
        workflow.config_settings.config_args or (),
    )
    SOURCES = reference_data.load_all("data", reference_data.load_yaml("workflow/schemas/source.schema.yaml"))
    OF_LEDGER = entries.load(LEDGER, reference_data.load_yaml("workflow/schemas/ledger.schema.yaml"))
    ENTRIES = list(OF_LEDGER)
    configuration.check_config(config, SOURCES, ENTRIES)
    FIGURES = {name: settings.of_figure(config, SOURCES, name) for name in config["figures"]}
    JUDGED = {name: settings.of_judgement(config, SOURCES, name) for name in configuration.judged(config)}
except reference_data.SourceError as error:
    raise WorkflowError(str(error))

PAPER = [figure for figure in FIGURES if is_of_paper(figure)]
TIMED, SLIDES = figures.with_trait("timed"), figures.with_trait("slide")  # as figure.yaml says
NOTEBOOKS = sorted(path.stem for path in Path("workflow/notebooks").glob("*.ipynb"))


wildcard_constraints:
    figure="|".join(FIGURES),
    judged="|".join(JUDGED),
    scene="|".join(config["scenes"]) or "none",
    notebook="|".join(NOTEBOOKS) or "none",


def digest(*paths):
    """A param: one hash of all code of a job, so that Snakemake runs it again if a module has changed.

    `paths` are files or folders, with wildcards in braces, or functions of the wildcards. What they
    import from src counts too, directly or not: see `stronge1994.imports`. A file of data/ is an input, by
    its date, and stands here, too: a copy that replaces it may have an older date.
    """

    def of_job(wildcards):
        given = [path(wildcards) if callable(path) else [path.format(**wildcards)] for path in paths]
        return imports.digest(sum(given, []))

    return of_job


def code_of(part):
    """The `curves` or the `drawing` of a figure, for `digest`."""
    return lambda wildcards: [f"{figures.folder_of(wildcards.figure)}/{part}.py"]


def of_figure(part):
    """A part of `settings.of_figure`: settings of curves and drawing, `tables` to solve, `series` to draw."""
    return lambda wildcards: FIGURES[wildcards.figure][part]


def of_judged(part):
    """A part of `settings.of_judgement`: settings, `table` of curves or of a scene, `series` to compare."""
    return lambda wildcards: JUDGED[wildcards.judged][part]


def made(names):
    """Tables and pictures of figures and scenes, and all on the way to them.

    A failed job removes its files. Snakemake makes a missing one again only if it is asked for: else it
    is content with what an earlier run has made of it.
    """
    drawn = [name for name in names if name in FIGURES]
    slides = [name for name in SLIDES if name in names]
    return [
        *rules.versions.output,
        *(JUDGED[name]["table"] for name in names),
        *expand("figures/{figure}.{kind}", figure=drawn, kind=["svg", "png"]),
        *expand("figures/slides/{figure}_{ground}.png", figure=slides, ground=["light", "dark"]),
    ]


def rows_of(names):
    """Names of the comparisons of some figures or scenes."""
    return [title for name in names for title in JUDGED[name]["settings"]["comparisons"]]


def priority(wildcards):
    """The figures of the paper come first, in its order."""
    name = wildcards.get("figure") or wildcards.judged
    return 20 - PAPER.index(name) if name in PAPER else 0


def summary(stopped):
    """What the run says at its end, by the tables that are up to date then.

    Snakemake's graph of jobs tells which. It is no public interface: so Snakemake is pinned.
    """
    jobs, dag = list(workflow.dag.jobs), workflow.dag
    failed = [job for job in workflow.scheduler.failed if job.output]  # but for the gates
    done = {path for job in set(jobs) - set(dag.needrun_jobs()) for path in job.output}
    targets = {"all": JUDGED, "paper": PAPER} | {name: [name] for name in JUDGED}
    gates = {job.rule.name: job for job in jobs if job.rule.name in targets}
    judged = {name for target in gates for name in targets[target]}
    tables = {name: f"results/verdicts/{name}.csv" for name in JUDGED if name in judged}
    tables = {name: table for name, table in tables.items() if table in done}
    return gate.summary(
        list(tables.values()),
        rows_of(tables),
        ENTRIES if "all" in gates and gate.LEDGER in done else [],
        {name: figures.stated()[name]["shows"] for name in PAPER},
        {f"{job.name} {' '.join(job.wildcards)}".strip(): f"{job.log}" for job in failed},
        {name for name, job in gates.items() if dag.finished(job) and not workflow.touch},
        stopped,
        workflow.config_settings.config_args or [],
        [path for job in dag.targetjobs for path in job.output if path in done],
    )


def notice():
    """What a run says before it begins, if it is long and was not asked for by the main command."""
    if any(job.rule.name == "site" for job in workflow.dag.needrun_jobs()):
        return "site: where nothing is made yet, all pages take five minutes of processor time.\n"
    return ""
