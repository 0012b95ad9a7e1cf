"""Settings and references that the rules need before they run."""

from collections.abc import Mapping
from typing import Any

from stronge1994 import reference_data
from stronge1994.plan import figures
from stronge1994.plan.config import (
    SHARED,
    Config,
    Entry,
    Inventory,
    judged,
    reference,
    table_of,
)

# Properties of a material. Their parameters in source.yaml begin with its name.
PROPERTIES = ("young_modulus", "poisson_ratio")


def settings(config: Config, inventory: Inventory, figure: str) -> dict[str, Any]:
    """Settings of one figure: shared physics and its own, an experiment by its parameters."""
    stated = figures.stated()[figure]
    own = config["figures"][figure]
    chosen = {key: config[key] for key in stated.get("shared", [])} | own
    for key, setting in stated["settings"].items():
        if setting.get("allowed") == "source":
            parameters = inventory[own[key]]["parameters"]
            known = {name: parameters[name] for name in setting["parameters"]}
            chosen[key] = {name: parameter["value"] for name, parameter in known.items()}
            if setting.get("uncertain"):
                sigmas = {name: parameter["uncertainty"] for name, parameter in known.items()}
                chosen["uncertainty"] = {name: sigma for name, sigma in sigmas.items() if sigma}
        if setting.get("materials"):
            chosen |= materials(inventory[own[key].split("/")[0]]["parameters"])
    return chosen


def materials(stated: Mapping[str, Mapping[str, Any]]) -> dict[str, Any]:
    """Settings that hold the materials among the parameters of a source, and one sigma of each.

    >>> number = {"value": 70e9, "uncertainty": 1e9}
    >>> ratio = {"value": 0.22, "uncertainty": 0.02}
    >>> named = materials({"float_glass_young_modulus": number, "float_glass_poisson_ratio": ratio})
    >>> named["materials"]
    {'material': ['float_glass'], 'young_modulus': [70000000000.0], 'poisson_ratio': [0.22]}
    >>> named["uncertainty"]["poisson_ratio"]
    [0.02]
    """
    end = f"_{PROPERTIES[0]}"
    names = [name.removesuffix(end) for name in stated if name.endswith(end)]

    def column(key: str) -> dict[str, list[float]]:
        return {part: [stated[f"{name}_{part}"][key] for name in names] for part in PROPERTIES}

    return {
        "materials": {"material": names} | column("value"),
        "uncertainty": column("uncertainty"),
    }


def settings_of_explorer(config: Config) -> dict[str, Any]:
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


def expected_rows(config: Config, inventory: Inventory) -> dict[str, bool]:
    """Rows that the table of verdicts must have: `{comparison: is it awaited}`."""
    rows = {f"{name}-solved": False for name in judged(config)}
    for name in judged(config):
        known = references(config, inventory, name)
        for title, entry in comparisons(config, name).items():
            series = known.get(entry.get("reference", ""), {})
            rows[title] = series.get("kind") == "awaited"
    return rows


def expected_alone(
    rows: Mapping[str, bool], config: Config, name: str
) -> dict[str, str | dict[str, bool]]:
    """Settings of the gate of one figure or scene: its table of verdicts, and the rows of it."""
    own = {f"{name}-solved", *comparisons(config, name)}
    return {
        "table": f"results/verdicts/{name}.csv",
        "comparisons": {title: waits for title, waits in rows.items() if title in own},
    }


def plan_of_judgement(config: Config, inventory: Inventory, name: str) -> dict[str, Any]:
    """Settings of the job that judges one figure or scene, and the files that it reads."""
    job_settings = {
        "comparisons": comparisons(config, name),
        "references": references(config, inventory, name),
        "significance": config["significance"],
    }
    series = files_of_series(config, inventory, name)
    return {"settings": job_settings, "table": table_of(name), "series": series}


def plan_of_figure(config: Config, inventory: Inventory, figure: str) -> dict[str, Any]:
    """Settings of the rules of one figure, and the files that they read.

    It is called for each figure before Snakemake looks at a rule: where an input function raises,
    Snakemake drops the rule and silently takes its old output for a source file.
    """
    tables = nodes_of(config, inventory, figure)
    return {
        "settings": settings(config, inventory, figure),
        "nodes": tables,
        "tables": list(tables),
        "overlays": overlays(config, inventory, figure),
        "series": files_of_series(config, inventory, figure),
    }


def references(config: Config, inventory: Inventory, name: str) -> dict[str, Entry]:
    """Series and facts that comparisons name, with the parameters of their source."""
    named = [c["reference"] for c in comparisons(config, name).values() if "reference" in c]
    return {full: _with_parameters(inventory, full) for full in named}


def _with_parameters(inventory: Inventory, full: str) -> Entry:
    stated = inventory[full.split("/")[0]]["parameters"]
    parameters = {key: parameter["value"] for key, parameter in stated.items()}
    return reference(inventory, full)[1] | {"parameters": parameters}


def series_of(config: Config, inventory: Inventory, figure: str) -> dict[str, Entry]:
    """Series at hand that a figure compares or draws: `{source/series: entry}`."""
    chosen = references(config, inventory, figure)
    asked = figures.stated().get(figure, {}).get("draws", [])
    chosen |= {full: _with_parameters(inventory, full) for full in asked}
    return {name: entry for name, entry in chosen.items() if entry.get("path")}


def files_of_series(config: Config, inventory: Inventory, figure: str) -> list[str]:
    """Files of the series at hand for one figure, in order."""
    return sorted({entry["path"] for entry in series_of(config, inventory, figure).values()})


def overlays(config: Config, inventory: Inventory, figure: str) -> dict[str, Entry]:
    """Series and facts to draw over one figure: those that it compares, and those under `draws`."""
    named = references(config, inventory, figure).items()
    asked = figures.stated()[figure].get("draws", [])
    chosen = {name: entry for name, entry in named if "statement" in entry}
    for name, entry in series_of(config, inventory, figure).items():
        if entry["kind"] != "computed" or name in asked:
            chosen[name] = entry
    return chosen


def nodes_of(config: Config, inventory: Inventory, figure: str) -> dict[str, str | None]:
    """Tables through whose points curves must pass: `{path: column of x}`, None for all of it."""
    stated = figures.stated()[figure]
    for key, setting in stated["settings"].items():
        if setting.get("allowed") == "table":
            _, table = reference(inventory, config["figures"][figure][key])
            return {table["path"]: None}
    if not stated.get("nodes"):
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
