# What is refused before Snakemake reads the config: it would read some of it wrongly in silence.
import os
import sys
from pathlib import Path

from snakemake.exceptions import WorkflowError

# The sources that the rules track, wherever else the packages may be installed: for this process,
# and for the Python of every job.
sys.path.insert(0, str(Path(workflow.basedir) / "src"))
os.environ.update(PYTHONPATH=sys.path[0])
from stronge1994 import gate, plan, reference_data
from stronge1994.gate import options
from stronge1994.plan import config as configuration
from stronge1994.plan import files
from stronge1994.plan.config import ConfigError


# Jobs on a cluster read this file too: only the process that was started speaks for the run.
STARTED_HERE = workflow.is_main_process and not options.is_dry(sys.argv)


def refused(error):
    """What to raise; a run that is refused has not passed, whatever an earlier one did."""
    if STARTED_HERE:
        gate.drop_pass()
    return WorkflowError(str(error))


if Path(workflow.basedir).resolve() != Path.cwd().resolve():
    raise WorkflowError(f"run Snakemake in the folder of its Snakefile: cd {workflow.basedir}")
if set("{}") & set(workflow.basedir):
    raise WorkflowError(
        f"{workflow.basedir}: Snakemake takes braces in a path for a wildcard: rename the folder, or "
        "move the project to one without braces"
    )
try:
    files.refuse_unreadable_modules()
    for file in (*configuration.FILES, *workflow.config_settings.configfiles):
        reference_data.load_yaml(file)
    if workflow.is_main_process:
        configuration.refuse_misread_values(workflow.config_settings.config_args or ())
        options.refuse_untrustworthy(sys.argv)
except (reference_data.SourceError, ConfigError, options.OptionError) as error:
    raise refused(error)
