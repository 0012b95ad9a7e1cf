"""The tables of figures and of sources in the READMEs, made from their folders.

A test compares them, and writes them where they differ.
"""

import re
from collections.abc import Iterable
from pathlib import Path

from stronge1994 import reference_data
from stronge1994.plan import figures

ROOT = Path(__file__).parents[3]


def texts() -> dict[Path, str]:
    """Each README with its table as it must be."""
    pictures = [(f"`{name}`", content["shows"]) for name, content in figures.stated().items()]
    sources = [
        (f"`{path.parent.name}`", content["holds"], content["made"])
        for path in sorted(ROOT.glob("data/*/source.yaml"))
        for content in [reference_data.load_yaml(path)]
    ]
    tables: dict[Path, list[tuple[str, ...]]] = {
        ROOT / "figures/README.md": [("figure", "what it shows"), ("---",) * 2, *pictures],
        ROOT / "data/README.md": [
            ("source", "what it holds", "how it was made"), ("---",) * 3, *sources,
        ],
    }  # fmt: skip
    return {path: _filled(path.read_text(encoding="utf-8"), rows) for path, rows in tables.items()}


def _filled(text: str, rows: Iterable[Iterable[str]]) -> str:
    """A README whose table, between its marks, has these rows."""
    table = "".join(f"| {' | '.join(row)} |\n" for row in rows)
    marks = r"(<!-- (?:figures|sources) -->\n).*?(<!-- end -->)"
    return re.sub(marks, lambda mark: f"{mark[1]}{table}{mark[2]}", text, flags=re.S)
