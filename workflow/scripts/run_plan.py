"""What the rules need to know before they run: checked config and data, settings, modules."""

import ast
import functools
import hashlib
import json
import re
from pathlib import Path

import records
import reference_data
import strict_yaml

SCRIPTS = Path(__file__).parent
SRC = SCRIPTS.parents[1] / "src"
FIGURES = [f"fig{number}" for number in range(2, 10)]
FIGURES += ["micro_slip", "convergence", "trade", "superball", "stability", "rod"]
CONFLICT = re.compile(r"^(<<<<<<< |>>>>>>> )", flags=re.M)
WITH_NODES = ["fig5", "fig6", "fig7", "fig8", "fig9", "convergence", "rod"]  # pass through points
SCENE = "scene_"  # before the name of a scene, among what is judged
TIMED = ("convergence", "trade")  # measure time: nothing may run beside them
EXPLORED = [f"fig{number}" for number in range(3, 10)] + ["superball"]  # impacts to play with
# Curves of Fig. 5 that have the parameters of a source: which ones they need.
SPHERE = ["mass_ratio", "stiffness_ratio", "restitution"]
SOURCES_OF_CURVES = {
    "experiment": [*SPHERE, "friction", "speed", "radius"],
    "finite_elements": SPHERE,
}
# Groups that play no part: mass, in force against deflection; bodies or a table with their own.
BOTH = ["mass_ratio", "stiffness_ratio"]
WITHOUT = {"fig2": ["mass_ratio"], "superball": BOTH, "stability": BOTH, "rod": ["mass_ratio"]}


class ConfigError(Exception):
    """What the rules are made from is not admissible: config, a module, a file that they read."""


def with_values(node):
    """Numbers and truths for the texts that snakemake makes of them inside braces of --config."""
    if isinstance(node, dict):
        return {key: with_values(value) for key, value in node.items()}
    if isinstance(node, list):
        return [with_values(value) for value in node]
    if isinstance(node, str) and node.lower() in ("true", "false"):
        return node.lower() == "true"
    if isinstance(node, str):
        for tag, number in {"int": int, "float": float}.items():
            if strict_yaml.NUMBERS[f"tag:yaml.org,2002:{tag}"].fullmatch(node):
                return number(node)
        if node.lower() in ("nan", "inf", "-inf"):  # to be refused as numbers, not as words
            return float(node)
    return node


def refuse_misread_values(arguments):
    """Refuse a --config whose values Snakemake would take for others, or that is there twice.

    Parameters
    ----------
    arguments : sequence of str
        `name=value`, as the user wrote them.
    """
    names = [text.partition("=")[0] for text in arguments]
    for text, name in zip(arguments, names, strict=True):
        if names.count(name) > 1:
            raise ConfigError(f"--config {name}: it is there twice")
        value = text.partition("=")[2]
        try:
            strict_yaml.load(f"{name}: {value}")
        except ValueError as error:
            raise ConfigError(f"--config {text}: {str(error).partition(': ')[2]}") from None


def check_config(config, schema, inventory, ledger):
    """Refuse an inadmissible config, naming the field, its value and what is allowed."""
    try:
        reference_data.refuse_invalid(config, schema, "config")
    except reference_data.SourceError as error:
        raise ConfigError(str(error)) from None
    for figure, settings in config["figures"].items():
        for key in ("incidence", "angle", "tilt"):
            _ascending(f"config: figures.{figure}.{key}", settings.get(key))
    for key in SOURCES_OF_CURVES:
        source = config["figures"]["fig5"][key]
        if source not in inventory:
            raise ConfigError(
                f"config: figures.fig5.{key}: '{source}' is not in data/; allowed are "
                + ", ".join(inventory)
            )
    where, table = "config: figures.stability.points", config["figures"]["stability"]["points"]
    if reference(inventory, table, where)[0] != "series":
        raise ConfigError(f"{where}: '{table}' is no series")
    for scene in config["scenes"]:
        if not Path(f"data/scenes/{scene}.csv").is_file():
            raise ConfigError(f"config: scenes.{scene}: there is no data/scenes/{scene}.csv")
    for name, comparison in config["comparisons"].items():
        if comparison["figure"] not in judged(config):
            raise ConfigError(
                f"config: comparisons.{name}.figure: '{comparison['figure']}' is not judged; "
                "allowed are " + ", ".join(judged(config))
            )
        _check_comparison(f"config: comparisons.{name}", comparison, inventory)
        entry = comparison.get("documented", {}).get("entry")
        if entry is not None and entry not in ledger:
            raise ConfigError(
                f"config: comparisons.{name}.documented.entry: '{entry}' is not in the ledger; a "
                "difference that does not concern the paper has a `note` instead"
            )


def _ascending(where, span):
    if isinstance(span, list) and not span[0] < span[1]:
        raise ConfigError(f"{where} = {span}: the first number must be the smaller")


def _check_comparison(where, comparison, inventory):
    metric = comparison["metric"]
    columns = {
        "balance": ("columns", "`columns`, two"),
        "largest": ("largest", "`largest`, a column"),
        "range": ("columns", "`columns` and their `range`"),
        "contraction": ("columns", "`columns`, incidence and rebound"),
    }
    if metric in columns:
        key, words = columns[metric]
        if key not in comparison or (metric == "range" and "range" not in comparison):
            raise ConfigError(f"{where}: metric {metric} needs {words}")
        _ascending(f"{where}.range", comparison.get("range"))
        return
    if "reference" not in comparison:
        raise ConfigError(f"{where}: metric {metric} needs `reference`")
    kind, known = reference(inventory, comparison["reference"], where)
    if (kind == "facts") != (metric == "landmark"):
        raise ConfigError(f"{where}: metric {metric} does not go with one of the {kind}")
    if metric == "landmark" and "landmark" not in comparison:
        raise ConfigError(f"{where}: metric landmark needs `landmark`")
    several = metric == "distance" and "curve" in known.get("labels", [])
    if metric in ("distance", "landmark") and "curve" not in comparison and not several:
        raise ConfigError(f"{where}: metric {metric} needs `curve`")
    for label in comparison.get("points", {}):
        if label not in known.get("labels", []):
            raise ConfigError(f"{where}.points.{label}: no label of {comparison['reference']}")
    for key, span in comparison.get("regression", {}).items():
        _ascending(f"{where}.regression.{key}", span)


def judged(config):
    """Names of all that comparisons may judge: figures, scenes, the parameter study."""
    return [*FIGURES, *(f"{SCENE}{name}" for name in config["scenes"]), "study"]


def table_of(name):
    """The file that is judged under a name.

    Examples
    --------
    >>> table_of("fig5"), table_of("scene_superball")
    ('results/curves/fig5.csv', 'results/scenes/superball.csv')
    """
    if name == "study":
        return "results/study.npz"
    if name.startswith(SCENE):
        return f"results/scenes/{name.removeprefix(SCENE)}.csv"
    return f"results/curves/{name}.csv"


def reference(inventory, name, where="reference"):
    """The series or fact `source/entry`: ("series" or "facts", its entry)."""
    source, entry = name.split("/")
    for kind in ("series", "facts"):
        if entry in inventory.get(source, {}).get(kind, {}):
            return kind, inventory[source][kind][entry]
    raise ConfigError(f"{where}: '{name}' is neither a series nor a fact in data/")


def settings(config, inventory, figure):
    """Settings of one figure: shared physics and its own, an experiment by its parameters."""
    chosen = {
        "mass_ratio": config["mass_ratio"],
        "stiffness_ratio": config["stiffness_ratio"],
        **config["figures"][figure],
    }
    for group in WITHOUT.get(figure, ()):
        del chosen[group]
    for key, needed in SOURCES_OF_CURVES.items():
        if key in chosen:
            stated = inventory[chosen[key]]["parameters"]
            chosen[key] = {name: stated[name]["value"] for name in needed}
            if key == "experiment":
                chosen["uncertainty"] = {
                    name: stated[name]["uncertainty"]
                    for name in needed
                    if stated[name]["uncertainty"]
                }
    return chosen


def settings_of_peers(config):
    """Impacts of figure `trade` on which other codes are tried."""
    keys = ("incidence", "samples", "restitution", "tolerance")
    chosen = {key: config["figures"]["trade"][key] for key in keys}
    return {key: config[key] for key in ("mass_ratio", "stiffness_ratio")} | chosen


def settings_of_explorer(config):
    """Shared physics, and the impacts of the figures that the explorer offers."""
    keys = ("incidence", "friction", "restitution", "throw")
    figures = {
        figure: {key: config["figures"][figure][key] for key in keys if key in settings}
        for figure, settings in config["figures"].items()
        if figure in EXPLORED
    }
    return {key: config[key] for key in ("mass_ratio", "stiffness_ratio")} | {"figures": figures}


def comparisons(config, name):
    """Comparisons of one figure, of a scene or of the study: `{name: entry}`."""
    chosen = config["comparisons"].items()
    return {title: dict(entry) for title, entry in chosen if entry["figure"] == name}


def expected_rows(config, inventory):
    """Rows that the table of verdicts must have: `{comparison: may it be awaited}`."""
    rows = {f"{name}-solved": False for name in judged(config)}
    for name in judged(config):
        known = references(config, inventory, name)
        for title, entry in comparisons(config, name).items():
            series = known.get(entry.get("reference"), {})
            rows[title] = series.get("kind") == "awaited" and not series["path"]
    return rows


def plan_of_judgement(config, inventory, name):
    """What the rule that compares one figure, scene or study is told, and what it reads."""
    sources = sources_of(config, inventory, name)
    return {
        "table": table_of(name),
        "comparisons": comparisons(config, name),
        "references": references(config, inventory, name),
        "sources": sources,
        "series": [f"results/series/{source}.csv" for source in sources],
    }


def plan_of_figure(config, inventory, figure):
    """What the rules of one figure are told, and the files that they read.

    It is asked for each figure before Snakemake looks at a rule: where an input function raises,
    Snakemake drops the rule and takes its old output for a source file, without a word.
    """
    sources, tables = sources_of(config, inventory, figure), nodes_of(config, inventory, figure)
    solver = modules("solve", f"planarimpact.curves.{figure}")
    judging = modules("sensitivity", f"planarimpact.curves.{figure}")
    drawing = modules("draw", f"draw_{figure}")
    return {
        "solver": solver,
        "solver content": content(*solver, *tables),
        "drawing": drawing,
        "drawing content": content(*drawing),
        "sensitivity": judging,
        "sensitivity content": content(*judging, *tables),
        "settings": settings(config, inventory, figure),
        "nodes": tables,
        "tables": list(tables),
        "overlays": overlays(config, inventory, figure),
        "sources": sources,
        "series": [f"results/series/{source}.csv" for source in sources],
    }


def references(config, inventory, name):
    """Series and facts that some comparisons name: `{source/entry: entry}`.

    With the parameters of their source, which say where a regime begins.
    """
    named = [c["reference"] for c in comparisons(config, name).values() if "reference" in c]
    found = {}
    for full in named:
        stated = inventory[full.split("/")[0]]["parameters"]
        parameters = {key: parameter["value"] for key, parameter in stated.items()}
        found[full] = reference(inventory, full)[1] | {"parameters": parameters}
    return found


def series_of(config, inventory, figure):
    """Series at hand for one figure: `{source/series: entry}`, awaited ones left out."""
    chosen = references(config, inventory, figure).items()
    return {name: entry for name, entry in chosen if entry.get("path")}


def sources_of(config, inventory, figure):
    """Sources with series at hand for one figure, in order."""
    return sorted({name.split("/")[0] for name in series_of(config, inventory, figure)})


def overlays(config, inventory, figure):
    """What to draw over one figure: measured series, with the parameters of their source, facts."""
    named = references(config, inventory, figure).items()
    chosen = {name: entry for name, entry in named if "statement" in entry}
    for name, entry in series_of(config, inventory, figure).items():
        if entry["kind"] != "computed":
            chosen[name] = entry
    return chosen


def nodes_of(config, inventory, figure):
    """Reference tables whose points the curves must pass through: `{path: column of x}`.

    A column None stands for the whole table, of the figure that is given one.
    """
    if "points" in config["figures"][figure]:
        _, table = reference(inventory, config["figures"][figure]["points"])
        return {table["path"]: None}
    if figure not in WITH_NODES:
        return {}
    exact = {
        c.get("reference")
        for c in comparisons(config, figure).values()
        if c["metric"] == "vertices"
    }
    return {
        entry["path"]: reference_data.column_name(entry["x"])
        for name, entry in series_of(config, inventory, figure).items()
        if name in exact and "event" not in entry.get("labels", [])
    }


def refuse_unreadable_modules():
    """Refuse a module that Python cannot read, whatever the target: its rule would be dropped."""
    for file in [*SCRIPTS.glob("*.py"), *SRC.rglob("*.py")]:
        try:
            compile(file.read_bytes(), file, "exec", dont_inherit=True)
        except SyntaxError as error:
            raise ConfigError(f"{_shown(file)}, line {error.lineno}: {error.msg}") from None
        except ValueError as error:
            raise ConfigError(f"{_shown(file)}: {error}") from None


def content(*files):
    """Fingerprint of what files hold."""
    digests = "".join(_digest(file) for file in files)
    return hashlib.sha256(digests.encode()).hexdigest()


_digest = functools.cache(records.fingerprint)


def present(*files):
    """The files, if they are there; Snakemake would drop the rule that reads a missing one.

    One file comes back as it is, several as a list: what an input of a rule may be.
    """
    for file in files:
        if not Path(file).is_file():
            raise ConfigError(f"{file}: missing, and a rule reads it")
        text = Path(file).read_text(encoding="utf-8")
        if not text.strip():
            raise ConfigError(f"{file}: empty")
        if CONFLICT.search(text):
            raise ConfigError(f"{file}: it has marks of a merge that was not finished")
    return list(files) if len(files) > 1 else files[0]


def modules(*names):
    """Files of some modules and of all they import: scripts beside this one, and planarimpact.

    Inputs of the rules, so that an edit reruns what it must and nothing more.
    """
    found, todo = set(), [file for name in names for file in _files(name)]
    while todo:
        file = todo.pop()
        if file not in found:
            found.add(file)
            todo += _imported(file)
    return sorted(str(_shown(file)) for file in found)


def modules_of_notebook(name):
    """As `modules`, of what runs a notebook of workflow/notebooks and of what it imports."""
    path = SCRIPTS.parent / "notebooks" / f"{name}.ipynb"
    try:
        book = json.loads(path.read_text(encoding="utf-8"))
        cells = ["".join(cell["source"]) for cell in book["cells"] if cell["cell_type"] == "code"]
    except (ValueError, KeyError, TypeError, RecursionError) as error:
        words = f"{type(error).__name__}: {error}"
        raise ConfigError(f"{_shown(path)}: not a notebook ({words})") from None
    try:
        imported = [name for cell in cells for name in _imports(cell)]
    except (SyntaxError, ValueError) as error:
        raise ConfigError(f"{_shown(path)}: a cell is no Python: {error}") from None
    return modules("run_notebook", *imported)


@functools.cache
def _imported(file):
    return [path for name in _imports(file.read_bytes()) for path in _files(name)]


def _imports(text):
    """Names that a Python text imports."""
    names = []
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Import):
            names += [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom) and node.module:
            names += [node.module, *(f"{node.module}.{alias.name}" for alias in node.names)]
    return names


def _shown(file):
    """A path of the repository, from its top folder."""
    return file.relative_to(SRC.parent)


def _files(name):
    """Files that an import of `name` reads: its packages and itself, if they are ours."""
    sibling = SCRIPTS / f"{name}.py"
    if sibling.is_file():
        return [sibling]
    parts = name.split(".")
    paths = [SRC.joinpath(*parts[: i + 1]) for i in range(len(parts))]
    candidates = [p for path in paths for p in (path / "__init__.py", path.with_suffix(".py"))]
    return [path for path in candidates if path.is_file()]
