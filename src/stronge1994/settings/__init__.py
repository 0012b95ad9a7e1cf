"""What the rules need of the config and of each figure.yaml, checked and completed.

All is found before Snakemake looks at a rule: where an input function raises, Snakemake drops the
rule, and silently takes its old output for a source file.
"""

from collections.abc import Mapping
from typing import Any

from stronge1994.names import SCENE
from stronge1994.reference_data import Inventory, Series, reference
from stronge1994.settings import figures
from stronge1994.settings.config import SHARED, Config, Entry, table_of


def physics(config: Config, inventory: Inventory, figure: str) -> dict[str, Any]:
    """Settings of one figure: shared physics and its own, an experiment by its parameters."""
    stated = figures.stated()[figure]
    own = config["figures"][figure]
    chosen = settings_of(config, figure)
    for key, setting in stated["settings"].items():
        if setting.get("allowed") == "source":
            parameters = inventory[own[key]]["parameters"]
            known = {name: parameters[name] for name in setting["parameters"]}
            chosen[key] = {name: parameter["value"] for name, parameter in known.items()}
            if setting.get("uncertain"):
                sigmas = {name: parameter["uncertainty"] for name, parameter in known.items()}
                chosen["uncertainty"] = {name: sigma for name, sigma in sigmas.items() if sigma}
    return chosen


def of_explorer(config: Config) -> dict[str, Any]:
    """Shared physics, and the impacts of the figures that the explorer offers."""
    keys = ("incidence", "friction", "restitution")
    chosen = {}
    for figure in figures.with_trait("explorer"):
        own = {key: value for key, value in config["figures"][figure].items() if key in keys}
        chosen[figure] = own | {"open": figures.stated()[figure]["explorer"]}
    return {key: config[key] for key in SHARED} | {"figures": chosen}


def comparisons(config: Config, name: str) -> dict[str, Entry]:
    """Comparisons of one figure or of a scene: `{name: entry}`."""
    chosen = config["comparisons"].items()
    return {title: dict(entry) for title, entry in chosen if entry["figure"] == name}


def of_figure(config: Config, inventory: Inventory, figure: str) -> dict[str, Any]:
    """What the rules of one figure need: settings of its curves and of its drawing, and files."""
    nodes, drawn = nodes_of(config, inventory, figure), overlays(config, inventory, figure)
    own = physics(config, inventory, figure)
    return {
        "curves": {"settings": own, "nodes": nodes},
        "tables": list(nodes),
        "drawing": {
            "settings": own,
            "overlays": drawn,
            "slide": figures.stated()[figure].get("slide"),
        },
        "series": _files(drawn),
    }


def of_judgement(config: Config, inventory: Inventory, name: str) -> dict[str, Any]:
    """What the rule that judges a figure or a scene needs."""
    known = references(config, inventory, name)
    return {
        "settings": {
            "comparisons": comparisons(config, name),
            "references": known,
            "significance": config["significance"],
            "settings": settings_of(config, name),
        },
        "table": table_of(name),
        "series": _files(known),
    }


def settings_of(config: Config, name: str) -> dict[str, Any]:
    """Settings of a figure or of a scene, as the config has them."""
    if name.startswith(SCENE):
        return dict(config["scenes"][name.removeprefix(SCENE)])
    shared = figures.stated()[name].get("shared", [])
    return {key: config[key] for key in shared} | config["figures"][name]


def references(config: Config, inventory: Inventory, name: str) -> dict[str, Entry]:
    """Series and facts that comparisons name."""
    named = [c["reference"] for c in comparisons(config, name).values() if "reference" in c]
    return {full: reference(inventory, full) for full in named}


def _files(entries: Mapping[str, Entry]) -> list[str]:
    """Files of the series at hand among some entries, in order."""
    return sorted({entry["path"] for entry in entries.values() if entry.get("path")})


def overlays(config: Config, inventory: Inventory, figure: str) -> dict[str, Entry]:
    """Series and facts to draw over one figure: those that it compares, and those under `draws`."""
    compared = references(config, inventory, figure).items()
    asked = figures.stated()[figure].get("draws", [])
    chosen = {name: entry for name, entry in compared if entry.get("kind") != "computed"}
    return chosen | {full: reference(inventory, full) for full in asked}


def nodes_of(config: Config, inventory: Inventory, figure: str) -> dict[str, str | None]:
    """Tables through whose points curves must pass: `{path: column of x}`, None for all of it."""
    stated = figures.stated()[figure]
    for key, setting in stated["settings"].items():
        if setting.get("allowed") == "table":
            return {reference(inventory, config["figures"][figure][key])["path"]: None}
    named = comparisons(config, figure).values() if stated.get("nodes") else ()
    exact = [reference(inventory, c["reference"]) for c in named if c["metric"] == "vertices"]
    return {
        entry["path"]: Series(**entry).x.name
        for entry in exact
        if entry["path"] and "event" not in entry.get("labels", [])
    }
