"""What a folder of a figure may state, and how a faulty one is refused."""

import sys
from types import SimpleNamespace

import numpy as np
import pytest

from stronge1994.figures.shared.curves import solving
from stronge1994.plan import figures
from stronge1994.reference_data import SourceError

GOOD = """\
shows: a curve of mine
caption: A caption of more than thirty letters.
settings:
  friction: {value: 0.5, allowed: friction}
  points: {value: mine/pairs, allowed: table}
comparisons:
  "line-{e}":
    each: {e: [0.5, 1]}
    curve: "e = {e}"
    reference: mine/line
    metric: distance
    reason: a line that is known
"""


CURVES = "def curves(friction, points, nodes, samples=3): ...\n"


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """An own folder of figures, with one."""
    (tmp_path / "fig10").mkdir()
    for name, text in (("figure.yaml", GOOD), ("curves.py", CURVES), ("drawing.py", "")):
        (tmp_path / "fig10" / name).write_text(text)
    monkeypatch.setattr(figures, "FOLDER", tmp_path)
    figures.stated.cache_clear()
    yield tmp_path
    figures.stated.cache_clear()


def test_a_good_folder_is_read_and_bytecode_is_none(folder):
    for path in (folder, folder / "fig10", folder / "gone"):
        (path / "__pycache__").mkdir(parents=True)
        (path / "__pycache__/a.pyc").touch()
    assert list(figures.stated()) == ["fig10"]
    assert figures.values(figures.stated()["fig10"]["settings"])["friction"] == 0.5
    found = figures.comparisons()
    assert {name: entry["curve"] for name, entry in found.items()} == {
        "fig10-line-0.5": "e = 0.5", "fig10-line-1": "e = 1",
    }  # fmt: skip


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("shows:", "show:", "fig10/figure.yaml: top level: .*'show' was .*; allowed are shows, "),
        ("allowed: friction", "allowed: frictoin", "settings: allowed: 'frictoin' is no kind"),
        ("value: 0.5", "value: 50", "figure.yaml: settings: friction: 50 is greater than the max"),
        ("allowed: friction", "allowed: {type: nubmer}", "friction.allowed.type: 'nubmer' is not"),
        ("value: 0.5, allowed: friction", "value: [1, 0], allowed: {ascending: true}", "larger th"),
        ('curve: "e = {e}"', 'curve: "e = {f}"', "comparisons.line-{e}: `each` has no {f}"),
        ("e: [0.5, 1]", "e: [1, 1]", "comparisons.line-{e}: 'line-1' stands twice"),
    ],
)
def test_a_faulty_figure_is_refused(old, new, words, folder):
    assert old in GOOD
    (folder / "fig10/figure.yaml").write_text(GOOD.replace(old, new, 1))
    with pytest.raises(SourceError, match=words) as refusal:
        figures.comparisons()
    assert "\n" not in str(refusal.value)


@pytest.mark.parametrize("name", ["figure.yaml", "drawing.py"])
def test_a_file_that_is_missing_is_named(name, folder):
    (folder / "fig10" / name).unlink()
    with pytest.raises(SourceError, match=f"fig10/{name}: (missing|No such file)"):
        figures.stated()


def test_a_bad_name_is_refused(folder):
    (folder / "fig10").rename(folder / "Fig-10")
    with pytest.raises(SourceError, match="Fig-10: allowed are a to z, 0 to 9 and _"):
        figures.stated()


def test_curves_that_are_not_finite_are_none(tmp_path, monkeypatch):
    columns = {"x [1]": np.array([0.5, 1.5]), "y [1]": np.array([0.0, np.nan])}
    module = SimpleNamespace(curves=lambda: {"mine": columns})
    monkeypatch.setitem(sys.modules, "stronge1994.figures.mine.curves", module)
    with pytest.raises(ValueError, match="'mine', column 'y.*' is nan where .* is 1.5"):
        solving.solve("mine", {}, {}, str(tmp_path / "mine.csv"))
    assert not (tmp_path / "mine.csv").exists()
