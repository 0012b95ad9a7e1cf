"""Page of the sources of data and settings of a run."""

import json
from collections import Counter
from collections.abc import Mapping
from typing import Any

import yaml

from stronge1994.pages import templates
from stronge1994.settings.config import SHARED

# Kinds of reference data, in the order in which their sources stand; facts are stated.
KINDS = ("measured", "digitised", "stated", "computed", "awaited")


def kinds(source: Mapping[str, Any]) -> list[str]:
    """Kind of each series and fact of a source.

    >>> kinds({"series": {"a": {"kind": "computed"}}, "facts": {"b": {"statement": "so"}}})
    ['computed', 'stated']
    """
    series = source.get("series", {}).values()
    return [entry["kind"] for entry in series] + ["stated"] * len(source.get("facts", {}))


def by_kind(sources: Mapping[str, Any]) -> dict[str, Any]:
    """Sources in the order of `KINDS`; one of several kinds stands with its first.

    >>> of = {kind: {"series": {"a": {"kind": kind}}} for kind in ("computed", "stated")}
    >>> list(by_kind(of))
    ['stated', 'computed']
    """

    def rank(name: str) -> int:
        return min(map(KINDS.index, kinds(sources[name])), default=len(KINDS))

    return {name: sources[name] for name in sorted(sources, key=rank)}


def used(source: str, comparisons: Mapping[str, Any]) -> list[str]:
    """Figures and scenes with curves that are compared with a source.

    >>> used("maw1976", {"fig5-maw": {"figure": "fig5", "reference": "maw1976/rebound"}})
    ['fig5']
    """
    every = (c for c in comparisons.values() if c.get("reference", "").split("/")[0] == source)
    return list(dict.fromkeys(c["figure"] for c in every))


def page(sources: Mapping[str, Any], config: Mapping[str, Any]) -> str:
    """The page of sources and settings, from data/*/source.yaml and the config of the run."""
    comparisons = config["comparisons"].items()
    settings = {
        figure: {"figures": {figure: entry}}
        | {"comparisons": {name: c for name, c in comparisons if c["figure"] == figure}}
        for figure, entry in config["figures"].items()
    }
    environment = templates.environment()
    environment.filters["in_yaml"] = in_yaml
    environment.filters["counts"] = lambda source: Counter(kinds(source))
    return environment.get_template("sources.html").render(
        sources=by_kind(sources),
        used={name: used(name, config["comparisons"]) for name in sources},
        shared={key: config[key] for key in (*SHARED, "significance")},
        settings={figure: in_yaml(part) for figure, part in settings.items()},
    )


def in_yaml(document: Any) -> str:
    """A part of the config as it stands in its files.

    >>> print(in_yaml({"restitution": [0.5, 1]}), end="")
    restitution: [0.5, 1]
    """
    copy = json.loads(json.dumps(document))  # equal parts of one document would get anchors
    return yaml.safe_dump(
        copy, sort_keys=False, default_flow_style=None, width=96, allow_unicode=True
    )
