# Checked config and data before any work, and what the rules ask of them. All of it is worked out
# here, once: the functions below only look it up.
import closing
import ledger_entries
import study_plan

LEDGER = "data/stronge1994/ledger.yaml"
NOTEBOOKS = sorted(path.stem for path in Path("workflow/notebooks").glob("*.ipynb"))
try:
    config = run_plan.with_values(config)
    LEDGER_SCHEMA = reference_data.load_yaml("workflow/schemas/ledger.schema.yaml")
    SOURCES = reference_data.load_all("data", reference_data.load_yaml("workflow/schemas/source.schema.yaml"))
    ENTRIES = ledger_entries.load(LEDGER, LEDGER_SCHEMA)
    SYMBOLS = reference_data.load_yaml(LEDGER)["symbols"]
    schema = reference_data.load_yaml("workflow/schemas/config.schema.yaml")
    run_plan.check_config(config, schema, SOURCES, ENTRIES)
    study_plan.check(config)
    FIGURES = {
        figure: run_plan.plan_of_figure(config, SOURCES, figure) for figure in run_plan.FIGURES
    }
    JUDGED = {
        name: run_plan.plan_of_judgement(config, SOURCES, name)
        for name in run_plan.judged(config)
    }
    EXPECTED_ROWS = run_plan.expected_rows(config, SOURCES)
    NOTEBOOK_MODULES = {name: run_plan.modules_of_notebook(name) for name in NOTEBOOKS}
except (reference_data.SourceError, run_plan.ConfigError) as error:
    raise refused(error)

EXPECTED_ENTRIES = {name: "check" in entry for name, entry in ENTRIES.items()}
CHUNKS = study_plan.chunks(config)
# Sources with whose series something is compared.
COMPARED = sorted({source for plan in JUDGED.values() for source in plan["sources"]})
UNTIMED = [figure for figure in FIGURES if figure not in run_plan.TIMED]
# Every value that a wildcard has in a run.
VALUES = {
    "figure": list(FIGURES),
    "judged": list(JUDGED),
    "source": COMPARED,
    "scene": list(config["scenes"]),
    "notebook": NOTEBOOKS,
    "chunk": CHUNKS,
}


wildcard_constraints:
    figure="|".join(FIGURES),
    judged="|".join(JUDGED),
    source="[a-z0-9_]+",
    scene="|".join(config["scenes"]) or "none",
    notebook="|".join(NOTEBOOKS) or "none",
    chunk=r"\d+-\d+",


# Every rule has the fingerprint of what it reads of this repository as a parameter, `content`.
# Snakemake runs a job again if an input is newer than its output: files from an archive or a backup
# may be other ones and yet older.
def content_of_source(wildcards):
    return run_plan.content(*run_plan.modules("convert_series"), *files_of_source(wildcards))


def content_of_scene(wildcards):
    table = f"data/scenes/{wildcards.scene}.csv"
    return run_plan.content(*run_plan.modules("solve_scene"), table)


def content_of_notebook(wildcards):
    notebook = f"workflow/notebooks/{wildcards.notebook}.ipynb"
    template = "workflow/report/notebook.html"
    return run_plan.content(*notebook_modules(wildcards), notebook, template)


def of_figure(part, plans=FIGURES, wildcard="figure"):
    """Input function: a part of what `run_plan.plan_of_figure` says of a figure, or of another plan."""

    def found(wildcards):
        return plans[getattr(wildcards, wildcard)][part]

    return found


def of_judged(part, wildcard="judged"):
    """Input function: a part of what `run_plan.plan_of_judgement` says."""
    return of_figure(part, JUDGED, wildcard)


def sources(*files):
    """Files of this repository that a rule reads, refused where one is missing."""
    try:
        return run_plan.present(*files)
    except run_plan.ConfigError as error:
        raise refused(error)


# Only `snakemake --report` reads them all.
CAPTIONS = ["explorer", "figures", "ledger", "notebooks", "peers", "stability", "study", "trade"]
sources(*expand("workflow/report/{caption}.rst", caption=[*CAPTIONS, "which_model"]))


def scene_tolerance(wildcards):
    return config["scenes"][wildcards.scene]["tolerance"]


def notebook_modules(wildcards):
    return NOTEBOOK_MODULES[wildcards.notebook]


def all_cores(wildcards):
    return workflow.cores


def cores_reserved(wildcards):
    return workflow.cores if wildcards.figure in run_plan.TIMED else 1


def source_of(wildcards):
    return SOURCES[wildcards.source]


def files_of_source(wildcards):
    series = SOURCES[wildcards.source]["series"].values()
    return [f"data/{wildcards.source}/source.yaml", *(s["path"] for s in series if s["path"])]


# Checks are found by name: every module that holds some is an input.
LEDGER_MODULES = [f"planarimpact.ledger.{module}" for module in ledger_entries.MODULES]
