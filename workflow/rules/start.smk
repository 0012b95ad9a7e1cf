# Refuse here what Snakemake would silently misread in the config.
import os
import shlex
import sys
from pathlib import Path

from snakemake.exceptions import WorkflowError

# The sources that the plans name, wherever else the packages may be installed: for this process,
# and for the Python of every job.
sys.path.insert(0, str(Path(workflow.basedir) / "src"))
os.environ.update(PYTHONPATH=sys.path[0])
# Snakemake puts this path into the shell's commands without quotes (its issue 2645): those of a folder
# with blanks, brackets or apostrophes.
sys.executable = shlex.quote(sys.executable)
from stronge1994.run import plans


if Path(workflow.basedir).resolve() != Path.cwd().resolve():
    raise WorkflowError(f"run Snakemake in the folder of its Snakefile: cd {workflow.basedir}")
if set("{}") & set(workflow.basedir):
    raise WorkflowError(
        f"{workflow.basedir}: Snakemake takes braces in a path for a wildcard: rename the folder, or "
        "move the project to one without braces"
    )
# Jobs on a cluster read this file too: only the process that was started begins a run.
if workflow.is_main_process:
    plans.start(sys.argv)
# Behind that: an error in one of them leaves no verdict of an earlier run.
from stronge1994 import plan, reference_data
from stronge1994.plan import config as configuration
from stronge1994.plan import figures, files
from stronge1994.plan.config import ConfigError
from stronge1994.run import last_words, record


try:
    for file in (configuration.FILE, *workflow.config_settings.configfiles):
        reference_data.load_yaml(file)
    if workflow.is_main_process:
        configuration.refuse_misread_values(workflow.config_settings.config_args or ())
except (reference_data.SourceError, ConfigError) as error:
    raise WorkflowError(str(error))
