# What the rules share: settings, checked before any work, values of wildcards, and functions for inputs.
import logging
import os
import shlex
import sys
from datetime import datetime
from pathlib import Path

from snakemake.exceptions import WorkflowError
from snakemake.logging import logger
from snakemake_interface_logger_plugins.common import LogEvent

if Path.cwd().resolve() != Path(workflow.basedir).resolve():
    raise WorkflowError(
        f"this command belongs into the folder of the project: cd {shlex.quote(workflow.basedir)}"
    )
if set("{}") & set(workflow.basedir):
    raise WorkflowError(f"{workflow.basedir}: Snakemake takes braces for a wildcard: rename the folder")

# Every job takes the packages from this folder, wherever else they may be installed.
sys.path.insert(0, f"{workflow.basedir}/src")
os.environ.update(PYTHONPATH=sys.path[0])
# Snakemake puts this path into the command of a script without quotes (its issue 2645): the blanks of a
# folder `OneDrive - NTNU` would break it.
sys.executable = shlex.quote(sys.executable)
from stronge1994 import ledger_table, reference_data, settings
from stronge1994.names import is_of_paper
from stronge1994.settings import config as configuration
from stronge1994.settings import figures
from stronge1994.versions import WHEEL

ACCEPTED = "data/accepted/verdicts.csv"
try:
    # In place of `configfile:`: workflow/config.yaml over each figure.yaml, --configfile and --config over
    # both. They are read as strict YAML; what Snakemake makes of --config is not used.
    config = configuration.load(
        [configuration.FILE, *workflow.config_settings.configfiles],
        workflow.config_settings.config_args or (),
    )
    from stronge1994 import paper  # which refuses an entry that is not complete

    SOURCES = reference_data.load_all("data")
    ENTRIES = paper.entries(SOURCES["stronge1994"]["facts"])
    COMPARISONS = configuration.comparisons(config, SOURCES, ENTRIES)
    FIGURES = {name: settings.of_figure(config, SOURCES, COMPARISONS, name) for name in config["figures"]}
    JUDGED = {name: settings.of_judgement(config, COMPARISONS, name) for name in configuration.judged(config)}
except (reference_data.SourceError, ledger_table.EntryError) as error:
    raise WorkflowError(str(error))

PAPER = [figure for figure in FIGURES if is_of_paper(figure)]
SHOWS = {figure: stated["shows"] for figure, stated in figures.stated().items()}
GRADES = {name: entry.words.get("grade", "") for name, entry in ENTRIES.items()}
TIMED, SLIDES = figures.with_trait("timed"), figures.with_trait("slide")  # as figure.yaml says
NOTEBOOKS = sorted(path.stem for path in Path("workflow/notebooks").glob("*.ipynb"))
# What can be asked for alone, and what it judges: Figs 2 to 9, the ledger, each figure, each scene.
TARGETS = {"paper": PAPER, "ledger": []} | {name: [name] for name in JUDGED}


wildcard_constraints:
    figure="|".join(FIGURES),
    judged="|".join(JUDGED),
    scene="|".join(config["scenes"]) or "none",
    notebook="|".join(NOTEBOOKS) or "none",
    target="|".join(TARGETS),


# Code is an input like any other. Its content counts, not its date, see max-checksum-file-size in the profile.
# Groups are coarse, as a whole run takes little; tests/workflow/test_code_inputs.py finds what they lack.
def files(*patterns):
    """Files by patterns, without bytecode, documents and the hidden files of editors."""
    paths = [path for pattern in patterns for path in Path().glob(pattern) if path.is_file()]
    return sorted(str(path) for path in paths if path.suffix not in (".pyc", ".md") and path.name[0] != ".")


COMMON = files("src/planarimpact/*.py", "src/planarimpact/common/*", "src/stronge1994/*.py")
COMMON += files(
    "src/stronge1994/figures/*.py", "src/stronge1994/studies/*.py", "src/stronge1994/reference_data/*"
)
PACKAGE = files("src/planarimpact/**/*")
SOLVER = [*PACKAGE, "environment.txt"]  # another version of a package solves again
SOLVING = [*SOLVER, *COMMON, *files("src/stronge1994/printed/*", "src/stronge1994/figures/shared/curves/*")]
DRAWING = [*COMMON, *files("src/stronge1994/figures/shared/drawing/*")]
JUDGING = [*COMMON, *files("src/stronge1994/judging/*")]
PAPER_LEDGER = files("src/stronge1994/paper/*", "src/stronge1994/printed/*")
WRITING = [*DRAWING, *JUDGING, *PAPER_LEDGER, *files("src/stronge1994/settings/*", "src/stronge1994/pages/*")]
WRITING += files("src/stronge1994/explorer/*")


def of_folder(without):
    """Modules in the folder of a figure, without one of them."""
    return lambda wildcards: [
        path for path in files(f"{figures.folder_of(wildcards.figure)}/*.py") if Path(path).name != without
    ]


def made(names):
    """Tables and pictures of figures and scenes, and all on the way to them.

    A failed job removes its files. Snakemake makes a missing one again only if it is asked for: else it
    is content with what an earlier run has made of it.
    """
    drawn = [name for name in names if name in FIGURES]
    slides = [name for name in SLIDES if name in names]
    return [
        *(JUDGED[name]["table"] for name in names),
        *expand("figures/{figure}.{kind}", figure=drawn, kind=["svg", "png"]),
        *expand("figures/slides/{figure}_{ground}.png", figure=slides, ground=["light", "dark"]),
    ]


def rows_of(names):
    """Names of the comparisons of some figures or scenes."""
    return [one.name for name in names for one in settings.of(COMPARISONS, name)]


def priority(wildcards):
    """The figures of the paper come first, in its order."""
    name = wildcards.get("figure") or wildcards.judged
    return 20 - PAPER.index(name) if name in PAPER else 0


class Tenths(logging.Handler):
    """Says in a file how far a run is, a line for each tenth of its jobs; a terminal has bars."""

    def emit(self, record):
        if getattr(record, "event", None) == LogEvent.PROGRESS:
            done, total = record.done, record.total
            if 10 * done // total > 10 * (done - 1) // total:
                print(f"[{datetime.now():%H:%M:%S}] {done} of {total} jobs done", file=sys.stderr, flush=True)


if not sys.stderr.isatty():
    logger.addHandler(Tenths())
# A job that fails is named with its log. That its process ended with status 1 says nothing more.
logger.addFilter(lambda record: "returned non-zero exit status 1." not in record.getMessage())
