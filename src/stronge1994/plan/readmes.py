"""The tables of figures and of sources in the READMEs, made from their folders.

After a figure or a source was added: `.venv/bin/python -m stronge1994.plan.readmes`.
"""

import re
from collections.abc import Iterable
from pathlib import Path

from stronge1994 import reference_data
from stronge1994.plan import figures

ROOT = Path(__file__).parents[3]


def texts() -> dict[Path, str]:
    """Each README with its table as it must be."""
    pictures = [(f"`{name}`", told["shows"]) for name, told in figures.stated().items()]
    sources = [
        (f"`{path.parent.name}`", told["holds"], told["made"])
        for path in sorted(ROOT.glob("data/*/source.yaml"))
        for told in [reference_data.load_yaml(path)]
    ]
    return {
        ROOT / "figures/README.md": _filled(
            "figures", _table(("figure", "what it shows"), pictures)
        ),
        ROOT / "data/README.md": _filled(
            "sources", _table(("source", "what it holds", "how it was made"), sources)
        ),
    }


def _filled(name: str, table: str) -> str:
    folder = {"figures": "figures", "sources": "data"}[name]
    text = (ROOT / folder / "README.md").read_text(encoding="utf-8")
    start, end = f"<!-- {name} -->\n", "<!-- end -->"
    return re.sub(f"{start}.*?{end}", lambda _: f"{start}{table}{end}", text, flags=re.S)


def _table(header: Iterable[str], rows: Iterable[Iterable[str]]) -> str:
    head = tuple(header)
    return "".join(f"| {' | '.join(row)} |\n" for row in (head, ("---",) * len(head), *rows))


if __name__ == "__main__":
    for path, text in texts().items():
        path.write_text(text, encoding="utf-8")
