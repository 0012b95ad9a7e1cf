"""What the parameter study is, before it runs: its grid, checked."""

import math
from typing import Any

from stronge1994.plan.config import SHARED, Config, ConfigError

MOST = 100_000_000  # points: the gathered study holds 25 bytes of each in memory
ELASTIC = ("continuum", "annuli")  # models without hysteresis


def settings(config: Config) -> dict[str, Any]:
    """Model, its settings and the whole grid: an axis left out has its shared value."""
    study = config["study"]
    grid = {key: [config[key]] for key in SHARED} | study["grid"]
    return {"model": study["model"], "settings": study.get("settings", {}), "grid": grid}


def count(config: Config) -> int:
    """How many points the grid has."""
    axes = settings(config)["grid"].values()
    return math.prod(axis["points"] if isinstance(axis, dict) else len(axis) for axis in axes)


def check(config: Config) -> None:
    """Refuse a study that its schema cannot: naming the field, its value and what is allowed."""
    study = config["study"]
    for name, axis in study["grid"].items():
        ends = [axis["from"], axis["to"]] if isinstance(axis, dict) else axis
        if any(low >= high for low, high in zip(ends, ends[1:], strict=False)):
            raise ConfigError(f"config: study.grid.{name} = {axis}: the numbers must ascend")
    model, chosen = study["model"], study.get("settings")
    if model in ELASTIC and study["grid"]["restitution"] != [1]:
        raise ConfigError(
            f"config: study.grid.restitution = {study['grid']['restitution']}: {model} is elastic; "
            "allowed is [1]"
        )
    if chosen:
        # Here, not above: it takes a third of a second, which every start would pay.
        from planarimpact import models
        from planarimpact.ground import checks

        try:
            models.refuse_unknown(models.get(model), chosen)
        except checks.InputError as error:
            raise ConfigError(f"config: study.settings.{error}") from None
    points = count(config)
    if points > MOST:
        raise ConfigError(f"config: study.grid: {points} points; allowed are up to {MOST}")
    if study["chunks"] > points:
        raise ConfigError(
            f"config: study.chunks = {study['chunks']}: allowed are up to {points}, one a point"
        )
