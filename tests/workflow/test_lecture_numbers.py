"""The cell of numbers of a lecture: it feeds all cells, and refuses what is not allowed."""

import ast
import re

import matplotlib
import nbformat
import pytest

from tests.workflow.project import ROOT

FOLDER = ROOT / "workflow/notebooks"
NAMES = "choosing_a_model", "where_friction_turns_round"
WRONG = "0,5", "'0.5'", "None", "float('nan')", "-1", "1e9"


def code_of(name):
    """The cells of code of a lecture by their ids, without its checks."""
    cells = nbformat.read(FOLDER / f"{name}.ipynb", as_version=4).cells
    return {
        cell.id: cell.source
        for cell in cells
        if cell.cell_type == "code" and "check" not in cell.metadata.get("tags", ())
    }


def numbers_of(name):
    """The names of the numbers that a student may change."""
    return re.findall(r"^([A-Z_]+) = ", code_of(name)["numbers"], flags=re.M)


@pytest.mark.parametrize("name", NAMES)
def test_each_wrong_number_is_one_sentence_with_its_name_and_what_is_allowed(name, monkeypatch):
    monkeypatch.chdir(FOLDER)
    matplotlib.use("Agg")
    code, names = code_of(name), {}
    with matplotlib.rc_context():
        exec(code["style"], names)
    exec(code["numbers"], names)
    for number in numbers_of(name):
        for entry in WRONG:
            changed, count = re.subn(
                rf"(?m)^{number} = \S+", f"{number} = {entry}", code["numbers"]
            )
            assert count == 1
            with pytest.raises(ValueError, match=rf"^{number} = .*: allowed is one number") as said:
                exec(changed, names)  # `allow` looks there
            assert "\n" not in str(said.value)
        exec(code["numbers"], names)


@pytest.mark.parametrize("name", NAMES)
def test_each_number_is_used_and_each_cell_to_play_with_starts_from_them(name):
    code = code_of(name)
    cells = list(code)
    below = {place: code[place] for place in cells[cells.index("numbers") + 1 :]}
    for number in numbers_of(name):
        assert re.search(rf"\b{number}\b", "\n".join(below.values())), number
    games = [source for source in below.values() if re.search(r"^play\(", source, flags=re.M)]
    assert len(games) == 3
    for game in games:
        shown = next(one for one in ast.parse(game).body if isinstance(one, ast.FunctionDef))
        starts = {getattr(value, "id", ast.unparse(value)) for value in shown.args.defaults}
        assert starts and starts <= {*numbers_of(name)}
        assert "print(f" in ast.unparse(shown), "says what it used"
