"""The figure of workflow/add_a_figure.md, added as it stands: two folders, and nothing else."""

import json
import re

from stronge1994 import csv_tables
from tests.workflow.project import ROOT

FILE = re.compile(r"^`((?:src|data)/[\w/.]+)`.*?\n\n```\w+\n(.*?)^```", re.M | re.S)
JOBS = ["all", "report"]


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
    assert result.returncode == 0 and "fig10: no comparison fails." in result.stdout
    verdicts = csv_tables.read_rows(fresh / "results/verdicts/fig10.csv")
    assert {r["verdict"] for r in verdicts if r["comparison"] == "fig10-line"} == {"right"}
    assert (fresh / "figures/fig10.svg").stat().st_size > 1000
    # Nothing else has to name it: a whole run judges it too, and its report shows it.
    plans = [json.loads((fresh / f"results/plans/{job}.json").read_text()) for job in JOBS]
    assert "fig10-line" in plans[0]["settings"]["comparisons"]
    assert "Friction takes the same" in plans[1]["settings"]["captions"]["fig10"]
    assert "sliding_line" in plans[1]["settings"]["sources"]
