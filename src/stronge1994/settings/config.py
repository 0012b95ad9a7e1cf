"""The config, which is refused before any work where it is not admissible."""

from collections.abc import Iterable
from pathlib import Path
from typing import Any, TypeAlias

from stronge1994 import reference_data
from stronge1994.names import SCENE
from stronge1994.reference_data import Series, strict_yaml
from stronge1994.settings import figures

Config: TypeAlias = dict[str, Any]  # what the config files hold
Inventory: TypeAlias = dict[str, Any]  # `{source: contents of its source.yaml}`
Entry: TypeAlias = dict[str, Any]  # a comparison of the config; a series or fact of a source

FILE = "workflow/config.yaml"  # what a user edits
SHARED = ("mass_ratio", "stiffness_ratio")  # groups that figures share
# Largest allowance for a model, as a share of the range of its axis.
LARGEST_ALLOWANCE = 0.02
# Reason for the tolerance of the comparison of a scene.
OF_SCENES = (
    "every row against a second code of the continuum of its loss, with the mechanics of rigid "
    "bodies in 50 digits; sigma is the accuracy of that and the tolerance of the scene"
)


class ConfigError(reference_data.SourceError):
    """The config is not admissible."""


def load(files: Iterable[str | Path], arguments: Iterable[str] = ()) -> Config:
    """The whole config: files, each over those before it, and the arguments of --config over them.

    They are read as YAML 1.2. Snakemake's own reader would take 010 for 8, and yes for true.
    """
    config: Config = {}
    for file in files:
        config = overridden(config, reference_data.load_yaml(file))
    given: Config = {}
    for text in arguments:
        name, _, value = text.partition("=")
        if name in given:
            raise ConfigError(f"--config {name}: it is there twice")
        try:
            given |= strict_yaml.load(f"{name}: {value}")
        except ValueError as error:
            raise ConfigError(f"--config {text!a}: {str(error).partition(': ')[2]}") from None
    return complete(overridden(config, given))


def complete(config: Config) -> Config:
    """A config with the settings and comparisons of all figures, which it may override."""
    every = figures.stated().items()
    stated = {
        "figures": {name: figures.values(figure["settings"]) for name, figure in every},
        "comparisons": figures.comparisons() | _of_scenes(config.get("scenes")),
    }
    return overridden(stated, config)


def overridden(stated: Config, config: Config) -> Config:
    """The first of two configs, with the values of the second in place of its own or added."""
    both = {
        key: overridden(stated[key], value)
        if isinstance(value, dict) and isinstance(stated.get(key), dict)
        else value
        for key, value in config.items()
    }
    return stated | both


def _of_scenes(scenes: Any) -> dict[str, Entry]:
    """A comparison of every scene that names a reference."""
    named = scenes.items() if isinstance(scenes, dict) else ()
    return {
        f"scene-{name.replace('_', '-')}": {
            "figure": f"{SCENE}{name}",
            "reference": scene["reference"],
            "metric": "vertices",
            "reason": OF_SCENES,
        }
        for name, scene in named
        if isinstance(scene, dict) and "reference" in scene
    }


def schema() -> dict[str, Any]:
    """JSON schema of the whole config, with the settings of each figure."""
    whole, stated = figures.schema("config"), figures.stated().items()
    own = {
        "type": "object",
        "additionalProperties": False,
        "properties": {name: figures.schema_of(figure["settings"]) for name, figure in stated},
    }
    return whole | {
        "properties": whole["properties"] | {"figures": own},
        "$defs": whole["$defs"] | figures.definitions(),
    }


def check_config(config: Config, inventory: Inventory, ledger: Iterable[str]) -> None:
    """Refuse an inadmissible config, naming the field, its value and what is allowed."""
    reference_data.refuse_invalid(config, schema(), "config")
    for figure, stated in figures.stated().items():
        for key, setting in stated["settings"].items():
            where, value = f"config: figures.{figure}.{key}", config["figures"][figure][key]
            kind = setting.get("allowed")
            if kind == "source":
                _check_source(where, value, setting.get("parameters", []), inventory)
            if kind == "table" and "kind" not in reference(inventory, value, where):
                raise ConfigError(f"{where}: {value!a} is no series")
    for scene in config["scenes"]:
        if not Path(f"data/scenes/{scene}.csv").is_file():
            raise ConfigError(f"config: scenes.{scene}: there is no data/scenes/{scene}.csv")
        reference_data.text_of(f"data/scenes/{scene}.csv")
    for name, comparison in config["comparisons"].items():
        if comparison["figure"] not in judged(config):
            raise ConfigError(
                f"config: comparisons.{name}.figure: {comparison['figure']!a} is not judged; "
                "allowed are " + ", ".join(judged(config))
            )
        _check_comparison(f"config: comparisons.{name}", comparison, inventory)
        entry = comparison.get("differs", {}).get("entry")
        if entry is not None and entry not in ledger:
            raise ConfigError(
                f"config: comparisons.{name}.differs.entry: {entry!a} is not in the ledger; a "
                "difference that does not concern the paper has a `note` instead"
            )


def _check_source(where: str, name: str, needed: list[str], inventory: Inventory) -> None:
    if name not in inventory:
        raise ConfigError(f"{where}: {name!a} is not in data/; allowed are {', '.join(inventory)}")
    missing = set(needed) - set(inventory[name]["parameters"])
    if missing:
        problem = f"{name!a} states no {min(missing)}; needed are {', '.join(needed)}"
        raise ConfigError(f"{where}: {problem}")


def _check_comparison(where: str, comparison: Entry, inventory: Inventory) -> None:
    metric = comparison["metric"]
    if metric not in ("distance", "vertices", "landmark"):
        return
    known = reference(inventory, comparison["reference"], where)
    if ("statement" in known) != (metric == "landmark"):
        raise ConfigError(f"{where}: metric {metric}: a landmark needs a fact, all others a series")
    if metric == "distance" and not ("curve" in comparison or known.get("labels")):
        raise ConfigError(f"{where}: metric distance needs `curve`")
    for label in comparison.get("points", {}):
        if label not in known.get("labels", []):
            raise ConfigError(f"{where}.points.{label}: no label of {comparison['reference']}")
    for key, size in comparison.get("allowance", {}).items():
        series = Series(**known)
        for axis in [series.x] if key == "x" else series.ordinates:
            low, high = axis.range
            if size > LARGEST_ALLOWANCE * (high - low):
                raise ConfigError(
                    f"{where}.allowance.{key} = {size:g}: allowed is up to "
                    f"{LARGEST_ALLOWANCE * (high - low):g}, a fiftieth of the range {low:g} to "
                    f"{high:g}; with more the comparison would judge nothing"
                )


def judged(config: Config) -> list[str]:
    """Names of all that comparisons may judge: figures and scenes."""
    return [*config["figures"], *(f"{SCENE}{name}" for name in config["scenes"])]


def table_of(name: str) -> str:
    """The file that is judged under a name.

    >>> table_of("fig5"), table_of("scene_superball")
    ('results/curves/fig5.csv', 'results/scenes/superball.csv')
    """
    if name.startswith(SCENE):
        return f"results/scenes/{name.removeprefix(SCENE)}.csv"
    return f"results/curves/{name}.csv"


def reference(inventory: Inventory, name: str, where: str = "reference") -> Entry:
    """The series, which has a `kind`, or the fact that `source/entry` names."""
    source, _, entry = name.partition("/")
    stated = inventory.get(source, {})
    known = stated.get("series", {}) | stated.get("facts", {})
    if entry in known:
        return known[entry]
    allowed = ", ".join([f"{source}/{one}" for one in known] or inventory)
    problem = f"{name!a} is neither a series nor a fact in data/; allowed are {allowed}"
    raise ConfigError(f"{where}: {problem}")
