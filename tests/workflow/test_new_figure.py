"""The figure of workflow/README.md, added as it stands there: two folders, and nothing else."""

import re

from stronge1994 import csv_tables
from tests.workflow.project import ROOT

FILE = re.compile(r"^`((?:src|data)/[\w/.]+)`.*?\n\n```\w+\n(.*?)^```", re.M | re.S)


def test_a_figure_of_the_readme_is_drawn_judged_and_reported(finished):
    text = (ROOT / "workflow/README.md").read_text(encoding="utf-8").split("## Add a figure")[1]
    files = dict(FILE.findall(text))
    assert sorted(path.rpartition("/")[2] for path in files) == [
        "curves.py", "drawing.py", "figure.yaml", "source.yaml", "velocity.csv",
    ]  # fmt: skip
    for path, content in files.items():
        (finished / path).parent.mkdir(parents=True, exist_ok=True)
        (finished / path).write_text(content)
    result = finished.run()
    assert result.returncode == 0 and (finished / "results/PASSED").exists(), result.stdout
    verdicts = csv_tables.read_rows(finished / "results/verdicts.csv")
    assert {r["verdict"] for r in verdicts if r["comparison"] == "fig10-line"} == {"right"}
    assert (finished / "figures/fig10.svg").stat().st_size > 1000
    report = (finished / "figures/report.html").read_text(encoding="utf-8")
    assert "Friction takes the same from every impact" in report and 'id="fig10"' in report
    assert "sliding_line" in (finished / "figures/sources.html").read_text(encoding="utf-8")
