"""What a folder of a figure may state; tests/refusals has what it may not."""

import contextlib
from unittest import mock

from stronge1994.names import home
from stronge1994.settings import figures

GOOD = """\
shows: a curve of mine
caption: A caption of more than thirty letters.
settings:
  friction: {value: 0.5, allowed: friction}
  points: {value: mine/pairs, allowed: table}
comparisons:
  "line-{e}":
    each: {e: [0.5, 1]}
    curve: {model: lumped, e: "{e}"}
    reference: mine/line
    metric: distance
    reason: a line that is known
"""


CURVES = "def curves(friction, points, nodes, samples=3): ...\n"


@contextlib.contextmanager
def folder_with(folder, old="", new="", without="", name="fig10"):
    """Figures are those of a folder, with one, after a change of what it states."""
    assert old in GOOD
    own = folder / home(name) / name
    own.mkdir(parents=True)
    stated = GOOD.replace(old, new, 1)
    for file, text in (("figure.yaml", stated), ("curves.py", CURVES), ("drawing.py", "")):
        if file != without:
            (own / file).write_text(text)
    figures.stated.cache_clear()
    try:
        with mock.patch.object(figures, "PACKAGE", folder):
            yield
    finally:
        figures.stated.cache_clear()


def test_a_good_folder_is_read_and_bytecode_is_none(tmp_path):
    with folder_with(tmp_path):
        studies = tmp_path / "studies"
        for path in (studies, studies / "fig10", studies / "gone"):
            (path / "__pycache__").mkdir(parents=True)
            (path / "__pycache__/a.pyc").touch()
        assert list(figures.stated()) == ["fig10"]
        assert figures.values(figures.stated()["fig10"]["settings"])["friction"] == 0.5
        found = figures.comparisons()
    assert {name: entry["curve"]["e"] for name, entry in found.items()} == {
        "fig10-line-0.5": 0.5, "fig10-line-1": 1,
    }  # fmt: skip
