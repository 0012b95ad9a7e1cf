"""What the rules need of the config and of each figure.yaml, checked and completed.

All is found before Snakemake looks at a rule: where an input function raises, Snakemake drops the
rule, and silently takes its old output for a source file.
"""

from collections.abc import Iterable, Mapping
from typing import Any, TypeAlias

from stronge1994.judging.comparisons import Comparison, Metric
from stronge1994.names import SCENE
from stronge1994.reference_data import Fact, Inventory, Series, reference
from stronge1994.settings import figures
from stronge1994.settings.config import SHARED, Config, table_of

Comparisons: TypeAlias = Mapping[str, Comparison]


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


def of_figure(
    config: Config, inventory: Inventory, comparisons: Comparisons, figure: str
) -> dict[str, Any]:
    """What the rules of one figure need: settings of its curves and of its drawing, and files.

    Of data/ these are `tables` to solve and `series` to draw: over a figure are drawn the series
    and facts that it compares, and those under `draws`.
    """
    stated, own = figures.stated()[figure], physics(config, inventory, figure)
    nodes = _nodes(config, inventory, comparisons, figure)
    compared = [one.reference for one in of(comparisons, figure) if one.reference]
    drawn = {one.name: one for one in compared if getattr(one, "kind", "") != "computed"}
    drawn |= {full: reference(inventory, full) for full in stated.get("draws", [])}
    return {
        "curves": {"settings": own, "nodes": nodes},
        "tables": list(nodes),
        "drawing": {"settings": own, "overlays": drawn, "slide": stated.get("slide")},
        "series": _files(drawn.values()),
    }


def of_judgement(config: Config, comparisons: Comparisons, name: str) -> dict[str, Any]:
    """What the rule that judges a figure or a scene needs: settings, the table, and `series`."""
    own = of(comparisons, name)
    return {
        "settings": {
            "comparisons": own,
            "significance": config["significance"],
            "settings": settings_of(config, name),
        },
        "table": table_of(name),
        "series": _files(one.reference for one in own),
    }


def of(comparisons: Comparisons, name: str) -> list[Comparison]:
    """Comparisons of one figure or of a scene."""
    return [one for one in comparisons.values() if one.figure == name]


def settings_of(config: Config, name: str) -> dict[str, Any]:
    """Settings of a figure or of a scene, as the config has them."""
    if name.startswith(SCENE):
        return dict(config["scenes"][name.removeprefix(SCENE)])
    shared = figures.stated()[name].get("shared", [])
    return {key: config[key] for key in shared} | config["figures"][name]


def _files(known: Iterable[Series | Fact | None]) -> list[str]:
    """Files of the series at hand, in order."""
    return sorted({one.path for one in known if isinstance(one, Series) and one.path})


def _nodes(
    config: Config, inventory: Inventory, comparisons: Comparisons, figure: str
) -> dict[str, str | None]:
    """Tables through whose points curves must pass: `{path: column of x}`, None for all of it."""
    stated = figures.stated()[figure]
    for key, setting in stated["settings"].items():
        if setting.get("allowed") == "table":
            series = reference(inventory, config["figures"][figure][key])
            return dict.fromkeys(_files([series]))
    own = of(comparisons, figure) if stated.get("nodes") else []
    exact = [one.reference for one in own if one.metric == Metric.VERTICES]
    return {
        one.path: one.x.name
        for one in exact
        if isinstance(one, Series) and one.path and "event" not in one.labels
    }
