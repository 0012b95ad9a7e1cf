# What is refused before Snakemake reads the config: it would read some of it wrongly in silence.
import sys
from pathlib import Path

from snakemake.exceptions import WorkflowError

sys.path.insert(0, str(Path(workflow.basedir) / "workflow" / "scripts"))
import judgement
import options
import reference_data
import run_plan


# Jobs on a cluster read this file too: only the process that was started speaks for the run.
STARTED_HERE = workflow.is_main_process and not options.is_dry(sys.argv)


def refused(error):
    """What to raise; a run that is refused has not passed, whatever an earlier one did."""
    if STARTED_HERE:
        judgement.drop_pass()
    return WorkflowError(str(error))


if Path(workflow.basedir).resolve() != Path.cwd().resolve():
    raise WorkflowError(f"run Snakemake in the folder of its Snakefile: cd {workflow.basedir}")
try:
    run_plan.refuse_unreadable_modules()
    for file in ("workflow/config.yaml", *workflow.config_settings.configfiles):
        reference_data.load_yaml(file)
    if workflow.is_main_process:
        run_plan.refuse_misread_values(workflow.config_settings.config_args or ())
        options.refuse_untrustworthy(sys.argv)
except (reference_data.SourceError, run_plan.ConfigError, options.OptionError) as error:
    raise refused(error)
