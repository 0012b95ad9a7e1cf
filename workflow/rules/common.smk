# Checked config and data before any work, and what the rules ask of them.
import sys
import time
from pathlib import Path

from snakemake.exceptions import WorkflowError

sys.path.insert(0, str(Path(workflow.basedir) / "workflow" / "scripts"))
import closing
import ledger_entries
import reference_data
import run_plan
import study_plan

STARTED = time.time()
LEDGER = "data/stronge1994/ledger.yaml"
NOTEBOOKS = sorted(path.stem for path in Path("workflow/notebooks").glob("*.ipynb"))
LEDGER_SCHEMA = reference_data.load_yaml("workflow/schemas/ledger.schema.yaml")
try:
    config = run_plan.with_values(config)
    SOURCES = reference_data.load_all("data", reference_data.load_yaml("workflow/schemas/source.schema.yaml"))
    ENTRIES = ledger_entries.load(LEDGER, LEDGER_SCHEMA)
    SYMBOLS = reference_data.load_yaml(LEDGER)["symbols"]
    schema = reference_data.load_yaml("workflow/schemas/config.schema.yaml")
    run_plan.check_config(config, schema, SOURCES, ENTRIES)
    study_plan.check(config)
except (reference_data.SourceError, run_plan.ConfigError) as error:
    raise WorkflowError(str(error))


wildcard_constraints:
    figure="|".join(run_plan.FIGURES),
    source="[a-z0-9_]+",
    scene="|".join(config["scenes"]) or "none",
    notebook="|".join(NOTEBOOKS) or "none",
    chunk=r"\d+-\d+",


def settings(wildcards):
    return run_plan.settings(config, SOURCES, wildcards.figure)


def nodes(wildcards):
    return run_plan.nodes_of(config, SOURCES, wildcards.figure)


def node_tables(wildcards):
    return list(nodes(wildcards))


def comparisons(wildcards):
    return run_plan.comparisons(config, wildcards.figure)


def references(wildcards):
    return run_plan.references(config, SOURCES, wildcards.figure)


def overlays(wildcards):
    return run_plan.overlays(config, SOURCES, wildcards.figure)


def compared_sources(wildcards):
    return run_plan.sources_of(config, SOURCES, wildcards.figure)


def compared_series(wildcards):
    return [f"results/series/{source}.csv" for source in compared_sources(wildcards)]


def solver_modules(wildcards):
    return run_plan.modules("solve", f"planarimpact.curves.{wildcards.figure}")


def scene_tables(wildcards):
    return [f"results/scenes/{scene}.csv" for scene in config["scenes"]]


def scene_tolerance(wildcards):
    return config["scenes"][wildcards.scene]["tolerance"]


def notebook_modules(wildcards):
    return run_plan.modules_of_notebook(wildcards.notebook)


def notebook_pages(wildcards):
    return [f"figures/{notebook}.html" for notebook in NOTEBOOKS]


def all_cores(wildcards):
    return workflow.cores


def cores_reserved(wildcards):
    return workflow.cores if wildcards.figure in run_plan.TIMED else 1


def drawing_modules(wildcards):
    return run_plan.modules("draw", f"draw_{wildcards.figure}")


# Checks are found by name: every module that holds some is an input.
LEDGER_MODULES = [f"planarimpact.ledger.{module}" for module in ledger_entries.MODULES]


def source_of(wildcards):
    return SOURCES[wildcards.source]


def files_of_source(wildcards):
    series = SOURCES[wildcards.source]["series"].values()
    return [f"data/{wildcards.source}/source.yaml", *(s["path"] for s in series if s["path"])]
