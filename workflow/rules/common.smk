# Checked config and data before any work, and what the rules ask of them. All of it is worked out
# here, once: the functions below only look it up.
from stronge1994.gate import closing
from stronge1994.ledger import entries
from stronge1994.pages import interface
from stronge1994.plan import grid
from stronge1994.plan.files import modules

LEDGER = "data/stronge1994/ledger.yaml"
NOTEBOOKS = sorted(path.stem for path in Path("workflow/notebooks").glob("*.ipynb"))
try:
    config = configuration.with_values(config)
    LEDGER_SCHEMA = reference_data.load_yaml("workflow/schemas/ledger.schema.yaml")
    SOURCES = reference_data.load_all("data", reference_data.load_yaml("workflow/schemas/source.schema.yaml"))
    ENTRIES = entries.load(LEDGER, LEDGER_SCHEMA)
    SYMBOLS = reference_data.load_yaml(LEDGER)["symbols"]
    schema = reference_data.load_yaml("workflow/schemas/config.schema.yaml")
    configuration.check_config(config, schema, SOURCES, ENTRIES)
    grid.check(config)
    FIGURES = {
        figure: plan.plan_of_figure(config, SOURCES, figure) for figure in config["figures"]
    }
    JUDGED = {
        name: plan.plan_of_judgement(config, SOURCES, name)
        for name in configuration.judged(config)
    }
    EXPECTED_ROWS = plan.expected_rows(config, SOURCES)
    NOTEBOOK_MODULES = {name: files.modules_of_notebook(name) for name in NOTEBOOKS}
except (reference_data.SourceError, ConfigError) as error:
    raise refused(error)

EXPECTED_ENTRIES = {name: entries.is_run(entry) for name, entry in ENTRIES.items()}
# Sources with whose series something is compared.
COMPARED = sorted({source for told in JUDGED.values() for source in told["sources"]})
UNTIMED = [figure for figure in FIGURES if figure not in plan.TIMED]


scattergather:
    study=config["study"]["chunks"],


# Every value that a wildcard has in a run.
VALUES = {
    "figure": list(FIGURES),
    "judged": list(JUDGED),
    "source": COMPARED,
    "scene": list(config["scenes"]),
    "notebook": NOTEBOOKS,
    "scatteritem": gather.study("{scatteritem}"),
}


wildcard_constraints:
    figure="|".join(FIGURES),
    judged="|".join(JUDGED),
    source="[a-z0-9_]+",
    scene="|".join(config["scenes"]) or "none",
    notebook="|".join(NOTEBOOKS) or "none",


def content_of(maker):
    """Function that gives the fingerprint of what a job of a rule reads of this repository."""

    def found(wildcards):
        given = [
            part.apply_wildcards(wildcards) if isinstance(part, str) else part(wildcards)
            for part in maker.input
        ]
        paths = [path for part in given for path in ([part] if isinstance(part, str) else part)]
        return files.content(*(p for p in paths if p.startswith(("data/", "src/", "workflow/"))))

    return found


def of_figure(part, plans=FIGURES, wildcard="figure"):
    """Input function: a part of what `plan.plan_of_figure` says of a figure, or of another plan."""

    def found(wildcards):
        return plans[getattr(wildcards, wildcard)][part]

    return found


def of_judged(part, wildcard="judged"):
    """Input function: a part of what `plan.plan_of_judgement` says."""
    return of_figure(part, JUDGED, wildcard)


def sources(*paths):
    """Files of this repository that a rule reads, refused where one is missing."""
    try:
        return files.present(*paths)
    except ConfigError as error:
        raise refused(error)


# What every page includes, beside its own template.
EVERY_PAGE = sources("workflow/report/theme.css", "workflow/report/site.html")
# Only `snakemake --report` reads them all.
CAPTIONS = ["explorer", "figures", "ledger", "letter", "notebooks", "peers", "stability", "study", "trade"]
sources(*expand("workflow/report/{caption}.rst", caption=[*CAPTIONS, "which_model"]))


def scene_tolerance(wildcards):
    return config["scenes"][wildcards.scene]["tolerance"]


def notebook_modules(wildcards):
    return NOTEBOOK_MODULES[wildcards.notebook]


def all_cores(wildcards):
    return workflow.cores


def cores_reserved(wildcards):
    return workflow.cores if wildcards.figure in plan.TIMED else 1


def source_of(wildcards):
    return SOURCES[wildcards.source]


def files_of_source(wildcards):
    series = SOURCES[wildcards.source]["series"].values()
    return [f"data/{wildcards.source}/source.yaml", *(s["path"] for s in series if s["path"])]


# Checks are found by name: every module that holds some is an input.
LEDGER_MODULES = [f"stronge1994.ledger.{module}" for module in entries.MODULES]
