"""Page of the sources of data, settings and versions of a run."""

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import yaml

from stronge1994.pages import templates

# Settings that all figures share.
SHARED = ("mass_ratio", "stiffness_ratio", "significance")


def page(
    sources: Mapping[str, Any],
    config: Mapping[str, Any],
    run: Mapping[str, Any],
    template: Path,
) -> str:
    """The page of sources and settings, from data/*/source.yaml and the config of the run."""
    comparisons = config["comparisons"].items()
    settings = {
        figure: {"figures": {figure: entry}}
        | {"comparisons": {name: c for name, c in comparisons if c["figure"] == figure}}
        for figure, entry in config["figures"].items()
    }
    environment = templates.environment(template.parent)
    return environment.get_template(template.name).render(
        sources=sources,
        shared={key: config[key] for key in SHARED},
        settings={figure: in_yaml(part) for figure, part in settings.items()},
        run=run,
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
