# What is refused before Snakemake reads the config: it would read some of it wrongly in silence.
import sys
from pathlib import Path

from snakemake.exceptions import WorkflowError

sys.path.insert(0, str(Path(workflow.basedir) / "workflow" / "scripts"))
import reference_data
import run_plan

try:
    run_plan.refuse_unreadable_modules()
    reference_data.load_yaml("workflow/config.yaml")
except (reference_data.SourceError, run_plan.ConfigError) as error:
    raise WorkflowError(str(error))
