# Check config and data before any work, and plan every job.
from stronge1994.curve_names import SCENE, is_of_paper
from stronge1994.ledger import entries

LEDGER = "data/stronge1994/ledger.yaml"
FACTS = "data/stronge1994/source.yaml"  # to which the ledger refers
NOTEBOOKS = sorted(path.stem for path in Path("workflow/notebooks").glob("*.ipynb"))
try:
    config = configuration.complete(configuration.with_values(config))
    LEDGER_SCHEMA = reference_data.load_yaml("workflow/schemas/ledger.schema.yaml")
    SOURCES = reference_data.load_all("data", reference_data.load_yaml("workflow/schemas/source.schema.yaml"))
    ENTRIES = entries.load(LEDGER, LEDGER_SCHEMA)
    SYMBOLS = reference_data.load_yaml(LEDGER)["symbols"]
    configuration.check_config(config, SOURCES, ENTRIES)
    FIGURES = {
        figure: plan.plan_of_figure(config, SOURCES, figure) for figure in config["figures"]
    }
    JUDGED = {
        name: plan.plan_of_judgement(config, SOURCES, name)
        for name in configuration.judged(config)
    }
    # Rows that the tables of the run must have.
    EXPECTED = {
        "comparisons": {title: waits for own in JUDGED.values() for title, waits in own["rows"].items()},
        "entries": {name: entries.is_run(entry) for name, entry in ENTRIES.items()},
    }
except (reference_data.SourceError, ConfigError) as error:
    raise WorkflowError(str(error))

TIMED = figures.with_trait("timed")
UNTIMED = [figure for figure in FIGURES if figure not in TIMED]
SLIDES = figures.with_trait("slide")
CAPTIONS = {figure: stated["caption"] for figure, stated in figures.stated().items()}


def priority(wildcards):
    """The paper's figures go before all others, Fig. 3 first, then the one that takes longest.

    A lecture waits for `trade`, so it is next.
    """
    name = wildcards.get("figure") or wildcards.get("judged")
    return {"fig3": 4, "fig5": 3, "trade": 1}.get(name, 2 * is_of_paper(name))


# Every value that a wildcard has in a run.
VALUES = {
    "figure": list(FIGURES),
    "judged": list(JUDGED),
    "scene": list(config["scenes"]),
    "notebook": NOTEBOOKS,
}


wildcard_constraints:
    figure="|".join(FIGURES),
    judged="|".join(JUDGED),
    scene="|".join(config["scenes"]) or "none",
    notebook="|".join(NOTEBOOKS) or "none",


PLANNED = []  # names of jobs


def planned(job, script, *rooms, settings=lambda value: {}, reads=lambda value: []):
    """Write the plan of each job of a rule, and give their path, which has the wildcard of the rule.

    `rooms` of the reproduction are what the job imports; `{figure}` in one is the value of the
    wildcard, if that is a figure. `settings` and `reads`, files of this repository, depend on the
    value.
    """
    _, _, wildcard = job.rstrip("}").partition("{")
    for value in VALUES[wildcard] if wildcard else [""]:
        own = [room.format(figure=value) for room in rooms if value in FIGURES or "{" not in room]
        sources = files.sources(script, *own)
        name = job.format(**{wildcard: value}) if wildcard else job
        try:
            if workflow.is_main_process:
                plans.write(name, [*sources, *reads(value)], settings(value))
        except FileNotFoundError as error:
            raise WorkflowError(f"{error.filename}: missing, and the job {name} reads it")
        PLANNED.append(name)
    return plans.path(job)


def of_figure(part, plans=FIGURES, wildcard="figure"):
    """Input function: one entry of `plan.plan_of_figure`, or of another plan."""
    return lambda wildcards: plans[getattr(wildcards, wildcard)][part]


def of_drawing(figure):
    """Settings of the plan of a drawing."""
    own = {key: FIGURES[figure][key] for key in ("settings", "overlays")}
    return own | {"slide": figures.stated()[figure].get("slide")}


def slides_of(figures):
    """Pictures of the slides that some figures have."""
    own = [figure for figure in SLIDES if figure in figures]
    return expand("figures/slides/{figure}_{ground}.png", figure=own, ground=["light", "dark"])


def files_of_one(name):
    """Files of the jobs that make, draw and judge one figure or scene."""
    makers = [rules.judge, *([rules.curves, rules.draw] if name in FIGURES else [rules.scene])]
    made = [path for maker in makers for path in maker.output]
    chosen = dict.fromkeys(["figure", "judged"], name) | {"scene": name.removeprefix(SCENE)}
    return expand(made, **chosen) + slides_of([name])


# Files that every page includes, beside its own template.
EVERY_PAGE = ["workflow/report/theme.css", "workflow/report/site.html"]
