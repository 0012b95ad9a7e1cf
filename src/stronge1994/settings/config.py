"""The config, which is refused before any work where it is not admissible."""

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any, TypeAlias

from stronge1994 import reference_data
from stronge1994.judging.comparisons import Comparison
from stronge1994.names import SCENE
from stronge1994.reference_data import Fact, Faults, SourceError, formats, strict_yaml
from stronge1994.settings import figures

Config: TypeAlias = dict[str, Any]  # what the config files hold
Inventory: TypeAlias = reference_data.Inventory
Entry: TypeAlias = dict[str, Any]  # a comparison of the config

FILE = "workflow/config.yaml"  # what a user edits
SHARED = ("mass_ratio", "stiffness_ratio")  # groups that figures share


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
            raise SourceError(f"--config {name}: it is there twice")
        try:
            given |= strict_yaml.load(f"{name}: {value}")
        except ValueError as error:
            raise SourceError(f"--config {text!a}: {str(error).partition(': ')[2]}") from None
    return complete(overridden(config, given))


def complete(config: Config) -> Config:
    """A config with the settings and comparisons of all figures, which it may override."""
    every = figures.stated().items()
    stated = {
        "figures": {name: figures.values(figure["settings"]) for name, figure in every},
        "comparisons": figures.comparisons(),
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


def schema() -> dict[str, Any]:
    """JSON schema of the whole config, with the settings of each figure."""
    whole = figures.schema("config")
    every = {name: figures.schema_of(own["settings"]) for name, own in figures.stated().items()}
    own = {"type": "object", "additionalProperties": False, "properties": every}
    return whole | {"properties": whole["properties"] | {"figures": own}}


def comparisons(
    config: Config, inventory: Inventory, ledger: Iterable[str]
) -> dict[str, Comparison]:
    """Every comparison of a config, by its name.

    An inadmissible config is refused: for each fault field, value and what is allowed.
    """
    reference_data.refuse_invalid(config, schema(), "config")
    faults, stated, names, made = Faults(), figures.comparisons(), judged(config), {}
    for figure, own in figures.stated().items():
        for key, setting in own["settings"].items():
            with faults:
                where, value = f"config: figures.{figure}.{key}", config["figures"][figure][key]
                _check_setting(where, value, setting, inventory)
    for scene in config["scenes"]:
        with faults:
            if not Path(f"data/scenes/{scene}.csv").is_file():
                raise SourceError(f"config: scenes.{scene}: there is no data/scenes/{scene}.csv")
            reference_data.text_of(f"data/scenes/{scene}.csv")
    for name, entry in config["comparisons"].items():
        own = entry == stated.get(name)
        file = figures.file_of(entry["figure"]) if own else "config"
        where = f"{file}: comparisons.{name}"
        with faults:
            if entry.get("figure") not in names:
                problem = f"{entry.get('figure')!a} is not judged; allowed are {', '.join(names)}"
                raise SourceError(f"{where}.figure: {problem}")
            known: dict[str, Any] = {"name": name}
            if full := entry.get("reference"):
                known["reference"] = reference_data.reference(inventory, full, f"{where}.reference")
            made[name] = formats.read(Comparison, entry, where, **known)
            of_ledger = getattr(made[name].differs, "entry", "")
            if of_ledger and of_ledger not in ledger:
                raise SourceError(
                    f"{where}.differs.entry: {of_ledger!a} is not in the ledger; a "
                    "difference that does not concern the paper has a `note` instead"
                )
    faults.refuse()
    return made


def _check_setting(
    where: str, value: Any, setting: Mapping[str, Any], inventory: Inventory
) -> None:
    """Refuse a source that is not there or lacks parameters, and a table that is no series."""
    kind, needed = setting.get("allowed"), setting.get("parameters", [])
    known = reference_data.reference(inventory, value, where) if kind == "table" else None
    if isinstance(known, Fact):
        raise SourceError(f"{where}: {value!a} is no series")
    if kind != "source":
        return
    if value not in inventory:
        problem = f"{value!a} is not in data/; allowed are {', '.join(inventory)}"
        raise SourceError(f"{where}: {problem}")
    if missing := set(needed) - set(inventory[value]["parameters"]):
        problem = f"{value!a} states no {min(missing)}; needed are {', '.join(needed)}"
        raise SourceError(f"{where}: {problem}")


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
