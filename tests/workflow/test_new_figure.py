"""The figure of workflow/add_a_figure.md, added as it stands: two folders, and nothing else."""

import re

from stronge1994 import tables
from tests.workflow.project import ROOT

FILE = re.compile(r"^`((?:src|data)/[\w/.]+)`.*?\n\n```\w+\n(.*?)^```", re.M | re.S)


def test_a_figure_of_the_readme_is_drawn_and_judged_alone(fresh):
    text = (ROOT / "workflow/add_a_figure.md").read_text(encoding="utf-8")
    files = dict(FILE.findall(text))
    assert sorted(path.rpartition("/")[2] for path in files) == [
        "curves.py", "drawing.py", "figure.yaml", "source.yaml", "velocity.csv",
    ]  # fmt: skip
    for path, content in files.items():
        (fresh / path).parent.mkdir(parents=True, exist_ok=True)
        (fresh / path).write_text(content)
    result = fresh.run("fig10")
    assert result.returncode == 0 and "New: nobody has accepted fig10-line yet." in result.stdout
    verdicts = tables.read_rows(fresh / "results/verdicts/fig10.csv")
    assert {r["verdict"] for r in verdicts if r["comparison"] == "fig10-line"} == {"passed"}
    assert (fresh / "figures/fig10.svg").stat().st_size > 1000
    # Nothing else has to name it: a whole run judges it too.
    assert "results/verdicts/fig10.csv" in fresh.run("--summary").stdout
