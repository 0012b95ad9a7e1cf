"""The errors that workflow/README.md explains come in its words, and end by what it says."""

import base64
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


def test_a_killed_run(fresh):
    table = "results/series/kharaz2001.csv"
    assert fresh.run(table).returncode == 0
    marks = fresh / ".snakemake"
    (marks / "locks").mkdir(exist_ok=True)
    (marks / "locks/0.output.lock").write_text(f"{table}\n")
    assert "--unlock" in explained(fresh.run(table, "--force"))
    assert fresh.run("--unlock").returncode == 0

    (marks / "incomplete").mkdir(exist_ok=True)
    (marks / "incomplete" / base64.b64encode(table.encode()).decode()).write_text("")
    again = fresh.run(table)
    assert again.returncode == 0 and "Reading the series" in again.stdout
