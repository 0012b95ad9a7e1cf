"""What the rules need to know before they run: checked config and data, settings, modules."""

import ast
import functools
import json
from pathlib import Path

import reference_data

SCRIPTS = Path(__file__).parent
SRC = SCRIPTS.parents[1] / "src"
FIGURES = [f"fig{number}" for number in range(2, 10)]
FIGURES += ["micro_slip", "convergence", "trade", "superball", "stability", "rod"]
TIMED = ("convergence", "trade")  # measure time: nothing may run beside them
EXPLORED = [f"fig{number}" for number in range(3, 10)] + ["superball"]  # impacts to play with
# Groups that play no part: mass, in force against deflection; bodies or a table with their own.
BOTH = ["mass_ratio", "stiffness_ratio"]
WITHOUT = {"fig2": ["mass_ratio"], "superball": BOTH, "stability": BOTH, "rod": ["mass_ratio"]}


class ConfigError(Exception):
    """workflow/config.yaml or a --config value is not admissible, or a module is no Python."""


def with_values(node):
    """Numbers and truths for the texts that snakemake makes of them inside braces of --config."""
    if isinstance(node, dict):
        return {key: with_values(value) for key, value in node.items()}
    if isinstance(node, list):
        return [with_values(value) for value in node]
    if isinstance(node, str) and node.lower() in ("true", "false"):
        return node.lower() == "true"
    for number in (int, float) if isinstance(node, str) else ():
        try:
            return number(node)
        except ValueError:
            continue
    return node


def check_config(config, schema, inventory, ledger):
    """Refuse an inadmissible config, naming the field, its value and what is allowed."""
    try:
        reference_data.refuse_invalid(config, schema, "config")
    except reference_data.SourceError as error:
        raise ConfigError(str(error)) from None
    for figure, settings in config["figures"].items():
        for key in ("incidence", "angle", "tilt"):
            _ascending(f"config: figures.{figure}.{key}", settings.get(key))
    experiment = config["figures"]["fig5"]["experiment"]
    if experiment not in inventory:
        raise ConfigError(
            f"config: figures.fig5.experiment: '{experiment}' is not in data/; allowed are "
            + ", ".join(inventory)
        )
    where, table = "config: figures.stability.points", config["figures"]["stability"]["points"]
    if reference(inventory, table, where)[0] != "series":
        raise ConfigError(f"{where}: '{table}' is no series")
    for scene in config["scenes"]:
        if not Path(f"data/scenes/{scene}.csv").is_file():
            raise ConfigError(f"config: scenes.{scene}: there is no data/scenes/{scene}.csv")
    for name, comparison in config["comparisons"].items():
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
    columns = {"balance": "`balance`, two columns", "largest": "`largest`, a column"}
    if metric in columns:
        if metric not in comparison:
            raise ConfigError(f"{where}: metric {metric} needs {columns[metric]}")
        return
    if "reference" not in comparison:
        raise ConfigError(f"{where}: metric {metric} needs `reference`")
    kind, _ = reference(inventory, comparison["reference"], where)
    if (kind == "facts") != (metric == "landmark"):
        raise ConfigError(f"{where}: metric {metric} does not go with one of the {kind}")
    if metric == "landmark" and "landmark" not in comparison:
        raise ConfigError(f"{where}: metric landmark needs `landmark`")
    if metric in ("distance", "landmark") and "curve" not in comparison:
        raise ConfigError(f"{where}: metric {metric} needs `curve`")
    spans = {"window": comparison.get("window"), **comparison.get("documented", {})}
    for key, span in spans.items():
        _ascending(f"{where}.{key}", span)


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
    if "experiment" in chosen:
        keys = ("mass_ratio", "stiffness_ratio", "restitution", "friction", "speed", "radius")
        stated = inventory[chosen["experiment"]]["parameters"]
        chosen["experiment"] = {key: stated[key]["value"] for key in keys}
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


def comparisons(config, figure):
    """Comparisons of one figure, `{name: entry}`."""
    chosen = config["comparisons"].items()
    return {name: dict(entry) for name, entry in chosen if entry["figure"] == figure}


def references(config, inventory, figure):
    """Series and facts that the comparisons of one figure name: `{source/entry: entry}`."""
    named = [c["reference"] for c in comparisons(config, figure).values() if "reference" in c]
    return {name: reference(inventory, name)[1] for name in named}


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
            stated = inventory[name.split("/")[0]]["parameters"]
            parameters = {key: parameter["value"] for key, parameter in stated.items()}
            chosen[name] = {**entry, "parameters": parameters}
    return chosen


def nodes_of(config, inventory, figure):
    """Reference tables whose points the curves must pass through: `{path: column of x}`.

    A column None stands for the whole table, of the figure that is given one.
    """
    if "points" in config["figures"][figure]:
        _, table = reference(inventory, config["figures"][figure]["points"])
        return {table["path"]: None}
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
    return sorted(str(file.relative_to(SRC.parent)) for file in found)


def modules_of_notebook(name):
    """As `modules`, of what runs a notebook of workflow/notebooks and of what it imports."""
    path = SCRIPTS.parent / "notebooks" / f"{name}.ipynb"
    book = json.loads(path.read_text(encoding="utf-8"))
    cells = ["".join(cell["source"]) for cell in book["cells"] if cell["cell_type"] == "code"]
    return modules("run_notebook", *_imports("\n".join(cells), path))


@functools.cache
def _imported(file):
    names = _imports(file.read_text(encoding="utf-8"), file)
    return [path for name in names for path in _files(name)]


def _imports(text, file):
    """Names that the text of a file imports."""
    try:
        tree = ast.parse(text)
    except SyntaxError as error:
        raise ConfigError(f"{file}, line {error.lineno}: {error.msg}") from None
    names = []
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            names += [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom) and node.module:
            names += [node.module, *(f"{node.module}.{alias.name}" for alias in node.names)]
    return names


def _files(name):
    """Files that an import of `name` reads: its packages and itself, if they are ours."""
    sibling = SCRIPTS / f"{name}.py"
    if sibling.is_file():
        return [sibling]
    parts = name.split(".")
    paths = [SRC.joinpath(*parts[: i + 1]) for i in range(len(parts))]
    candidates = [p for path in paths for p in (path / "__init__.py", path.with_suffix(".py"))]
    return [path for path in candidates if path.is_file()]
