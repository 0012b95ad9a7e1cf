"""The errors that workflow/README.md explains come in its words, and end by what it says."""

import re
from pathlib import Path

README = (Path(__file__).parents[2] / "workflow/README.md").read_text(encoding="utf-8")
SECTION = README.split("## Troubleshooting")[1].split("\n## ")[0]


def explained(result):
    """The row of the README whose words a failed run has printed."""
    assert result.returncode != 0, result.stdout
    rows = re.findall(r"^\| `(.*?)`.*? \| (.*) \|$", SECTION, flags=re.M)
    assert len(rows) >= 5
    said = [advice for words, advice in rows if words in result.stdout]
    assert len(said) == 1, result.stdout
    return said[0]


def test_another_folder(fresh):
    (fresh / "Snakefile").unlink()
    assert "another folder" in explained(fresh.run())


def test_braces_without_quotes(fresh):
    unquoted = ["figures={fig6:", "{restitution:", "[0,", "0.9]}}"]
    assert "quotes" in explained(fresh.run("--config", *unquoted))
