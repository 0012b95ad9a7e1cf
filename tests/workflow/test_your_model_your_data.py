"""The page workflow/your_model_your_data.md, typed from top to bottom in a fresh copy."""

import os
import re
import subprocess
import sys

import pytest

from stronge1994 import judging, reference_data
from stronge1994.judging.comparisons import Comparison
from stronge1994.settings.figures import expanded
from tests.workflow.project import ROOT

TEXT = (ROOT / "workflow/your_model_your_data.md").read_text(encoding="utf-8")
FOLDER = "src/stronge1994/studies/marble"
NOT_RUN = "<!-- not run"


def blocks():
    """Kind and content of each block of code, and the words before it."""
    parts = re.split(r"^```", TEXT, flags=re.M)
    for words, block in zip(parts[::2], parts[1::2], strict=False):
        kind, _, content = block.partition("\n")
        yield kind, content, words


@pytest.fixture
def typed(fresh, tmp_path_factory):
    """The copy after all was typed, and pairs of what was said and what was printed."""
    home = tmp_path_factory.mktemp("home")
    (home / "marble").mkdir()
    (fresh / ".venv").symlink_to(sys.prefix)
    folder, printed, pairs = home / "marble", "", []
    path = f"{fresh / '.venv/bin'}:{os.environ['PATH']}"
    environment = os.environ | {"HOME": str(home), "PATH": path}
    for kind, content, words in blocks():
        folder = fresh.folder if "## 2. Your data" in words else folder
        paths = re.findall(r"`(~?[\w/]+/\w+\.\w+)`", words)
        if kind == "text":
            pairs.append((content, printed))
        elif kind == "sh" and NOT_RUN not in words:
            found = subprocess.run(
                ["bash", "-e", "-c", content],
                cwd=folder,
                env=environment,
                capture_output=True,
                text=True,
            )
            printed = found.stdout
            assert found.returncode == 0, found.stdout + found.stderr
        elif kind != "sh" and paths:
            inside = paths[-1].startswith("~")
            path = home / paths[-1][2:] if inside else fresh / paths[-1]
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(content)
    return fresh, pairs


@pytest.mark.slow
def test_a_stranger_adds_a_model_and_a_series_and_sees_them_judged(typed):
    project, pairs = typed
    assert len(pairs) == 2
    for said, printed in pairs:
        assert printed == said
    assert (project / "figures/marble.svg").stat().st_size > 10_000

    # The last block says what is known of a difference.
    folder = project / FOLDER
    text, known = (folder / "figure.yaml").read_text(), list(blocks())[-1][1]
    assert "    each: {model: *models}\n" in text
    (folder / "figure.yaml").write_text(text.replace("    each: {model: *models}\n", known))
    ((name, entry),) = reference_data.load_yaml(folder / "figure.yaml")["comparisons"].items()
    found = {"marble": reference_data.load(project / "data/marble")}
    known = reference_data.reference(found, entry["reference"])
    every = [Comparison(own, **one | {"reference": known}) for own, one in expanded(name, entry)]
    rows = judging.compare("marble", project / "results/curves/marble.csv", every, 0.001, {})
    assert [row["verdict"] for row in rows] == ["cannot tell", "differs"]
